#pragma once
#include <petscdm.h>

#include <span>
#include <vector>

#include "cell_grid.hpp"
#include "locate.hpp"
#include "swarm.hpp"

namespace hg {

/// The CellGrid of a non-overlapping DMPlex of hexahedra. Collective.
/// corners: num_cells × 8 × 3 in tensor order, as mesh.hpp holds them (their values must be those of the DM's
/// coordinates, for corners are matched with vertices by coordinates). cell_ids: num_cells numbers of the cells in the
/// undistributed mesh, or empty: then the global numbering of the distributed DM is used (ids depend on the partition).
/// Faces shared between ranks are paired through the DM's point SF.
PetscErrorCode build_cell_grid(DM dm, std::span<const double> corners, std::span<const PetscInt> cell_ids,
                               CellGrid &grid);

/// What a call of locate_points did, summed over all ranks.
struct MigrateStats {
  PetscInt moved = 0;         ///< points that changed rank
  PetscInt rounds = 0;        ///< exchanges with neighbours; 0 if nothing crossed
  PetscInt removed = 0;       ///< points removed by OutsidePolicy::kRemove
  PetscInt projected = 0;     ///< points moved back by OutsidePolicy::kProject
  double removed_mass = 0.0;  ///< kg
};

/// Step stages 1 and 6 in one: locate every point from its x, walking from the cell it was in, and ship the points
/// whose walk crosses a rank border to the rank behind that face, where the walk goes on; repeat until none is in
/// transit. Sets cell and x_ref of every point. Collective.
///
/// A point whose walk ends at the boundary is offered to every rank once (concave domains); if none holds it,
/// options.outside says what happens. kError: the message gives id, coordinates, and the nearest cell.
/// The number of points and Σ rho0 V0 are compared before and after; a difference stops the run with a message.
PetscErrorCode locate_points(const SwarmOptions &options, const CellGrid &grid, const HexLocator &locator, Swarm &swarm,
                             MigrateStats *stats = nullptr);

}  // namespace hg
