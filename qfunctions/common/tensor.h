/// @file
/// 3 x 3 tensors for QFunctions, in forms that keep their digits near the undeformed state.
///
/// A full tensor is A[9], A[3*i + j]. A symmetric tensor is s[6] = {xx, yy, zz, yz, xz, xy}.
/// C text for host and device: no memory but the caller's, no branch that threads could not take together.
#ifndef HG_COMMON_TENSOR_H
#define HG_COMMON_TENSOR_H

#include <ceed/types.h>
#ifndef CEED_RUNNING_JIT_PASS
#include <math.h>
#endif

/// The n components of point i of a field at Q points.
CEED_QFUNCTION_HELPER
void hg_load(CeedInt Q, CeedInt i, CeedInt n, const CeedScalar *field, CeedScalar *a) {
  for (CeedInt c = 0; c < n; c++) a[c] = field[c * Q + i];
}

CEED_QFUNCTION_HELPER
void hg_store(CeedInt Q, CeedInt i, CeedInt n, const CeedScalar *a, CeedScalar *field) {
  for (CeedInt c = 0; c < n; c++) field[c * Q + i] = a[c];
}

/// Physical gradient A[3*c + j] = Σ_d du[d][c] dXdx[3*d + j] of a 3-vector; du is laid out as CEED_EVAL_GRAD gives it,
/// with the reference direction d slowest.
CEED_QFUNCTION_HELPER
void hg_gradient(CeedInt Q, CeedInt i, const CeedScalar *du, const CeedScalar *dXdx, CeedScalar *A) {
  for (CeedInt c = 0; c < 3; c++) {
    for (CeedInt j = 0; j < 3; j++) {
      CeedScalar sum = 0.;
      for (CeedInt d = 0; d < 3; d++) sum += du[(3 * d + c) * Q + i] * dXdx[3 * d + j];
      A[3 * c + j] = sum;
    }
  }
}

/// The transpose of hg_gradient, times w: dv[d][c] = w Σ_j dXdx[3*d + j] P[3*c + j], that is w ∇v : P.
CEED_QFUNCTION_HELPER
void hg_gradient_transpose(CeedInt Q, CeedInt i, CeedScalar w, const CeedScalar *dXdx, const CeedScalar *P,
                           CeedScalar *dv) {
  for (CeedInt d = 0; d < 3; d++) {
    for (CeedInt c = 0; c < 3; c++) {
      CeedScalar sum = 0.;
      for (CeedInt j = 0; j < 3; j++) sum += dXdx[3 * d + j] * P[3 * c + j];
      dv[(3 * d + c) * Q + i] = w * sum;
    }
  }
}

/// C = A B
CEED_QFUNCTION_HELPER
void hg_multiply(const CeedScalar *A, const CeedScalar *B, CeedScalar *C) {
  for (CeedInt i = 0; i < 3; i++) {
    for (CeedInt j = 0; j < 3; j++) C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  }
}

/// C = A Bᵀ
CEED_QFUNCTION_HELPER
void hg_multiply_transpose(const CeedScalar *A, const CeedScalar *B, CeedScalar *C) {
  for (CeedInt i = 0; i < 3; i++) {
    for (CeedInt j = 0; j < 3; j++) {
      C[3 * i + j] = A[3 * i] * B[3 * j] + A[3 * i + 1] * B[3 * j + 1] + A[3 * i + 2] * B[3 * j + 2];
    }
  }
}

/// A = s as a full tensor
CEED_QFUNCTION_HELPER
void hg_unpack_symmetric(const CeedScalar *s, CeedScalar *A) {
  A[0] = s[0];
  A[4] = s[1];
  A[8] = s[2];
  A[5] = A[7] = s[3];
  A[2] = A[6] = s[4];
  A[1] = A[3] = s[5];
}

/// s = (A + Aᵀ)/2
CEED_QFUNCTION_HELPER
void hg_symmetric_part(const CeedScalar *A, CeedScalar *s) {
  s[0] = A[0];
  s[1] = A[4];
  s[2] = A[8];
  s[3] = 0.5 * (A[5] + A[7]);
  s[4] = 0.5 * (A[2] + A[6]);
  s[5] = 0.5 * (A[1] + A[3]);
}

