#include <petscsf.h>

#include <vector>

#include "options/error.hpp"
#include "swarm/migrate.hpp"

namespace hg {
namespace {

/// Rank and local cell on the other side of each face at a rank border, by mesh point; rank -1 elsewhere.
struct Side {
  PetscInt rank, cell;
};

std::vector<Side> other_sides(const Mesh &mesh, PetscMPIInt rank) {
  PetscInt p_start, p_end;
  petsc_check(DMPlexGetChart(mesh.dm, &p_start, &p_end));
  PetscSF sf;
  petsc_check(DMGetPointSF(mesh.dm, &sf));
  PetscInt num_roots, num_leaves;
  const PetscInt *leaves;
  const PetscSFNode *roots;
  petsc_check(PetscSFGetGraph(sf, &num_roots, &num_leaves, &leaves, &roots));
  std::vector<Side> mine(p_end, Side{-1, -1}), theirs(p_end, Side{-1, -1});
  for (std::size_t i = 0; i < mesh.faces.size(); i++) {
    mine[mesh.faces[i]] = {rank, static_cast<PetscInt>(i / 6)};
  }
  // A face at a border has two sides, one the root of its point in the SF and one the leaf: one reduction and one
  // broadcast swap them. Both read `mine`, which neither changes; points other than faces carry nothing of use.
  petsc_check(PetscSFReduceBegin(sf, MPIU_2INT, mine.data(), theirs.data(), MPI_REPLACE));
  petsc_check(PetscSFReduceEnd(sf, MPIU_2INT, mine.data(), theirs.data(), MPI_REPLACE));
  petsc_check(PetscSFBcastBegin(sf, MPIU_2INT, mine.data(), theirs.data(), MPI_REPLACE));
  petsc_check(PetscSFBcastEnd(sf, MPIU_2INT, mine.data(), theirs.data(), MPI_REPLACE));
  return theirs;
}

}  // namespace

CellGrid build_cell_grid(const Mesh &mesh) {
  PetscMPIInt rank, size;
  MPI_Comm_rank(mesh.comm, &rank);
  MPI_Comm_size(mesh.comm, &size);
  CellGrid grid;
  grid.corners = mesh.corner_coords;
  grid.cell_ids.assign(mesh.cell_ids.begin(), mesh.cell_ids.end());
  const std::int32_t num_cells = grid.num_cells();
  grid.neighbours.resize(mesh.neighbours.size());
  for (std::size_t i = 0; i < mesh.neighbours.size(); i++) {
    grid.neighbours[i] = mesh.neighbours[i] >= 0 ? static_cast<std::int32_t>(mesh.neighbours[i]) : CellGrid::kBoundary;
  }
  if (size == 1) return grid;

  const std::vector<Side> sides = other_sides(mesh, rank);
  std::vector<PetscSFNode> nodes;
  for (std::size_t i = 0; i < mesh.faces.size(); i++) {
    const Side &side = sides[mesh.faces[i]];
    if (grid.neighbours[i] >= 0 || side.rank < 0) continue;
    grid.neighbours[i] = CellGrid::remote_link(static_cast<std::int32_t>(grid.remote.size()));
    CellGrid::RemoteFace face;
    face.rank = static_cast<std::int32_t>(side.rank);
    face.cell = static_cast<std::int32_t>(side.cell);
    grid.remote.push_back(face);
    nodes.push_back({side.rank, side.cell});
  }
  // The remote cells' corners, so that ties are decided without a message.
  const auto num_remote = static_cast<PetscInt>(nodes.size());
  SfHandle sf;
  petsc_check(PetscSFCreate(mesh.comm, sf.put()));
  petsc_check(PetscSFSetGraph(sf, num_cells, num_remote, nullptr, PETSC_COPY_VALUES, nodes.data(), PETSC_COPY_VALUES));
  MPI_Datatype corners_type;
  MPI_Type_contiguous(24, MPI_DOUBLE, &corners_type);
  MPI_Type_commit(&corners_type);
  std::vector<double> corners(static_cast<std::size_t>(num_remote) * 24);
  petsc_check(PetscSFBcastBegin(sf, corners_type, grid.corners.data(), corners.data(), MPI_REPLACE));
  petsc_check(PetscSFBcastEnd(sf, corners_type, grid.corners.data(), corners.data(), MPI_REPLACE));
  sf.reset();
  MPI_Type_free(&corners_type);
  for (PetscInt k = 0; k < num_remote; k++) {
    std::copy_n(corners.begin() + 24 * k, 24, grid.remote[k].corners.begin());
  }
  return grid;
}

}  // namespace hg
