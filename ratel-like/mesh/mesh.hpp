/// @file
/// The mesh of a run: hexahedra in a non-overlapping DMPlex, with order-p nodal spaces and their CEED restrictions.
///
/// Reference cell [-1,1]^3. A cell's corners are numbered in tensor order, corner a + 2b + 4c at reference coordinates
/// (2a-1, 2b-1, 2c-1), and the frame is right-handed (det ∂x/∂X > 0). Nodes of a space of order p are the tensor
/// product of p+1 Gauss-Lobatto points, numbered x fastest, in the same frame as the corners; both come from the cell's
/// eight vertices, so they cannot differ. The geometry is trilinear.
#pragma once

#include <ceed.h>
#include <petscdmplex.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "options/handle.hpp"

namespace hg {

struct MeshOptions {
  PetscInt order = 1;  ///< of the displacement space, 1 to 8
  /// Moves each vertex once after the mesh is made (x[3] in, x[3] out); for tests on distorted cells.
  std::function<void(double *)> deform = nullptr;
  /// Load of a cell by its centroid, for balance between ranks; empty: every cell the same.
  std::function<PetscInt(const double *)> cell_weight{};
};

/// A nodal space of any order and number of components without constraints, for projections, stresses, output.
/// Local vectors of `dm` hold num_comp values for each local node, next to each other; global vectors hold each node
/// once.
struct MeshSpace {
  PetscInt order = 1;
  CeedInt num_comp = 1;
  DmHandle dm;                     ///< shares the mesh, has its own section
  CeedElemRestrictionHandle rstr;  ///< num_cells × (order+1)^3 × num_comp, comp_stride 1, L-vector = local vector of dm
  PetscInt local_size = 0;         ///< length of a local vector
};

/// The mesh and the displacement space.
struct Mesh {
  /// Makes the mesh from -dm_plex_* options: a box (-dm_plex_dim 3 -dm_plex_simplex 0 are set for it) or a Gmsh file
  /// (-dm_plex_filename). Distributes it without overlap. Errors: a file that is not a mesh, cells that are not
  /// hexahedra, a cell with a non-positive Jacobian determinant at a corner.
  /// Boxes carry the label "Face Sets" with 1: z low, 2: z high, 3: y low, 4: y high, 5: x high, 6: x low.
  Mesh(MPI_Comm comm, Ceed ceed, const MeshOptions &options);
  Mesh(const Mesh &) = delete;
  Mesh &operator=(const Mesh &) = delete;

  MPI_Comm comm;
  Ceed ceed;    ///< borrowed, must outlive the mesh
  DmHandle dm;  ///< displacement space: 3 components, order p, Dirichlet constraints in its section
  PetscInt order;
  CeedInt num_cells = 0;  ///< local cells; cell c is mesh point cell_start + c
  PetscInt cell_start = 0;
  PetscInt num_cells_global = 0;
  std::vector<PetscInt> cell_ids;  ///< number of each local cell in the mesh before it was distributed
  PetscInt local_size = 0;  ///< length of a local displacement vector, constrained entries included

  CeedElemRestrictionHandle rstr_u;  ///< num_cells × (p+1)^3 × 3, comp_stride 1, L-vector = local vector of dm
  CeedElemRestrictionHandle rstr_x;  ///< num_cells × 8 × 3, comp_stride 1, L-vector = `x`
  CeedVectorHandle x;                ///< coordinates of the local vertices

  std::vector<double> corner_coords;  ///< num_cells × 8 × 3, tensor order
  std::vector<PetscInt> vertices;     ///< num_cells × 8 mesh points, tensor order
  std::vector<PetscInt> faces;        ///< num_cells × 6 mesh points: x low, x high, y low, y high, z low, z high
  std::vector<PetscInt> neighbours;   ///< num_cells × 6 local cells across `faces`, -1 if none on this rank

  std::span<const double, 24> corners(CeedInt cell) const {
    return std::span<const double, 24>(corner_coords.data() + 24 * static_cast<std::size_t>(cell), 24);
  }

  /// The space of the given order and components; made at the first call and kept. Collective at the first call.
  const MeshSpace &space(PetscInt space_order, CeedInt num_comp) const;

  /// Bases from a tensor space of order `space_order` with num_comp components to (num_points_1d)^3 quadrature points.
  /// The space's nodes are Gauss-Lobatto points. Order 1 with 3 components also serves the coordinates.
  CeedBasisHandle basis(PetscInt space_order, CeedInt num_comp, CeedInt num_points_1d, CeedQuadMode quadrature) const;

  /// Coordinates of the nodes of space(order, 3), as a local vector of it (3 values for each local node).
  const std::vector<double> &node_coordinates(PetscInt space_order) const;

  /// Local offsets of rstr_u: entry (cell * (p+1)^3 + node), the index of component 0 in a local vector.
  const std::vector<CeedInt> &node_offsets() const { return offsets_u_; }

  /// Constrains components of the displacement nodes: constrained[3 * node + c] != 0, `node` counting as in
  /// node_coordinates(order). Must be the same on every rank that has the node. Collective; replaces earlier
  /// constraints and `dm` itself (local vectors keep their layout, global vectors made before do not fit any more).
  void constrain(std::span<const char> constrained);
  /// The constraints in force: 3 * (number of local nodes) entries, empty when none were set.
  const std::vector<char> &constraints() const { return constrained_; }

  /// Node numbers, ascending, of the local nodes of space(space_order, ·) on the faces and cells with this label value
  /// and on their edges and vertices. A face that only another rank has is not seen: a node of it may be missing here.
  std::vector<PetscInt> nodes_on(PetscInt space_order, const std::string &label, PetscInt value) const;

  /// Sums a local array with `width` entries for each node of space(space_order, ·) over ranks and returns sums to all.
  void sum_shared(PetscInt space_order, int width, std::span<double> values) const;

 private:
  SectionHandle make_section(PetscInt space_order, CeedInt num_comp, std::span<const char> constrained) const;
  std::vector<CeedInt> make_offsets(PetscSection section, PetscInt space_order, CeedInt num_comp) const;
  CeedElemRestrictionHandle make_restriction(const std::vector<CeedInt> &offsets, PetscInt space_order,
                                             CeedInt num_comp, PetscInt size) const;
  void read_topology();
  void read_geometry(const std::function<void(double *)> &deform);
  void find_faces();

  DmHandle base_;  ///< the mesh alone, without a section

  std::vector<CeedInt> offsets_u_;
  std::vector<char> constrained_;
  mutable std::map<std::pair<PetscInt, CeedInt>, std::unique_ptr<MeshSpace>> spaces_;
  mutable std::map<PetscInt, std::vector<double>> node_coordinates_;
};

}  // namespace hg
