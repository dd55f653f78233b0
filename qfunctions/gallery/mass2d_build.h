/// @file
/// Gallery Mass2DBuild: q = w det J, the stored data of a mass operator in 2D.
///
/// in[0] gradient of the coordinates (4), in[1] quadrature weight (1); out[0] q (1).
#pragma once

#include "../common/jacobian.h"

CEED_QFUNCTION(Mass2DBuild)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *dx = in[0], *w = in[1];
  CeedScalar *qdata = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    CeedScalar A[2][2];

    qdata[q] = w[q] * JacobianAdjugate2D(Q, q, dx, A);
  }
  return CEED_ERROR_SUCCESS;
}
