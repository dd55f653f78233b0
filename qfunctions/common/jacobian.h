/// @file
/// The mapping x(X) from the reference cell to space, at one quadrature or material point.
///
/// The gradient of the coordinates comes from the basis with the reference direction slowest and the coordinate next:
/// ∂x_c/∂X_d of point q is dx[q + Q (c + dim d)].
///
/// With J_cd = ∂x_c/∂X_d and A = adj J (so A J = det J · 1, that is A_dc = det J ∂X_d/∂x_c), the weak Laplacian in
/// reference coordinates is ∫ ∂v/∂X_d K_de ∂u/∂X_e with the symmetric K = w A Aᵀ / det J. A symmetric tensor is packed
/// as its diagonal followed by the off-diagonal entries (01) in 2D and (12, 02, 01) in 3D.
#pragma once

#include <ceed/types.h>

/// A = adj J of the 2×2 Jacobian of point q; returns det J.
CEED_QFUNCTION_HELPER
CeedScalar JacobianAdjugate2D(const CeedInt Q, const CeedInt q, const CeedScalar *dx, CeedScalar A[2][2]) {
  const CeedScalar J00 = dx[q + Q * 0], J10 = dx[q + Q * 1], J01 = dx[q + Q * 2], J11 = dx[q + Q * 3];

  A[0][0] = J11;
  A[0][1] = -J01;
  A[1][0] = -J10;
  A[1][1] = J00;
  return J00 * J11 - J01 * J10;
}

/// A = adj J of the 3×3 Jacobian of point q; returns det J.
CEED_QFUNCTION_HELPER
CeedScalar JacobianAdjugate3D(const CeedInt Q, const CeedInt q, const CeedScalar *dx, CeedScalar A[3][3]) {
  const CeedScalar J00 = dx[q + Q * 0], J10 = dx[q + Q * 1], J20 = dx[q + Q * 2];
  const CeedScalar J01 = dx[q + Q * 3], J11 = dx[q + Q * 4], J21 = dx[q + Q * 5];
  const CeedScalar J02 = dx[q + Q * 6], J12 = dx[q + Q * 7], J22 = dx[q + Q * 8];

  A[0][0] = J11 * J22 - J12 * J21;
  A[0][1] = J02 * J21 - J01 * J22;
  A[0][2] = J01 * J12 - J02 * J11;
  A[1][0] = J12 * J20 - J10 * J22;
  A[1][1] = J00 * J22 - J02 * J20;
  A[1][2] = J02 * J10 - J00 * J12;
  A[2][0] = J10 * J21 - J11 * J20;
  A[2][1] = J01 * J20 - J00 * J21;
  A[2][2] = J00 * J11 - J01 * J10;
  return J00 * A[0][0] + J10 * A[0][1] + J20 * A[0][2];
}

/// Writes K = s A Aᵀ of point q packed as (00, 11, 01).
CEED_QFUNCTION_HELPER
void StoreScaledGram2D(const CeedInt Q, const CeedInt q, const CeedScalar s, CeedScalar A[2][2], CeedScalar *K) {
  K[q + Q * 0] = s * (A[0][0] * A[0][0] + A[0][1] * A[0][1]);
  K[q + Q * 1] = s * (A[1][0] * A[1][0] + A[1][1] * A[1][1]);
  K[q + Q * 2] = s * (A[0][0] * A[1][0] + A[0][1] * A[1][1]);
}

/// Writes K = s A Aᵀ of point q packed as (00, 11, 22, 12, 02, 01).
CEED_QFUNCTION_HELPER
void StoreScaledGram3D(const CeedInt Q, const CeedInt q, const CeedScalar s, CeedScalar A[3][3], CeedScalar *K) {
  K[q + Q * 0] = s * (A[0][0] * A[0][0] + A[0][1] * A[0][1] + A[0][2] * A[0][2]);
  K[q + Q * 1] = s * (A[1][0] * A[1][0] + A[1][1] * A[1][1] + A[1][2] * A[1][2]);
  K[q + Q * 2] = s * (A[2][0] * A[2][0] + A[2][1] * A[2][1] + A[2][2] * A[2][2]);
  K[q + Q * 3] = s * (A[1][0] * A[2][0] + A[1][1] * A[2][1] + A[1][2] * A[2][2]);
  K[q + Q * 4] = s * (A[0][0] * A[2][0] + A[0][1] * A[2][1] + A[0][2] * A[2][2]);
  K[q + Q * 5] = s * (A[0][0] * A[1][0] + A[0][1] * A[1][1] + A[0][2] * A[1][2]);
}

/// dv_d = Σ_e K_de du_e for component c of num_comp at point q; K packed as (00, 11, 01), direction d of du and dv at
/// q + Q (c + num_comp d).
CEED_QFUNCTION_HELPER
void ApplyPacked2D(const CeedInt Q, const CeedInt q, const CeedInt c, const CeedInt num_comp, const CeedScalar *K,
                   const CeedScalar *du, CeedScalar *dv) {
  const CeedScalar K00 = K[q + Q * 0], K11 = K[q + Q * 1], K01 = K[q + Q * 2];
  const CeedScalar g0 = du[q + Q * c], g1 = du[q + Q * (c + num_comp)];

  dv[q + Q * c] = K00 * g0 + K01 * g1;
  dv[q + Q * (c + num_comp)] = K01 * g0 + K11 * g1;
}

/// dv_d = Σ_e K_de du_e for component c of num_comp at point q; K packed as (00, 11, 22, 12, 02, 01), direction d of du
/// and dv at q + Q (c + num_comp d).
CEED_QFUNCTION_HELPER
void ApplyPacked3D(const CeedInt Q, const CeedInt q, const CeedInt c, const CeedInt num_comp, const CeedScalar *K,
                   const CeedScalar *du, CeedScalar *dv) {
  const CeedScalar K00 = K[q + Q * 0], K11 = K[q + Q * 1], K22 = K[q + Q * 2];
  const CeedScalar K12 = K[q + Q * 3], K02 = K[q + Q * 4], K01 = K[q + Q * 5];
  const CeedScalar g0 = du[q + Q * c], g1 = du[q + Q * (c + num_comp)], g2 = du[q + Q * (c + 2 * num_comp)];

  dv[q + Q * c] = K00 * g0 + K01 * g1 + K02 * g2;
  dv[q + Q * (c + num_comp)] = K01 * g0 + K11 * g1 + K12 * g2;
  dv[q + Q * (c + 2 * num_comp)] = K02 * g0 + K12 * g1 + K22 * g2;
}
