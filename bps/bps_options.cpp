#include "bps_options.hpp"

#include <fmt/format.h>

#include "number_list.hpp"
#include "plex_mesh.hpp"

namespace hg::bps {

namespace {

/// The text of an option, or what it is otherwise; with -help, prints a line on it.
std::string get_text(const char *option, const char *meaning, const std::string &otherwise) {
  PetscBool wants_help = PETSC_FALSE, found = PETSC_FALSE;
  std::array<char, PETSC_MAX_PATH_LEN> text{};
  ok(PetscOptionsHasHelp(nullptr, &wants_help));
  if (wants_help) {
    ok((*PetscHelpPrintf)(PETSC_COMM_WORLD, "  %s <%s>: %s\n", option,
                          otherwise.empty() ? "not set" : otherwise.c_str(), meaning));
  }
  ok(PetscOptionsGetString(nullptr, nullptr, option, text.data(), text.size(), &found));
  return found ? text.data() : otherwise;
}

std::vector<Problem> parse_problems(const std::string &text) {
  std::vector<Problem> problems;
  for (const auto &name : split(text)) {
    const Problem *problem = find_problem(name);
    if (name == "all") {
      problems.insert(problems.end(), all_problems().begin(), all_problems().end());
    } else if (problem) {
      problems.push_back(*problem);
    } else {
      throw Error(fmt::format("-problem {}: unknown; known are bp1, bp2, bp3, bp4, bp5, bp6 and all", name));
    }
  }
  return problems;
}

CeedInt parse_integer(const char *option, const std::string &text, CeedInt low, CeedInt high) {
  const auto values = parse_integers(option, text, low, high);
  if (values.size() != 1) throw Error(fmt::format("{} {}: expected one number", option, text));
  return values.front();
}

}  // namespace

BpsOptions parse_bps_options() {
  BpsOptions options;
  options.resources = split(get_text("-ceed", "backend resources, separated by commas", "/cpu/self"));
  options.problems = parse_problems(get_text("-problem", "bp1 ... bp6 or all, separated by commas", "bp3"));
  options.degrees =
      parse_integers("-degree", get_text("-degree", "polynomial degrees, such as 1,2,3 or 1-8", "3"), 1, 8);
  const std::string nodes = get_text("-local_nodes", "nodes wanted on each rank", "1e4");
  options.local_nodes = parse_reals("-local_nodes", nodes, 8, 2e9).front();
  const std::string cells = get_text("-cells", "cells in each direction, such as 8,8,8, in place of -local_nodes", "");
  if (!cells.empty()) {
    const auto values = parse_integers("-cells", cells, 1, 100000);
    if (values.size() != 3) throw Error(fmt::format("-cells {}: expected three numbers, such as 8,8,8", cells));
    options.num_cells = std::array<PetscInt, 3>{values[0], values[1], values[2]};
  }
  const std::string swarm =
      get_text("-swarm", "where material points lie: none, uniform, gauss, random or quadrature", "none");
  const std::string per_cell = get_text("-points_per_cell", "material points in each cell (not set: (p+2)^3)", "");
  if (!per_cell.empty()) options.points_per_cell = parse_integer("-points_per_cell", per_cell, 1, 1000000);
  if (swarm != "none") {
    options.swarm = find_placement(swarm);
    if (!options.swarm)
      throw Error(fmt::format("-swarm {}: unknown; known are none, uniform, gauss, random and quadrature", swarm));
    if (options.points_per_cell > 0) require_point_count(*options.swarm, options.points_per_cell);
  } else if (options.points_per_cell > 0) {
    throw Error(fmt::format("-points_per_cell {}: needs -swarm uniform, gauss or random", per_cell));
  }
  options.repetitions =
      parse_integer("-reps", get_text("-reps", "timed applications of each operator", "10"), 1, 1000000);
  const std::string json = get_text("-json", "write one record for each run to this file", "");
  if (!json.empty()) options.json = json;
  return options;
}

}  // namespace hg::bps
