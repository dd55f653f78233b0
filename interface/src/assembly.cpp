/// Assembly of linear operators: the QFunction becomes a matrix at each point, which is contracted with the bases,
///
///   K[(c',m),(c,n)] = Σ_q Σ_(o,i) B_o(q,m) D(q)[o,i] B_i(q,n),
///
/// where i runs over the active input values of component c, o over the active output values of component c', and B
/// holds values or derivatives of the basis functions at the points. Quadrature points and material points differ only
/// in how B is tabulated. Cost for each point: 2 n_i P for B_i, 2 n_o n_i P for D B_i, 2 n_o P (c P) for the product.
#include <algorithm>
#include <cstdlib>
#include <optional>

#include "operator.hpp"

namespace {

using hg::require;
using hg::text;

/// Elements whose assembled QFunctions are held at once: bounds the memory of diagonal and full assembly.
constexpr CeedSize chunk_values = CeedSize{1} << 20;

/// Points of element e.
CeedInt num_points(const CeedProgram &program, CeedInt e) {
  return program.at_points ? hg::points_in_element(*program.points_rstr, e).size : program.num_qpts;
}

/// The basis functions of the active fields on one source or sink, tabulated at the points of an element.
class Table {
 public:
  Table(const CeedProgram &program, const CeedProgramSide &side, const CeedProgramField *fields, CeedInt num_fields,
        CeedInt side_index)
      : program_(program), rstr_(*side.rstr), num_comp_(side.num_comp) {
    for (CeedInt i = 0; i < num_fields; i++) {
      if (fields[i].side != side_index || fields[i].first_value < 0) continue;
      const CeedBasis basis = fields[i].space >= 0 ? program.spaces[fields[i].space].basis : nullptr;
      const CeedInt q_comp = basis != nullptr ? hg::q_components(*basis, fields[i].eval_mode) : 1;
      fields_.push_back({fields[i].first_value, fields[i].eval_mode, basis, q_comp});
      for (CeedInt d = 0; d < q_comp; d++) first_values_.push_back(fields[i].first_value + d * num_comp_);
    }
    if (!program.at_points) tabulate_quadrature();
  }

  /// Makes the table that of element e; x_ref: coordinates of all points, NULL at quadrature points.
  void move_to(CeedInt e, const CeedScalar *x_ref) {
    P_ = rstr_.num_nodes(e);
    Q_ = num_points(program_, e);
    if (program_.at_points) tabulate_points(e, x_ref);
    if (rstr_.num_bands > 0) turn(e);
  }

  CeedInt P() const { return P_; }
  CeedInt num_comp() const { return num_comp_; }
  const CeedElemRestriction_private &rstr() const { return rstr_; }
  /// Rows of the table at a point: one for each field and derivative direction.
  CeedInt num_rows() const { return static_cast<CeedInt>(first_values_.size()); }
  /// Active value of component c in row k.
  CeedInt value(CeedInt k, CeedInt c) const { return first_values_[k] + c; }
  /// Row k at point q: P values.
  const CeedScalar *row(CeedInt k, CeedInt q) const {
    return &(rstr_.num_bands > 0 ? turned_ : table_)[(static_cast<CeedSize>(q) * num_rows() + k) * P_];
  }
  bool is_same_space_as(const Table &other) const { return hg::equal(rstr_, other.rstr_); }

 private:
  struct Field {
    CeedInt first_value;
    CeedEvalMode mode;
    CeedBasis basis;  ///< NULL: mode NONE
    CeedInt q_comp;
  };

  CeedScalar *row(CeedInt k, CeedInt q) { return &table_[(static_cast<CeedSize>(q) * num_rows() + k) * P_]; }

  void tabulate_quadrature() {
    P_ = rstr_.elem_size;
    Q_ = program_.num_qpts;
    table_.assign(static_cast<std::size_t>(Q_) * num_rows() * P_, 0.0);
    CeedInt k = 0;
    for (const Field &field : fields_) {
      const CeedScalar *matrix = field.basis != nullptr ? hg::matrix(*field.basis, field.mode).data() : nullptr;
      for (CeedInt d = 0; d < field.q_comp; d++, k++) {
        for (CeedInt q = 0; q < Q_; q++) {
          if (matrix == nullptr) {
            row(k, q)[q] = 1.0;
          } else {
            std::copy_n(matrix + (static_cast<CeedSize>(d) * Q_ + q) * P_, P_, row(k, q));
          }
        }
      }
    }
  }

