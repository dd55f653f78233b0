#pragma once
#include "mesh/mesh.hpp"
#include "swarm/cell_grid.hpp"
#include "swarm/locate.hpp"
#include "swarm/swarm.hpp"

namespace hg {

/// The CellGrid of a mesh; faces shared between ranks are paired through the point SF of its DMPlex. Collective.
CellGrid build_cell_grid(const Mesh &mesh);

/// What a call of locate_points did, summed over all ranks.
struct MigrateStats {
  PetscInt moved = 0;         ///< points shipped to another rank, counted at every hop
  PetscInt rounds = 0;        ///< exchanges between ranks; 0 if nothing crossed
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
/// The number of points and Σ rho0 V0 are compared before and after; a difference stops the run with a message
/// (hg::Error on every rank).
MigrateStats locate_points(const SwarmOptions &options, const CellGrid &grid, const HexLocator &locator, Swarm &swarm);

}  // namespace hg
