/// @file
/// Bases of the reference backend: products of small matrices, one direction after another.
#pragma once

#include <ceed/plugin.h>

#include <vector>

namespace hg::ref {

/// Number of points that are worked on side by side.
inline constexpr CeedInt lanes = 8;

/// A basis for one element at a time, made once from a CeedBasis of which it keeps nothing. Arrays are those of
/// CeedBasisApply() for one element: P is the number of nodes, Q of quadrature points, nc of components,
/// q_comp of values a component. Modes are CEED_EVAL_INTERP and the space's derivative (gradient, divergence or curl).
/// Each of the q_comp values is B u with B a Kronecker product of matrices, one for each direction; a basis without
/// tensor product has one direction, along which its nodes and quadrature points are numbered.
/// There is no allocation but in set_points() when more points come than ever before. One object serves one thread.
class ElementBasis {
 public:
  ElementBasis() = default;
  /// Reads the matrices of `basis` into `element_basis`. Returns a CeedErrorType; the error has been reported.
  static int create(CeedBasis basis, ElementBasis *element_basis);

  CeedInt dim() const { return dim_; }
  CeedInt num_comp() const { return num_comp_; }
  CeedInt num_nodes() const { return power(P_, num_directions_); }
  CeedInt num_quadrature_points() const { return power(Q_, num_directions_); }
  CeedInt q_comp(CeedEvalMode mode) const { return mode == CEED_EVAL_INTERP ? q_interp_ : q_derivative_; }

  /// v = B u at the quadrature points; u: P x nc, v: Q x nc x q_comp.
  void apply(CeedEvalMode mode, const CeedScalar *u, CeedScalar *v);
  /// u += B^T v
  void apply_transpose_add(CeedEvalMode mode, const CeedScalar *v, CeedScalar *u);
  /// w: Q quadrature weights
  void weights(CeedScalar *w) const;

  /// Whether the basis is known away from its quadrature points; what follows needs it.
  bool can_evaluate_at_points() const { return num_coeff_ > 0; }
  /// Evaluates the 1D functions at the points, for all applications until the next call.
  /// x_ref: num_points x dim, point fastest.
  void set_points(CeedInt num_points, const CeedScalar *x_ref);
  /// v = B u at the points that are set; u: P x nc, v: num_points x nc x q_comp.
  void apply_at_points(CeedEvalMode mode, const CeedScalar *u, CeedScalar *v);
  /// u += B^T v
  void apply_transpose_add_at_points(CeedEvalMode mode, const CeedScalar *v, CeedScalar *u);
  /// The same with other points.
  void apply_at_points(CeedEvalMode mode, CeedInt num_points, const CeedScalar *x_ref, const CeedScalar *u,
                       CeedScalar *v) {
    set_points(num_points, x_ref);
    apply_at_points(mode, u, v);
  }
  void apply_transpose_add_at_points(CeedEvalMode mode, CeedInt num_points, const CeedScalar *x_ref,
                                     const CeedScalar *v, CeedScalar *u) {
    set_points(num_points, x_ref);
    apply_transpose_add_at_points(mode, v, u);
  }

 private:
  /// One number for each of the points worked on side by side.
  struct Lane {
    CeedScalar v[lanes];
  };

  static CeedInt power(CeedInt base, CeedInt exponent) { return CeedIntPow(base, exponent); }
  const Lane *value_1d(CeedInt block, CeedInt d) const { return &table_[(block * dim_ + d) * 2 * P_]; }
  const Lane *derivative_1d(CeedInt block, CeedInt d) const { return value_1d(block, d) + P_; }
  static void contract(CeedInt rows, CeedInt P, const Lane *table, const Lane *in, Lane *out);
  static void expand_add(CeedInt rows, CeedInt P, const Lane *table, const Lane *in, Lane *out);

  /// A matrix of one direction and its transpose.
  struct Factor {
    std::vector<CeedScalar> matrix;     ///< Q by P of a direction
    std::vector<CeedScalar> transpose;  ///< P by Q
  };
  /// The factor of direction d in value g.
  const Factor &factor(CeedEvalMode mode, CeedInt g, CeedInt d) const {
    if (is_tensor_) return factors_[mode == CEED_EVAL_GRAD && d == g ? 1 : 0];
    return factors_[mode == CEED_EVAL_INTERP ? g : q_interp_ + g];
  }
  void add_factors(const CeedScalar *matrices, CeedInt count);

  bool is_tensor_ = true;
  CeedInt dim_ = 0, num_directions_ = 0, num_comp_ = 0;
  CeedInt P_ = 0, Q_ = 0;  ///< nodes and points of a direction
  CeedInt q_interp_ = 1, q_derivative_ = 0, num_coeff_ = 0;
  std::vector<Factor> factors_;        ///< tensor: interpolation, gradient; else one for each value of each mode
  std::vector<CeedScalar> weight_;     ///< Q of a direction
  std::vector<CeedScalar> chebyshev_;  ///< num_coeff by P_1d
  std::vector<CeedScalar> work_[2];
  CeedInt num_points_ = 0;
  std::vector<Lane> table_;        ///< (value or derivative of node, direction, block of points)
  std::vector<Lane> node_lanes_;   ///< P x nc
  std::vector<Lane> partials_[2];  ///< dim + 1 partial results of P x nc entries at most
};

/// The entries of the table of basis functions that the reference backend has.
void fill_basis_ops(CeedBasisOps &ops);

}  // namespace hg::ref
