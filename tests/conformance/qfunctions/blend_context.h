/// @file
/// Context of the QFunction blend.
#ifndef HG_TEST_BLEND_CONTEXT_H
#define HG_TEST_BLEND_CONTEXT_H

#include <ceed/types.h>

#define BLEND_MAX_FIELDS 64

typedef struct {
  CeedInt num_in, num_out, seed;
  CeedInt in_size[BLEND_MAX_FIELDS], out_size[BLEND_MAX_FIELDS], in_is_active[BLEND_MAX_FIELDS];
} BlendContext;

#endif
