/// @file
/// BP3 to BP6: the Poisson operator ∫ ∇v·∇u on one and on three components, with six stored values a point.
#pragma once

#include "../common/jacobian.h"

/// Stored data K = w adj(J) adj(J)ᵀ / det J packed as (00, 11, 22, 12, 02, 01).
/// in[0] gradient of the coordinates (9), in[1] weight (1); out[0] K (6).
CEED_QFUNCTION(BPPoissonSetup)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *dx = in[0], *w = in[1];
  CeedScalar *qdata = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    CeedScalar A[3][3];
    const CeedScalar detJ = JacobianAdjugate3D(Q, q, dx, A);

    StoreScaledGram3D(Q, q, w[q] / detJ, A, qdata);
  }
  return CEED_ERROR_SUCCESS;
}

/// dv = K du. in[0] reference gradient of u (3), in[1] K (6); out[0] reference gradient for v (3).
CEED_QFUNCTION(BPPoissonApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *du = in[0], *qdata = in[1];
  CeedScalar *dv = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) ApplyPacked3D(Q, q, 0, 1, qdata, du, dv);
  return CEED_ERROR_SUCCESS;
}

/// dv_c = K du_c. in[0] reference gradient of u (9), in[1] K (6); out[0] reference gradient for v (9).
CEED_QFUNCTION(BPPoissonApply3)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *du = in[0], *qdata = in[1];
  CeedScalar *dv = out[0];

  (void)ctx;
  for (CeedInt c = 0; c < 3; c++) {
    CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) ApplyPacked3D(Q, q, c, 3, qdata, du, dv);
  }
  return CEED_ERROR_SUCCESS;
}
