/// @file
/// What all kinds of assembly share. The QFunction becomes a matrix D(q) at each point q, which is contracted with the
/// bases:
///
///   K[(r,m),(c,n)] = Σ_q Σ_(l,k) B_l(q,m) D(q)[value(l,r), value(k,c)] B_k(q,n),
///
/// where k runs over the values and derivatives of the trial functions that the active inputs take, l over those of the
/// test functions, and B_k(q,n) is that of function n at point q. Quadrature points and material points differ only in
/// how B is tabulated.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "operator.hpp"

namespace hg {

/// Points of element e.
CeedInt num_points(const CeedProgram &program, CeedInt e);
/// Throws unless there are an active input and an active output.
void require_linearisable(const CeedOperator_private &op, const CeedProgram &program);

/// The matrix of the QFunction at the points of an element, seen from either layout.
class PointMatrices {
 public:
  PointMatrices(const CeedProgram &program, const CeedScalar *element_values, CeedInt Q)
      : values_(element_values),
        num_out_(program.num_active_out),
        point_stride_(program.at_points ? program.num_active_in * program.num_active_out : 1),
        component_stride_(program.at_points ? 1 : Q) {}
  /// Derivative of output value o by input value i at point q.
  CeedScalar operator()(CeedInt q, CeedInt i, CeedInt o) const {
    return values_[static_cast<CeedSize>(q) * point_stride_ +
                   static_cast<CeedSize>(i * num_out_ + o) * component_stride_];
  }

 private:
  const CeedScalar *values_;
  CeedInt num_out_;
  CeedSize point_stride_, component_stride_;
};

/// The elements [first, last) with their assembled QFunctions, one element after another.
struct AssembledElements {
  const CeedProgram &program;
  CeedInt first, last;
  const CeedScalar *values;  ///< NULL where there are no points

  /// Calls visit(e, Q, D) for each element with its Q points.
  template <typename Visit>
  void for_each(Visit &&visit) const {
    const CeedSize num_comp = static_cast<CeedSize>(program.num_active_in) * program.num_active_out;
    const CeedScalar *of_element = values;
    for (CeedInt e = first; e < last; e++) {
      const CeedInt Q = num_points(program, e);
      visit(e, Q, PointMatrices(program, of_element, Q));
      of_element += Q * num_comp;
    }
  }
};

/// Calls visit(elements) for some elements after others, so that memory does not grow with the mesh: from what is kept
/// where the user asked for reuse, else assembled there and then.
void for_each_assembled(CeedOperator_private &op, const CeedProgram &program,
                        const std::function<void(const AssembledElements &)> &visit);

/// Functions in one evaluation mode, at the points of an element: value d of function n at point q is
/// values[q*point_stride + d*value_stride + n].
struct FunctionValues {
  const CeedScalar *values = nullptr;
  CeedSize point_stride = 0, value_stride = 0;
};

/// What the active fields of a program need of their bases, at the points of one element after another. Each space is
/// tabulated once for an element, however many fields use it. Functions of oriented restrictions are turned: they
/// belong to the entries of the L-vector.
class Tabulation {
 public:
  explicit Tabulation(const CeedProgram &program);
  Tabulation(const Tabulation &) = delete;
  Tabulation &operator=(const Tabulation &) = delete;
  void move_to(CeedInt e);
  /// The functions that a field takes; rstr: that of its source or sink. The reference holds as long as the object.
  const FunctionValues &operator()(const CeedProgramField &field, const CeedElemRestriction_private &rstr) const;

 private:
  struct Space {
    const CeedElemRestriction_private *rstr = nullptr;
    CeedBasis_private *basis = nullptr;  ///< NULL: no active field uses the space
    bool is_interpolated = false, is_derived = false;
    FunctionValues interp, derivative;
    std::vector<CeedScalar> own_interp, own_derivative;  ///< where the values change from element to element
  };
  /// CEED_EVAL_NONE with an oriented restriction: nodes are points.
  struct TurnedNodes {
    const CeedElemRestriction_private *rstr;
    std::vector<CeedScalar> own;
    FunctionValues values;
  };
  void tabulate_at_points(CeedInt e, Space &space);
  void turn(CeedInt e, Space &space);
  void add_nodes(const CeedElemRestriction_private &rstr);

