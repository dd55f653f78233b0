// The QFunction of an operator as a matrix at each point, and what is kept of it.
#include <algorithm>

#include "assembly.hpp"

namespace {

using hg::require;
using hg::text;

/// Values of assembled QFunctions that are held at once by diagonal and full assembly: few enough to stay in the second
/// cache, but those of one group of elements at least, as many as backends work on side by side.
constexpr CeedSize chunk_values = CeedSize{1} << 16;
constexpr CeedInt chunk_group = 8;

/// Number of points of all elements.
CeedSize total_points(const CeedProgram &program) {
  if (!program.at_points) return static_cast<CeedSize>(program.num_elem) * program.num_qpts;
  CeedSize count = 0;
  for (CeedInt e = 0; e < program.num_elem; e++) count += hg::num_points(program, e);
  return count;
}

/// Calls visit(first, last, values) for elements [first, last) and the number of values of their assembled QFunctions.
template <typename Visit>
void for_each_chunk(const CeedProgram &program, Visit &&visit) {
  const CeedSize num_comp = static_cast<CeedSize>(program.num_active_in) * program.num_active_out;
  const auto group_end = [&](CeedInt e) { return e + std::min(chunk_group, program.num_elem - e); };
  const auto size = [&](CeedInt first, CeedInt last) {
    CeedSize count = 0;
    for (CeedInt e = first; e < last; e++) count += hg::num_points(program, e) * num_comp;
    return count;
  };
  for (CeedInt first = 0, last = 0; first < program.num_elem; first = last) {
    last = group_end(first);
    CeedSize count = size(first, last);
    while (last < program.num_elem) {
      const CeedSize next = size(last, group_end(last));
      if (count + next > chunk_values) break;
      count += next;
      last = group_end(last);
    }
    visit(first, last, count);
  }
}

/// Restriction of the assembled QFunction: all its components at all points.
hg::Ref<CeedElemRestriction_private> assembled_restriction(CeedOperator_private &op, const CeedProgram &program) {
  const CeedInt num_comp = program.num_active_in * program.num_active_out;
  CeedElemRestriction rstr = nullptr;
  if (!program.at_points) {
    const CeedInt Q = program.num_qpts;
    const CeedInt strides[3] = {1, Q, Q * num_comp};
    hg::check(CeedElemRestrictionCreateStrided(op.ceed.get(), program.num_elem, Q, num_comp,
                                               total_points(program) * num_comp, strides, &rstr));
  } else {
    // Points are stored one element after another, whatever their numbers in the operator's own restriction.
    const CeedInt count = static_cast<CeedInt>(total_points(program));
    std::vector<CeedInt> offsets{program.num_elem + 1};
    for (CeedInt e = 0; e < program.num_elem; e++) offsets.push_back(offsets.back() + hg::num_points(program, e));
    for (CeedInt i = 0; i < count; i++) offsets.push_back(i);
    hg::check(CeedElemRestrictionCreateAtPoints(op.ceed.get(), program.num_elem, count, num_comp,
                                                static_cast<CeedSize>(count) * num_comp, CEED_MEM_HOST,
                                                CEED_COPY_VALUES, offsets.data(), &rstr));
  }
  return hg::Ref<CeedElemRestriction_private>::adopt(rstr);
}

void require_places(const CeedVector *assembled, const CeedElemRestriction *rstr) {
  hg::require_argument(assembled, "assembled (where the handle goes)");
  hg::require_argument(rstr, "rstr (where the handle goes)");
}

void assemble_qfunction(CeedOperator op, CeedVector *assembled, CeedElemRestriction *rstr) {
  const CeedProgram &program = hg::program_of(hg::deref(op, "CeedOperator"));
  require_places(assembled, rstr);
  hg::require_linearisable(*op, program);
  auto new_rstr = assembled_restriction(*op, program);
  CeedVector vector = nullptr;
  hg::check(CeedVectorCreate(op->ceed.get(), new_rstr->l_size, &vector));
  auto new_vector = hg::Ref<CeedVector_private>::adopt(vector);
  hg::check(CeedVectorSetValue(vector, 0.0));
  if (program.num_elem > 0 && new_rstr->l_size > 0) {
    hg::check(op->ceed->ops.op.linear_assemble_qfunction(op, &program, 0, program.num_elem, vector));
  }
  *assembled = new_vector.release();
  *rstr = new_rstr.release();
}

}  // namespace

namespace hg {

CeedInt num_points(const CeedProgram &program, CeedInt e) {
  return program.at_points ? points_in_element(*program.points_rstr, e).size : program.num_qpts;
}

void require_linearisable(const CeedOperator_private &op, const CeedProgram &program) {
  require(program.num_active_in > 0 && program.num_active_out > 0, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' has %s; assembly needs an active input and an active output", op.shown_name(),
                program.num_active_in == 0 ? "no active input" : "no active output");
  });
}

