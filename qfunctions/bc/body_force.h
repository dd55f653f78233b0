/// @file
/// Body force per unit of mass: w N (ρ₀/J_n) g.
#ifndef HG_BC_BODY_FORCE_H
#define HG_BC_BODY_FORCE_H

#include "../common/contexts.h"
#include "../common/kinematics.h"

/// in: q_data (10), F (9), rho (1); out: v (3)
CEED_QFUNCTION(HgBodyForce)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const HgBodyForceContext *context = (const HgBodyForceContext *)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *rho = in[2];
  CeedScalar *v = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    hg_load_reference(Q, i, q_data, F, &k);
    for (CeedInt c = 0; c < 3; c++) v[c * Q + i] = k.w * rho[i] * context->acceleration[c];
  }
  return 0;
}

#endif
