/// @file
/// q_data (10) at material points: the point's current volume V in place of a quadrature weight, then dXdx.
#ifndef HG_MPM_GEOMETRY_POINTS_H
#define HG_MPM_GEOMETRY_POINTS_H

#include "../common/tensor.h"

/// in: ∂x/∂X (9), V (1); out: q_data (10)
CEED_QFUNCTION(HgGeometryPoints)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *dx = in[0], *V = in[1];
  CeedScalar *q_data = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    q_data[i] = V[i];
    (void)hg_store_inverse_jacobian(Q, i, dx, q_data + Q);
  }
  return 0;
}

#endif
