// 1D basis functions as polynomials: evaluation away from the quadrature points.
#include <algorithm>

#include "basis.hpp"
#include "dense.hpp"

namespace {

/// T_k(x) and T_k'(x) for k = 0 .. size-1: T_(k+1) = 2 x T_k - T_(k-1).
void chebyshev(CeedScalar x, std::vector<CeedScalar> &value, std::vector<CeedScalar> &derivative) {
  const std::size_t size = value.size();
  value[0] = 1.0;
  derivative[0] = 0.0;
  if (size > 1) {
    value[1] = x;
    derivative[1] = 1.0;
  }
  for (std::size_t k = 2; k < size; k++) {
    value[k] = 2.0 * x * value[k - 1] - value[k - 2];
    derivative[k] = 2.0 * value[k - 1] + 2.0 * x * derivative[k - 1] - derivative[k - 2];
  }
}

}  // namespace

namespace hg {

std::vector<CeedScalar> chebyshev_coefficients(const std::vector<CeedScalar> &points,
                                               const std::vector<CeedScalar> &values, CeedInt num_columns) {
  const auto n = static_cast<CeedInt>(points.size());
  for (CeedInt i = 0; i < n; i++) {
    for (CeedInt j = 0; j < i; j++) {
      if (points[i] == points[j]) return {};
    }
  }
  std::vector<CeedScalar> at_points(points.size() * points.size()), value(points.size()), derivative(points.size());
  for (CeedInt i = 0; i < n; i++) {
    chebyshev(points[i], value, derivative);
    for (CeedInt k = 0; k < n; k++) at_points[i * n + k] = value[k];
  }
  return multiply(pseudo_inverse(at_points, n, n, "Chebyshev polynomials at the quadrature points"), values, n, n,
                  num_columns);
}

void require_polynomial(const CeedBasis_private &basis) {
  require(basis.is_tensor, CEED_ERROR_UNSUPPORTED, [&] {
    return text(
        "CeedBasis: this basis in a %s has no tensor product: it is known at its quadrature points alone, and "
        "cannot be evaluated at arbitrary points",
        CeedFESpaces[basis.fe_space]);
  });
  require(!basis.chebyshev_1d.empty(), CEED_ERROR_UNSUPPORTED, [&] {
    return text(
        "CeedBasis: evaluation at arbitrary points needs basis functions that are determined by their values at the "
        "quadrature points; P_1d is %" CeedInt_FMT " and Q_1d is %" CeedInt_FMT
        ", expected Q_1d >= P_1d and distinct points",
        basis.P_1d, basis.Q_1d);
  });
}

void evaluate_1d(const CeedBasis_private &basis, CeedScalar x, CeedScalar *value, CeedScalar *derivative) {
  require_polynomial(basis);
  const CeedInt P = basis.P_1d, size = basis.num_chebyshev();
  std::vector<CeedScalar> t(size), dt(size);
  chebyshev(x, t, dt);
  for (CeedInt j = 0; j < P; j++) value[j] = derivative[j] = 0.0;
  for (CeedInt k = 0; k < size; k++) {
    for (CeedInt j = 0; j < P; j++) {
      value[j] += t[k] * basis.chebyshev_1d[k * P + j];
      derivative[j] += dt[k] * basis.chebyshev_1d[k * P + j];
    }
  }
}

}  // namespace hg

// interp[n] = prod_d value_d(n_d); direction d of grad has the derivative as its factor d.
int CeedBasisEvaluateAtPoint(CeedBasis basis, const CeedScalar *x_ref, CeedScalar *interp, CeedScalar *grad) {
  return hg::guard(hg::ceed_of(basis), [&] {
    const auto &b = hg::deref_basis(basis);
    hg::require_argument(x_ref, "x_ref (dim coordinates)");
    hg::require_polynomial(b);
    const CeedInt P = b.P_1d;
    std::vector<CeedScalar> value(static_cast<std::size_t>(b.dim) * P), derivative(value.size());
    for (CeedInt d = 0; d < b.dim; d++) hg::evaluate_1d(b, x_ref[d], &value[d * P], &derivative[d * P]);
    for (CeedInt n = 0; n < b.P; n++) {
      for (CeedInt g = -1; g < b.dim; g++) {
        CeedScalar *target = g < 0 ? interp : grad;
        if (target == nullptr) continue;
        CeedScalar product = 1.0;
        for (CeedInt d = 0, rest = n; d < b.dim; d++, rest /= P) {
          product *= (d == g ? derivative : value)[d * P + rest % P];
        }
        target[g < 0 ? n : g * b.P + n] = product;
      }
    }
  });
}

int CeedBasisGetChebyshevCoefficients1D(CeedBasis basis, CeedInt *num_coeff, const CeedScalar **chebyshev_1d) {
  return hg::guard(hg::ceed_of(basis), [&] {
    const auto &b = hg::deref_basis(basis);
    const bool is_known = !b.chebyshev_1d.empty();
    if (num_coeff != nullptr) *num_coeff = is_known ? b.num_chebyshev() : 0;
    if (chebyshev_1d != nullptr) *chebyshev_1d = is_known ? b.chebyshev_1d.data() : nullptr;
  });
}

int CeedBasisGetChebyshevInterp1D(CeedBasis basis, CeedScalar *chebyshev_interp_1d) {
  return hg::guard(hg::ceed_of(basis), [&] {
    const auto &b = hg::deref_basis(basis);
    hg::require_argument(chebyshev_interp_1d, "chebyshev_interp_1d (Q_1d * P_1d entries)");
    hg::require_tensor(b, "the Chebyshev interpolation");
    const auto coefficients = hg::chebyshev_coefficients(b.q_ref, b.interp_1d, b.P_1d);
    hg::require(!coefficients.empty(), CEED_ERROR_UNSUPPORTED,
                "CeedBasis: quadrature points coincide; expected distinct points for Chebyshev coefficients");
    std::copy(coefficients.begin(), coefficients.end(), chebyshev_interp_1d);
  });
}

// D = G B^+, so that D B = G for every basis with Q_1d >= P_1d.
int CeedBasisGetCollocatedGrad(CeedBasis basis, CeedScalar *colo_grad_1d) {
  return hg::guard(hg::ceed_of(basis), [&] {
    const auto &b = hg::deref_basis(basis);
    hg::require_argument(colo_grad_1d, "colo_grad_1d (Q_1d * Q_1d entries)");
    hg::require_tensor(b, "the collocated gradient");
    const auto inverse = hg::pseudo_inverse(b.interp_1d, b.Q_1d, b.P_1d, "CeedBasis: interp_1d");
    const auto d = hg::multiply(b.grad_1d, inverse, b.Q_1d, b.P_1d, b.Q_1d);
    std::copy(d.begin(), d.end(), colo_grad_1d);
  });
}
