#include "point_operator.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace hg::host {

bool PointOperator::takes(const Kernels &kernels, const CeedProgram &program) {
  bool takes_all = program.at_points;
  for (CeedInt i = 0; takes_all && i < program.num_spaces; i++) {
    if (program.spaces[i].rstr != CEED_ELEMRESTRICTION_NONE) {
      takes_all = PointBasis::takes(kernels, program.spaces[i].basis);
    }
  }
  return takes_all;
}

PointOperator::PointOperator(const Kernels &kernels, const CeedProgram &program)
    : PointOperator(kernels, program, {}) {}

PointOperator PointOperator::followed(const CeedProgram &program) const {
  PointOperator followed(*kernels_, program, bases_);
  followed.set_function(function_);
  return followed;
}

namespace {

/// Whether any of the fields is evaluated from nodes, or integrated to them.
bool is_any_at_nodes(const CeedProgramField *fields, CeedInt count) {
  return std::any_of(fields, fields + count, [](const CeedProgramField &field) {
    return field.eval_mode != CEED_EVAL_NONE && field.eval_mode != CEED_EVAL_WEIGHT;
  });
}

/// What is all at points is copied, and all arrays are to stream by at once: in pieces of so many points (32: 1.5 times
/// the rate that pieces of 200 have, in memory).
constexpr CeedSize few_points = 32;

}  // namespace

PointOperator::PointOperator(const Kernels &kernels, const CeedProgram &program, std::vector<PointBasis> bases)
    : kernels_(&kernels), W_(kernels.width), points_epoch_(program.points_epoch), bases_(std::move(bases)) {
  chk(CeedQFunctionGetUserFunction(program.qf, &function_));
  chk(CeedQFunctionGetVectorLength(program.qf, &vec_length_));
  has_nodes_ =
      is_any_at_nodes(program.inputs, program.num_inputs) || is_any_at_nodes(program.outputs, program.num_outputs);
  may_lie_across_ = has_nodes_ && !may_count_points(program.qf);
  chk(CeedElemRestrictionGetElementMap(program.points_rstr, &points_));
  dim_ = points_->num_comp;
  for_blocks(0, program.num_elem, W_, [&](CeedInt first, CeedInt num_elem) {
    for (const bool is_across : {false, true}) {
      most_points_ = std::max(most_points_, block(first, num_elem, is_across).stride());
    }
  });
  const CeedSize num_points = points_->offsets[program.num_elem] - points_->offsets[0];
  few_elements_ =
      std::clamp(few_points * program.num_elem / std::max<CeedSize>(num_points, 1), CeedSize(1), CeedSize(W_));
  for (CeedInt s = 0; s < program.num_sources; s++) sources_.push_back(make_side(kernels, program.sources[s]));
  for (CeedInt t = 0; t < program.num_sinks; t++) sinks_.push_back(make_side(kernels, program.sinks[t]));
  std::size_t num_bases = 0;
  for (CeedInt i = 0; i < program.num_spaces; i++) {
    const bool is_for_weights = program.spaces[i].rstr == CEED_ELEMRESTRICTION_NONE;
    basis_of_space_.push_back(is_for_weights ? -1 : static_cast<CeedInt>(num_bases));
    if (!is_for_weights && num_bases++ == bases_.size()) bases_.emplace_back(kernels, program.spaces[i].basis);
  }
  place_inputs(program);
  place_outputs(program);
  std::size_t coefficients = 0, work = 0;
  for (const auto &basis : bases_) {
    coefficients = std::max(coefficients, basis.num_coefficients());
    work = std::max(work, basis.work_size());
  }
  for (const auto *sides : {&sources_, &sinks_}) {
    for (const Side &side : *sides) work = std::max(work, side.nodes ? side.nodes->work_size() : 0);
  }
  x_ref_ = add_values(dim_);
  coefficients_ = arena_.add(coefficients * W_);
  sums_ = arena_.add(coefficients * max_width);  // of points side by side
  work_ = arena_.add(work);
}

