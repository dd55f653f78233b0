/// @file
/// v = w u for each of the values of u, whose number is the context. in: w, u; out: v.
#ifndef HG_TEST_WEIGHTED_H
#define HG_TEST_WEIGHTED_H

#include <ceed/types.h>

CEED_QFUNCTION(weighted)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt size = *(const CeedInt *)ctx;
  for (CeedInt k = 0; k < size; k++) {
    for (CeedInt q = 0; q < Q; q++) out[0][k * Q + q] = in[0][q] * in[1][k * Q + q];
  }
  return 0;
}

#endif
