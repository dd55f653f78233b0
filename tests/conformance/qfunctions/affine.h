/// @file
/// v = w factor (shift + u), with the other sign if the context says so. in: u, w; out: v. Fails where the number of
/// points is not the multiple that the context asks for.
#ifndef HG_TEST_AFFINE_H
#define HG_TEST_AFFINE_H

#include <ceed/types.h>

#include "affine_context.h"

CEED_QFUNCTION(affine)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const AffineContext *affine_ctx = (const AffineContext *)ctx;
  if (affine_ctx->multiple > 0 && Q % affine_ctx->multiple != 0) return 1;
  const CeedScalar factor = affine_ctx->is_negative ? -affine_ctx->factor : affine_ctx->factor;
  for (CeedInt q = 0; q < Q; q++) out[0][q] = in[1][q] * factor * (affine_ctx->shift + in[0][q]);
  return 0;
}

#endif
