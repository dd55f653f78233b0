/// @file
/// Gallery Poisson2DBuild: K = w adj(J) adj(J)ᵀ / det J packed as (00, 11, 01), the stored data of a Poisson operator
/// in 2D.
///
/// in[0] gradient of the coordinates (4), in[1] quadrature weight (1); out[0] K (3).
#pragma once

#include "../common/jacobian.h"

CEED_QFUNCTION(Poisson2DBuild)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *dx = in[0], *w = in[1];
  CeedScalar *qdata = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    CeedScalar A[2][2];
    const CeedScalar detJ = JacobianAdjugate2D(Q, q, dx, A);

    StoreScaledGram2D(Q, q, w[q] / detJ, A, qdata);
  }
  return CEED_ERROR_SUCCESS;
}
