#pragma once
#include <petscsys.h>

#include <span>
#include <string>

#include "output/series.hpp"
#include "swarm/swarm.hpp"

namespace hg {

/// A field computed outside the swarm to write with the points: n × components, storage order.
/// Components 1, 3, 6 (a symmetric tensor xx yy zz yz xz xy, written as nine) or 9.
struct ExtraPointField {
  std::string name;
  PetscInt components = 1;
  std::span<const double> values;
};

/// Time series of points for ParaView: `<prefix>-NNNNNN.h5` for each output (parallel HDF5, one file for all ranks) and
/// `<prefix>.xdmf`, a temporal collection that is complete and readable after every write.
///
/// Always written: x, displacement (u), velocity (v), volume (V), J (det F), region, id; plus the extra fields, such as
/// the Cauchy stress; and `vertex`, one cell for each point, so that viewers have something to draw. Datasets lie in
/// rank order, storage order within a rank.
class PointsWriter {
 public:
  /// Nothing is written yet. A directory in the prefix must exist.
  PointsWriter(MPI_Comm comm, std::string prefix);
  /// After a restart: keep the outputs of an earlier run that are listed in <prefix>.xdmf with step <= last_step.
  void resume(PetscInt last_step);
  /// Collective. Failure to write (full disk, no permission) throws hg::Error naming the file and the cause.
  void write(PetscInt step, PetscReal time, const Swarm &swarm, std::span<const ExtraPointField> extra = {});

 private:
  MPI_Comm comm_;
  std::string prefix_;
  TimeSeries series_;
};

}  // namespace hg
