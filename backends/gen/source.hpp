/// @file
/// The text of a QFunction.
#pragma once

#include <ceed/backend.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hg::gen {

/// Where a QFunction's text is, and what it is made of.
struct Source {
  std::filesystem::path file;
  std::string function;
  std::vector<std::filesystem::path> roots;  ///< folders in which included files are looked for
  std::vector<std::string> defines;          ///< NAME or NAME=VALUE
  std::string digest;                        ///< of the file and all that it includes by quotes

  /// Throws NoSource, or NotCompiled where the text is not there.
  static Source of(CeedQFunction qf);
};

}  // namespace hg::gen
