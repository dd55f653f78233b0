/// @file
/// The names of CUDA.
#pragma once

#include "../gpu/vendor.hpp"

namespace hg::cuda {

extern const gpu::Vendor vendor;

}  // namespace hg::cuda
