/// @file
/// The options of bps, in PETSc's style.
#pragma once

#include <petscsys.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "points.hpp"
#include "problem.hpp"

namespace hg::bps {

struct BpsOptions {
  std::vector<std::string> resources;
  std::vector<Problem> problems;
  std::vector<CeedInt> degrees;
  double local_nodes = 1e4;                          ///< nodes wanted on each rank
  std::optional<std::array<PetscInt, 3>> num_cells;  ///< in place of local_nodes
  std::optional<Placement> swarm;                    ///< empty: at quadrature points
  CeedInt points_per_cell = 0;
  int repetitions = 10;
  std::optional<std::filesystem::path> json;
};

/// The same on every rank, and so is the Error if an option is bad. With -help, prints what the options mean.
BpsOptions parse_bps_options();

}  // namespace hg::bps
