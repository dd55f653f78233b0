/// v = Σ_e R_e^T B^T D(B R_e u): gather an element, evaluate at its points, call the QFunction, integrate, scatter.
#include "operator.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "basis.hpp"
#include "restriction.hpp"

namespace hg::ref {

namespace {

/// What the operator's C calls return on the way out of C++ code; the error has been reported.
struct Failed {
  int code;
};

void chk(int code) {
  if (code != CEED_ERROR_SUCCESS) throw Failed{code};
}

template <typename F>
int wall(Ceed ceed, F &&f) {
  try {
    f();
    return CEED_ERROR_SUCCESS;
  } catch (const Failed &failed) {
    return failed.code > 0 ? CEED_ERROR_BACKEND : failed.code;
  } catch (const std::bad_alloc &) {
    return CeedError(ceed, CEED_ERROR_BACKEND, "Out of memory");
  } catch (const std::exception &error) {
    return CeedError(ceed, CEED_ERROR_BACKEND, "%s", error.what());
  }
}

/// A host array for a scope. release() ends it before, where an error still counts.
class Reader {
 public:
  explicit Reader(CeedVector vec) : vec_(vec) { chk(CeedVectorGetArrayRead(vec, CEED_MEM_HOST, &array_)); }
  Reader(const Reader &) = delete;
  Reader &operator=(const Reader &) = delete;
  ~Reader() {
    if (vec_ != nullptr) CeedVectorRestoreArrayRead(vec_, &array_);
  }
  void release() { chk(CeedVectorRestoreArrayRead(std::exchange(vec_, nullptr), &array_)); }
  const CeedScalar *data() const { return array_; }

 private:
  CeedVector vec_;
  const CeedScalar *array_ = nullptr;
};

class Writer {
 public:
  enum Mode { read_write, write_only };
  explicit Writer(CeedVector vec, Mode mode = read_write) : vec_(vec) {
    chk(mode == read_write ? CeedVectorGetArray(vec, CEED_MEM_HOST, &array_)
                           : CeedVectorGetArrayWrite(vec, CEED_MEM_HOST, &array_));
  }
  Writer(const Writer &) = delete;
  Writer &operator=(const Writer &) = delete;
  ~Writer() {
    if (vec_ != nullptr) CeedVectorRestoreArray(vec_, &array_);
  }
  void release() { chk(CeedVectorRestoreArray(std::exchange(vec_, nullptr), &array_)); }
  CeedScalar *data() const { return array_; }

 private:
  CeedVector vec_;
  CeedScalar *array_ = nullptr;
};

/// The context's data for a scope.
class ContextData {
 public:
  explicit ContextData(CeedQFunction qf) : qf_(qf) { chk(CeedQFunctionGetContextData(qf, CEED_MEM_HOST, &data_)); }
  ContextData(const ContextData &) = delete;
  ContextData &operator=(const ContextData &) = delete;
  ~ContextData() {
    if (qf_ != nullptr) CeedQFunctionRestoreContextData(qf_, &data_);
  }
  void release() { chk(CeedQFunctionRestoreContextData(std::exchange(qf_, nullptr), &data_)); }
  void *data() const { return data_; }

