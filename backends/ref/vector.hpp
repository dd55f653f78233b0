/// @file
/// Vectors of the reference backend: one array on the host.
#pragma once

#include <ceed/plugin.h>

namespace hg::ref {

/// Memory only: arithmetic is the core's.
void fill_vector_ops(CeedVectorOps &ops);

}  // namespace hg::ref
