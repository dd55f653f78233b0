/// Creation, composition, description.
#include "operator.hpp"

#include <algorithm>

#include "view.hpp"

namespace {

hg::Ref<CeedOperator_private> create(Ceed ceed, const CeedOperator *handle) {
  hg::deref(ceed, "Ceed");
  hg::require_argument(handle, "op (where the handle goes)");
  auto op = hg::Ref<CeedOperator_private>::adopt(new CeedOperator_private);
  op->ceed = hg::Ref<Ceed_private>(ceed);
  return op;
}

hg::Ref<CeedOperator_private> create_single(Ceed ceed, CeedQFunction qf, bool is_at_points,
                                            const CeedOperator *handle) {
  hg::deref(qf, "QFunction of the operator");
  hg::require(!qf->is_sentinel, CEED_ERROR_MINOR, "The operator's QFunction is CEED_QFUNCTION_NONE; expected a QFunction");
  hg::require_gallery_fields(*qf);
  auto op = create(ceed, handle);
  op->is_at_points = is_at_points;
  op->qf = hg::Ref<CeedQFunction_private>(qf);
  qf->is_immutable = true;
  const auto make_fields = [](const std::vector<CeedQFunctionField> &qf_fields, auto &fields, auto &list) {
    for (const CeedQFunctionField qf_field : qf_fields) {
      fields.push_back(std::make_unique<CeedOperatorField_private>());
      fields.back()->qf_field = qf_field;
      list.push_back(fields.back().get());
    }
  };
  make_fields(qf->input_list, op->inputs, op->input_list);
  make_fields(qf->output_list, op->outputs, op->output_list);
  return op;
}

void require_composite(const CeedOperator_private &op) {
  hg::require(op.is_composite, CEED_ERROR_MINOR,
              [&] { return hg::text("CeedOperator '%s' is not composite", op.shown_name()); });
}

/// Whether `wanted` is the operator or in it.
bool contains(const CeedOperator_private &op, const CeedOperator_private &wanted) {
  return &op == &wanted || std::any_of(op.sub_list.begin(), op.sub_list.end(),
                                       [&](const CeedOperator sub) { return contains(*sub, wanted); });
}

void require_single(const CeedOperator_private &op) {
  hg::require(!op.is_composite, CEED_ERROR_MINOR, [&] {
    return hg::text("CeedOperator '%s' is composite; ask its sub-operators", op.shown_name());
  });
}

}  // namespace

CeedOperator_private::~CeedOperator_private() {
  if ((is_known_to_backend || is_joined) && ceed->ops.op.destroy != nullptr) ceed->ops.op.destroy(this);
}

void CeedOperator_private::view(FILE *stream, bool with_fields) const {
  const hg::Lines line(stream, num_view_tabs);
  line(0, "%sCeedOperator%s%s%s", is_composite ? "Composite " : "", is_at_points ? " AtPoints" : "",
       *full_name() == '\0' ? "" : " - ", full_name());
  if (is_composite) {
    view_parts(stream, num_view_tabs, with_fields);
  } else if (with_fields) {
    view_fields(stream, num_view_tabs);
  }
}

void CeedOperator_private::view_parts(FILE *stream, CeedInt tabs, bool with_fields) const {
  const hg::Lines line(stream, tabs);
  for (std::size_t i = 0; i < subs.size(); i++) {
    const CeedOperator_private &sub = *subs[i];
    line(1, "SubOperator %zu%s%s%s", i, sub.name.empty() ? "" : " - ", sub.name.c_str(), with_fields ? ":" : "");
    if (!with_fields) continue;
    if (sub.is_composite) {
      sub.view_parts(stream, tabs + 1, with_fields);
    } else {
      sub.view_fields(stream, tabs + 1);
    }
  }
}

