// A function that fails where one has to look for it.
#pragma once

#include <ceed/types.h>

#define HG_TEST_REQUIRE(condition) \
  do {                             \
    if (!(condition)) return 7;    \
  } while (0)
#define HG_TEST_IS_SMALL(value) HG_TEST_REQUIRE((value) < 1)

/// v = u, which must be less than 1
CEED_QFUNCTION(refuse)
(void *, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const char *const nothing = "// {";  // no comment, and no body
  for (CeedInt q = 0; q < Q; q++) {
    HG_TEST_IS_SMALL(in[0][q]);
    out[0][q] = in[0][q] + (nothing == nullptr);
  }
  return 0;
}

#ifdef HG_TEST_NEVER
CEED_QFUNCTION(refuse)
(void *, CeedInt, const CeedScalar *const *, CeedScalar *const *) {
  return 0;
}
#endif
