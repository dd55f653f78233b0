/// Application.
#include <algorithm>

#include "assembly.hpp"
#include "operator.hpp"

namespace {

using hg::require;
using hg::text;

enum class Passive { write, add };

void check_vector(const CeedOperator_private &op, CeedVector vec, CeedSize expected, const char *what) {
  hg::deref(vec, what);
  if (expected < 0) return;  // an operator without an active input ignores one, without an output it gives zeros
  require(!vec->is_sentinel, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' has an active %s; expected a vector of length %" CeedSize_FMT, op.shown_name(), what,
                expected);
  });
  require(vec->length >= expected, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s': the %s vector has length %" CeedSize_FMT "; expected %" CeedSize_FMT " or more",
                op.shown_name(), what, vec->length, expected);
  });
}

/// Distinct vectors of the passive outputs.
std::vector<CeedVector> passive_outputs(CeedOperator_private &op) {
  std::vector<CeedVector> vectors;
  hg::for_each_single(op, [&](CeedOperator_private &single) {
    const CeedProgram &program = hg::program_of(single);
    for (CeedInt i = 0; i < program.num_sinks; i++) {
      const CeedVector vec = program.sinks[i].vec;
      if (!program.sinks[i].is_active && std::find(vectors.begin(), vectors.end(), vec) == vectors.end()) {
        vectors.push_back(vec);
      }
    }
  });
  return vectors;
}

/// What is read must hold values and nobody may write it, what is written must be free: checked before anything changes.
void check_access(CeedOperator_private &op, CeedVector in, CeedVector out, bool is_added, Passive passive) {
  hg::for_each_single(op, [&](CeedOperator_private &single) {
    const CeedProgram &program = hg::program_of(single);
    if (program.num_elem == 0) return;
    for (CeedInt s = 0; s < program.num_sources; s++) {
      CeedVector_private &vec = *(program.sources[s].is_active ? in : program.sources[s].vec);
      hg::require_readable(vec);
      hg::require_values(vec, "Input vector");
    }
    for (CeedInt t = 0; t < program.num_sinks; t++) {
      const CeedProgramSide &sink = program.sinks[t];
      CeedVector_private &vec = *(sink.is_active ? out : sink.vec);
      hg::require_writable(vec);
      if (sink.is_active ? is_added : passive == Passive::add) hg::require_values(vec, "Output vector that is added to");
    }
  });
}

bool is_sequential(const CeedOperator_private &op) {
  return op.is_sequential ||
         std::any_of(op.subs.begin(), op.subs.end(), [](const auto &sub) { return is_sequential(*sub); });
}

/// Whether one of the programs reads what another one writes.
bool depend_on_each_other(const std::vector<const CeedProgram *> &programs, CeedVector in) {
  const auto reads = [&](const CeedProgram &program, CeedVector vec) {
    return (program.at_points && program.points == vec) ||
           std::any_of(program.sources, program.sources + program.num_sources,
                       [&](const CeedProgramSide &source) { return (source.is_active ? in : source.vec) == vec; });
  };
  for (const CeedProgram *one : programs) {
    for (CeedInt t = 0; t < one->num_sinks; t++) {
      if (one->sinks[t].is_active) continue;
      for (const CeedProgram *other : programs) {
        if (other != one && reads(*other, one->sinks[t].vec)) return true;
      }
    }
  }
  return false;
}

bool has_active(const CeedProgramSide *sides, CeedInt count) {
  return std::any_of(sides, sides + count, [](const CeedProgramSide &side) { return side.is_active; });
}

/// What a single operator is applied to: CEED_VECTOR_NONE where it has no active input, or output.
CeedVector input_of(const CeedProgram &program, CeedVector in) {
  return has_active(program.sources, program.num_sources) ? in : CEED_VECTOR_NONE;
}
CeedVector output_of(const CeedProgram &program, CeedVector out) {
  return has_active(program.sinks, program.num_sinks) ? out : CEED_VECTOR_NONE;
}

/// All parts of a composite at once, where the backend takes that: else false.
bool apply_parts(CeedOperator_private &composite, CeedVector in, CeedVector out) {
  const auto apply_add_parts = composite.ceed->ops.op.apply_add_parts;
  if (apply_add_parts == nullptr || is_sequential(composite)) return false;
  std::vector<CeedOperator> parts;
  std::vector<const CeedProgram *> programs;
  std::vector<CeedVector> inputs, outputs;
  bool are_of_one_ceed = true;
  hg::for_each_single(composite, [&](CeedOperator_private &single) {
    const CeedProgram &program = hg::program_of(single);
    if (program.num_elem == 0) return;
    are_of_one_ceed = are_of_one_ceed && single.ceed.get() == composite.ceed.get();
    parts.push_back(&single);
    programs.push_back(&program);
    inputs.push_back(input_of(program, in));
    outputs.push_back(output_of(program, out));
  });
  if (!are_of_one_ceed || parts.size() < 2 || depend_on_each_other(programs, in)) return false;
  composite.is_joined = true;
  hg::check(apply_add_parts(&composite, static_cast<CeedInt>(parts.size()), parts.data(), programs.data(),
                            inputs.data(), outputs.data()));
  return true;
}

