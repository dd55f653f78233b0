#include "basis_factors.hpp"

#include <algorithm>
#include <cmath>

#include "access.hpp"

namespace hg::host {

namespace {

/// D with D B = G, for B and G Q by P; empty where there is none to working precision. With B = W R, the columns of W
/// orthonormal: D = G R^-1 W^T. (The core's pseudoinverse tells the user of dependent columns, which are no error
/// here.)
std::vector<CeedScalar> derivative_at_points(const CeedScalar *B, const CeedScalar *G, CeedInt Q, CeedInt P) {
  if (Q < P) return {};
  std::vector<CeedScalar> W(B, B + static_cast<std::size_t>(Q) * P), X(G, G + static_cast<std::size_t>(Q) * P);
  const auto dot = [&](CeedInt j, CeedInt k) {
    CeedScalar sum = 0;
    for (CeedInt q = 0; q < Q; q++) sum += W[q * P + j] * W[q * P + k];
    return sum;
  };
  // Column operations that make the columns of W orthonormal turn G into X = G R^-1.
  for (CeedInt k = 0; k < P; k++) {
    const CeedScalar before = std::sqrt(dot(k, k));
    for (CeedInt pass = 0; pass < 2; pass++) {
      for (CeedInt j = 0; j < k; j++) {
        const CeedScalar r = dot(j, k);
        for (CeedInt q = 0; q < Q; q++) {
          W[q * P + k] -= r * W[q * P + j];
          X[q * P + k] -= r * X[q * P + j];
        }
      }
    }
    const CeedScalar norm = std::sqrt(dot(k, k));
    if (!(norm > 1e-10 * before)) return {};
    for (CeedInt q = 0; q < Q; q++) {
      W[q * P + k] /= norm;
      X[q * P + k] /= norm;
    }
  }
  std::vector<CeedScalar> D(static_cast<std::size_t>(Q) * Q);
  CeedScalar largest = 0, error = 0;
  for (CeedInt i = 0; i < Q; i++) {
    for (CeedInt j = 0; j < Q; j++) {
      for (CeedInt k = 0; k < P; k++) D[i * Q + j] += X[i * P + k] * W[j * P + k];
    }
    for (CeedInt k = 0; k < P; k++) {
      CeedScalar product = 0;
      for (CeedInt j = 0; j < Q; j++) product += D[i * Q + j] * B[j * P + k];
      largest = std::max(largest, std::abs(G[i * P + k]));
      error = std::max(error, std::abs(product - G[i * P + k]));
    }
  }
  return error <= 1e-14 * Q * largest ? D : std::vector<CeedScalar>();
}

}  // namespace

BasisFactors::BasisFactors(CeedBasis basis) {
  bool is_tensor = false;
  chk(CeedBasisIsTensor(basis, &is_tensor));
  chk(CeedBasisGetNumComponents(basis, &num_comp));
  if (is_tensor) {
    read_tensor(basis);
  } else {
    read_full(basis);
  }
}

void BasisFactors::read_tensor(CeedBasis basis) {
  const CeedScalar *B, *G, *weight;
  chk(CeedBasisGetDimension(basis, &num_directions));
  chk(CeedBasisGetNumNodes1D(basis, &P));
  chk(CeedBasisGetNumQuadraturePoints1D(basis, &Q));
  chk(CeedBasisGetInterp1D(basis, &B));
  chk(CeedBasisGetGrad1D(basis, &G));
  chk(CeedBasisGetQWeights(basis, &weight));
  const std::size_t size = static_cast<std::size_t>(Q) * P;
  bool is_identity = P == Q;
  for (CeedInt i = 0; i < Q && is_identity; i++) {
    for (CeedInt j = 0; j < P; j++) is_identity = is_identity && B[i * P + j] == (i == j ? 1.0 : 0.0);
  }
  interp_1d.assign(B, B + size);
  if (!is_identity) grad_1d = derivative_at_points(B, G, Q, P);
  route = is_identity ? Route::identity : !grad_1d.empty() ? Route::collocated : Route::chains;
  if (grad_1d.empty()) grad_1d.assign(G, G + size);
  weights = {1.0};
  for (CeedInt d = 0; d < num_directions; d++) {
    std::vector<CeedScalar> product;
    for (CeedInt q = 0; q < Q; q++) {
      for (const CeedScalar w : weights) product.push_back(w * weight[q]);
    }
    weights = std::move(product);
  }
}

void BasisFactors::read_full(CeedBasis basis) {
  const CeedScalar *matrices, *weight;
  chk(CeedBasisGetNumNodes(basis, &P));
  chk(CeedBasisGetNumQuadraturePoints(basis, &Q));
  const std::size_t size = static_cast<std::size_t>(P) * Q;
  const auto add = [&](CeedEvalMode mode, std::vector<const CeedScalar *> &factors) {
    CeedInt count = 0;
    chk(CeedBasisGetNumQuadratureComponents(basis, mode, &count));
    chk(CeedOperatorGetBasisPointer(basis, mode, nullptr, &matrices));
    for (CeedInt g = 0; g < count; g++) factors.push_back(matrices + g * size);
  };
  add(CEED_EVAL_INTERP, interp);
  CeedEvalMode mode = CEED_EVAL_NONE;
  chk(CeedBasisGetDerivativeMode(basis, &mode));
  if (mode != CEED_EVAL_NONE) add(mode, derivative);
  chk(CeedBasisGetQWeights(basis, &weight));
  weights.assign(weight, weight + Q);
}

}  // namespace hg::host
