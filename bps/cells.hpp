/// @file
/// What a bake-off operator needs to know of a mesh of hexahedra, whoever made it.
#pragma once

#include <ceed.h>

#include <array>
#include <span>
#include <vector>

namespace hg::bps {

/// Cells of one process. Nodes of a cell are in tensor order, the first direction fastest. The arrays must outlive it.
struct Cells {
  CeedInt num_elem;
  CeedSize num_dofs;                        ///< length of the L-vector of the solution
  std::span<const CeedInt> dof_offsets;     ///< (p + 1)³ a cell: L-vector index of component 0; components adjacent
  std::span<const CeedInt> vertex_offsets;  ///< 8 a cell: index of the first coordinate; 3 coordinates adjacent
  std::span<const CeedScalar> coordinates;  ///< of all vertices
};

/// The map of the unit cube to itself that deforms the mesh smoothly: X + (4, −3, 2.5)/100 Π sin(π X_i).
/// Faces stay in their planes, so the domain does not depend on the mesh; det J ≥ 0.7 everywhere.
std::array<double, 3> deform(const std::array<double, 3> &X);

/// A structured mesh of the deformed unit cube, in the order that it is stored.
class BoxMesh {
 public:
  /// num_cells a direction; degree p of the solution; components interleaved.
  BoxMesh(std::array<CeedInt, 3> num_cells, CeedInt degree, CeedInt num_comp);

  /// Valid while this object lives.
  Cells cells() const;
  std::array<CeedInt, 3> num_cells() const { return num_cells_; }
  /// 0 at the DoFs on the boundary, 1 elsewhere.
  std::vector<CeedScalar> interior_mask() const;

 private:
  std::array<CeedInt, 3> num_cells_, num_nodes_;
  CeedInt num_comp_;
  std::vector<CeedInt> dof_offsets_, vertex_offsets_;
  std::vector<CeedScalar> coordinates_;
};

/// Cells in each direction so that the number of DoFs is as near to num_dofs as a nearly cubic box allows.
std::array<CeedInt, 3> box_for_dofs(double num_dofs, CeedInt degree, CeedInt num_comp);

}  // namespace hg::bps
