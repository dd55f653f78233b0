#pragma once
#include <petscvec.h>

#include <map>
#include <string>

#include "swarm/cell_grid.hpp"
#include "swarm/swarm.hpp"

namespace hg {

/// The state of a run between two steps. Whoever owns the step loop fills it to write, and hands it in with the objects
/// made (vectors of the right size, an empty swarm) to read.
struct Checkpoint {
  PetscInt step = 0;                           ///< steps done
  double time = 0.0;                           ///< s
  double dt = 0.0;                             ///< next step's size, s
  std::map<std::string, double> scalars{};     ///< any other number, kept bitwise
  std::map<std::string, std::string> texts{};  ///< any string that must agree or be kept, such as options
  std::map<std::string, Vec> vectors{};        ///< not owned; each rank's own entries, bitwise
  Swarm *swarm = nullptr;  ///< not owned; every field, storage order of each rank; nullptr: no points
};

/// Writes `path` (HDF5). Written to `path`.tmp, flushed to the disk, then renamed over `path`: whatever goes wrong, a
/// full disk above all, the old checkpoint stays, the temporary file is removed, and the error names the cause on every
/// rank. Collective. The grid is recorded by a fingerprint.
void write_checkpoint(MPI_Comm comm, const std::string &path, const CellGrid &grid, const Checkpoint &state);

/// Reads `path` into `state`: step, time, dt, scalars, texts; the vectors named in state.vectors; the swarm if not
/// nullptr (resized; cells and ξ are as written, so no location is needed). A run on the same ranks goes on bitwise.
/// Clear errors: no such file, not a checkpoint, another version, another number of ranks, another mesh or partition, a
/// vector of another size, points where none are expected or the other way round. Collective.
void read_checkpoint(MPI_Comm comm, const std::string &path, const CellGrid &grid, Checkpoint &state);

/// When to write: -checkpoint <file> (default: none), -checkpoint_interval <steps> (1; the last step is always
/// written); -restart <file>.
struct CheckpointOptions {
  std::string file;
  PetscInt interval = 1;
  std::string restart;

  static CheckpointOptions read(MPI_Comm comm);
};

}  // namespace hg
