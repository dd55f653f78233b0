/// @file
/// q_data (10) at integration points: the weight, then dXdx[3*k + j] = ∂X_k/∂x_j.
#ifndef HG_COMMON_GEOMETRY_H
#define HG_COMMON_GEOMETRY_H

#include "tensor.h"

/// Quadrature points of a cell. in: ∂x/∂X (9), quadrature weight (1); out: q_data (10) with w det ∂x/∂X
CEED_QFUNCTION(HgGeometry)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *dx = in[0], *w = in[1];
  CeedScalar *q_data = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) q_data[i] = w[i] * hg_store_inverse_jacobian(Q, i, dx, q_data + Q);
  return 0;
}

#endif