/// Not before they are used: where `gen` has compiled the loop, they are for assembly alone.
void PointOperator::make_arrays(const CeedProgram &program) {
  if (!in_.empty() || !out_.empty()) return;
  arena_.allocate();
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    in_.push_back(arena_[input_arrays_[i]]);
    input_sizes_.push_back(program.inputs[i].size);
    if (program.inputs[i].eval_mode == CEED_EVAL_WEIGHT) std::fill_n(arena_[input_arrays_[i]], most_points_, 1.0);
  }
  for (const int array : output_arrays_) out_.push_back(arena_[array]);
}

PointOperator::Side PointOperator::make_side(const Kernels &kernels, const CeedProgramSide &side) const {
  Side made{.points = nullptr, .nodes = nullptr, .block = -1, .num_comp = side.num_comp, .is_active = side.is_active};
  if (side.is_points) {
    chk(CeedElemRestrictionGetElementMap(side.rstr, &made.points));
  } else {
    made.nodes = std::make_unique<BlockMap>(kernels, side.rstr);
  }
  return made;
}

/// Room for `size` values at each point of a block; kernels read W points at a time, beyond the last one too.
int PointOperator::add_values(CeedInt size) {
  return arena_.add(static_cast<std::size_t>(size) * most_points_ + max_width);
}

/// Room for a side's nodes; false where there was.
bool PointOperator::add_nodes(Side &side) {
  if (side.block >= 0) return false;
  side.block = arena_.add(side.nodes->block_size());
  return true;
}

void PointOperator::place_inputs(const CeedProgram &program) {
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    const CeedProgramField &field = program.inputs[i];
    input_arrays_.push_back(add_values(field.size));
    if (field.eval_mode == CEED_EVAL_NONE) {
      copies_in_.push_back({field.side, input_arrays_.back()});
      const bool is_larger = largest_source_ < 0 || sources_[field.side].num_comp > sources_[largest_source_].num_comp;
      if (is_larger) largest_source_ = field.side;
    } else if (field.eval_mode != CEED_EVAL_WEIGHT) {
      evaluation_of(evaluations_, field, false).array_of(field) = input_arrays_.back();
      add_nodes(sources_[field.side]);
    }
  }
}

void PointOperator::place_outputs(const CeedProgram &program) {
  for (CeedInt o = 0; o < program.num_outputs; o++) {
    const CeedProgramField &field = program.outputs[o];
    output_arrays_.push_back(add_values(field.size));
    if (field.eval_mode == CEED_EVAL_NONE) {
      copies_out_.push_back({field.side, output_arrays_.back()});
    } else {
      evaluation_of(integrations_, field, false).array_of(field) = output_arrays_.back();
      if (add_nodes(sinks_[field.side])) {
        const Side &sink = sinks_[field.side];
        results_.push_back({field.side, sink.block, arena_.add(sink.nodes->block_size())});
      }
    }
  }
}

PointBlock PointOperator::block(CeedInt first, CeedInt num_elem, bool may_lie_across) const {
  return {*points_, W_, vec_length_, may_lie_across && may_lie_across_, first, num_elem};
}

namespace {

/// Numbers from a point on; NULL stays NULL.
template <typename Scalar>
Scalar *from_point(Scalar *values, CeedInt point) {
  return values == nullptr ? nullptr : values + point;
}

}  // namespace

/// Calls kernel(points, first of them in the arrays, lane of their element) for each element, or at once for all.
template <typename Kernel>
void PointOperator::for_points(const PointBlock &block, const PointBasis &basis, Ahead &ahead, Kernel &&kernel) const {
  PointEvaluation at{basis.dim(), basis.K(), basis.num_comp(), block.size(), arena_[x_ref_], block.stride(), &ahead};
  if (block.is_across()) return kernel(at, 0, 0);
  CeedInt point = 0;
  for (CeedInt lane = 0; lane < block.num_elem(); lane++, point += at.num_points, at.x_ref += at.num_points) {
    at.num_points = block.num_points_in(lane);
    kernel(at, point, lane);
  }
}

