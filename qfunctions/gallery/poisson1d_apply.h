/// @file
/// Gallery Poisson1DApply: dv = K du, the action of a scalar Poisson operator in 1D.
///
/// in[0] gradient of u (1), in[1] stored K (1); out[0] gradient for v (1).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(Poisson1DApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *du = in[0], *qdata = in[1];
  CeedScalar *dv = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) dv[q] = qdata[q] * du[q];
  return CEED_ERROR_SUCCESS;
}
