/// @file
/// The law of the QFunction soften, and its context.
#ifndef HG_TEST_SOFTEN_LAW_H
#define HG_TEST_SOFTEN_LAW_H

#include <ceed/types.h>
#ifndef CEED_RUNNING_JIT_PASS
#include <math.h>
#endif

typedef struct {
  CeedScalar limit, rate;
} SoftenContext;

/// l = √(1 + c u²) up to the limit, then limit (1 + rate log(l/limit)).
CEED_QFUNCTION_HELPER CeedScalar soften_law(const SoftenContext *context, CeedScalar u, CeedScalar c) {
  const CeedScalar limit = context->limit, rate = context->rate;  // what a branch alone reads hinders SIMD
  const CeedScalar l = sqrt(1 + c * u * u), beyond = log(l / limit);
  if (l < limit) return l;
  return limit * (1 + rate * beyond);
}

#endif
