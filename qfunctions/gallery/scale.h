/// @file
/// Gallery Scale: v_c = s_c u_c.
///
/// The context is one CeedInt: the number of components. Fields are added by whoever creates it.
/// in[0] u (n), in[1] s (n); out[0] v (n).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(Scale)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt num_comp = *(const CeedInt *)ctx;
  const CeedScalar *u = in[0], *s = in[1];
  CeedScalar *v = out[0];

  CeedPragmaSIMD for (CeedInt i = 0; i < Q * num_comp; i++) v[i] = s[i] * u[i];
  return CEED_ERROR_SUCCESS;
}
