/// @file
/// Contexts of the QFunctions: what the host fills in.
#ifndef HG_COMMON_CONTEXTS_H
#define HG_COMMON_CONTEXTS_H

#include <ceed/types.h>

/// Context of HgMass and HgCopy
typedef struct {
  CeedInt num_comp;
} HgMassContext;

/// Context of HgBodyForce
typedef struct {
  CeedScalar acceleration[3];  ///< g
} HgBodyForceContext;

/// Context of HgMmsLinearForce and HgMmsLinearError
typedef struct {
  CeedScalar amplitude;  ///< A₀, times the load factor
} HgMmsLinearContext;

/// Context of HgPointUpdate
typedef struct {
  CeedScalar delta_t;  ///< Δt
} HgPointUpdateContext;

#endif
