/// @file
/// v = w s(u, c) u, where s grows like a logarithm beyond a limit. in: u, c, w, id; out: v.
#ifndef HG_TEST_SOFTEN_H
#define HG_TEST_SOFTEN_H

#include <ceed/types.h>

#include "soften_law.h"

CEED_QFUNCTION(soften)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const SoftenContext *context = (const SoftenContext *)ctx;
  const CeedScalar *u = in[0], *c = in[1], *w = in[2];
  CeedScalar *v = out[0];
  CeedPragmaSIMD
  for (CeedInt q = 0; q < Q; q++) {  // the loop over points
    v[q] = w[q] * soften_law(context, u[q], c[q]) * u[q];
  }
  return 0;
}

#endif
