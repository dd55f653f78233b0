/// @file
/// Solid operators integrated by Gauss quadrature on the cells (FEM).
#pragma once

#include <span>
#include <vector>

#include "mesh/region_map.hpp"
#include "operators/solid_operators.hpp"

namespace hg {

/// Number of Gauss points in each direction is order + 1 + q_extra. One sub-operator for each material in use; regions
/// of the same material share it and differ by the moduli and density that their cells read.
class FemOperators : public SolidOperators {
 public:
  /// The mesh must outlive this object. regions[i] fills region i of the map. Not collective; a rank may have no cells.
  FemOperators(const Mesh &mesh, const RegionMap &map, std::span<const RegionMaterial> regions, CeedInt q_extra = 0);

  /// Cell averages (over the undeformed cell) of Material::diagnostic at displacement u: num_cells × num_diagnostic.
  std::vector<double> cell_diagnostics(CeedVector u);

 private:
  CeedInt points_per_cell_ = 0;
  std::vector<std::vector<CeedInt>> cells_;  ///< of each part
};

}  // namespace hg