  void tabulate_points(CeedInt e, const CeedScalar *x_ref) {
    table_.assign(static_cast<std::size_t>(Q_) * num_rows() * P_, 0.0);
    const auto points = hg::points_in_element(*program_.points_rstr, e);
    const CeedInt dim = program_.points_rstr->num_comp;
    for (CeedInt q = 0; q < Q_; q++) {
      const CeedScalar *x = x_ref + static_cast<CeedSize>(points.points[q]) * dim;
      CeedInt k = 0;
      for (const Field &field : fields_) {
        if (field.mode == CEED_EVAL_NONE) {
          row(k, q)[q] = 1.0;
        } else if (field.mode == CEED_EVAL_INTERP) {
          hg::check(CeedBasisEvaluateAtPoint(field.basis, x, row(k, q), nullptr));
        } else {
          hg::check(CeedBasisEvaluateAtPoint(field.basis, x, nullptr, row(k, q)));
        }
        k += field.q_comp;
      }
    }
  }

  /// B T_e: the functions of the unknowns in the L-vector, whose orientation the element does not share.
  void turn(CeedInt e) {
    turned_.assign(table_.size(), 0.0);
    for (std::size_t row = 0; row < table_.size(); row += P_) {
      for (CeedInt n = 0; n < P_; n++) {
        rstr_.for_each_turned(e, n, [&](CeedInt m, CeedScalar t) { turned_[row + m] += table_[row + n] * t; });
      }
    }
  }

  const CeedProgram &program_;
  const CeedElemRestriction_private &rstr_;
  CeedInt num_comp_;
  std::vector<Field> fields_;
  std::vector<CeedInt> first_values_;
  CeedInt P_ = 0, Q_ = 0;
  std::vector<CeedScalar> table_, turned_;
};

/// The matrix of the QFunction at the points of an element, seen from either layout.
class PointMatrices {
 public:
  PointMatrices(const CeedProgram &program, const CeedScalar *element_values, CeedInt Q)
      : values_(element_values), num_out_(program.num_active_out),
        point_stride_(program.at_points ? program.num_active_in * program.num_active_out : 1),
        component_stride_(program.at_points ? 1 : Q) {}
  /// Derivative of output value o by input value i at point q.
  CeedScalar operator()(CeedInt q, CeedInt i, CeedInt o) const {
    return values_[static_cast<CeedSize>(q) * point_stride_ + static_cast<CeedSize>(i * num_out_ + o) * component_stride_];
  }

 private:
  const CeedScalar *values_;
  CeedInt num_out_;
  CeedSize point_stride_, component_stride_;
};

/// Diagonal of an element: diagonal[c*P + n] += ...; `trial` and `test` are of one space.
void add_element_diagonal(const PointMatrices &D, CeedInt Q, const Table &trial, const Table &test,
                          CeedScalar *diagonal) {
  const CeedInt P = trial.P();
  for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt k = 0; k < trial.num_rows(); k++) {
      for (CeedInt l = 0; l < test.num_rows(); l++) {
        const CeedScalar *b = trial.row(k, q), *t = test.row(l, q);
        for (CeedInt c = 0; c < trial.num_comp(); c++) {
          const CeedScalar d = D(q, trial.value(k, c), test.value(l, c));
          for (CeedInt n = 0; n < P; n++) diagonal[c * P + n] += t[n] * d * b[n];
        }
      }
    }
  }
}

/// Element matrix, rows (component, node) of `test`, columns (component, node) of `trial`, row-major: overwritten.
void element_matrix(const PointMatrices &D, CeedInt Q, const Table &trial, const Table &test,
                    std::vector<CeedScalar> &DB, CeedScalar *K) {
  const CeedInt P = trial.P(), M = test.P();
  const CeedSize num_columns = static_cast<CeedSize>(trial.num_comp()) * P;
  std::fill_n(K, num_columns * test.num_comp() * M, 0.0);
  DB.resize(P);
  for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt c = 0; c < trial.num_comp(); c++) {
      for (CeedInt l = 0; l < test.num_rows(); l++) {
        const CeedScalar *t = test.row(l, q);
        for (CeedInt r = 0; r < test.num_comp(); r++) {
          std::fill(DB.begin(), DB.end(), 0.0);
          for (CeedInt k = 0; k < trial.num_rows(); k++) {
            const CeedScalar d = D(q, trial.value(k, c), test.value(l, r));
            const CeedScalar *b = trial.row(k, q);
            for (CeedInt n = 0; n < P; n++) DB[n] += d * b[n];
          }
          for (CeedInt m = 0; m < M; m++) {
            CeedScalar *row = K + (static_cast<CeedSize>(r) * M + m) * num_columns + static_cast<CeedSize>(c) * P;
            for (CeedInt n = 0; n < P; n++) row[n] += t[m] * DB[n];
          }
        }
      }
    }
  }
}

