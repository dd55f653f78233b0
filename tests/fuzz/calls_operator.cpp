// Calls on operators.
#include <algorithm>

#include "objects.hpp"

namespace hg::fuzz {
namespace {

/// A name of a field of the operator's QFunction, or any.
const char *field_name(Objects &o, CeedOperator op) {
  const int choice = o.bytes.next_byte();
  const char *name = o.name();
  CeedQFunction qf = nullptr;
  if (choice >= 240 || op == nullptr || CeedOperatorGetQFunction(op, &qf) != CEED_ERROR_SUCCESS) return name;
  CeedInt num_in = 0, num_out = 0;
  CeedQFunctionField *in = nullptr, *out = nullptr;
  if (CeedQFunctionGetFields(qf, &num_in, &in, &num_out, &out) == CEED_ERROR_SUCCESS && num_in + num_out > 0) {
    const CeedInt i = choice % (num_in + num_out);
    CeedQFunctionFieldGetName(i < num_in ? in[i] : out[i - num_in], &name);
  }
  CeedQFunctionDestroy(&qf);
  return name;
}

int set_field(Objects &o) {
  const CeedOperator op = o.op();
  const char *name = field_name(o, op);
  const CeedElemRestriction rstr = o.restriction();
  const CeedBasis basis = o.basis();
  return CeedOperatorSetField(op, name, rstr, basis, o.vector());
}

/// A vector of the active length, or any.
CeedVector active(Objects &o, CeedOperator op, bool is_input) {
  if (o.bytes.next_byte() >= 128) return o.vector();
  CeedSize in = 0, out = 0;
  if (op == nullptr || CeedOperatorGetActiveVectorLengths(op, &in, &out) != CEED_ERROR_SUCCESS) return o.vector();
  const CeedSize length = is_input ? in : out;
  return length < 0 ? CEED_VECTOR_NONE : o.temporary(length, 0.5);
}

template <int (*Apply)(CeedOperator, CeedVector, CeedVector, CeedRequest *)>
int apply(Objects &o) {
  const CeedOperator op = o.op();
  const CeedVector in = active(o, op, true), out = active(o, op, false);
  return Apply(op, in, out, o.request());
}

int set_context(Objects &o) {
  double doubles[8] = {};
  std::int32_t integers[8] = {};
  bool flags[8] = {};
  const CeedOperator from = o.op(), op = o.flag() ? from : o.op();
  static const char *const names[] = {"a", "b", "c", ""};
  CeedContextFieldLabel label = nullptr;
  if (from != nullptr) CeedOperatorGetContextFieldLabel(from, names[o.slot() % 4], &label);
  switch (o.bytes.next_byte() % 3) {
    case 0:
      return CeedOperatorSetContextDouble(op, label, doubles);
    case 1:
      return CeedOperatorSetContextInt32(op, label, integers);
    default:
      return CeedOperatorSetContextBoolean(op, label, flags);
  }
}

int read_context(Objects &o) {
  const double *doubles = nullptr;
  const std::int32_t *integers = nullptr;
  const bool *flags = nullptr;
  std::size_t num = 0;
  const CeedOperator from = o.op(), op = o.flag() ? from : o.op();
  CeedContextFieldLabel label = nullptr;
  const char *name = o.name();
  if (from != nullptr) CeedOperatorGetContextFieldLabel(from, name, &label);
  int code;
  switch (o.bytes.next_byte() % 3) {
    case 0:
      code = CeedOperatorGetContextDoubleRead(op, label, &num, &doubles);
      return code != CEED_ERROR_SUCCESS ? code : CeedOperatorRestoreContextDoubleRead(op, label, &doubles);
    case 1:
      code = CeedOperatorGetContextInt32Read(op, label, &num, &integers);
      return code != CEED_ERROR_SUCCESS ? code : CeedOperatorRestoreContextInt32Read(op, label, &integers);
    default:
      code = CeedOperatorGetContextBooleanRead(op, label, &num, &flags);
      return code != CEED_ERROR_SUCCESS ? code : CeedOperatorRestoreContextBooleanRead(op, label, &flags);
  }
}

/// What a field gives out is counted.
int get_field(Objects &o) {
  const CeedOperator op = o.op();
  CeedOperatorField field = nullptr;
  const char *name = field_name(o, op);
  const int code = CeedOperatorGetFieldByName(op, name, &field);
  if (code != CEED_ERROR_SUCCESS || field == nullptr) return code;
  CeedElemRestriction rstr = nullptr;
  CeedBasis basis = nullptr;
  CeedVector vec = nullptr;
  const int told = CeedOperatorFieldGetData(field, &name, &rstr, &basis, &vec);
  CeedElemRestrictionDestroy(&rstr);
  CeedBasisDestroy(&basis);
  CeedVectorDestroy(&vec);
  return told;
}

int composite_multiplicity(Objects &o) {
  const CeedOperator op = o.op();
  CeedInt num_skip = static_cast<CeedInt>(o.bytes.next_byte() % 3);
  CeedInt skip[2] = {o.count(), o.count()};
  return CeedOperatorCompositeGetMultiplicity(op, num_skip, skip, o.vector());
}

/// Operators that a composite one applies, for sums of sums.
CeedInt num_singles(CeedOperator op) {
  bool is_composite = false;
  if (op == nullptr || CeedOperatorIsComposite(op, &is_composite) != CEED_ERROR_SUCCESS || !is_composite) return 1;
  CeedInt num = 0, total = 1;
  CeedOperator *subs = nullptr;
  CeedOperatorCompositeGetNumSub(op, &num);
  CeedOperatorCompositeGetSubList(op, &subs);
  for (CeedInt i = 0; i < num; i++) total += num_singles(subs[i]);
  return total;
}

int add_sub(Objects &o) {
  const CeedOperator composite = o.op(), sub = o.op();
  if (num_singles(composite) + num_singles(sub) > 32) return CEED_ERROR_SUCCESS;
  return CeedOperatorCompositeAddSub(composite, sub);
}

const Call calls[] = {
    {"CeedOperatorCreate", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       const CeedQFunction qf = o.qfunction();
       return o.create(o.operators, [&](CeedOperator *op) {
         return CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op);
       });
     }},
    {"CeedOperatorCreateAtPoints", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       const CeedQFunction qf = o.qfunction();
       return o.create(o.operators, [&](CeedOperator *op) {
         return CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op);
       });
     }},
    {"CeedOperatorCreateComposite", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       return o.create(o.operators, [&](CeedOperator *op) { return CeedOperatorCreateComposite(ceed, op); });
     }},
    {"CeedOperatorDestroy", false, [](Objects &o) { return o.operators.remove(o.operators.at(o.slot())); }},
    {"CeedOperatorReferenceCopy", false,
     [](Objects &o) {
       const CeedOperator op = o.op();
       return o.create(o.operators, [&](CeedOperator *copy) { return CeedOperatorReferenceCopy(op, copy); });
     }},
    {"CeedOperatorSetField", true, set_field},
    {"CeedOperatorSetField", true, set_field},
    {"CeedOperatorAtPointsSetPoints", true,
     [](Objects &o) {
       const CeedOperator op = o.op();
       const CeedElemRestriction rstr = o.restriction();
       return CeedOperatorAtPointsSetPoints(op, rstr, o.vector());
     }},
    {"CeedOperatorAtPointsGetPoints", false,
     [](Objects &o) {
       CeedElemRestriction rstr = nullptr;
       CeedVector points = nullptr;
       const int code = CeedOperatorAtPointsGetPoints(o.op(), &rstr, &points);
       CeedElemRestrictionDestroy(&rstr);
       CeedVectorDestroy(&points);
       return code;
     }},
    {"CeedOperatorCompositeAddSub", false, add_sub},
    {"CeedOperatorCompositeGetSubList", false,
     [](Objects &o) {
       const CeedOperator op = o.op();
       CeedInt num = 0;
       CeedOperator *subs = nullptr;
       const int code = CeedOperatorCompositeGetNumSub(op, &num);
       return code != CEED_ERROR_SUCCESS ? code : CeedOperatorCompositeGetSubList(op, &subs);
     }},
    {"CeedOperatorCompositeGetSubByName", false,
     [](Objects &o) {
       CeedOperator sub = nullptr;
       const CeedOperator op = o.op();
       return CeedOperatorCompositeGetSubByName(op, o.name(), &sub);
     }},
    {"CeedOperatorCompositeSetSequential", false,
     [](Objects &o) {
       const CeedOperator op = o.op();
       return CeedOperatorCompositeSetSequential(op, o.flag());
     }},
    {"CeedOperatorCompositeGetMultiplicity", true, composite_multiplicity},
    {"CeedOperatorCheckReady", false, [](Objects &o) { return CeedOperatorCheckReady(o.op()); }},
    {"CeedOperatorGetActiveVectorLengths", false,
     [](Objects &o) {
       CeedSize in = 0, out = 0;
       return CeedOperatorGetActiveVectorLengths(o.op(), &in, &out);
     }},
    {"CeedOperatorApply", true, apply<CeedOperatorApply>},
    {"CeedOperatorApplyAdd", true, apply<CeedOperatorApplyAdd>},
    {"CeedOperatorApplyAddActive", true, apply<CeedOperatorApplyAddActive>},
    {"CeedOperatorSetName", false,
     [](Objects &o) {
       const CeedOperator op = o.op();
       return CeedOperatorSetName(op, o.name());
     }},
    {"CeedOperatorGetName", false,
     [](Objects &o) {
       const char *name = nullptr;
       return CeedOperatorGetName(o.op(), &name);
     }},
    {"CeedOperatorView", false, [](Objects &o) { return CeedOperatorView(o.op(), o.flag() ? o.stream() : nullptr); }},
    {"CeedOperatorViewTerse", false, [](Objects &o) { return CeedOperatorViewTerse(o.op(), o.stream()); }},
    {"CeedOperator counts", false,
     [](Objects &o) {
       static int (*const getters[])(CeedOperator, CeedInt *) = {CeedOperatorGetNumElements,
                                                                 CeedOperatorGetNumQuadraturePoints,
                                                                 CeedOperatorGetNumArgs, CeedOperatorGetNumViewTabs};
       CeedInt value = 0;
       const CeedOperator op = o.op();
       return getters[o.bytes.next_byte() % std::size(getters)](op, &value);
     }},
    {"CeedOperator flags", false,
     [](Objects &o) {
       static int (*const getters[])(CeedOperator, bool *) = {
           CeedOperatorIsAtPoints,  CeedOperatorIsComposite, CeedOperatorHasTensorBases,
           CeedOperatorIsSetupDone, CeedOperatorIsImmutable, CeedOperatorCompositeIsSequential};
       bool value = false;
       const CeedOperator op = o.op();
       return getters[o.bytes.next_byte() % std::size(getters)](op, &value);
     }},
    {"CeedOperatorGetFlopsEstimate", false,
     [](Objects &o) {
       CeedSize flops = 0;
       return CeedOperatorGetFlopsEstimate(o.op(), &flops);
     }},
    {"CeedOperatorGetContext", false,
     [](Objects &o) {
       CeedQFunctionContext ctx = nullptr;
       const int code = CeedOperatorGetContext(o.op(), &ctx);
       CeedQFunctionContextDestroy(&ctx);
       return code;
     }},
    {"CeedOperatorSetContext (values)", true, set_context},
    {"CeedOperatorGetContext (values)", false, read_context},
    {"CeedOperatorGetFieldByName", false, get_field},
    {"CeedOperatorGetFields", false,
     [](Objects &o) {
       CeedInt num_in = 0, num_out = 0;
       CeedOperatorField *in = nullptr, *out = nullptr;
       return CeedOperatorGetFields(o.op(), &num_in, &in, &num_out, &out);
     }},
    {"CeedOperatorGetActiveBases", false,
     [](Objects &o) {
       CeedBasis in = nullptr, out = nullptr;
       const int code = CeedOperatorGetActiveBases(o.op(), &in, &out);
       CeedBasisDestroy(&in);
       CeedBasisDestroy(&out);
       return code;
     }},
    {"CeedOperatorGetActiveElemRestrictions", false,
     [](Objects &o) {
       CeedElemRestriction in = nullptr, out = nullptr;
       const int code = CeedOperatorGetActiveElemRestrictions(o.op(), &in, &out);
       CeedElemRestrictionDestroy(&in);
       CeedElemRestrictionDestroy(&out);
       return code;
     }},
};

}  // namespace

std::span<const Call> operator_calls() {
  return calls;
}

}  // namespace hg::fuzz
