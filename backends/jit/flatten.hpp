/// @file
/// One text of a QFunction and all that it includes, for compilers that see no files.
#pragma once

#include <string>

#include "source.hpp"

namespace hg::jit {

/// The QFunction's file with every file that it includes in its place, looked for beside the one that includes it and
/// in the source's folders; lines keep the file and number that they have there. A file with `#pragma once` comes once.
/// What <> names and is not found, such as the system's headers, and the library's own (ceed.h, ceed/...) are left out.
/// Throws NotCompiled where what quotes name is not found, with the file and line.
std::string flatten(const Source &source);

}  // namespace hg::jit