/// Number of points of the elements [first, last).
CeedSize points_in_range(const CeedProgram &program, CeedInt first, CeedInt last) {
  if (!program.at_points) return static_cast<CeedSize>(last - first) * program.num_qpts;
  CeedSize count = 0;
  for (CeedInt e = first; e < last; e++) count += num_points(program, e);
  return count;
}

void require_linearisable(const CeedOperator_private &op, const CeedProgram &program) {
  require(program.num_active_in > 0 && program.num_active_out > 0, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' has %s; assembly needs an active input and an active output", op.shown_name(),
                program.num_active_in == 0 ? "no active input" : "no active output");
  });
}

/// Calls f(e, matrices) for each element with its assembled QFunction, chunk by chunk, or from what is kept where the
/// user asked for reuse.
template <typename F>
void for_each_element(CeedOperator_private &op, const CeedProgram &program, F &&f) {
  require_linearisable(op, program);
  const CeedSize num_comp = static_cast<CeedSize>(program.num_active_in) * program.num_active_out;
  const auto walk = [&](const CeedScalar *values, CeedInt first, CeedInt last) {
    for (CeedInt e = first; e < last; e++) {
      const CeedInt Q = num_points(program, e);
      f(e, Q, PointMatrices(program, values, Q));
      values += Q * num_comp;
    }
  };
  if (op.reuses_assembly) {
    CeedVector assembled = nullptr;
    CeedElemRestriction rstr = nullptr;
    hg::check(CeedOperatorLinearAssembleQFunctionBuildOrUpdate(&op, &assembled, &rstr, CEED_REQUEST_IMMEDIATE));
    const auto held_vector = hg::Ref<CeedVector_private>::adopt(assembled);
    const auto held_rstr = hg::Ref<CeedElemRestriction_private>::adopt(rstr);
    const hg::ReadArray array(assembled);
    walk(array.data(), 0, program.num_elem);
    return;
  }
  hg::Ref<CeedVector_private> values;
  for (CeedInt first = 0, last = 0; first < program.num_elem; first = last) {
    CeedSize count = 0;
    do {
      count += num_points(program, last++) * num_comp;
    } while (last < program.num_elem && count + num_points(program, last) * num_comp <= chunk_values);
    if (count == 0) continue;
    if (!values || values->length < count) {
      CeedVector created = nullptr;
      const CeedSize all = points_in_range(program, 0, program.num_elem) * num_comp;
      hg::check(CeedVectorCreate(op.ceed.get(), std::max(count, std::min(all, chunk_values)), &created));
      values = hg::Ref<CeedVector_private>::adopt(created);
    }
    hg::check(op.ceed->ops.op.linear_assemble_qfunction(&op, &program, first, last - first, values.get()));
    const hg::ReadArray array(values.get());
    walk(array.data(), first, last);
  }
}

/// Reference coordinates of the points for the lifetime of the object.
class Points {
 public:
  explicit Points(const CeedProgram &program) {
    if (program.at_points) array_.emplace(program.points);
  }
  const CeedScalar *data() const { return array_ ? array_->data() : nullptr; }

 private:
  std::optional<hg::ReadArray> array_;
};

/// Calls f(source index, sink index) for each pair of active sides.
template <typename F>
void for_each_pair(const CeedProgram &program, F &&f) {
  for (CeedInt s = 0; s < program.num_sources; s++) {
    for (CeedInt t = 0; t < program.num_sinks; t++) {
      if (program.sources[s].is_active && program.sinks[t].is_active) f(s, t);
    }
  }
}

void add_diagonal(CeedOperator_private &op, CeedVector diagonal) {
  const CeedProgram &program = hg::program_of(op);
  if (program.num_elem == 0) return;
  if (op.ceed->ops.op.linear_assemble_add_diagonal != nullptr) {
    hg::check(op.ceed->ops.op.linear_assemble_add_diagonal(&op, &program, diagonal));
    return;
  }
  const Points points(program);
  struct Pair {
    Table trial, test;
  };
  std::vector<Pair> pairs;
  for_each_pair(program, [&](CeedInt s, CeedInt t) {
    Pair pair{Table(program, program.sources[s], program.inputs, program.num_inputs, s),
              Table(program, program.sinks[t], program.outputs, program.num_outputs, t)};
    if (pair.trial.is_same_space_as(pair.test)) pairs.push_back(std::move(pair));
  });
  require_linearisable(op, program);
  require(!pairs.empty(), CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s': active input and output have different restrictions; only operators from a space "
                "to itself have a diagonal",
                op.shown_name());
  });
  const hg::WriteArray array(diagonal);
  std::vector<CeedScalar> element;
  for_each_element(op, program, [&](CeedInt e, CeedInt Q, const PointMatrices &D) {
    for (Pair &pair : pairs) {
      pair.trial.move_to(e, points.data());
      pair.test.move_to(e, points.data());
      const CeedInt P = pair.trial.P();
      element.assign(static_cast<std::size_t>(P) * pair.trial.num_comp(), 0.0);
      add_element_diagonal(D, Q, pair.trial, pair.test, element.data());
      for (CeedInt c = 0; c < pair.trial.num_comp(); c++) {
        for (CeedInt n = 0; n < P; n++) array[pair.trial.rstr().place(e, n, c)] += element[c * P + n];
      }
    }
  });
}

