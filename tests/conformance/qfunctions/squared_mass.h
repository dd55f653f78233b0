/// @file
/// v = w c u². in: u, c, w; out: v.
#ifndef HG_TEST_SQUARED_MASS_H
#define HG_TEST_SQUARED_MASS_H

#include <ceed/types.h>

CEED_QFUNCTION(squared_mass)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  for (CeedInt q = 0; q < Q; q++) out[0][q] = in[2][q] * in[1][q] * in[0][q] * in[0][q];
  return 0;
}

#endif
