/// @file
/// Gallery Mass1DBuild: q = w det J, the stored data of a mass operator in 1D.
///
/// in[0] gradient of the coordinates (1), in[1] quadrature weight (1); out[0] q (1).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(Mass1DBuild)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *dx = in[0], *w = in[1];
  CeedScalar *qdata = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    qdata[q] = w[q] * dx[q];
  }
  return CEED_ERROR_SUCCESS;
}
