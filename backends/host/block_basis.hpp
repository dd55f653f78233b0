/// @file
/// A basis for a block of elements, as a chain of contractions.
#pragma once

#include <ceed/backend.h>

#include <vector>

#include "basis_factors.hpp"
#include "kernels.hpp"

namespace hg::host {

/// A matrix of one direction with the kernels that apply it, and its transpose.
class Factor {
 public:
  Factor() = default;
  /// B: M by N, row-major
  Factor(const Kernels &kernels, const CeedScalar *B, CeedInt M, CeedInt N);
  /// out (+)= B in along a direction, see Contraction
  void apply(CeedInt pre, CeedInt post, const CeedScalar *in, CeedScalar *out, Ahead &ahead, bool add = false) const {
    forward_.kernel[add](forward_.coefficients.data(), forward_.M, forward_.N, pre, post, in, out, ahead);
  }
  /// out (+)= B^T in
  void apply_transpose(CeedInt pre, CeedInt post, const CeedScalar *in, CeedScalar *out, Ahead &ahead,
                       bool add = false) const {
    back_.kernel[add](back_.coefficients.data(), back_.M, back_.N, pre, post, in, out, ahead);
  }
  std::size_t num_bytes() const {
    return (forward_.coefficients.size() + back_.coefficients.size()) * sizeof(CeedScalar);
  }

  /// B, or its transpose: its coefficients (see Contraction) and its kernels.
  struct Direction {
    CeedInt M = 0, N = 0;
    Symmetry symmetry = Symmetry::none;  ///< that the coefficients make use of
    std::vector<CeedScalar> coefficients;
    Contraction kernel[2] = {};  ///< to set, to add
  };
  const Direction &direction(bool is_transpose) const { return is_transpose ? back_ : forward_; }

 private:
  static Direction prepare(const Kernels &kernels, const std::vector<CeedScalar> &B, CeedInt M, CeedInt N);

  Direction forward_, back_;
};

/// A basis for W elements side by side, made once from a CeedBasis of which it keeps nothing. With P nodes, Q
/// quadrature points and nc components, arrays of a block are
///   u           (component, node): nc x P
///   interp      (value, component, point): q_interp x nc x Q
///   derivative  (value, component, point): q_derivative x nc x Q
/// with the last index fastest, W numbers each. Tensor products go direction by direction; where Q_1d >= P_1d
/// derivatives are taken of the values at the quadrature points (the collocated derivative), else of each direction's
/// own chain.
class BlockBasis {
 public:
  BlockBasis(const Kernels &kernels, CeedBasis basis);

  CeedInt num_points() const { return power(Q_, num_directions_); }
  /// Numbers of the work array that the functions below need.
  std::size_t work_size() const { return 3 * work_stride_; }
  /// interp = B u, derivative = G u; either may be NULL
  void evaluate(const CeedScalar *u, CeedScalar *interp, CeedScalar *derivative, CeedScalar *work, Ahead &ahead) const;
  /// u (+)= B^T interp + G^T derivative; either may be NULL. What is in `interp` afterwards is undefined.
  void integrate(CeedScalar *interp, const CeedScalar *derivative, CeedScalar *u, bool add, CeedScalar *work,
                 Ahead &ahead) const;
  /// Bytes of its matrices.
  std::size_t num_bytes() const {
    std::size_t bytes = weights_.size() * sizeof(CeedScalar) + interp_1d_.num_bytes() + grad_1d_.num_bytes();
    for (const auto *factors : {&interp_, &derivative_}) {
      for (const Factor &factor : *factors) bytes += factor.num_bytes();
    }
    return bytes;
  }
  /// Quadrature weights, one for each point.
  const std::vector<CeedScalar> &weights() const { return weights_; }

  /// How values come about, for those who print it.
  using Route = BasisFactors::Route;
  Route route() const { return route_; }
  CeedInt num_directions() const { return num_directions_; }  ///< 1 where the matrices are full
  CeedInt num_comp() const { return num_comp_; }
  CeedInt P() const { return P_; }  ///< nodes in a direction
  CeedInt Q() const { return Q_; }  ///< points in a direction
  /// Factors of a tensor product: values, and derivatives (between points where they are collocated).
  const Factor &interp_1d() const { return interp_1d_; }
  const Factor &grad_1d() const { return grad_1d_; }
  /// Full matrices, one for each value.
  const std::vector<Factor> &interp() const { return interp_; }
  const std::vector<Factor> &derivative() const { return derivative_; }

 private:
  static CeedInt power(CeedInt base, CeedInt exponent) { return CeedIntPow(base, exponent); }
  BlockBasis(const Kernels &kernels, const BasisFactors &factors);
  void to_points(const CeedScalar *u, CeedScalar *values, CeedInt derived_direction, CeedScalar *work,
                 Ahead &ahead) const;
  void to_nodes(const CeedScalar *values, CeedScalar *u, CeedInt derived_direction, bool add, CeedScalar *work,
                Ahead &ahead) const;

  Route route_ = Route::full;
  CeedInt width_ = 0;
  CeedInt num_directions_ = 1, num_comp_ = 0, P_ = 0, Q_ = 0;  ///< P, Q: of a direction
  Factor interp_1d_, grad_1d_;                                 ///< tensor; grad_1d: between points where collocated
  std::vector<Factor> interp_, derivative_;                    ///< full: one for each value
  std::vector<CeedScalar> weights_;
  std::size_t work_stride_ = 0;
};

}  // namespace hg::host
