/// @file
/// What assembly at points costs beside assembly at as many quadrature points.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bakeoff.hpp"

namespace hg::bps {

/// The kinds of assembly that are timed, in the order of AssemblyRecord::kinds.
struct AssemblyTimes {
  std::string kind;                 ///< `qfunction`, `diagonal`, `point blocks`, `matrix`
  double at_quadrature = 0;         ///< best seconds for an element
  std::optional<double> at_points;  ///< empty: the library refuses

  double ratio() const { return *at_points / at_quadrature; }
};

struct AssemblyRecord {
  std::string problem, ceed;
  int degree = 0, q_1d = 0, repetitions = 0;
  long long elements = 0, dofs = 0, points_per_cell = 0;
  std::vector<AssemblyTimes> kinds;
  std::string cpu, library_version;
};

/// Times all kinds on a box of n³ cells, with the points at the quadrature points. Both sides take turns, so that what
/// else the machine does disturbs both. Throws Error.
AssemblyRecord time_assembly(Ceed ceed, const Problem &problem, CeedInt degree, CeedInt num_cells_1d, int repetitions);

void to_json(nlohmann::ordered_json &json, const AssemblyRecord &record);

}  // namespace hg::bps