/// What an L-vector at points holds for the next block, taken to have as many points as this one and to lie together,
/// as it does where points are sorted by element. Elsewhere the lines that are asked for are not the right ones.
Ahead PointOperator::ask_for(const PointBlock &block, const CeedElementMap &map, const CeedScalar *l) const {
  const CeedInt next = block.first() + W_;
  if (next >= map.num_elem || map.offsets[next] == map.offsets[next + 1]) return {};
  constexpr CeedSize line = Ahead::line / static_cast<CeedSize>(sizeof(CeedScalar));
  const CeedSize steps = block.num_packs(), lines = static_cast<CeedSize>(block.num_points()) * map.num_comp / line + 1;
  return {.next = reinterpret_cast<std::uintptr_t>(l) +
                  static_cast<CeedSize>(map.offsets[map.offsets[next]]) * map.num_comp * sizeof(CeedScalar),
          .lines = static_cast<CeedInt>((lines + steps - 1) / steps)};
}

/// The QFunction's inputs for a block of elements; sources that are NULL are left out.
void PointOperator::read(const PointBlock &block, const CeedScalar *x_ref,
                         const std::vector<const CeedScalar *> &sources) {
  CeedScalar *work = arena_[work_], *coefficients = arena_[coefficients_];
  const auto gather = [&](const CeedElementMap &map, const CeedScalar *l, CeedScalar *values) {
    kernels_->gather_points(block.size(), map.num_comp, block.places(map, places_), l, map.l_size, block.stride(),
                            values);
  };
  if (has_nodes_) gather(*points_, x_ref, arena_[x_ref_]);
  for (std::size_t s = 0; s < sources_.size(); s++) {
    if (sources[s] == nullptr || sources_[s].block < 0) continue;
    sources_[s].nodes->gather(block.first(), block.num_elem(), sources[s], arena_[sources_[s].block], work);
  }
  Ahead ahead;
  if (has_nodes_) ahead = ask_for(block, *points_, x_ref);
  for (const Evaluation &e : evaluations_) {
    if (sources[e.side] == nullptr) continue;
    const PointBasis &basis = this->basis(e.space);
    basis.to_coefficients(arena_[sources_[e.side].block], coefficients, work);
    const EvaluatePoints evaluate = basis.evaluate[e.derivative >= 0][block.is_across()];
    for_points(block, basis, ahead, [&](const PointEvaluation &at, CeedInt point, CeedInt lane) {
      evaluate(at, coefficients + lane, from_point(arena_[e.interp], point), from_point(arena_[e.derivative], point));
    });
    ahead = {};
  }
  for (const Copy &copy : copies_in_) {
    if (sources[copy.side] != nullptr) gather(*sources_[copy.side].points, sources[copy.side], arena_[copy.array]);
  }
  for (std::size_t i = 0; i < input_arrays_.size(); i++) pad(block, input_sizes_[i], arena_[input_arrays_[i]]);
}

/// Fills a component's points up to the stride with the last one, which is a valid one.
void PointOperator::pad(const PointBlock &block, CeedInt size, CeedScalar *values) const {
  for (CeedInt c = 0; c < size && block.stride() > block.size(); c++) {
    CeedScalar *component = values + static_cast<std::size_t>(c) * block.stride();
    std::fill(component + block.size(), component + block.stride(), component[block.size() - 1]);
  }
}

/// Integrates the QFunction's outputs and adds them to the L-vectors of the sinks.
void PointOperator::write(const PointBlock &block, const ProgramArrays &arrays) {
  CeedScalar *work = arena_[work_], *coefficients = arena_[coefficients_];
  Ahead ahead;
  if (has_nodes_ && largest_source_ >= 0)
    ahead = ask_for(block, *sources_[largest_source_].points, arrays.sources()[largest_source_]);
  for (const Evaluation &e : integrations_) {
    const PointBasis &basis = this->basis(e.space);
    if (block.num_elem() < W_) std::fill_n(coefficients, basis.num_coefficients() * W_, 0.0);
    const IntegratePoints integrate = basis.integrate[e.derivative >= 0][block.is_across()];
    block.drop_repeated(basis.num_comp(), arena_[e.interp]);
    block.drop_repeated(basis.num_comp() * basis.dim(), arena_[e.derivative]);
    for_points(block, basis, ahead, [&](const PointEvaluation &at, CeedInt point, CeedInt lane) {
      integrate(at, from_point(arena_[e.interp], point), from_point(arena_[e.derivative], point), arena_[sums_],
                coefficients + lane);
    });
    ahead = {};
    basis.from_coefficients(coefficients, arena_[sinks_[e.side].block], e.add, work);
  }
  for (const Result &result : results_) {
    sinks_[result.side].nodes->to_rows(block.first(), block.num_elem(), arena_[result.array], arena_[result.rows],
                                       work);
  }
  for_lanes(results_.size(), block.num_elem(), [&](CeedInt lane, CeedInt end) {
    for (const Result &result : results_) {
      sinks_[result.side].nodes->scatter_add(block.first(), block.num_elem(), lane, end, arena_[result.rows],
                                             arrays.sinks()[result.side]);
    }
  });
  for (const Copy &copy : copies_out_) {
    const Side &side = sinks_[copy.side];
    const CeedInt *places = block.places(*side.points, places_);
    block.for_each_run([&](CeedInt first, CeedInt count) {
      kernels_->scatter_points[!arrays.is_set(copy.side)](
          count, side.num_comp, places + first, arena_[copy.array] + first, block.stride(), arrays.sinks()[copy.side]);
    });
  }
}

