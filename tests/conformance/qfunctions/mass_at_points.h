/// @file
/// v_c = q u_c. in: u (n), q; out: v (n). The context is n, one CeedInt.
#ifndef HG_TEST_MASS_AT_POINTS_H
#define HG_TEST_MASS_AT_POINTS_H

#include <ceed/types.h>

CEED_QFUNCTION(mass_at_points)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedInt num_comp = *(const CeedInt *)ctx;
  for (CeedInt c = 0; c < num_comp; c++) {
    for (CeedInt q = 0; q < Q; q++) out[0][c * Q + q] = in[1][q] * in[0][c * Q + q];
  }
  return 0;
}

#endif
