/// @file
/// Gallery MassApply: v = q u, the action of a scalar mass operator.
///
/// in[0] u (1), in[1] stored q (1); out[0] v (1).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(MassApply)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *qdata = in[1];
  CeedScalar *v = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) v[q] = qdata[q] * u[q];
  return CEED_ERROR_SUCCESS;
}
