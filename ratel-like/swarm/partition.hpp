#pragma once
#include <petscdmplex.h>

#include <functional>
#include <span>
#include <vector>

#include "options/handle.hpp"

namespace hg {

/// Weight of a cell in the partition, by its centroid: the number of points it will hold (MPM) or 1 (FEM); >= 0.
/// A rule of place, because points are seeded after the mesh is distributed.
using CellWeightFn = std::function<PetscInt(const double centroid[3])>;

/// Cuts a graph into num_parts by METIS_PartGraphKway with a fixed seed, so that the
/// answer is always the same. starts: num_vertices + 1; neighbours: by vertex; weights: num_vertices or empty (1).
/// Returns the part of each vertex; no part is empty unless there are more parts than vertices. Throws hg::Error if
/// METIS fails.
std::vector<PetscInt> partition_graph(std::span<const PetscInt> starts, std::span<const PetscInt> neighbours,
                                      std::span<const PetscInt> weights, PetscInt num_parts);

/// Distributes a DMPlex in place over its ranks, no overlap, cut by partition_graph (or by the partitioner of PETSc
/// that -petscpartitioner_type names). The dual graph is gathered on rank 0, cut there, and the answer is scattered:
/// made for meshes that are read or created on one rank, as DMPlex's are. weight: empty for 1. Returns, for each local
/// cell, its number in the mesh before: seeding needs a number that is the same on every partition. On one rank: dm
/// unchanged, 0, 1, 2, …. Collective. The DM may hold coordinates and labels; it should not hold a section yet.
std::vector<PetscInt> distribute_mesh(DmHandle &dm, const CellWeightFn &weight = {});

}  // namespace hg
