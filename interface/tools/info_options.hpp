/// @file
/// The command line of ceed-info.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hg::info {

/// Exit statuses of the program.
inline constexpr int exit_fine = 0, exit_failed = 1, exit_usage = 2, exit_unavailable = 3, exit_no_suite = 4;

enum class Task { list, support, check, memory };

struct InfoOptions {
  Task task = Task::list;
  std::vector<std::string> resources;  ///< to check, or to have in the table; empty: all
  std::vector<std::string> plugins;    ///< files to load
  std::string cases;                   ///< filter of GoogleTest
  std::optional<std::string> json;     ///< file; "-": standard output, instead of text
  bool is_detailed = false, is_shown = false;
};

/// The options, or the exit status of a program that is done (help, version, or a bad option; already printed).
struct ParsedOptions {
  std::optional<InfoOptions> options;
  int exit_code = exit_fine;
};

ParsedOptions parse_options(int argc, const char *const *argv);

}  // namespace hg::info