/// Entries of one operator in coordinate form.
CeedSize num_entries(CeedOperator_private &op) {
  const CeedProgram &program = hg::program_of(op);
  CeedSize count = 0;
  for_each_pair(program, [&](CeedInt s, CeedInt t) {
    const auto &in = *program.sources[s].rstr, &out = *program.sinks[t].rstr;
    if (!in.is_points() && !out.is_points()) {
      count += static_cast<CeedSize>(program.num_elem) * in.elem_size * in.num_comp * out.elem_size * out.num_comp;
      return;
    }
    for (CeedInt e = 0; e < program.num_elem; e++) {
      count += static_cast<CeedSize>(in.num_nodes(e)) * in.num_comp * out.num_nodes(e) * out.num_comp;
    }
  });
  return count;
}

void assemble(CeedOperator_private &op, CeedSize offset, CeedVector values) {
  const CeedProgram &program = hg::program_of(op);
  if (program.num_elem == 0) return;
  if (op.ceed->ops.op.linear_assemble != nullptr) {
    hg::check(op.ceed->ops.op.linear_assemble(&op, &program, offset, values));
    return;
  }
  const Points points(program);
  const hg::WriteArray array(values);
  std::vector<CeedScalar> DB;
  for_each_pair(program, [&](CeedInt s, CeedInt t) {
    Table trial(program, program.sources[s], program.inputs, program.num_inputs, s);
    Table test(program, program.sinks[t], program.outputs, program.num_outputs, t);
    for_each_element(op, program, [&](CeedInt e, CeedInt Q, const PointMatrices &D) {
      trial.move_to(e, points.data());
      test.move_to(e, points.data());
      element_matrix(D, Q, trial, test, DB, array.data() + offset);
      offset += static_cast<CeedSize>(trial.P()) * trial.num_comp() * test.P() * test.num_comp();
    });
  });
}

void symbolic(CeedOperator_private &op, CeedInt *rows, CeedInt *cols, CeedSize &k) {
  const CeedProgram &program = hg::program_of(op);
  for_each_pair(program, [&](CeedInt s, CeedInt t) {
    const auto &in = *program.sources[s].rstr, &out = *program.sinks[t].rstr;
    for (CeedInt e = 0; e < program.num_elem; e++) {
      const CeedInt P = in.num_nodes(e), M = out.num_nodes(e);
      for (CeedInt r = 0; r < out.num_comp; r++) {
        for (CeedInt m = 0; m < M; m++) {
          const CeedInt row = static_cast<CeedInt>(out.place(e, m, r));
          for (CeedInt c = 0; c < in.num_comp; c++) {
            for (CeedInt n = 0; n < P; n++, k++) {
              rows[k] = row;
              cols[k] = static_cast<CeedInt>(in.place(e, n, c));
            }
          }
        }
      }
    }
  });
}

/// Restriction of the assembled QFunction: all its components at all points.
hg::Ref<CeedElemRestriction_private> assembled_restriction(CeedOperator_private &op, const CeedProgram &program) {
  const CeedInt num_comp = program.num_active_in * program.num_active_out;
  CeedElemRestriction rstr = nullptr;
  if (!program.at_points) {
    const CeedInt Q = program.num_qpts;
    const CeedInt strides[3] = {1, Q, Q * num_comp};
    const CeedSize l_size = static_cast<CeedSize>(program.num_elem) * Q * num_comp;
    hg::check(CeedElemRestrictionCreateStrided(op.ceed.get(), program.num_elem, Q, num_comp, l_size, strides, &rstr));
  } else {
    // Points are stored one element after another, whatever their numbers in the operator's own restriction.
    const CeedInt count = static_cast<CeedInt>(points_in_range(program, 0, program.num_elem));
    std::vector<CeedInt> offsets{program.num_elem + 1};
    for (CeedInt e = 0; e < program.num_elem; e++) offsets.push_back(offsets.back() + num_points(program, e));
    for (CeedInt i = 0; i < count; i++) offsets.push_back(i);
    hg::check(CeedElemRestrictionCreateAtPoints(op.ceed.get(), program.num_elem, count, num_comp,
                                                static_cast<CeedSize>(count) * num_comp, CEED_MEM_HOST,
                                                CEED_COPY_VALUES, offsets.data(), &rstr));
  }
  return hg::Ref<CeedElemRestriction_private>::adopt(rstr);
}

