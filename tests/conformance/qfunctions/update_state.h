/// @file
/// F_new = (1 + ∇u) F in 2D, and the trace of F_new. in: ∇u (direction slower than component: ∂u_c/∂x_d at d*2 + c), F
/// (row-major); out: F_new, trace.
#ifndef HG_TEST_UPDATE_STATE_H
#define HG_TEST_UPDATE_STATE_H

#include <ceed/types.h>

CEED_QFUNCTION(update_state)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  for (CeedInt q = 0; q < Q; q++) {
    CeedScalar trace = 0;
    for (CeedInt c = 0; c < 2; c++) {
      for (CeedInt d = 0; d < 2; d++) {
        CeedScalar value = in[1][(c * 2 + d) * Q + q];
        for (CeedInt k = 0; k < 2; k++) value += in[0][(k * 2 + c) * Q + q] * in[1][(k * 2 + d) * Q + q];
        out[0][(c * 2 + d) * Q + q] = value;
        if (c == d) trace += value;
      }
    }
    out[1][q] = trace;
  }
  return 0;
}

#endif