void for_each_assembled(CeedOperator_private &op, const CeedProgram &program,
                        const std::function<void(const AssembledElements &)> &visit) {
  require_linearisable(op, program);
  if (op.reuses_assembly) {
    CeedVector assembled = nullptr;
    CeedElemRestriction rstr = nullptr;
    check(CeedOperatorLinearAssembleQFunctionBuildOrUpdate(&op, &assembled, &rstr, CEED_REQUEST_IMMEDIATE));
    const auto held_vector = Ref<CeedVector_private>::adopt(assembled);
    const auto held_rstr = Ref<CeedElemRestriction_private>::adopt(rstr);
    const ReadArray array(assembled);
    const CeedScalar *values = array.data();
    for_each_chunk(program, [&](CeedInt first, CeedInt last, CeedSize count) {
      visit({program, first, last, values});
      values += count;
    });
    return;
  }
  Ref<CeedVector_private> values;
  for_each_chunk(program, [&](CeedInt first, CeedInt last, CeedSize count) {
    if (count == 0) return visit({program, first, last, nullptr});
    if (!values || values->length < count) {
      CeedVector created = nullptr;
      check(CeedVectorCreate(op.ceed.get(), count, &created));
      values = Ref<CeedVector_private>::adopt(created);
    }
    check(op.ceed->ops.op.linear_assemble_qfunction(&op, &program, first, last - first, values.get()));
    const ReadArray array(values.get());
    visit({program, first, last, array.data()});
  });
}

bool assemble_on_backend(CeedOperator_private &op, const CeedProgram &program, CeedAssembleKind kind, CeedSize offset,
                         CeedVector values) {
  require_linearisable(op, program);
  const auto assemble = op.ceed->ops.op.linear_assemble;
  if (assemble == nullptr || op.reuses_assembly) return false;
  bool is_done = false;
  check(assemble(&op, &program, kind, offset, values, &is_done));
  return is_done;
}

bool contract_on_backend(CeedOperator_private &op, const Coupling &coupling, CeedAssembleKind kind,
                         const AssembledElements &elements, CeedScalar *entries) {
  const auto contract = op.ceed->ops.op.linear_assemble_elements;
  if (contract == nullptr || elements.values == nullptr) return false;
  bool is_done = false;
  check(contract(&op, &elements.program, coupling.source, coupling.sink, kind, elements.first,
                 elements.last - elements.first, elements.values, entries, &is_done));
  return is_done;
}

}  // namespace hg

int CeedOperatorSetQFunctionAssemblyReuse(CeedOperator op, bool reuse_assembly_data) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::for_each_single(hg::deref(op, "CeedOperator"), [&](CeedOperator_private &single) {
      single.reuses_assembly = reuse_assembly_data;
      single.assembly_needs_update = true;
    });
  });
}

int CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(CeedOperator op, bool needs_data_update) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::for_each_single(hg::deref(op, "CeedOperator"),
                        [&](CeedOperator_private &single) { single.assembly_needs_update = needs_data_update; });
  });
}

int CeedOperatorLinearAssembleQFunction(CeedOperator op, CeedVector *assembled, CeedElemRestriction *rstr,
                                        CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { assemble_qfunction(op, assembled, rstr); });
}

int CeedOperatorLinearAssembleQFunctionBuildOrUpdate(CeedOperator op, CeedVector *assembled, CeedElemRestriction *rstr,
                                                     CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] {
    const CeedProgram &program = hg::program_of(hg::deref(op, "CeedOperator"));
    require_places(assembled, rstr);
    // Points may have moved since: what was kept for them does not fit the new ones.
    const bool fits = op->assembled && (!program.at_points || !op->assembly_needs_update);
    if (!fits) {
      CeedVector vector = nullptr;
      CeedElemRestriction restriction = nullptr;
      assemble_qfunction(op, &vector, &restriction);
      op->assembled = hg::Ref<CeedVector_private>::adopt(vector);
      op->assembled_rstr = hg::Ref<CeedElemRestriction_private>::adopt(restriction);
    } else if (op->assembly_needs_update || !op->reuses_assembly) {
      if (program.num_elem > 0) {
        hg::check(op->ceed->ops.op.linear_assemble_qfunction(op, &program, 0, program.num_elem, op->assembled.get()));
      }
    }
    op->assembly_needs_update = false;
    const auto hand_out = [](auto &held, auto *handle) {
      auto copy = held;
      auto old = *handle;
      *handle = copy.release();
      hg::destroy(&old);
    };
    hand_out(op->assembled, assembled);
    hand_out(op->assembled_rstr, rstr);
  });
}

int CeedOperatorAssemblyDataStrip(CeedOperator op) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::for_each_single(hg::deref(op, "CeedOperator"), [](CeedOperator_private &single) {
      single.assembled = {};
      single.assembled_rstr = {};
      single.assembly_needs_update = true;
    });
  });
}
