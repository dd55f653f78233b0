#include "block_operator.hpp"

#include <algorithm>
#include <cstdint>

namespace hg::host {

bool BlockOperator::takes(const Kernels &kernels, const CeedProgram &program) {
  CeedInt vec_length = 1;
  chk(CeedQFunctionGetVectorLength(program.qf, &vec_length));
  return !program.at_points && static_cast<CeedSize>(program.num_qpts) * kernels.width % vec_length == 0;
}

BlockOperator::BlockOperator(const Kernels &kernels, const CeedProgram &program)
    : kernels_(&kernels), W_(kernels.width), Q_(program.num_qpts) {
  chk(CeedQFunctionGetUserFunction(program.qf, &function_));
  chk(CeedQFunctionGetVectorLength(program.qf, &vec_length_));
  for (CeedInt s = 0; s < program.num_sources; s++) {
    sources_.push_back({BlockMap(kernels, program.sources[s].rstr), -1, program.sources[s].is_active});
  }
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    sinks_.push_back({BlockMap(kernels, program.sinks[t].rstr), -1, program.sinks[t].is_active});
  }
  std::vector<CeedBasis> handles;
  for (CeedInt i = 0; i < program.num_spaces; i++) {
    const auto found = std::find(handles.begin(), handles.end(), program.spaces[i].basis);
    basis_of_space_.push_back(static_cast<CeedInt>(found - handles.begin()));
    if (found != handles.end()) continue;
    handles.push_back(program.spaces[i].basis);
    bases_.emplace_back(kernels, program.spaces[i].basis);
  }
  place_inputs(program);
  place_outputs(program);
  std::size_t work = 0;
  for (const auto &basis : bases_) work = std::max(work, basis.work_size());
  for (const auto *sides : {&sources_, &sinks_}) {
    for (const Side &side : *sides) work = std::max(work, side.map.work_size());
  }
  work_ = arena_.add(work);
}

/// Not before they are used: where `gen` has compiled the loop and blocks are full, they never are.
void BlockOperator::make_arrays(const CeedProgram &program) {
  if (!in_.empty() || !out_.empty()) return;
  arena_.allocate();
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    in_.push_back(arena_[input_arrays_[i]]);
    const bool is_new = std::none_of(input_values_.begin(), input_values_.end(),
                                     [&](const PointArray &other) { return other.array == input_arrays_[i]; });
    if (is_new) input_values_.push_back({input_arrays_[i], program.inputs[i].size});
  }
  for (CeedInt o = 0; o < program.num_outputs; o++) {
    out_.push_back(arena_[output_arrays_[o]]);
    output_values_.push_back({output_arrays_[o], program.outputs[o].size});
  }
  fill_weights(program);
  plan_ahead();
}

void BlockOperator::fill_weights(const CeedProgram &program) {
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    if (program.inputs[i].eval_mode != CEED_EVAL_WEIGHT) continue;
    const auto &weights = basis(program.inputs[i].space).weights();
    CeedScalar *values = arena_[input_arrays_[i]];
    for (CeedInt q = 0; q < Q_; q++) std::fill_n(values + static_cast<std::size_t>(q) * W_, W_, weights[q]);
  }
}

/// Passive inputs that are the same values share an array: the QFunction only reads them. Active ones do not: assembly
/// gives each its own values.
void BlockOperator::place_inputs(const CeedProgram &program) {
  for (CeedInt i = 0; i < program.num_inputs; i++) {
    const CeedProgramField &field = program.inputs[i];
    const std::size_t size = static_cast<std::size_t>(field.size) * Q_ * W_;
    if (field.eval_mode == CEED_EVAL_WEIGHT) {
      input_arrays_.push_back(arena_.add(size));
    } else if (field.eval_mode == CEED_EVAL_NONE) {
      const auto same = std::find_if(copies_in_.begin(), copies_in_.end(), [&](const Copy &copy) {
        return copy.side == field.side && !sources_[field.side].is_active;
      });
      const int array = same == copies_in_.end() ? arena_.add(size) : same->array;
      if (same == copies_in_.end()) copies_in_.push_back({field.side, array});
      input_arrays_.push_back(array);
    } else {
      Evaluation &evaluation = evaluation_of(evaluations_, field, !sources_[field.side].is_active);
      int &place = evaluation.array_of(field);
      if (place < 0) place = arena_.add(size);
      input_arrays_.push_back(place);
      Side &source = sources_[field.side];
      if (source.block < 0) source.block = arena_.add(source.map.block_size());
    }
  }
}

void BlockOperator::place_outputs(const CeedProgram &program) {
  for (CeedInt o = 0; o < program.num_outputs; o++) {
    const CeedProgramField &field = program.outputs[o];
    output_arrays_.push_back(arena_.add(static_cast<std::size_t>(field.size) * Q_ * W_));
    if (field.eval_mode == CEED_EVAL_NONE) {
      add_result(field.side, output_arrays_.back());
      continue;
    }
    evaluation_of(integrations_, field, false).array_of(field) = output_arrays_.back();
    Side &sink = sinks_[field.side];
    if (sink.block < 0) {
      sink.block = arena_.add(sink.map.block_size());
      add_result(field.side, sink.block);
    }
  }
}

