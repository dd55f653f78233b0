/// @file
/// The text of a QFunction.
#pragma once

#include <ceed/backend.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hg::jit {

/// Where a QFunction's text is, and what it is made of.
struct Source {
  std::filesystem::path file;
  std::string function;
  std::vector<std::filesystem::path> roots;  ///< folders in which included files are looked for
  std::vector<std::string> defines;          ///< NAME or NAME=VALUE

  /// Throws NoSource, or NotCompiled where the text is not there.
  static Source of(CeedQFunction qf);
};
/// Of the file and all that it includes from folders that are known, for compilers that find it themselves.
std::string digest_of(const Source &source);

/// What a line includes.
struct Include {
  std::string name;  ///< empty: it includes nothing
  bool is_quoted = false;
};
Include included_by(std::string_view line);
/// The words of a directive after `#`, or nothing.
std::string_view directive(std::string_view line);

/// Lines that define what is defined for a QFunction ("NAME", "NAME=VALUE", "-DNAME=VALUE"), and lines that end that:
/// our own text does not see it. What else begins with a dash is an option for a compiler on the host.
struct Defines {
  std::string begin, end;
  std::vector<std::string> options;
};
Defines lines_of(const std::vector<std::string> &defines);

}  // namespace hg::jit