void PointOperator::apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  make_arrays(program);
  ProgramArrays arrays(program, in, out, mode, true);
  ContextData context(program.qf);
  for_blocks(0, program.num_elem, has_nodes_ ? W_ : few_elements_, [&](CeedInt first, CeedInt num_elem) {
    const PointBlock block = this->block(first, num_elem, true);
    if (block.num_points() == 0) return;
    read(block, arrays.points(), arrays.sources());
    call(program, block, context.data());
    write(block, arrays);
  });
  context.release();
  arrays.release();
}

void PointOperator::call(const CeedProgram &program, const PointBlock &block, void *context) {
  check_returned(program, function_(context, block.stride(), in_.data(), out_.data()), block.first(), block.num_elem());
}

/// Elements, a power of two, whose matrices stay in the second-level cache while column after column is written.
CeedInt PointOperator::elements_to_assemble(CeedSize numbers_of_point) const {
  constexpr CeedSize most = CeedSize{1} << 14;  // numbers: 128 KiB
  CeedInt num_elem = W_;
  while (num_elem > 1 && numbers_of_point * most_points_ / W_ * num_elem > most) num_elem /= 2;
  return num_elem;
}

/// Column by column: the QFunction of a unit value of each active input, all others zero.
void PointOperator::linear_assemble_qfunction(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem,
                                              CeedVector values) {
  make_arrays(program);
  ProgramArrays arrays(program);
  Writer assembled(values, Writer::write_only);
  ContextData context(program.qf);
  const CeedInt num_out = program.num_active_out;
  const CeedSize of_point = static_cast<CeedSize>(program.num_active_in) * num_out;
  std::vector<const CeedScalar *> results(num_out);
  CeedScalar *to = assembled.data();
  const CeedInt step = elements_to_assemble(of_point);
  for_blocks(first_elem, first_elem + num_elem, step, [&](CeedInt first, CeedInt lanes) {
    const PointBlock block = this->block(first, lanes, false);  // in the order of the list
    if (block.num_points() == 0) return;
    read(block, arrays.points(), arrays.sources());
    const auto fill_input = [&](CeedInt i, CeedInt c, CeedScalar value) {
      std::fill_n(arena_[input_arrays_[i]] + static_cast<std::size_t>(c) * block.stride(), block.stride(), value);
    };
    for_each_active(program.inputs, program.num_inputs, [&](CeedInt i, CeedInt c, CeedInt) { fill_input(i, c, 0); });
    for_each_active(program.outputs, program.num_outputs, [&](CeedInt o, CeedInt c, CeedInt d) {
      results[d] = arena_[output_arrays_[o]] + static_cast<std::size_t>(c) * block.stride();
    });
    for_each_active(program.inputs, program.num_inputs, [&](CeedInt i, CeedInt c, CeedInt column) {
      fill_input(i, c, 1);
      call(program, block, context.data());
      fill_input(i, c, 0);
      CeedScalar *row = to + column * num_out;
      for (CeedInt p = 0; p < block.num_points(); p++, row += of_point) {
        for (CeedInt d = 0; d < num_out; d++) row[d] = results[d][p];
      }
    });
    to += block.num_points() * of_point;
  });
  context.release();
  assembled.release();
  arrays.release();
}

}  // namespace hg::host
