/// @file
/// Which region owns a cell or a point.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "options/options.hpp"

namespace hg {

/// Resolves regions on a mesh. Regions are tried in the order of -material, then the one that takes the rest.
class RegionMap {
 public:
  /// Errors: two regions that take the rest, a label that the mesh does not have.
  RegionMap(const Mesh &mesh, std::span<const Region> regions);

  int num_regions() const { return static_cast<int>(regions_.size()); }
  const Region &region(int index) const { return regions_[index]; }
  /// Region of a local cell: by its label, or its centroid in a box; -1 if no region takes it.
  int of_cell(CeedInt cell) const { return of_cell_[cell]; }
  /// Region of a point at x[3] in local cell `cell`: by the cell's label, or the point in a box; -1 if none takes it.
  int of_point(CeedInt cell, std::span<const double, 3> x) const;
  /// Local cells of a region, ascending.
  const std::vector<CeedInt> &cells(int region) const { return cells_[region]; }
  /// Error unless every cell has a region, as finite elements need.
  void require_all_cells() const;

 private:
  int find(CeedInt cell, std::span<const double, 3> x) const;

  const Mesh &mesh_;
  std::vector<Region> regions_;
  std::vector<std::vector<char>> labelled_;  ///< for each region with a label: a flag for each local cell
  std::vector<int> of_cell_;
  std::vector<std::vector<CeedInt>> cells_;
};

}  // namespace hg
