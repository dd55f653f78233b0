/// @file
/// v = w c m u, ∂v_d = w c k_d ∂u_d for each component: mass and anisotropic stiffness with a coefficient c at each point.
/// in: w, c, u, ∂u; out: v, ∂v.
#ifndef HG_TEST_HELMHOLTZ_H
#define HG_TEST_HELMHOLTZ_H

#include <ceed/types.h>

#include "helmholtz_context.h"

CEED_QFUNCTION(helmholtz)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const HelmholtzContext *context = (const HelmholtzContext *)ctx;
  const CeedInt num_comp = context->num_comp;
  for (CeedInt c = 0; c < num_comp; c++) {
    for (CeedInt q = 0; q < Q; q++) {
      const CeedScalar scale = in[0][q] * in[1][q];
      out[0][c * Q + q] = scale * context->mass * in[2][c * Q + q];
      for (CeedInt d = 0; d < context->dim; d++) {
        const CeedInt i = (d * num_comp + c) * Q + q;
        out[1][i] = scale * context->stiffness[d] * in[3][i];
      }
    }
  }
  return 0;
}

#endif
