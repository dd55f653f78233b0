/// @file
/// Context of the QFunction mix.
#ifndef HG_TEST_MIX_CONTEXT_H
#define HG_TEST_MIX_CONTEXT_H

#include <ceed/types.h>

#define MIX_MAX_FIELDS 8
#define MIX_MAX_VALUES 64

typedef struct {
  CeedInt num_in, num_out;
  CeedInt in_size[MIX_MAX_FIELDS], out_size[MIX_MAX_FIELDS], in_is_active[MIX_MAX_FIELDS];
  CeedScalar factor[MIX_MAX_VALUES];
  CeedScalar matrix[MIX_MAX_VALUES * MIX_MAX_VALUES];
} MixContext;

#endif
