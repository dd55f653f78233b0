/// @file
/// Gallery Vector3MassApply: v_c = q u_c, the action of a mass operator on three components.
///
/// in[0] u (3), in[1] stored q (1); out[0] v (3).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(Vector3MassApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *qdata = in[1];
  CeedScalar *v = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt c = 0; c < 3; c++) v[q + Q * c] = qdata[q] * u[q + Q * c];
  }
  return CEED_ERROR_SUCCESS;
}
