/// @file
/// Context of the QFunction helmholtz.
#ifndef HG_TEST_HELMHOLTZ_CONTEXT_H
#define HG_TEST_HELMHOLTZ_CONTEXT_H

#include <ceed/types.h>

typedef struct {
  CeedInt dim, num_comp;
  CeedScalar mass, stiffness[3];
} HelmholtzContext;

#endif