  const CeedProgram &program_;
  std::optional<ReadArray> points_;
  std::vector<Space> spaces_;
  std::deque<TurnedNodes> turned_nodes_;
  FunctionValues identity_;  ///< of CEED_EVAL_NONE
  std::vector<CeedScalar> identity_values_, values_1d_, work_;
};

/// The functions of one active source or sink as rows: one for each field and value of a field.
class Functions {
 public:
  /// `tabulation` is read as it moves. side: index in program.sources (is_trial) or program.sinks.
  Functions(const CeedProgram &program, const Tabulation &tabulation, bool is_trial, CeedInt side);

  const CeedElemRestriction_private &rstr() const { return *rstr_; }
  CeedInt num_comp() const { return rstr_->num_comp; }
  CeedInt num_rows() const { return static_cast<CeedInt>(rows_.size()); }
  /// Active value of component c in row k.
  CeedInt value(CeedInt k, CeedInt c) const { return rows_[k].first_value + c; }
  /// Whether the rows of another are the same functions in the same order.
  bool has_rows_of(const Functions &other) const {
    return std::equal(rows_.begin(), rows_.end(), other.rows_.begin(), other.rows_.end(),
                      [](const Row &a, const Row &b) { return a.functions == b.functions && a.d == b.d; });
  }
  /// Row k at point q: the values of all functions.
  const CeedScalar *row(CeedInt k, CeedInt q) const {
    const FunctionValues &f = *rows_[k].functions;
    return f.values + q * f.point_stride + rows_[k].d * f.value_stride;
  }

 private:
  struct Row {
    const FunctionValues *functions;
    CeedInt d, first_value;
  };
  const CeedElemRestriction_private *rstr_;
  std::vector<Row> rows_;
};

/// The coupling of one active source with one active sink.
struct Coupling {
  CeedInt source, sink;
  const CeedElemRestriction_private &trial, &test;

  CeedSize num_entries(CeedInt e) const {
    return static_cast<CeedSize>(trial.num_nodes(e)) * trial.num_comp * test.num_nodes(e) * test.num_comp;
  }
};
/// All couplings, in the order of the entries of the assembled matrix: by source, then by sink.
std::vector<Coupling> couplings(const CeedProgram &program);

/// Whether the backend did all of it; see CeedOperatorOps::linear_assemble.
bool assemble_on_backend(CeedOperator_private &op, const CeedProgram &program, CeedAssembleKind kind, CeedSize offset,
                         CeedVector values);
/// Whether the backend contracted; see CeedOperatorOps::linear_assemble_elements.
bool contract_on_backend(CeedOperator_private &op, const Coupling &coupling, CeedAssembleKind kind,
                         const AssembledElements &elements, CeedScalar *entries);

/// The functions of a coupling at the points of an element.
struct CoupledFunctions {
  Functions trial, test;
};

/// Those of all couplings; tables are made when the first element comes.
class FunctionTables {
 public:
  FunctionTables(const CeedProgram &program, const std::vector<Coupling> &all) : program_(program), all_(all) {}
  /// Coupling i at element e; the reference holds as long as the object.
  const CoupledFunctions &move_to(std::size_t i, CeedInt e);

 private:
  const CeedProgram &program_;
  const std::vector<Coupling> &all_;
  std::optional<Tabulation> tabulation_;
  std::vector<CoupledFunctions> functions_;
  CeedInt element_ = -1;
};

/// Rows and columns of entries, for the user to free with free().
struct IndexArrays {
  struct Free {
    void operator()(CeedInt *array) const noexcept { std::free(array); }
  };
  std::unique_ptr<CeedInt[], Free> rows, cols;
};
/// Throws, naming the operator and the count, where there is no memory.
IndexArrays allocate_indices(const CeedOperator_private &op, CeedSize count);
/// Throws unless the places in the active vectors are numbers of the type CeedInt.
void require_index_range(CeedOperator_private &op);

/// Element matrices of couplings.
class ElementMatrix {
 public:
  /// K: rows (component, node) of the test functions, columns (component, node) of the trial functions, row-major; it
  /// is overwritten.
  void compute(const CoupledFunctions &functions, CeedInt e, CeedInt Q, const PointMatrices &D, CeedScalar *K);

 private:
  std::vector<CeedScalar> test_, DB_;
};

}  // namespace hg
