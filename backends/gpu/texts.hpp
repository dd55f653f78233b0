/// @file
/// The texts that are compiled for a device.
#pragma once

#include <string>
#include <string_view>

#include "../jit/texts.hpp"

namespace hg::gpu {

extern const jit::Texts texts;

/// A text by its name.
std::string text(std::string_view name);
/// What kernels and QFunctions begin with, after what the driver says first.
std::string first_text();
/// All kernels whose sizes are known when they run.
std::string library_text();

}  // namespace hg::gpu
