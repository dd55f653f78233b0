/// @file
/// Small QFunctions of the tests.
#ifndef HG_TEST_SIMPLE_H
#define HG_TEST_SIMPLE_H

#include <ceed/types.h>

/// Context of affine().
typedef struct {
  CeedScalar factor, shift;
  CeedInt multiple;  ///< what the number of points must be a multiple of; 0: anything
} AffineContext;

/// v = w factor (shift + u). in: u, w; out: v.
CEED_QFUNCTION(affine)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const AffineContext *affine_ctx = (const AffineContext *)ctx;
  if (affine_ctx->multiple > 0 && Q % affine_ctx->multiple != 0) return 1;
  for (CeedInt q = 0; q < Q; q++) {
    out[0][q] = in[1][q] * affine_ctx->factor * (affine_ctx->shift + in[0][q]);
  }
  return 0;
}

/// v = w c u². in: u, c, w; out: v.
CEED_QFUNCTION(squared_mass)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  for (CeedInt q = 0; q < Q; q++) out[0][q] = in[2][q] * in[1][q] * in[0][q] * in[0][q];
  return 0;
}

#endif
