// A vector and a scalar that act on each other.
#pragma once

#include <ceed/types.h>

/// v = 2 u + (1, 1, 1) p, q = 3 p - (u_0 + u_1 + u_2)
CEED_QFUNCTION(coupled)
(void *, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *p = in[1];
  CeedScalar *v = out[0], *q = out[1];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    q[i] = 3 * p[i] - u[i] - u[i + Q] - u[i + 2 * Q];
    for (CeedInt c = 0; c < 3; c++) v[i + c * Q] = 2 * u[i + c * Q] + p[i];
  }
  return CEED_ERROR_SUCCESS;
}
