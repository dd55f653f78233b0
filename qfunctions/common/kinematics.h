/// @file
/// Kinematics of one step, the same for FEM and MPM (see docs/theory/impm.md).
///
/// The mesh coordinates x are those at the start of the step. F_n is what the point has seen before, Δu what the step
/// adds: ΔH = ∇Δu, F = (I + ΔH) F_n = I + H with H = H_n + ΔH + ΔH H_n and H_n = F_n − I. FEM has F_n = I, so H = ΔH.
#ifndef HG_COMMON_KINEMATICS_H
#define HG_COMMON_KINEMATICS_H

#include "tensor.h"

typedef struct {
  CeedScalar w;        ///< weight of the point over J_n: its undeformed volume
  CeedScalar dXdx[9];  ///< ∂X/∂x, X the reference coordinates of the cell
  CeedScalar F_n[9];
  CeedScalar dH[9];  ///< ΔH
  CeedScalar H[9];
  CeedScalar J_minus_1;  ///< det F − 1
} HgKinematics;

/// w/J_n, dXdx and F_n of point i.
CEED_QFUNCTION_HELPER
void hg_load_reference(CeedInt Q, CeedInt i, const CeedScalar *q_data, const CeedScalar *F, HgKinematics *k) {
  CeedScalar H_n[9];
  hg_load(Q, i, 9, q_data + Q, k->dXdx);
  hg_load(Q, i, 9, F, k->F_n);
  for (CeedInt c = 0; c < 9; c++) H_n[c] = k->F_n[c] - (c % 4 == 0 ? 1. : 0.);
  k->w = q_data[i] / (1. + hg_determinant_minus_one(H_n));
}

/// Everything, from q_data (10), F (9) and the reference gradient of Δu (9).
CEED_QFUNCTION_HELPER
void hg_load_kinematics(CeedInt Q, CeedInt i, const CeedScalar *q_data, const CeedScalar *F, const CeedScalar *du,
                        HgKinematics *k) {
  CeedScalar H_n[9];
  hg_load_reference(Q, i, q_data, F, k);
  hg_gradient(Q, i, du, k->dXdx, k->dH);
  for (CeedInt c = 0; c < 9; c++) H_n[c] = k->F_n[c] - (c % 4 == 0 ? 1. : 0.);
  hg_multiply(k->dH, H_n, k->H);
  for (CeedInt c = 0; c < 9; c++) k->H[c] += H_n[c] + k->dH[c];
  k->J_minus_1 = hg_determinant_minus_one(k->H);
}

/// λ = K − 2μ/3
CEED_QFUNCTION_HELPER
CeedScalar hg_lambda(CeedScalar K, CeedScalar mu) {
  return K - 2. / 3. * mu;
}

/// The ten diagnostic values of a point from its Cauchy stress (symmetric, 6), J and energy ψ per undeformed volume:
/// the stress {xx, yy, zz, yz, xz, xy}, pressure −tr σ/3, von Mises stress, J, ψ.
CEED_QFUNCTION_HELPER
void hg_store_diagnostic(CeedInt Q, CeedInt i, const CeedScalar *sigma, CeedScalar J, CeedScalar psi,
                         CeedScalar *diagnostic) {
  const CeedScalar p = -(sigma[0] + sigma[1] + sigma[2]) / 3.;
  CeedScalar deviator = 0., shear = 0.;
  for (CeedInt c = 0; c < 3; c++) {
    deviator += (sigma[c] + p) * (sigma[c] + p);
    shear += sigma[3 + c] * sigma[3 + c];
  }
  hg_store(Q, i, 6, sigma, diagnostic);
  diagnostic[6 * Q + i] = p;
  diagnostic[7 * Q + i] = sqrt(1.5 * deviator + 3. * shear);
  diagnostic[8 * Q + i] = J;
  diagnostic[9 * Q + i] = psi;
}

#endif
