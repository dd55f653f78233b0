/// @file
/// Context of the QFunction affine.
#ifndef HG_TEST_AFFINE_CONTEXT_H
#define HG_TEST_AFFINE_CONTEXT_H

#include <ceed/types.h>

typedef struct {
  CeedScalar factor, shift;
  CeedInt multiple;  ///< what the number of points must be a multiple of; 0: anything
  bool is_negative;
} AffineContext;

#endif