void CeedOperator_private::view_fields(FILE *stream, CeedInt tabs) const {
  const hg::Lines line(stream, tabs);
  line(1, "%" CeedInt_FMT " elements with %" CeedInt_FMT " %s each", std::max(num_elem, 0), std::max(num_qpts, 0),
       is_at_points ? "max points" : "quadrature points");
  const std::size_t total = input_list.size() + output_list.size();
  line(1, "%zu field%s", total, hg::plural(total));
  const auto print = [&](const char *what, const char *title, const std::vector<CeedOperatorField> &fields) {
    line(1, "%zu %s field%s:", fields.size(), what, hg::plural(fields.size()));
    for (std::size_t i = 0; i < fields.size(); i++) {
      const CeedOperatorField_private &field = *fields[i];
      line(2, "%s field %zu:", title, i);
      line(3, "Name: \"%s\"", field.qf_field->name.c_str());
      line(3, "Size: %" CeedInt_FMT, field.qf_field->size);
      line(3, "EvalMode: %s", CeedEvalModes[field.qf_field->eval_mode]);
      if (!field.is_set()) {
        line(3, "Not set");
        continue;
      }
      if (field.basis.get() == CEED_BASIS_NONE) line(3, "No basis");
      if (field.is_active()) line(3, "Active vector");
      if (field.vec.get() == CEED_VECTOR_NONE) line(3, "No vector");
    }
  };
  print("input", "Input", input_list);
  print("output", "Output", output_list);
}

int CeedOperatorCreate(Ceed ceed, CeedQFunction qf, CeedQFunction, CeedQFunction, CeedOperator *op) {
  return hg::guard(ceed, [&] { *op = create_single(ceed, qf, false, op).release(); });
}

int CeedOperatorCreateAtPoints(Ceed ceed, CeedQFunction qf, CeedQFunction, CeedQFunction, CeedOperator *op) {
  return hg::guard(ceed, [&] { *op = create_single(ceed, qf, true, op).release(); });
}

int CeedOperatorCreateComposite(Ceed ceed, CeedOperator *op) {
  return hg::guard(ceed, [&] {
    auto created = create(ceed, op);
    created->is_composite = true;
    *op = created.release();
  });
}

int CeedOperatorReferenceCopy(CeedOperator op, CeedOperator *op_copy) {
  return hg::guard(hg::ceed_of(op), [&] { hg::reference_copy(op, op_copy); });
}

int CeedOperatorReference(CeedOperator op) {
  return hg::guard(hg::ceed_of(op), [&] { hg::reference(&hg::deref(op, "CeedOperator")); });
}

int CeedOperatorDestroy(CeedOperator *op) {
  return hg::guard(op != nullptr ? hg::ceed_of(*op) : nullptr, [&] { hg::destroy(op); });
}

int CeedOperatorCompositeAddSub(CeedOperator composite_op, CeedOperator sub_op) {
  return hg::guard(hg::ceed_of(composite_op), [&] {
    require_composite(hg::deref(composite_op, "composite CeedOperator"));
    hg::deref(sub_op, "sub-operator");
    hg::require(!composite_op->is_immutable, CEED_ERROR_MAJOR, [&] {
      return hg::text("CeedOperator '%s' takes no more sub-operators after it has been used",
                      composite_op->shown_name());
    });
    hg::require(!contains(*sub_op, *composite_op), CEED_ERROR_MINOR, [&] {
      return hg::text("CeedOperator '%s' cannot be its own sub-operator, nor one of a sub-operator",
                      composite_op->shown_name());
    });
    composite_op->sub_list.reserve(composite_op->subs.size() + 1);
    composite_op->subs.emplace_back(sub_op);
    composite_op->sub_list.push_back(sub_op);
  });
}

int CeedOperatorCompositeGetNumSub(CeedOperator op, CeedInt *num_suboperators) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_composite(hg::deref(op, "CeedOperator"));
    hg::result(num_suboperators, "num_suboperators") = static_cast<CeedInt>(op->subs.size());
  });
}

int CeedOperatorCompositeGetSubList(CeedOperator op, CeedOperator **sub_operators) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_composite(hg::deref(op, "CeedOperator"));
    hg::result(sub_operators, "sub_operators") = op->sub_list.data();
  });
}

int CeedOperatorCompositeGetSubByName(CeedOperator op, const char *op_name, CeedOperator *sub_op) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_composite(hg::deref(op, "CeedOperator"));
    hg::require(op_name != nullptr, CEED_ERROR_MINOR, [&] {
      return hg::text("CeedOperator '%s': the name of the sub-operator is NULL; expected text", op->shown_name());
    });
    hg::result(sub_op, "sub_op") = nullptr;
    for (const CeedOperator sub : op->sub_list) {
      if (sub->name == op_name) {
        *sub_op = sub;
        return;
      }
    }
  });
}

