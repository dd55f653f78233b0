/// @file
/// Gallery Vector3Poisson2DApply: dv = K du, the action of a Poisson operator on three components in 2D.
///
/// in[0] gradient of u (6), in[1] stored K (3); out[0] gradient for v (6).
#pragma once

#include "../common/jacobian.h"

CEED_QFUNCTION(Vector3Poisson2DApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *du = in[0], *qdata = in[1];
  CeedScalar *dv = out[0];

  (void)ctx;
  for (CeedInt c = 0; c < 3; c++) {
    CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) ApplyPacked2D(Q, q, c, 3, qdata, du, dv);
  }
  return CEED_ERROR_SUCCESS;
}
