/// @file
/// Gallery Identity to scalar: v = u_0, the first component.
///
/// The context is not read. Fields are added by whoever creates it.
/// in[0] u (n); out[0] v (1).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(IdentityScalar)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0];
  CeedScalar *v = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) v[q] = u[q];
  return CEED_ERROR_SUCCESS;
}
