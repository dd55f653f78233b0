#include "program.hpp"

#include <algorithm>

#include "operator.hpp"

namespace hg {

Program::Program(const CeedOperator_private &op) {
  const auto lower = [&](const std::vector<CeedOperatorField> &fields, std::vector<CeedProgramSide> &sides,
                         std::vector<CeedProgramField> &lowered) {
    CeedInt num_active = 0;
    for (const CeedOperatorField field : fields) {
      CeedProgramField result{};
      result.name = field->qf_field->name.c_str();
      result.eval_mode = field->qf_field->eval_mode;
      result.size = field->qf_field->size;
      const bool has_side = result.eval_mode != CEED_EVAL_WEIGHT;
      result.side = has_side ? side(sides, field->rstr.get(), field->vec.get()) : -1;
      result.space = result.eval_mode != CEED_EVAL_NONE ? space(field->rstr.get(), field->basis.get()) : -1;
      result.first_value = -1;
      if (field->is_active()) {
        result.first_value = num_active;
        num_active += result.size;
      }
      lowered.push_back(result);
    }
    return num_active;
  };
  view_.num_active_in = lower(op.input_list, sources_, inputs_);
  view_.num_active_out = lower(op.output_list, sinks_, outputs_);
  for (const auto &source : sources_) {
    for (const auto &sink : sinks_) {
      require(source.is_active || sink.is_active || source.vec != sink.vec, CEED_ERROR_INCOMPATIBLE, [&] {
        return text("CeedOperator '%s': one vector is a passive input and a passive output; expected two vectors",
                    op.shown_name());
      });
    }
  }
  view_.qf = op.qf.get();
  view_.at_points = op.is_at_points;
  view_.num_elem = op.num_elem;
  view_.num_qpts = op.num_qpts;
  view_.num_sources = static_cast<CeedInt>(sources_.size());
  view_.num_sinks = static_cast<CeedInt>(sinks_.size());
  view_.num_spaces = static_cast<CeedInt>(spaces_.size());
  view_.num_inputs = static_cast<CeedInt>(inputs_.size());
  view_.num_outputs = static_cast<CeedInt>(outputs_.size());
  view_.sources = sources_.data();
  view_.sinks = sinks_.data();
  view_.spaces = spaces_.data();
  view_.inputs = inputs_.data();
  view_.outputs = outputs_.data();
  view_.points_rstr = op.points_rstr.get();
  view_.points = op.points.get();
  view_.points_epoch = op.points_epoch;
}

bool Program::has_shape_of(const Program &other) const {
  const auto same_sides = [](const std::vector<CeedProgramSide> &a, const std::vector<CeedProgramSide> &b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const CeedProgramSide &x, const CeedProgramSide &y) {
      return x.num_comp == y.num_comp && x.is_active == y.is_active && x.is_points == y.is_points &&
             (x.is_points || (x.rstr == y.rstr && x.elem_size == y.elem_size));
    });
  };
  const auto same_fields = [](const std::vector<CeedProgramField> &a, const std::vector<CeedProgramField> &b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const CeedProgramField &x, const CeedProgramField &y) {
      return x.eval_mode == y.eval_mode && x.size == y.size && x.side == y.side && x.space == y.space &&
             x.first_value == y.first_value;
    });
  };
  return view_.num_elem == other.view_.num_elem && same_sides(sources_, other.sources_) &&
         same_sides(sinks_, other.sinks_) && same_fields(inputs_, other.inputs_) &&
         same_fields(outputs_, other.outputs_) &&
         std::equal(spaces_.begin(), spaces_.end(), other.spaces_.begin(), other.spaces_.end(),
                    [](const CeedProgramSpace &x, const CeedProgramSpace &y) { return x.basis == y.basis && x.rstr == y.rstr; });
}

CeedInt Program::side(std::vector<CeedProgramSide> &sides, CeedElemRestriction rstr, CeedVector vec) {
  rstr = first_equal(rstr);
  const auto found = std::find_if(sides.begin(), sides.end(), [&](const CeedProgramSide &other) {
    return other.vec == vec && other.rstr == rstr;
  });
  if (found != sides.end()) return static_cast<CeedInt>(found - sides.begin());
  sides.push_back({.rstr = rstr,
                   .vec = vec,
                   .num_comp = rstr->num_comp,
                   .elem_size = rstr->elem_size,
                   .is_active = vec == CEED_VECTOR_ACTIVE,
                   .is_points = rstr->is_points()});
  return static_cast<CeedInt>(sides.size()) - 1;
}

CeedElemRestriction Program::first_equal(CeedElemRestriction rstr) const {
  for (const auto *sides : {&sources_, &sinks_}) {
    for (const CeedProgramSide &other : *sides) {
      if (other.rstr == rstr || equal(*other.rstr, *rstr)) return other.rstr;
    }
  }
  return rstr;
}

CeedInt Program::space(CeedElemRestriction rstr, CeedBasis basis) {
  const auto found = std::find_if(spaces_.begin(), spaces_.end(), [&](const CeedProgramSpace &other) {
    const bool same_rstr = other.rstr == rstr || (!other.rstr->is_sentinel && !rstr->is_sentinel && equal(*other.rstr, *rstr));
    return same_rstr && equal(*other.basis, *basis);
  });
  if (found != spaces_.end()) return static_cast<CeedInt>(found - spaces_.begin());
  spaces_.push_back({.rstr = rstr, .basis = basis});
  return static_cast<CeedInt>(spaces_.size()) - 1;
}

}  // namespace hg

int CeedOperatorGetProgram(CeedOperator op, const CeedProgram **program) {
  return hg::guard(hg::ceed_of(op),
                   [&] { hg::result(program, "program") = &hg::program_of(hg::deref(op, "CeedOperator")); });
}