void assemble_qfunction(CeedOperator op, CeedVector *assembled, CeedElemRestriction *rstr) {
  const CeedProgram &program = hg::program_of(hg::deref(op, "CeedOperator"));
  require_linearisable(*op, program);
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

void check_output(CeedOperator op, CeedVector assembled, const char *what) {
  CeedSize in = -1, out = -1;
  hg::check_ready(hg::deref(op, "CeedOperator"));
  if (op->is_composite && op->subs.empty()) return;
  hg::check(CeedOperatorGetActiveVectorLengths(op, &in, &out));
  require(in == out, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s': %s needs a square operator; its active input has length %" CeedSize_FMT
                ", its output %" CeedSize_FMT,
                op->shown_name(), what, in, out);
  });
  require(hg::deref(assembled, "vector of the diagonal").length == out, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s': the vector of the %s has length %" CeedSize_FMT "; expected %" CeedSize_FMT,
                op->shown_name(), what, assembled->length, out);
  });
}

}  // namespace

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

int CeedOperatorLinearAssembleDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *request) {
  return hg::guard(hg::ceed_of(op), [&] {
    check_output(op, assembled, "diagonal");
    hg::check(CeedVectorSetValue(assembled, 0.0));
    hg::check(CeedOperatorLinearAssembleAddDiagonal(op, assembled, request));
  });
}

int CeedOperatorLinearAssembleAddDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] {
    check_output(op, assembled, "diagonal");
    hg::for_each_single(*op, [&](CeedOperator_private &single) { add_diagonal(single, assembled); });
  });
}

int CeedOperatorLinearAssembleGetNumEntries(CeedOperator op, CeedSize *num_entries_out) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::check_ready(hg::deref(op, "CeedOperator"));
    CeedSize count = 0;
    hg::for_each_single(*op, [&](CeedOperator_private &single) { count += num_entries(single); });
    *num_entries_out = count;
  });
}

int CeedOperatorLinearAssembleSymbolic(CeedOperator op, CeedSize *num_entries_out, CeedInt **rows, CeedInt **cols) {
  return hg::guard(hg::ceed_of(op), [&] {
    CeedSize count = 0;
    hg::check(CeedOperatorLinearAssembleGetNumEntries(op, &count));
    const std::size_t bytes = std::max<std::size_t>(static_cast<std::size_t>(count), 1) * sizeof(CeedInt);
    using Array = std::unique_ptr<CeedInt, decltype(&std::free)>;
    Array new_rows(static_cast<CeedInt *>(std::malloc(bytes)), &std::free);
    Array new_cols(static_cast<CeedInt *>(std::malloc(bytes)), &std::free);
    require(new_rows && new_cols, CEED_ERROR_MAJOR, [&] {
      return text("CeedOperator '%s': no memory for 2 x %" CeedSize_FMT " indices", op->shown_name(), count);
    });
    CeedSize k = 0;
    hg::for_each_single(*op, [&](CeedOperator_private &single) { symbolic(single, new_rows.get(), new_cols.get(), k); });
    *num_entries_out = count;
    *rows = new_rows.release();
    *cols = new_cols.release();
  });
}

int CeedOperatorLinearAssemble(CeedOperator op, CeedVector values) {
  return hg::guard(hg::ceed_of(op), [&] {
    CeedSize count = 0;
    hg::check(CeedOperatorLinearAssembleGetNumEntries(op, &count));
    require(hg::deref(values, "vector of the entries").length == count, CEED_ERROR_DIMENSION, [&] {
      return text("CeedOperator '%s': the vector of the entries has length %" CeedSize_FMT "; expected %" CeedSize_FMT,
                  op->shown_name(), values->length, count);
    });
    hg::check(CeedVectorSetValue(values, 0.0));
    CeedSize offset = 0;
    hg::for_each_single(*op, [&](CeedOperator_private &single) {
      assemble(single, offset, values);
      offset += num_entries(single);
    });
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
