/// @file
/// A tensor-product basis at arbitrary points, for a block of elements.
#pragma once

#include <ceed/backend.h>

#include <cstddef>

#include "block_basis.hpp"

namespace hg::host {

/// The polynomials of a basis as Chebyshev series: c = C u with C the product of one matrix, K by P_1d, in each
/// direction. With nc components, arrays of a block are u (component, node): nc x P_1d^dim and c (component,
/// coefficient): nc x K^dim, W numbers each; the kernels at points take c from there. K = P_1d for Lagrange bases.
class PointBasis {
 public:
  /// Whether the basis is known away from its quadrature points, and the kernels take it.
  static bool takes(const Kernels &kernels, CeedBasis basis);
  PointBasis(const Kernels &kernels, CeedBasis basis);

  CeedInt dim() const { return dim_; }
  CeedInt num_comp() const { return num_comp_; }
  CeedInt P() const { return P_; }
  CeedInt K() const { return K_; }
  const Factor &matrix() const { return matrix_; }  ///< of one direction
  std::size_t num_coefficients() const { return static_cast<std::size_t>(CeedIntPow(K_, dim_)) * num_comp_; }
  /// Numbers of the work array that the functions below need.
  std::size_t work_size() const;
  /// Bytes of its matrices.
  std::size_t num_bytes() const { return matrix_.num_bytes(); }
  /// c = C u
  void to_coefficients(const CeedScalar *u, CeedScalar *c, CeedScalar *work) const;
  /// u (+)= C^T c
  void from_coefficients(const CeedScalar *c, CeedScalar *u, bool add, CeedScalar *work) const;

  EvaluatePoints evaluate[2][2];    ///< kernels: values alone, derivatives too; along an element, across
  IntegratePoints integrate[2][2];  ///< the same

 private:
  CeedInt width_, dim_ = 0, num_comp_ = 0, P_ = 0, K_ = 0;
  Factor matrix_;
};

}  // namespace hg::host
