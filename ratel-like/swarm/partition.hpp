#pragma once
#include <petscdmplex.h>
#include <petscpartitioner.h>

#include <functional>
#include <vector>

namespace hg {

/// Weight of a cell in the partition, by its centroid: the number of points it will hold (MPM) or 1 (FEM).
/// A rule of place, because points are seeded after the mesh is distributed.
using CellWeightFn = std::function<PetscInt(PetscInt cell, const double centroid[3])>;

/// Registers the PetscPartitioner type "metis" (-petscpartitioner_type metis). Call once, after PetscInitialize.
/// The dual graph is gathered on rank 0, cut there by METIS_PartGraphKway, and the answer is scattered: made for meshes
/// that are read or created on one rank, as DMPlex's are. A rank may end without cells only when there are fewer cells
/// than ranks. The cut is deterministic (fixed METIS seed).
PetscErrorCode register_metis_partitioner();

/// Distributes dm in place over its ranks with the "metis" partitioner (or the one that -petscpartitioner_type names),
/// no overlap, weights from `weight` (empty: 1). On return cell_ids holds, for each local cell, its number in the mesh
/// before: seeding needs it to be the same on every partition. On one rank: dm unchanged, cell_ids = 0, 1, 2, ….
/// Collective. The DM may hold coordinates and labels; it should not hold a section yet.
PetscErrorCode distribute_mesh(DM &dm, const CellWeightFn &weight, std::vector<PetscInt> &cell_ids);

}  // namespace hg