int CeedOperatorCompositeSetSequential(CeedOperator op, bool is_sequential) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_composite(hg::deref(op, "CeedOperator"));
    op->is_sequential = is_sequential;
  });
}

int CeedOperatorCompositeIsSequential(CeedOperator op, bool *is_sequential) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_composite(hg::deref(op, "CeedOperator"));
    hg::result(is_sequential, "is_sequential") = op->is_sequential;
  });
}

int CeedOperatorIsComposite(CeedOperator op, bool *is_composite) {
  return hg::guard(hg::ceed_of(op),
                   [&] { hg::result(is_composite, "is_composite") = hg::deref(op, "CeedOperator").is_composite; });
}

int CeedOperatorIsAtPoints(CeedOperator op, bool *is_at_points) {
  return hg::guard(hg::ceed_of(op),
                   [&] { hg::result(is_at_points, "is_at_points") = hg::deref(op, "CeedOperator").is_at_points; });
}

int CeedOperatorIsImmutable(CeedOperator op, bool *is_immutable) {
  return hg::guard(hg::ceed_of(op),
                   [&] { hg::result(is_immutable, "is_immutable") = hg::deref(op, "CeedOperator").is_immutable; });
}

int CeedOperatorIsSetupDone(CeedOperator op, bool *is_setup_done) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::result(is_setup_done, "is_setup_done") = hg::deref(op, "CeedOperator").is_known_to_backend;
  });
}

int CeedOperatorSetName(CeedOperator op, const char *name) {
  return hg::guard(hg::ceed_of(op), [&] { hg::deref(op, "CeedOperator").name = name != nullptr ? name : ""; });
}

int CeedOperatorGetName(CeedOperator op, const char **name) {
  return hg::guard(hg::ceed_of(op), [&] { hg::result(name, "name") = hg::deref(op, "CeedOperator").full_name(); });
}

int CeedOperatorSetNumViewTabs(CeedOperator op, CeedInt num_tabs) {
  return hg::set_view_tabs(op, num_tabs);
}

int CeedOperatorGetNumViewTabs(CeedOperator op, CeedInt *num_tabs) {
  return hg::get_view_tabs(op, num_tabs);
}

int CeedOperatorView(CeedOperator op, FILE *stream) {
  return hg::view_object(op, stream);
}

int CeedOperatorViewTerse(CeedOperator op, FILE *stream) {
  return hg::guard(hg::ceed_of(op), [&] {
    const auto &shown = hg::deref(op, "CeedOperator");
    hg::require(stream != nullptr, CEED_ERROR_MINOR, "The stream is NULL; expected an open file");
    shown.view(stream, false);
  });
}

int CeedOperatorGetCeed(CeedOperator op, Ceed *ceed) {
  return hg::get_ceed(op, ceed);
}

Ceed CeedOperatorReturnCeed(CeedOperator op) { return hg::ceed_of(op); }

int CeedOperatorGetData(CeedOperator op, void *data) {
  return hg::guard(hg::ceed_of(op),
                   [&] { hg::result(static_cast<void **>(data), "data") = hg::deref(op, "CeedOperator").data; });
}

int CeedOperatorSetData(CeedOperator op, void *data) {
  return hg::guard(hg::ceed_of(op), [&] { hg::deref(op, "CeedOperator").data = data; });
}

int CeedOperatorGetNumElements(CeedOperator op, CeedInt *num_elem) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_single(hg::deref(op, "CeedOperator"));
    hg::result(num_elem, "num_elem") = std::max(op->num_elem, 0);
  });
}

int CeedOperatorGetNumQuadraturePoints(CeedOperator op, CeedInt *num_qpts) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_single(hg::deref(op, "CeedOperator"));
    hg::result(num_qpts, "num_qpts") = std::max(op->num_qpts, 0);
  });
}

int CeedOperatorGetQFunction(CeedOperator op, CeedQFunction *qf) {
  return hg::guard(hg::ceed_of(op), [&] {
    require_single(hg::deref(op, "CeedOperator"));
    hg::hand_out(op->qf.get(), qf, "qf");
  });
}