void BlockOperator::add_result(CeedInt side, int array) {
  results_.push_back({side, array, arena_.add(sinks_[side].map.block_size())});
}

/// What is stored at the points streams by once: the largest such source of the next block is asked for while this one
/// is worked on, a few lines at each step.
void BlockOperator::plan_ahead() {
  CeedSize largest = 0;
  for (const Copy &copy : copies_in_) {
    const CeedSize bytes = sources_[copy.side].map.stored_size() * W_ * static_cast<CeedSize>(sizeof(CeedScalar));
    if (bytes <= largest) continue;
    largest = bytes;
    ahead_source_ = copy.side;
  }
  if (largest == 0) return;
  // A block of zeros counts the steps.
  ahead_ = {.next = 0, .lines = 1};
  evaluate(std::vector<const CeedScalar *>(sources_.size(), arena_[0]));
  integrate();
  const auto steps = static_cast<CeedSize>(ahead_.next / Ahead::line);
  ahead_.lines = steps == 0 ? 0 : static_cast<CeedInt>((largest / Ahead::line + steps - 1) / steps);
}

void BlockOperator::ask_for_block(CeedSize first, const std::vector<const CeedScalar *> &sources) {
  if (ahead_.lines == 0) return;
  const CeedSize entry = first * sources_[ahead_source_].map.stored_size();
  ahead_.next = reinterpret_cast<std::uintptr_t>(sources[ahead_source_]) + entry * sizeof(CeedScalar);
}

void BlockOperator::evaluate(const std::vector<const CeedScalar *> &sources) {
  CeedScalar *work = arena_[work_];
  for (const Evaluation &e : evaluations_) {
    if (sources[e.side] == nullptr) continue;
    basis(e.space).evaluate(arena_[sources_[e.side].block], arena_[e.interp], arena_[e.derivative], work, ahead_);
  }
}

/// Nodes lie scattered in L-vectors: what this block will be added to, and what the next one gathers, is on its way
/// while this one is worked on.
void BlockOperator::ask_for_nodes(CeedInt first, CeedInt num_elem, CeedInt end, const ProgramArrays &arrays) const {
  for (const Result &result : results_) {
    sinks_[result.side].map.ask(first, num_elem, arrays.sinks()[result.side], true);
  }
  if (end - first <= W_) return;
  const CeedInt next = first + W_;
  for (std::size_t s = 0; s < sources_.size(); s++) {
    if (sources_[s].block >= 0) sources_[s].map.ask(next, std::min(W_, end - next), arrays.sources()[s], false);
  }
}

/// The QFunction's inputs for a block of elements; sources that are NULL are left out.
void BlockOperator::read(CeedInt first, CeedInt num_elem, const std::vector<const CeedScalar *> &sources) {
  CeedScalar *work = arena_[work_];
  for (std::size_t s = 0; s < sources_.size(); s++) {
    if (sources[s] != nullptr && sources_[s].block >= 0) {
      sources_[s].map.gather(first, num_elem, sources[s], arena_[sources_[s].block], work);
    }
  }
  evaluate(sources);
  for (const Copy &copy : copies_in_) {
    if (sources[copy.side] == nullptr) continue;
    sources_[copy.side].map.gather(first, num_elem, sources[copy.side], arena_[copy.array], work);
  }
}

/// Calls the QFunction at the points of the elements that there are. Where they do not fill the lanes, the points are
/// moved together first: a QFunction may count or sum in its context, so that each point comes once (but for those that
/// fill up the QFunction's vector length).
void BlockOperator::call(const CeedProgram &program, CeedInt first, CeedInt num_elem, void *context) {
  const CeedInt num_points = num_elem == W_ ? Q_ * W_ : (Q_ * num_elem + vec_length_ - 1) / vec_length_ * vec_length_;
  if (num_elem < W_) {
    for (const PointArray &input : input_values_) narrow(num_elem, num_points, input.size, arena_[input.array]);
  }
  const int code = function_(context, num_points, in_.data(), out_.data());
  if (num_elem < W_) {
    // Inputs, too: assembly calls again with all of them but one.
    for (const PointArray &input : input_values_) widen(num_elem, num_points, input.size, arena_[input.array]);
    for (const PointArray &output : output_values_) widen(num_elem, num_points, output.size, arena_[output.array]);
    fill_weights(program);
  }
  check_returned(program, code, first, num_elem);
}

