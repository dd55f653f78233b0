/// @file
/// A linear QFunction of any number of fields: out_o = Σ_i (a_oi + b_oi s) x_i, where x_i are the values of the active
/// inputs, s is the sum of those of the passive inputs, and a and b are numbers of [-1, 1) that follow from the seed.
#ifndef HG_TEST_BLEND_H
#define HG_TEST_BLEND_H

#include <ceed/types.h>

#include "blend_context.h"

CEED_QFUNCTION_HELPER
CeedScalar blend_number(CeedInt seed, CeedInt o, CeedInt i) {
  const CeedInt mixed = (seed % 1009) * 7 + o * 193 + i * 389 + (o * i) % 31 * 57;
  return (mixed % 200) / (CeedScalar)100 - 1;
}

CEED_QFUNCTION(blend)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const BlendContext *blend_ctx = (const BlendContext *)ctx;
  for (CeedInt q = 0; q < Q; q++) {
    CeedScalar s = 0;
    for (CeedInt f = 0; f < blend_ctx->num_in; f++) {
      for (CeedInt k = 0; k < blend_ctx->in_size[f] && !blend_ctx->in_is_active[f]; k++) s += in[f][k * Q + q];
    }
    for (CeedInt g = 0, o = 0; g < blend_ctx->num_out; g++) {
      for (CeedInt l = 0; l < blend_ctx->out_size[g]; l++, o++) {
        CeedScalar sum = 0;
        for (CeedInt f = 0, i = 0; f < blend_ctx->num_in; f++) {
          for (CeedInt k = 0; k < blend_ctx->in_size[f] && blend_ctx->in_is_active[f]; k++, i++) {
            sum +=
                (blend_number(blend_ctx->seed, o, i) + s * blend_number(blend_ctx->seed + 1, o, i)) * in[f][k * Q + q];
          }
        }
        out[g][l * Q + q] = sum;
      }
    }
  }
  return 0;
}

#endif
