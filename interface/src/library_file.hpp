/// @file
/// Files of shared libraries, judged before the dynamic loader maps them.
#pragma once

#include <filesystem>
#include <string>

namespace hg {

/// Why `path` is no shared library for this process, or "": a file that is not there or cannot be read, no ELF file, not
/// a shared library, another processor or word size, shorter than its own headers say. The dynamic loader itself maps a
/// file that was cut short, and the process is then ended by a signal.
std::string why_not_loadable(const std::filesystem::path &path);

}  // namespace hg
