/// @file
/// Gallery Poisson1DBuild: K = w / J, the stored data of a Poisson operator in 1D.
///
/// in[0] gradient of the coordinate (1), in[1] quadrature weight (1); out[0] K (1).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(Poisson1DBuild)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *dx = in[0], *w = in[1];
  CeedScalar *qdata = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) qdata[q] = w[q] / dx[q];
  return CEED_ERROR_SUCCESS;
}
