/// @file
/// The weak form of u + ∇p = f, div u = g: ∫ v·u - p div v - q div u. in: w, u (as many values as the context says),
/// div u, p; out: v, div v, q.
#ifndef HG_TEST_SADDLE_POINT_H
#define HG_TEST_SADDLE_POINT_H

#include <ceed/types.h>

CEED_QFUNCTION(saddle_point)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt dim = *(const CeedInt *)ctx;
  for (CeedInt q = 0; q < Q; q++) {
    const CeedScalar w = in[0][q];
    for (CeedInt d = 0; d < dim; d++) out[0][d * Q + q] = w * in[1][d * Q + q];
    out[1][q] = -w * in[3][q];
    out[2][q] = -w * in[2][q];
  }
  return 0;
}

#endif