void apply(CeedOperator op, CeedVector in, CeedVector out, bool is_added, Passive passive) {
  hg::check_ready(hg::deref(op, "CeedOperator"));
  if (op->is_empty()) {
    if (!is_added && !hg::deref(out, "output").is_sentinel) hg::check(CeedVectorSetValue(out, 0.0));
    return;
  }
  CeedSize in_length = -1, out_length = -1;
  hg::check(CeedOperatorGetActiveVectorLengths(op, &in_length, &out_length));
  check_vector(*op, in, in_length, "input");
  check_vector(*op, out, out_length, "output");
  require(in != out || in->is_sentinel, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s': input and output are one vector; expected two", op->shown_name());
  });
  hg::require_not_read(*op, out, "output");
  check_access(*op, in, out, is_added, passive);
  if (!is_added && !out->is_sentinel) hg::check(CeedVectorSetValue(out, 0.0));
  CeedApplyMode mode = passive == Passive::write ? CEED_APPLY_ADD_ACTIVE : CEED_APPLY_ADD_ALL;
  if (op->is_composite && passive == Passive::write) {
    // Sub-operators may share a passive output: it is cleared once, then all of them add.
    for (const CeedVector vec : passive_outputs(*op)) hg::check(CeedVectorSetValue(vec, 0.0));
    mode = CEED_APPLY_ADD_ALL;
  }
  if (op->is_composite && mode == CEED_APPLY_ADD_ALL && apply_parts(*op, in, out)) return;
  hg::for_each_single(*op, [&](CeedOperator_private &single) {
    const CeedProgram &program = hg::program_of(single);
    if (program.num_elem == 0 && mode == CEED_APPLY_ADD_ALL) return;
    hg::check(single.ceed->ops.op.apply_add(&single, &program, input_of(program, in), output_of(program, out), mode));
  });
}

void prepare(CeedOperator op, CeedOperatorUse use) {
  hg::check_ready(hg::deref(op, "CeedOperator"));
  require(use >= CEED_USE_APPLY && use <= CEED_USE_ASSEMBLE_POINT_BLOCKS, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' is prepared for %d; expected a CeedOperatorUse, 0 to %d", op->shown_name(),
                static_cast<int>(use), static_cast<int>(CEED_USE_ASSEMBLE_POINT_BLOCKS));
  });
  hg::for_each_single(*op, [&](CeedOperator_private &single) {
    const CeedProgram &program = hg::program_of(single);
    const bool is_assembled = use != CEED_USE_APPLY;
    if (is_assembled) hg::require_linearisable(single, program);
    const auto prepare = single.ceed->ops.op.prepare;
    if (prepare == nullptr || program.num_elem == 0) return;
    const bool is_kept = is_assembled && single.reuses_assembly;
    hg::check(prepare(&single, &program, is_kept ? CEED_USE_ASSEMBLE_QFUNCTION : use));
  });
}

}  // namespace

int CeedOperatorPrepareFor(CeedOperator op, CeedOperatorUse use) {
  return hg::guard(hg::ceed_of(op), [&] { prepare(op, use); });
}

int CeedOperatorPrepare(CeedOperator op) {
  return hg::guard(hg::ceed_of(op), [&] { prepare(op, CEED_USE_APPLY); });
}

int CeedOperatorApply(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { apply(op, in, out, false, Passive::write); });
}

int CeedOperatorApplyAdd(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { apply(op, in, out, true, Passive::add); });
}

int CeedOperatorApplyAddActive(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { apply(op, in, out, true, Passive::write); });
}

int CeedOperatorGetFlopsEstimate(CeedOperator op, CeedSize *flops) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::check_ready(hg::deref(op, "CeedOperator"));
    CeedSize total = 0;
    hg::for_each_single(*op, [&](CeedOperator_private &single) {
      const CeedProgram &program = hg::program_of(single);
      // At points the work follows their number, which may differ between elements.
      CeedInt num_points = program.num_qpts;
      CeedSize all_points = static_cast<CeedSize>(program.num_elem) * program.num_qpts;
      if (program.at_points) {
        CeedInt in_all = 0;
        hg::check(CeedElemRestrictionGetNumPoints(program.points_rstr, &in_all));
        all_points = in_all;
        num_points = program.num_elem > 0 ? (in_all + program.num_elem - 1) / program.num_elem : 0;
      }
      const auto add_sides = [&](const CeedProgramSide *sides, CeedInt count, CeedTransposeMode t_mode) {
        for (CeedInt i = 0; i < count; i++) {
          CeedSize side_flops = 0;
          hg::check(CeedElemRestrictionGetFlopsEstimate(sides[i].rstr, t_mode, &side_flops));
          total += side_flops;
        }
      };
      const auto add_fields = [&](const CeedProgramField *fields, CeedInt count, CeedTransposeMode t_mode) {
        for (CeedInt i = 0; i < count; i++) {
          if (fields[i].space < 0 || fields[i].eval_mode == CEED_EVAL_WEIGHT) continue;
          CeedSize basis_flops = 0;
          hg::check(CeedBasisGetFlopsEstimate(program.spaces[fields[i].space].basis, t_mode, fields[i].eval_mode,
                                              program.at_points, num_points, &basis_flops));
          total += basis_flops * program.num_elem;
        }
      };
      add_sides(program.sources, program.num_sources, CEED_NOTRANSPOSE);
      add_sides(program.sinks, program.num_sinks, CEED_TRANSPOSE);
      add_fields(program.inputs, program.num_inputs, CEED_NOTRANSPOSE);
      add_fields(program.outputs, program.num_outputs, CEED_TRANSPOSE);
      CeedSize qf_flops = 0;
      hg::check(CeedQFunctionGetFlopsEstimate(program.qf, &qf_flops));
      total += qf_flops * all_points;
    });
    hg::result(flops, "flops") = total;
  });
}
