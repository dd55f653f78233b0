/// @file
/// Gallery Poisson2DApply: dv = K du, the action of a scalar Poisson operator in 2D.
///
/// in[0] gradient of u (2), in[1] stored K (3); out[0] gradient for v (2).
#pragma once

#include "../common/jacobian.h"

CEED_QFUNCTION(Poisson2DApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *du = in[0], *qdata = in[1];
  CeedScalar *dv = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) ApplyPacked2D(Q, q, 0, 1, qdata, du, dv);
  return CEED_ERROR_SUCCESS;
}