/// From W lanes to those of n elements, in place; `stride` points of a component, the last one repeated where they are
/// more than there are.
void BlockOperator::narrow(CeedInt n, CeedInt stride, CeedInt size, CeedScalar *values) const {
  for (CeedInt c = 0; c < size; c++) {
    const CeedScalar *from = values + static_cast<std::size_t>(c) * Q_ * W_;
    CeedScalar *to = values + static_cast<std::size_t>(c) * stride;
    for (CeedInt q = 0; q < Q_; q++) std::copy_n(from + q * W_, n, to + q * n);
    std::fill(to + Q_ * n, to + stride, to[Q_ * n - 1]);
  }
}

/// The way back; lanes without an element are zero.
void BlockOperator::widen(CeedInt n, CeedInt stride, CeedInt size, CeedScalar *values) const {
  for (CeedInt c = size - 1; c >= 0; c--) {
    const CeedScalar *from = values + static_cast<std::size_t>(c) * stride;
    CeedScalar *to = values + static_cast<std::size_t>(c) * Q_ * W_;
    for (CeedInt q = Q_ - 1; q >= 0; q--) {
      std::copy_backward(from + q * n, from + (q + 1) * n, to + q * W_ + n);
      std::fill(to + q * W_ + n, to + (q + 1) * W_, 0.0);
    }
  }
}

void BlockOperator::integrate() {
  for (const Evaluation &e : integrations_) {
    basis(e.space).integrate(arena_[e.interp], arena_[e.derivative], arena_[sinks_[e.side].block], e.add, arena_[work_],
                             ahead_);
  }
}

/// Integrates the QFunction's outputs and adds them to the L-vectors of the sinks.
void BlockOperator::write(CeedInt first, CeedInt num_elem, const std::vector<CeedScalar *> &sinks) {
  integrate();
  for (const Result &result : results_) {
    sinks_[result.side].map.to_rows(first, num_elem, arena_[result.array], arena_[result.rows], arena_[work_]);
  }
  for_lanes(results_.size(), num_elem, [&](CeedInt lane, CeedInt end) {
    for (const Result &result : results_) {
      sinks_[result.side].map.scatter_add(first, num_elem, lane, end, arena_[result.rows], sinks[result.side]);
    }
  });
}

void BlockOperator::apply_from(CeedInt first_elem, const CeedProgram &program, const ProgramArrays &arrays,
                               void *context) {
  make_arrays(program);
  for_blocks(first_elem, program.num_elem, W_, [&](CeedInt first, CeedInt num_elem) {
    ask_for_block(static_cast<CeedSize>(first) + W_, arrays.sources());
    read(first, num_elem, arrays.sources());
    ask_for_nodes(first, num_elem, program.num_elem, arrays);
    call(program, first, num_elem, context);
    write(first, num_elem, arrays.sinks());
  });
}

void BlockOperator::apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  ProgramArrays arrays(program, in, out, mode);
  ContextData context(program.qf);
  apply_from(0, program, arrays, context.data());
  context.release();
  arrays.release();
}

/// Column by column: the QFunction of a unit value of each active input, all others zero.
void BlockOperator::linear_assemble_qfunction(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem,
                                              CeedVector values) {
  make_arrays(program);
  ProgramArrays arrays(program);
  Writer assembled(values, Writer::write_only);
  ContextData context(program.qf);
  const CeedInt num_in = program.num_active_in, num_out = program.num_active_out, row = Q_ * W_;
  const std::size_t of_element = static_cast<std::size_t>(Q_) * num_in * num_out;
  std::vector<CeedScalar> rows(row);
  const auto fill_input = [&](CeedInt i, CeedInt c, CeedScalar value) {
    std::fill_n(arena_[input_arrays_[i]] + static_cast<std::size_t>(c) * row, row, value);
  };
  for_blocks(first_elem, first_elem + num_elem, W_, [&](CeedInt first, CeedInt lanes) {
    ask_for_block(static_cast<CeedSize>(first) + lanes, arrays.sources());
    read(first, lanes, arrays.sources());
    for_each_active(program.inputs, program.num_inputs, [&](CeedInt i, CeedInt c, CeedInt) { fill_input(i, c, 0); });
    for_each_active(program.inputs, program.num_inputs, [&](CeedInt i, CeedInt c, CeedInt column) {
      fill_input(i, c, 1);
      call(program, first, lanes, context.data());
      fill_input(i, c, 0);
      for_each_active(program.outputs, program.num_outputs, [&](CeedInt o, CeedInt d, CeedInt value) {
        kernels_->to_rows(Q_, arena_[output_arrays_[o]] + static_cast<std::size_t>(d) * row, rows.data());
        for (CeedInt lane = 0; lane < lanes; lane++) {
          std::copy_n(rows.data() + static_cast<std::size_t>(lane) * Q_, Q_,
                      assembled.data() + (first - first_elem + lane) * of_element +
                          (static_cast<std::size_t>(column) * num_out + value) * Q_);
        }
      });
    });
  });
  context.release();
  assembled.release();
  arrays.release();
}

}  // namespace hg::host
