/// v = Σ_e R_e^T B^T D(B R_e u): gather an element, evaluate at its points, call the QFunction, integrate, scatter.
#include "operator.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "../host/access.hpp"
#include "basis.hpp"
#include "restriction.hpp"

namespace hg::ref {

namespace {

using host::chk, host::ContextData, host::for_each_active, host::wall, host::Writer;

/// One element's values at its points, in the QFunction's layout: component c of point q at [c*stride + q], where the
/// stride is the number of points rounded up to the QFunction's vector length.
struct PointValues {
  std::vector<CeedScalar> values;
  CeedInt size = 0;
};

/// An operator taken apart into element maps, element bases and work arrays.
class ElementLoop {
 public:
  explicit ElementLoop(const CeedProgram &program) : program_(program), bases_(program.num_spaces) {
    chk(CeedQFunctionGetUserFunction(program.qf, &function_));
    chk(CeedQFunctionGetVectorLength(program.qf, &vec_length_));
    for (CeedInt i = 0; i < program.num_sources; i++) sources_.push_back(make_map(program.sources[i].rstr));
    for (CeedInt i = 0; i < program.num_sinks; i++) sinks_.push_back(make_map(program.sinks[i].rstr));
    for (CeedInt i = 0; i < program.num_spaces; i++) chk(ElementBasis::create(program.spaces[i].basis, &bases_[i]));
    if (program.at_points) points_ = make_map(program.points_rstr);

    const CeedInt max_points = round_up(program.num_qpts);
    const auto size_fields = [&](const CeedProgramField *fields, CeedInt count, std::vector<PointValues> &values) {
      for (CeedInt i = 0; i < count; i++) {
        values.push_back(
            {std::vector<CeedScalar>(static_cast<std::size_t>(max_points) * fields[i].size), fields[i].size});
      }
    };
    size_fields(program.inputs, program.num_inputs, inputs_);
    size_fields(program.outputs, program.num_outputs, outputs_);
    for (auto &input : inputs_) in_.push_back(input.values.data());
    for (auto &output : outputs_) out_.push_back(output.values.data());
    const auto size_sides = [](const CeedProgramSide *sides, CeedInt count,
                               std::vector<std::vector<CeedScalar>> &work) {
      for (CeedInt i = 0; i < count; i++)
        work.emplace_back(static_cast<std::size_t>(sides[i].elem_size) * sides[i].num_comp);
    };
    size_sides(program.sources, program.num_sources, source_work_);
    size_sides(program.sinks, program.num_sinks, sink_work_);
    x_ref_.resize(program.at_points ? static_cast<std::size_t>(3) * program.num_qpts : 0);
  }

  CeedInt num_points(CeedInt e) const { return program_.at_points ? points_.num_nodes(e) : program_.num_qpts; }
  CeedInt stride(CeedInt e) const { return round_up(num_points(e)); }

  /// Makes the points of element e those at which bases are evaluated; x_ref: L-vector of the coordinates.
  void set_points(CeedInt e, const CeedScalar *x_ref) {
    if (!program_.at_points) return;
    points_.gather(e, x_ref, x_ref_.data());
    for (auto &basis : bases_) basis.set_points(num_points(e), x_ref_.data());
  }

  /// Gathers source `s` of element e from its L-vector.
  void gather(CeedInt s, CeedInt e, const CeedScalar *l_vector) {
    sources_[s].gather(e, l_vector, source_work_[s].data());
  }

