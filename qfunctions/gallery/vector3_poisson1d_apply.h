/// @file
/// Gallery Vector3Poisson1DApply: dv = K du, the action of a Poisson operator on three components in 1D.
///
/// in[0] gradient of u (3), in[1] stored K (1); out[0] gradient for v (3).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(Vector3Poisson1DApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *du = in[0], *qdata = in[1];
  CeedScalar *dv = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt c = 0; c < 3; c++) dv[q + Q * c] = qdata[q] * du[q + Q * c];
  }
  return CEED_ERROR_SUCCESS;
}
