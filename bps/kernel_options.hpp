/// @file
/// The command line of bps-kernel.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cg.hpp"
#include "points.hpp"
#include "problem.hpp"

namespace hg::bps {

struct KernelOptions {
  std::vector<std::string> resources;  ///< `all` already replaced by the usable ones
  std::vector<Problem> problems;
  std::vector<CeedInt> degrees;
  std::vector<double> dofs;
  std::vector<CeedInt> points;  ///< points a cell
  /// Empty: not asked for. An empty entry is the operator at quadrature points.
  std::vector<std::optional<Placement>> placements;
  std::optional<std::filesystem::path> json;
  int repetitions = 10;
  CgOptions cg;
  bool check = false;
  bool quiet = false;
};

/// The options, or the exit code of a program that is done (help, or a bad option; both already printed).
struct ParsedOptions {
  std::optional<KernelOptions> options;
  int exit_code = 0;
};

ParsedOptions parse_options(int argc, const char *const *argv);

}  // namespace hg::bps
