#include "point_basis.hpp"

#include <algorithm>

#include "access.hpp"

namespace hg::host {

bool PointBasis::takes(const Kernels &kernels, CeedBasis basis) {
  CeedInt num_coeff = 0;
  const CeedScalar *coefficients = nullptr;
  chk(CeedBasisGetChebyshevCoefficients1D(basis, &num_coeff, &coefficients));
  return num_coeff > 0 && kernels.point_evaluation(num_coeff, true, false) != nullptr;
}

PointBasis::PointBasis(const Kernels &kernels, CeedBasis basis) : width_(kernels.width) {
  const CeedScalar *coefficients = nullptr;
  chk(CeedBasisGetDimension(basis, &dim_));
  chk(CeedBasisGetNumComponents(basis, &num_comp_));
  chk(CeedBasisGetNumNodes1D(basis, &P_));
  chk(CeedBasisGetChebyshevCoefficients1D(basis, &K_, &coefficients));
  matrix_ = Factor(kernels, coefficients, K_, P_);
  for (const bool with_derivatives : {false, true}) {
    for (const bool is_across : {false, true}) {
      evaluate[with_derivatives][is_across] = kernels.point_evaluation(K_, with_derivatives, is_across);
      integrate[with_derivatives][is_across] = kernels.point_integration(K_, with_derivatives, is_across);
    }
  }
}

std::size_t PointBasis::work_size() const {
  return 2 * static_cast<std::size_t>(CeedIntPow(std::max(K_, P_), dim_)) * num_comp_ * width_;
}

void PointBasis::to_coefficients(const CeedScalar *u, CeedScalar *c, CeedScalar *work) const {
  Ahead nothing;
  for (CeedInt d = 0; d < dim_; d++) {
    CeedScalar *out = d == dim_ - 1 ? c : work + (d % 2) * (work_size() / 2);
    matrix_.apply(num_comp_ * CeedIntPow(P_, dim_ - 1 - d), CeedIntPow(K_, d), u, out, nothing);
    u = out;
  }
}

void PointBasis::from_coefficients(const CeedScalar *c, CeedScalar *u, bool add, CeedScalar *work) const {
  Ahead nothing;
  for (CeedInt d = 0; d < dim_; d++) {
    const bool is_last = d == dim_ - 1;
    CeedScalar *out = is_last ? u : work + (d % 2) * (work_size() / 2);
    matrix_.apply_transpose(num_comp_ * CeedIntPow(K_, dim_ - 1 - d), CeedIntPow(P_, d), c, out, nothing,
                            add && is_last);
    c = out;
  }
}

}  // namespace hg::host