CEED_QFUNCTION_HELPER
CeedScalar hg_trace(const CeedScalar *A) {
  return A[0] + A[4] + A[8];
}

/// A : B
CEED_QFUNCTION_HELPER
CeedScalar hg_contract(const CeedScalar *A, const CeedScalar *B) {
  CeedScalar sum = 0.;
  for (CeedInt k = 0; k < 9; k++) sum += A[k] * B[k];
  return sum;
}

/// Second invariant (tr²A − tr A²)/2
CEED_QFUNCTION_HELPER
CeedScalar hg_second_invariant(const CeedScalar *A) {
  return (A[0] * A[4] - A[1] * A[3]) + (A[0] * A[8] - A[2] * A[6]) + (A[4] * A[8] - A[5] * A[7]);
}

CEED_QFUNCTION_HELPER
CeedScalar hg_determinant(const CeedScalar *A) {
  return A[0] * (A[4] * A[8] - A[5] * A[7]) + A[1] * (A[5] * A[6] - A[3] * A[8]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
}

/// det(I + H) − 1 = tr H + II(H) + det H, without the 1 that would take the digits of a small H.
CEED_QFUNCTION_HELPER
CeedScalar hg_determinant_minus_one(const CeedScalar *H) {
  return hg_trace(H) + (hg_second_invariant(H) + hg_determinant(H));
}

/// B = A⁻¹, with det = det A
CEED_QFUNCTION_HELPER
void hg_inverse(const CeedScalar *A, CeedScalar det, CeedScalar *B) {
  const CeedScalar r = 1. / det;
  B[0] = r * (A[4] * A[8] - A[5] * A[7]);
  B[1] = r * (A[2] * A[7] - A[1] * A[8]);
  B[2] = r * (A[1] * A[5] - A[2] * A[4]);
  B[3] = r * (A[5] * A[6] - A[3] * A[8]);
  B[4] = r * (A[0] * A[8] - A[2] * A[6]);
  B[5] = r * (A[2] * A[3] - A[0] * A[5]);
  B[6] = r * (A[3] * A[7] - A[4] * A[6]);
  B[7] = r * (A[1] * A[6] - A[0] * A[7]);
  B[8] = r * (A[0] * A[4] - A[1] * A[3]);
}

/// dX/dx from dx (9), the reference gradient of the coordinates as CEED_EVAL_GRAD gives it; returns det ∂x/∂X.
CEED_QFUNCTION_HELPER
CeedScalar hg_store_inverse_jacobian(CeedInt Q, CeedInt i, const CeedScalar *dx, CeedScalar *dXdx) {
  CeedScalar dxdX[9], inverse[9];
  for (CeedInt d = 0; d < 3; d++) {
    for (CeedInt c = 0; c < 3; c++) dxdX[3 * c + d] = dx[(3 * d + c) * Q + i];
  }
  const CeedScalar det = hg_determinant(dxdX);
  hg_inverse(dxdX, det, inverse);
  hg_store(Q, i, 9, inverse, dXdx);
  return det;
}

/// x − log(1 + x) for x > −1, to full relative precision near 0. With s = x/(2 + x), log(1 + x) = 2 artanh s and
/// x = 2s/(1 − s), so x − log(1 + x) = x s − 2 s³ (1/3 + s²/5 + s⁴/7 + …). NaN for x < −1.
CEED_QFUNCTION_HELPER
CeedScalar hg_x_minus_log1p(CeedScalar x) {
  if (fabs(x) > 0.2) return x - log1p(x);
  const CeedScalar s = x / (2. + x), t = s * s;
  // |s| < 0.1115 here: the first term left out is below 2e-17 of the sum
  const CeedScalar series =
      1. / 3. +
      t * (1. / 5. + t * (1. / 7. + t * (1. / 9. + t * (1. / 11. + t * (1. / 13. + t * (1. / 15. + t * (1. / 17.)))))));
  return x * s - 2. * s * t * series;
}

/// 0 where J > 0, NaN where a cell is inverted: added to a result, it makes the inversion visible in every norm.
CEED_QFUNCTION_HELPER
CeedScalar hg_nan_if_inverted(CeedScalar J) {
  return J > 0. ? 0. : sqrt(-1.);
}

#endif
