/// @file
/// Gallery Scale (scalar): v_c = s u_c.
///
/// The context is one CeedInt: the number of components. Fields are added by whoever creates it.
/// in[0] u (n), in[1] s (1); out[0] v (n).
#pragma once

#include <ceed/types.h>

CEED_QFUNCTION(ScaleScalar)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt num_comp = *(const CeedInt *)ctx;
  const CeedScalar *u = in[0], *s = in[1];
  CeedScalar *v = out[0];

  for (CeedInt c = 0; c < num_comp; c++) {
    CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) v[q + Q * c] = s[q] * u[q + Q * c];
  }
  return CEED_ERROR_SUCCESS;
}
