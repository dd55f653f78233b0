/// @file
/// One text of a QFunction and all that it includes, for compilers that see no files.
#pragma once

#include <string>

#include "source.hpp"

namespace hg::jit {

/// The QFunction's file with every file that it includes in its place, looked for beside the one that includes it and
/// in the source's folders; lines keep the file and number that they have there. Conditions are left to the compiler:
/// `#pragma once` becomes a guard, and what quotes name and is not found an #error at its line. What <> names and is
/// not found, such as the system's headers, and the library's own (ceed.h, ceed/...) are left out. Throws NotCompiled
/// where a file includes itself without a guard.
std::string flatten(const Source &source);

}  // namespace hg::jit
