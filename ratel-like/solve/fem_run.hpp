/// @file
/// A quasistatic run by finite elements: one equilibrium after the other.
#pragma once

#include <memory>
#include <optional>

#include "operators/fem_operators.hpp"
#include "output/mesh_writer.hpp"
#include "solve/setup.hpp"
#include "solve/static_solver.hpp"

namespace hg {

class FemRun {
 public:
  /// The setup must outlive the run. Reads a checkpoint if -restart asks for it. Collective.
  explicit FemRun(Setup &setup);

  /// Runs to -ts_max_time. Throws hg::Error if a step fails at the smallest size. Collective.
  void run();

  /// Displacement, a global vector of mesh.dm.
  Vec displacement() const { return u_; }
  /// The last step's quantities.
  const Record &record() const { return record_; }
  /// L2 norm of the error against the manufactured solution at the present time. Collective.
  double mms_error();

 private:
  void solve();
  void monitor();
  void output(bool last);
  void write_mesh(MeshWriter &writer);
  void measure();
  Checkpoint state();

  Setup &setup_;
  FemOperators operators_;
  StaticSolver solver_;
  MeshProbes probes_;
  VecHandle u_, previous_, local_;
  CeedVectorHandle ceed_u_;
  Record record_;
  std::array<double, 3> mass_displacement_{};
  std::optional<MeshWriter> series_, view_;
};

}  // namespace hg