 private:
  CeedQFunction qf_;
  void *data_ = nullptr;
};

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
        values.push_back({std::vector<CeedScalar>(static_cast<std::size_t>(max_points) * fields[i].size), fields[i].size});
      }
    };
    size_fields(program.inputs, program.num_inputs, inputs_);
    size_fields(program.outputs, program.num_outputs, outputs_);
    for (auto &input : inputs_) in_.push_back(input.values.data());
    for (auto &output : outputs_) out_.push_back(output.values.data());
    const auto size_sides = [](const CeedProgramSide *sides, CeedInt count, std::vector<std::vector<CeedScalar>> &work) {
      for (CeedInt i = 0; i < count; i++) work.emplace_back(static_cast<std::size_t>(sides[i].elem_size) * sides[i].num_comp);
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
  void gather(CeedInt s, CeedInt e, const CeedScalar *l_vector) { sources_[s].gather(e, l_vector, source_work_[s].data()); }

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
    const int code = function_(context, stride(e), in_.data(), out_.data());
    if (code == 0) return;
    const char *name = nullptr;
    chk(CeedQFunctionGetKernelName(program_.qf, &name));
    throw Failed{CeedError(CeedQFunctionReturnCeed(program_.qf), CEED_ERROR_BACKEND,
                           "QFunction '%s' returned %d in element %" CeedInt_FMT "; expected 0", name, code, e)};
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

/// Read access to the reference coordinates of the points, if there are any.
std::unique_ptr<Reader> read_points(const CeedProgram &program) {
  return program.at_points ? std::make_unique<Reader>(program.points) : nullptr;
}

/// All elements in turn. A function of its own: among the arrays that come and go, and the handlers of errors, GCC 12 makes
/// this loop a tenth slower.
[[gnu::noinline]] void apply_elements(const CeedProgram &program, ElementLoop &loop, const CeedScalar *points,
                                      const std::vector<std::unique_ptr<Reader>> &sources, void *context,
                                      const std::vector<CeedScalar *> &sinks) {
  for (CeedInt e = 0; e < program.num_elem; e++) {
    if (loop.num_points(e) == 0) continue;
    loop.set_points(e, points);
    for (CeedInt s = 0; s < program.num_sources; s++) loop.gather(s, e, sources[s]->data());
    for (CeedInt i = 0; i < program.num_inputs; i++) loop.evaluate(i, e);
    loop.call(e, context);
    loop.scatter_add(e, sinks);
  }
}

int apply_add(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    ElementLoop loop(*program);
    if (mode == CEED_APPLY_ADD_ACTIVE) {
      for (CeedInt t = 0; t < program->num_sinks; t++) {
        if (!program->sinks[t].is_active) chk(CeedVectorSetValue(program->sinks[t].vec, 0.0));
      }
    }
    const auto points = read_points(*program);
    std::vector<std::unique_ptr<Reader>> sources;
    for (CeedInt s = 0; s < program->num_sources; s++) {
      sources.push_back(std::make_unique<Reader>(program->sources[s].is_active ? in : program->sources[s].vec));
    }
    // Several sinks may share a vector, which has one writer at a time.
    std::vector<std::unique_ptr<Writer>> writers;
    std::vector<CeedVector> written;
    std::vector<CeedScalar *> sinks;
    for (CeedInt t = 0; t < program->num_sinks; t++) {
      const CeedVector vec = program->sinks[t].is_active ? out : program->sinks[t].vec;
      const auto found = std::find(written.begin(), written.end(), vec);
      if (found == written.end()) {
        written.push_back(vec);
        writers.push_back(std::make_unique<Writer>(vec));
        sinks.push_back(writers.back()->data());
      } else {
        sinks.push_back(writers[found - written.begin()]->data());
      }
    }
    ContextData context(program->qf);
    apply_elements(*program, loop, points ? points->data() : nullptr, sources, context.data(), sinks);
    context.release();
    for (const auto &writer : writers) writer->release();
    for (const auto &source : sources) source->release();
    if (points) points->release();
  });
}

/// Column by column: the QFunction of a unit value of each active input, all others zero.
int linear_assemble_qfunction(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                              CeedVector values) {
  return wall(CeedOperatorReturnCeed(op), [&] {
    ElementLoop loop(*program);
    const auto points = read_points(*program);
    std::vector<std::unique_ptr<Reader>> sources(program->num_sources);
    for (CeedInt s = 0; s < program->num_sources; s++) {
      if (!program->sources[s].is_active) sources[s] = std::make_unique<Reader>(program->sources[s].vec);
    }
    Writer assembled(values, Writer::write_only);
    CeedScalar *element_values = assembled.data();
    const CeedInt num_in = program->num_active_in, num_out = program->num_active_out;
    ContextData context(program->qf);
    for (CeedInt e = first_elem; e < first_elem + num_elem; e++) {
      const CeedInt Q = loop.num_points(e), stride = loop.stride(e);
      if (Q == 0) continue;
      loop.set_points(e, points ? points->data() : nullptr);
      for (CeedInt s = 0; s < program->num_sources; s++) {
        if (sources[s]) loop.gather(s, e, sources[s]->data());
      }
      const auto for_each_active = [&](const CeedProgramField *fields, CeedInt count, auto &&f) {
        for (CeedInt i = 0; i < count; i++) {
          for (CeedInt c = 0; fields[i].first_value >= 0 && c < fields[i].size; c++) f(i, c, fields[i].first_value + c);
        }
      };
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
    for (const auto &source : sources) {
      if (source) source->release();
    }
    if (points) points->release();
  });
}

}  // namespace

void fill_operator_ops(CeedOperatorOps &ops) {
  ops = {.create = nullptr,
         .destroy = nullptr,
         .apply_add = apply_add,
         .linear_assemble_qfunction = linear_assemble_qfunction,
         .linear_assemble_add_diagonal = nullptr,
         .linear_assemble = nullptr};
}

}  // namespace hg::ref
