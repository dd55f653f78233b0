/// @file
/// Material points of the bake-off problems at points: where they lie in their cells, and their weights.
#pragma once

#include <ceed.h>

#include <optional>
#include <string_view>
#include <vector>

#include "cells.hpp"
#include "problem.hpp"

namespace hg::bps {

enum class Placement {
  uniform,     ///< the centres of n³ equal boxes of each cell, equal weights
  gauss,       ///< n³ Gauss points with their weights
  random,      ///< independent and uniform in each cell, equal weights; the seed of a cell depends only on where it is
  quadrature,  ///< the quadrature points of the problem itself, with their weights
};

/// `uniform`, `gauss`, `random`, `quadrature`; empty if the name is none of them (`cell-random` is `random`).
std::optional<Placement> find_placement(std::string_view name);
std::string_view name(Placement placement);

struct PointCloud {
  CeedInt per_cell = 0;
  std::vector<CeedScalar> coordinates;  ///< reference coordinates in [−1, 1]³, 3 a point, points in cell order
  std::vector<CeedScalar> weights;      ///< of the reference cell: they sum to 8 in each cell
};

/// Throws Error if this many points a cell cannot be placed so.
void require_point_count(Placement placement, CeedInt per_cell);

/// The points of every cell. Throws Error if per_cell is not n³ where the placement asks for it; `quadrature` takes its
/// own count and ignores per_cell.
PointCloud place_points(const Cells &cells, const Problem &problem, CeedInt degree, Placement placement,
                        CeedInt per_cell);

}  // namespace hg::bps
