#pragma once
#include <petscdmplex.h>
#include <petscpartitioner.h>

#include <functional>
#include <vector>

#include "options/handle.hpp"

namespace hg {

/// Weight of a cell in the partition, by its centroid: the number of points it will hold (MPM) or 1 (FEM).
/// A rule of place, because points are seeded after the mesh is distributed.
using CellWeightFn = std::function<PetscInt(PetscInt cell, const double centroid[3])>;

/// Registers the PetscPartitioner type "metis" (-petscpartitioner_type metis). Does nothing when called again.
/// The dual graph is gathered on rank 0, cut there by METIS_PartGraphKway, and the answer is scattered: made for meshes
/// that are read or created on one rank, as DMPlex's are. A rank is left without cells only when there are fewer cells
/// than ranks. The cut is deterministic (fixed METIS seed).
void register_metis_partitioner();

/// Distributes dm in place over its ranks with the "metis" partitioner (or the one that -petscpartitioner_type names),
/// no overlap, weights from `weight` (empty: 1). Returns, for each local cell, its number in the mesh before: seeding
/// needs it to be the same on every partition. On one rank: dm unchanged, 0, 1, 2, ….
/// Collective. The DM may hold coordinates and labels; it should not hold a section yet.
std::vector<PetscInt> distribute_mesh(DmHandle &dm, const CellWeightFn &weight = {});

}  // namespace hg
