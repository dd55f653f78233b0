/// @file
/// A QFunction that touches every value of every field: with the values x_i of the active inputs and y_j of the passive
/// ones, out_o = (1 + Σ_j factor_j y_j) Σ_i matrix_oi x_i. Without active inputs, out_o = (1 + Σ_j factor_j y_j)
/// matrix_o0. Values are counted over the inputs in their order, active and passive ones apart.
#ifndef HG_TEST_MIX_H
#define HG_TEST_MIX_H

#include <ceed/types.h>

#include "mix_context.h"

CEED_QFUNCTION(mix)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const MixContext *mix_ctx = (const MixContext *)ctx;
  for (CeedInt q = 0; q < Q; q++) {
    CeedScalar scale = 1, active[MIX_MAX_VALUES];
    CeedInt num_active = 0, num_passive = 0;
    for (CeedInt f = 0; f < mix_ctx->num_in; f++) {
      for (CeedInt k = 0; k < mix_ctx->in_size[f]; k++) {
        const CeedScalar value = in[f][k * Q + q];
        if (mix_ctx->in_is_active[f]) {
          active[num_active++] = value;
        } else {
          scale += mix_ctx->factor[num_passive++] * value;
        }
      }
    }
    if (num_active == 0) active[num_active++] = 1;
    CeedInt row = 0;
    for (CeedInt f = 0; f < mix_ctx->num_out; f++) {
      for (CeedInt k = 0; k < mix_ctx->out_size[f]; k++, row++) {
        CeedScalar sum = 0;
        for (CeedInt i = 0; i < num_active; i++) sum += mix_ctx->matrix[row * MIX_MAX_VALUES + i] * active[i];
        out[f][k * Q + q] = scale * sum;
      }
    }
  }
  return 0;
}

#endif
