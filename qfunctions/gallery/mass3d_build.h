/// @file
/// Gallery Mass3DBuild: q = w det J, the stored data of a mass operator in 3D.
///
/// in[0] gradient of the coordinates (9), in[1] quadrature weight (1); out[0] q (1).
#pragma once

#include "../common/jacobian.h"

CEED_QFUNCTION(Mass3DBuild)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *dx = in[0], *w = in[1];
  CeedScalar *qdata = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    CeedScalar A[3][3];

    qdata[q] = w[q] * JacobianAdjugate3D(Q, q, dx, A);
  }
  return CEED_ERROR_SUCCESS;
}
