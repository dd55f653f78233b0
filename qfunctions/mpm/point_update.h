/// @file
/// The end of a step at a material point: what a point carries after the increment Δu of the mesh.
///
///   x ← x + Δu,  u ← u + Δu,  F ← (I + ∇Δu) F,  V ← det(I + ∇Δu) V,  v ← Δu/Δt
///
/// Outputs are new values; nothing is overwritten, so that a step can still be rejected.
#ifndef HG_MPM_POINT_UPDATE_H
#define HG_MPM_POINT_UPDATE_H

#include "../common/contexts.h"
#include "../common/tensor.h"

/// in: q_data (10), F (9), x (3), u (3), Δu (3), ∇Δu (9); out: x (3), u (3), v (3), F (9), V (1).
/// V is NaN where det(I + ∇Δu) <= 0.
CEED_QFUNCTION(HgPointUpdate)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar delta_t = ((const HgPointUpdateContext *)ctx)->delta_t;
  const CeedScalar *q_data = in[0], *F = in[1], *x = in[2], *u = in[3], *delta_u = in[4], *grad_delta_u = in[5];
  CeedScalar *x_new = out[0], *u_new = out[1], *v_new = out[2], *F_new = out[3], *V_new = out[4];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    CeedScalar dXdx[9], dH[9], F_n[9], F_next[9];
    for (CeedInt c = 0; c < 3; c++) {
      const CeedScalar delta = delta_u[c * Q + i];
      x_new[c * Q + i] = x[c * Q + i] + delta;
      u_new[c * Q + i] = u[c * Q + i] + delta;
      v_new[c * Q + i] = delta / delta_t;
    }
    hg_load(Q, i, 9, q_data + Q, dXdx);
    hg_load(Q, i, 9, F, F_n);
    hg_gradient(Q, i, grad_delta_u, dXdx, dH);
    hg_multiply(dH, F_n, F_next);
    for (CeedInt c = 0; c < 9; c++) F_next[c] += F_n[c];
    hg_store(Q, i, 9, F_next, F_new);
    const CeedScalar J_minus_1 = hg_determinant_minus_one(dH);
    V_new[i] = q_data[i] + (J_minus_1 + hg_nan_if_inverted(1. + J_minus_1)) * q_data[i];
  }
  return 0;
}

#endif
