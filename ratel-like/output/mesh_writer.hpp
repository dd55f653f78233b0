#pragma once
#include <ceed.h>
#include <petscsys.h>

#include <span>
#include <string>
#include <vector>

#include "output/series.hpp"

namespace hg {

/// One rank's part of the mesh as the writer wants it: order-p tensor nodes, x fastest, Gauss-Lobatto places.
/// Each cell is written as p³ linear hexahedra between its nodes: every viewer of VTU files draws those the same way,
/// which is not so for VTK's Lagrange cells (their edge order changed between versions).
struct MeshView {
  PetscInt order = 1;
  PetscInt num_nodes = 0;               ///< nodes in the local vector
  std::span<const CeedInt> cell_nodes;  ///< num_cells × (p+1)³: 3 × node, as Mesh::node_offsets has them
  std::span<const double> corners;      ///< num_cells × 8 × 3, tensor order (trilinear geometry)
};

struct NodeField {
  std::string name;
  PetscInt components = 1;
  std::span<const double> values;  ///< num_nodes × components
};
struct CellField {
  std::string name;
  std::span<const double> values;  ///< num_cells
};

/// Time series of the mesh for ParaView: `<prefix>-NNNNNN.vtu` on one rank, `<prefix>-NNNNNN.pvtu` with a piece
/// `<prefix>-NNNNNN-RRRR.vtu` for each rank on several, and `<prefix>.pvd` that lists the times, complete after each
/// write.
class MeshWriter {
 public:
  MeshWriter(MPI_Comm comm, std::string prefix);
  void resume(PetscInt last_step);
  /// Collective. Values are written as 64-bit floats, base64.
  void write(PetscInt step, PetscReal time, const MeshView &mesh, std::span<const NodeField> nodes,
             std::span<const CellField> cells = {});

 private:
  MPI_Comm comm_;
  std::string prefix_;
  TimeSeries series_;
};

}  // namespace hg
