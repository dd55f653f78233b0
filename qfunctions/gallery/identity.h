/// @file
/// Gallery Identity: v = u.
///
/// The context is one CeedInt: the number of components. Fields are added by whoever creates it.
/// in[0] u (n); out[0] v (n).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(Identity)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt num_comp = *(const CeedInt *)ctx;
  const CeedScalar *u = in[0];
  CeedScalar *v = out[0];

  CeedPragmaSIMD for (CeedInt i = 0; i < Q * num_comp; i++) v[i] = u[i];
  return CEED_ERROR_SUCCESS;
}
