// A function with a number that a program defines.
#pragma once

#include <ceed/types.h>

#ifndef HG_TEST_FACTOR
#define HG_TEST_FACTOR 1
#endif

/// v = HG_TEST_FACTOR u
CEED_QFUNCTION(by_factor)
(void *, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  for (CeedInt q = 0; q < Q; q++) out[0][q] = HG_TEST_FACTOR * in[0][q];
  return 0;
}
