/// @file
/// What every run has, whatever its method: made once, in the order in which one thing needs another.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boundary/boundary.hpp"
#include "materials/region_material.hpp"
#include "mesh/mesh.hpp"
#include "mesh/region_map.hpp"
#include "monitors/probes.hpp"
#include "monitors/record.hpp"
#include "options/handle.hpp"
#include "options/options.hpp"
#include "output/checkpoint.hpp"
#include "solve/clock.hpp"
#include "swarm/cell_grid.hpp"
#include "swarm/locate.hpp"
#include "swarm/swarm.hpp"

namespace hg {

/// Which files a run writes for viewers, and how much it says.
struct OutputOptions {
  std::string swarm;        ///< -ts_monitor_swarm <prefix>: points after steps (HDF5 and XDMF)
  std::string diagnostics;  ///< -ts_monitor_diagnostic_quantities <prefix>: mesh after steps (VTU)
  std::string view;         ///< -view_diagnostic_quantities <prefix>: the same, at the end only
  PetscInt interval = 1;    ///< -output_interval: steps between outputs
  bool quiet = false;       ///< -quiet: no line for each step

  static OutputOptions read(MPI_Comm comm);
  /// Whether this step is written to files.
  bool due(PetscInt step, bool last) const { return last || step % interval == 0; }
};

/// Reads all options (so that -help explains them and a mistake is found before work starts) and makes the mesh.
struct Setup {
  explicit Setup(MPI_Comm comm);

  MPI_Comm comm;
  RunOptions options;
  std::vector<RegionMaterial> materials;
  SwarmOptions swarm;
  OutputOptions output;
  CheckpointOptions checkpoint;
  Places probe_places;
  Clock clock;
  CeedHandle ceed;
  std::unique_ptr<Mesh> mesh;
  std::unique_ptr<RegionMap> regions;
  std::unique_ptr<BoundaryConditions> boundary;
  std::unique_ptr<CellGrid> grid;
  std::unique_ptr<HexLocator> locator;
  std::unique_ptr<Monitors> monitors;

  /// g(t), zero without a body force.
  std::array<double, 3> acceleration(double t) const;
  /// One line about the mesh, the method and the backend.
  void announce(PetscInt num_points) const;
  /// One line about a step, unless -quiet.
  void say_step(const Record &record) const;
  /// One line about a step that is tried again with half its size, unless -quiet.
  void say_rejected(double t, double dt, const std::string &reason) const;
};

}  // namespace hg