  /// Evaluates input i at the points from what was gathered.
  void evaluate(CeedInt i, CeedInt e) {
    const CeedProgramField &field = program_.inputs[i];
    CeedScalar *values = inputs_[i].values.data();
    const CeedInt Q = num_points(e);
    if (field.eval_mode == CEED_EVAL_WEIGHT) {
      if (program_.at_points) {
        std::fill_n(values, Q, 1.0);
      } else {
        bases_[field.space].weights(values);
      }
    } else if (field.eval_mode == CEED_EVAL_NONE) {
      std::copy_n(source_work_[field.side].data(), static_cast<std::size_t>(Q) * field.size, values);
    } else if (program_.at_points) {
      bases_[field.space].apply_at_points(field.eval_mode, source_work_[field.side].data(), values);
    } else {
      bases_[field.space].apply(field.eval_mode, source_work_[field.side].data(), values);
    }
    pad(inputs_[i], Q);
  }

  /// Calls the QFunction at the points of element e.
  void call(CeedInt e, void *context) {
    host::check_returned(program_, function_(context, stride(e), in_.data(), out_.data()), e, 1);
  }

  /// Integrates all outputs and adds them to the L-vectors of the sinks (NULL: skipped).
  void scatter_add(CeedInt e, const std::vector<CeedScalar *> &l_vectors) {
    for (auto &work : sink_work_) std::fill(work.begin(), work.end(), 0.0);
    const CeedInt Q = num_points(e);
    for (CeedInt o = 0; o < program_.num_outputs; o++) {
      const CeedProgramField &field = program_.outputs[o];
      unpad(outputs_[o], Q);
      CeedScalar *values = outputs_[o].values.data(), *work = sink_work_[field.side].data();
      if (field.eval_mode == CEED_EVAL_NONE) {
        for (CeedInt k = 0; k < Q * field.size; k++) work[k] += values[k];
      } else if (program_.at_points) {
        bases_[field.space].apply_transpose_add_at_points(field.eval_mode, values, work);
      } else {
        bases_[field.space].apply_transpose_add(field.eval_mode, values, work);
      }
    }
    for (CeedInt t = 0; t < program_.num_sinks; t++) {
      if (l_vectors[t] != nullptr) sinks_[t].scatter_add(e, sink_work_[t].data(), l_vectors[t]);
    }
  }

  /// Values of input i, component c at the points of element e.
  CeedScalar *input(CeedInt i, CeedInt c, CeedInt e) {
    return inputs_[i].values.data() + static_cast<std::size_t>(c) * stride(e);
  }
  const CeedScalar *output(CeedInt o, CeedInt c, CeedInt e) const {
    return outputs_[o].values.data() + static_cast<std::size_t>(c) * stride(e);
  }

 private:
  static ElementMap make_map(CeedElemRestriction rstr) {
    ElementMap map;
    chk(ElementMap::create(rstr, &map));
    return map;
  }

  CeedInt round_up(CeedInt n) const { return (n + vec_length_ - 1) / vec_length_ * vec_length_; }

  /// From stride Q to the padded stride; the padding repeats the last point, which is a valid one.
  void pad(PointValues &field, CeedInt Q) const {
    const CeedInt padded = round_up(Q);
    if (padded == Q) return;
    for (CeedInt c = field.size - 1; c >= 0; c--) {
      CeedScalar *to = field.values.data() + static_cast<std::size_t>(c) * padded;
      std::copy_backward(field.values.data() + static_cast<std::size_t>(c) * Q,
                         field.values.data() + static_cast<std::size_t>(c + 1) * Q, to + Q);
      std::fill(to + Q, to + padded, to[Q - 1]);
    }
  }

  void unpad(PointValues &field, CeedInt Q) const {
    const CeedInt padded = round_up(Q);
    if (padded == Q) return;
    for (CeedInt c = 1; c < field.size; c++) {
      std::copy_n(field.values.data() + static_cast<std::size_t>(c) * padded, Q,
                  field.values.data() + static_cast<std::size_t>(c) * Q);
    }
  }

