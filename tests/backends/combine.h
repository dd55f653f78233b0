// What the copy benchmark computes at each point.
#pragma once

#include <ceed/types.h>

/// o = a + b/2 for nine numbers each
CEED_QFUNCTION(combine)
(void *, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *a = in[0], *b = in[1];
  CeedScalar *o = out[0];
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt c = 0; c < 9; c++) o[q + c * Q] = a[q + c * Q] + 0.5 * b[q + c * Q];
  }
  return CEED_ERROR_SUCCESS;
}
