/// @file
/// The names of HIP.
#pragma once

#include "../gpu/vendor.hpp"

namespace hg::hip {

extern const gpu::Vendor vendor;

}  // namespace hg::hip