  const CeedProgram &program_;
  CeedQFunctionUser function_ = nullptr;
  CeedInt vec_length_ = 1;
  std::vector<ElementMap> sources_, sinks_;
  ElementMap points_;
  std::vector<ElementBasis> bases_;
  std::vector<PointValues> inputs_, outputs_;
  std::vector<const CeedScalar *> in_;
  std::vector<CeedScalar *> out_;
  std::vector<std::vector<CeedScalar>> source_work_, sink_work_;
  std::vector<CeedScalar> x_ref_;
};

/// All elements in turn. A function of its own: among the arrays that come and go, and the handlers of errors, GCC 12
/// makes this loop a tenth slower.
[[gnu::noinline]] void apply_elements(const CeedProgram &program, ElementLoop &loop, const host::ProgramArrays &arrays,
                                      void *context) {
  for (CeedInt e = 0; e < program.num_elem; e++) {
    if (loop.num_points(e) == 0) continue;
    loop.set_points(e, arrays.points());
    for (CeedInt s = 0; s < program.num_sources; s++) loop.gather(s, e, arrays.sources()[s]);
    for (CeedInt i = 0; i < program.num_inputs; i++) loop.evaluate(i, e);
    loop.call(e, context);
    loop.scatter_add(e, arrays.sinks());
  }
}

int apply_add(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    ElementLoop loop(*program);
    host::ProgramArrays arrays(*program, in, out, mode);
    ContextData context(program->qf);
    apply_elements(*program, loop, arrays, context.data());
    context.release();
    arrays.release();
  });
}

/// Column by column: the QFunction of a unit value of each active input, all others zero.
int linear_assemble_qfunction(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                              CeedVector values) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    ElementLoop loop(*program);
    host::ProgramArrays arrays(*program);
    Writer assembled(values, Writer::write_only);
    CeedScalar *element_values = assembled.data();
    const CeedInt num_in = program->num_active_in, num_out = program->num_active_out;
    ContextData context(program->qf);
    for (CeedInt e = first_elem; e < first_elem + num_elem; e++) {
      const CeedInt Q = loop.num_points(e), stride = loop.stride(e);
      if (Q == 0) continue;
      loop.set_points(e, arrays.points());
      for (CeedInt s = 0; s < program->num_sources; s++) {
        if (arrays.sources()[s] != nullptr) loop.gather(s, e, arrays.sources()[s]);
      }
      for (CeedInt i = 0; i < program->num_inputs; i++) {
        if (program->inputs[i].first_value < 0) loop.evaluate(i, e);
      }
      for_each_active(program->inputs, program->num_inputs,
                      [&](CeedInt i, CeedInt c, CeedInt) { std::fill_n(loop.input(i, c, e), stride, 0.0); });
      for_each_active(program->inputs, program->num_inputs, [&](CeedInt i, CeedInt c, CeedInt column) {
        std::fill_n(loop.input(i, c, e), stride, 1.0);
        loop.call(e, context.data());
        std::fill_n(loop.input(i, c, e), stride, 0.0);
        for_each_active(program->outputs, program->num_outputs, [&](CeedInt o, CeedInt d, CeedInt row) {
          const CeedScalar *from = loop.output(o, d, e);
          const CeedInt component = column * num_out + row;
          for (CeedInt q = 0; q < Q; q++) {
            const std::size_t to = program->at_points ? static_cast<std::size_t>(q) * num_in * num_out + component
                                                      : static_cast<std::size_t>(component) * Q + q;
            element_values[to] = from[q];
          }
        });
      });
      element_values += static_cast<std::size_t>(Q) * num_in * num_out;
    }
    context.release();
    assembled.release();
    arrays.release();
  });
}

}  // namespace

void fill_operator_ops(CeedOperatorOps &ops) {
  ops = {.create = nullptr,
         .destroy = nullptr,
         .prepare = nullptr,
         .apply_add = apply_add,
         .apply_add_parts = nullptr,
         .linear_assemble_qfunction = linear_assemble_qfunction,
         .linear_assemble = nullptr,
         .linear_assemble_elements = nullptr,
         .get_memory = nullptr};
}

}  // namespace hg::ref
