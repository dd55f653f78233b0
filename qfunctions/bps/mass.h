/// @file
/// BP1 and BP2: the mass operator ∫ v·u on one and on three components, with one stored value a point.
#pragma once

#include "../common/jacobian.h"

/// Stored data q = w det J. in[0] gradient of the coordinates (9), in[1] weight (1); out[0] q (1).
CEED_QFUNCTION(BPMassSetup)
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

/// v = q u. in[0] u (1), in[1] q (1); out[0] v (1).
CEED_QFUNCTION(BPMassApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *qdata = in[1];
  CeedScalar *v = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) v[q] = qdata[q] * u[q];
  return CEED_ERROR_SUCCESS;
}

/// v_c = q u_c. in[0] u (3), in[1] q (1); out[0] v (3).
CEED_QFUNCTION(BPMassApply3)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *qdata = in[1];
  CeedScalar *v = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt c = 0; c < 3; c++) v[q + Q * c] = qdata[q] * u[q + Q * c];
  }
  return CEED_ERROR_SUCCESS;
}
