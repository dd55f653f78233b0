/// @file
/// Products with the weight of a point, and sums over points, for fields of any size.
#ifndef HG_COMMON_INTEGRALS_H
#define HG_COMMON_INTEGRALS_H

#include "contexts.h"
#include "kinematics.h"

/// v = w u for each component. With u and v interpolated this is a mass matrix; with u the value that a point carries
/// it is the right-hand side of a projection to the mesh. in: q_data (10), u (num_comp); out: v (num_comp)
CEED_QFUNCTION(HgMass)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt num_comp = ((const HgMassContext *)ctx)->num_comp;
  const CeedScalar *w = in[0], *u = in[1];
  CeedScalar *v = out[0];
  for (CeedInt c = 0; c < num_comp; c++) {
    CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) v[c * Q + i] = w[i] * u[c * Q + i];
  }
  return 0;
}

/// The value itself, for evaluating a field of the mesh at points: v = u. in: u (num_comp); out: v (num_comp)
CEED_QFUNCTION(HgCopy)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt size = Q * ((const HgMassContext *)ctx)->num_comp;
  const CeedScalar *u = in[0];
  CeedScalar *v = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < size; i++) v[i] = u[i];
  return 0;
}

/// The weight itself: with v interpolated this is the row sum of the mass matrix.
/// in: q_data (10); out: v (1)
CEED_QFUNCTION(HgWeight)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *w = in[0];
  CeedScalar *v = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) v[i] = w[i];
  return 0;
}

/// in: q_data (10), F (9), rho (1), u (3), ∇u (9);
/// out: integrals (5): deformed volume w J/J_n, mass w ρ₀/J_n, mass times u (3)
CEED_QFUNCTION(HgIntegrals)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *rho = in[2], *u = in[3], *du = in[4];
  CeedScalar *integrals = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    hg_load_kinematics(Q, i, q_data, F, du, &k);
    const CeedScalar mass = k.w * rho[i];
    integrals[i] = k.w * (1. + k.J_minus_1);
    integrals[Q + i] = mass;
    for (CeedInt c = 0; c < 3; c++) integrals[(2 + c) * Q + i] = mass * u[c * Q + i];
  }
  return 0;
}

#endif
