#include "staged.hpp"

#include "../host/access.hpp"

namespace hg::gpu {

using host::chk;

void StagedOperator::make_points(const CeedProgram &program) {
  if (!program.at_points) {
    points_ = Points(program.num_elem, program.num_qpts);
    return;
  }
  const CeedElementMap &map = map_of(program.points_rstr);
  std::vector<CeedInt> counts(program.num_elem);
  for (CeedInt e = 0; e < program.num_elem; e++) counts[e] = map.offsets[e + 1] - map.offsets[e];
  points_ = Points(device_, program.num_elem, counts.data());
  coordinates_ = std::make_unique<Side>(side(program.points_rstr));
}

void StagedOperator::make(const CeedProgram &program) {
  points_epoch_ = -1;  // until all is made
  sources_.clear();
  sinks_.clear();
  inputs_.clear();
  outputs_.clear();
  make_points(program);
  for (CeedInt i = 0; i < program.num_spaces; i++) tables_of(program.spaces[i].basis);  // now, not when it is applied
  for (CeedInt s = 0; s < program.num_sources; s++) sources_.push_back(side(program.sources[s].rstr));
  for (CeedInt t = 0; t < program.num_sinks; t++) sinks_.push_back(side(program.sinks[t].rstr));
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    const CeedProgramField &f = program.inputs[i];
    inputs_.push_back(f.eval_mode == CEED_EVAL_NONE ? Buffer() : field(f));
    if (f.eval_mode != CEED_EVAL_WEIGHT) continue;
    tables_of(program.spaces[f.space].basis).weights(points_, inputs_.back().as<CeedScalar>());
  }
  for (CeedInt o = 0; o < program.num_outputs; o++) outputs_.push_back(field(program.outputs[o]));
  points_epoch_ = program.points_epoch;
}

/// The QFunction's inputs from the E-vectors of the sources; those that are not evaluated are in them as they are.
void StagedOperator::evaluate(const CeedProgram &program, const Tables &tables) {
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    const CeedProgramField &field = program.inputs[i];
    if (field.eval_mode == CEED_EVAL_NONE || field.eval_mode == CEED_EVAL_WEIGHT) continue;
    tables_of(program.spaces[field.space].basis)
        .evaluate(field.eval_mode, points_, program.num_elem, tables[field.space].as<CeedScalar>(),
                  sources_[field.side].values.as<CeedScalar>(), inputs_[i].as<CeedScalar>());
  }
}

/// The E-vectors of the sinks from the QFunction's outputs.
void StagedOperator::integrate(const CeedProgram &program, const Tables &tables) {
  std::vector<bool> has_values(sinks_.size(), false);
  for (CeedInt o = 0; o < program.num_outputs; o++) {
    const CeedProgramField &field = program.outputs[o];
    const bool add = has_values[field.side];
    const CeedScalar *from = outputs_[o].as<CeedScalar>();
    CeedScalar *to = sinks_[field.side].values.as<CeedScalar>();
    has_values[field.side] = true;
    if (field.eval_mode == CEED_EVAL_NONE) {
      const CeedSize length = points_.facts().num_points * field.size;
      device_.run("hg_axpby", length, VectorJob{.length = length, .a = 1, .b = add ? 1.0 : 0.0, .x = from, .w = to});
    } else {
      tables_of(program.spaces[field.space].basis)
          .integrate(field.eval_mode, points_, program.num_elem, tables[field.space].as<CeedScalar>(), from, to, add);
    }
  }
}

void StagedOperator::apply_add(const CeedProgram &program, PointFunction &function, CeedVector in, CeedVector out,
                               CeedApplyMode mode) {
  if (program.points_epoch != points_epoch_) make(program);
  host::ProgramArrays arrays(program, in, out, mode, false, CEED_MEM_DEVICE);
  Tables tables(program.num_spaces);
  if (program.at_points) {
    CeedScalar *x_ref = coordinates_->values.as<CeedScalar>();
    coordinates_->nodes.gather(arrays.points(), x_ref);
    for (CeedInt i = 0; i < program.num_spaces; i++) {
      if (program.spaces[i].rstr == CEED_ELEMRESTRICTION_NONE) continue;  // for weights
      tables[i] = tables_of(program.spaces[i].basis).at_points(points_, x_ref);
    }
  }
  for (std::size_t s = 0; s < sources_.size(); s++) {
    sources_[s].nodes.gather(arrays.sources()[s], sources_[s].values.as<CeedScalar>());
  }
  evaluate(program, tables);
  std::vector<const CeedScalar *> inputs;
  std::vector<CeedScalar *> outputs;
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    const CeedProgramField &field = program.inputs[i];
    const bool is_evaluated = field.eval_mode != CEED_EVAL_NONE;
    inputs.push_back((is_evaluated ? inputs_[i] : sources_[field.side].values).as<CeedScalar>());
  }
  for (const Buffer &output : outputs_) outputs.push_back(output.as<CeedScalar>());
  host::check_returned(program, function.call(points_, inputs, outputs), 0, program.num_elem);
  integrate(program, tables);
  for (std::size_t t = 0; t < sinks_.size(); t++) {
    sinks_[t].nodes.scatter_add(sinks_[t].values.as<CeedScalar>(), arrays.sinks()[t]);
  }
  arrays.release();
}

std::size_t StagedOperator::num_bytes() const {
  std::size_t bytes = sizeof *this + points_.num_bytes();
  const auto add = [&](const Side &side) { bytes += side.nodes.num_bytes() + side.values.num_bytes(); };
  for (const Side &side : sources_) add(side);
  for (const Side &side : sinks_) add(side);
  if (coordinates_) add(*coordinates_);
  for (const Buffer &input : inputs_) bytes += input.num_bytes();
  for (const Buffer &output : outputs_) bytes += output.num_bytes();
  return bytes;
}

}  // namespace hg::gpu
