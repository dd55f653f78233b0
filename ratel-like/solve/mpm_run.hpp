/// @file
/// A quasistatic run by the implicit material point method.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "operators/mpm_operators.hpp"
#include "output/points_writer.hpp"
#include "solve/points_on_mesh.hpp"
#include "solve/setup.hpp"
#include "solve/static_solver.hpp"
#include "swarm/epoch.hpp"

namespace hg {

/// Until a step is accepted no field of a point is written, so a rejected one costs only a smaller Δt.
class MpmRun {
 public:
  /// Seeds the points, or reads them if -restart asks for it. The setup must outlive the run. Collective.
  explicit MpmRun(Setup &setup);

  /// Runs to -ts_max_time. Throws hg::Error if a step fails at the smallest size, or a point is lost. Collective.
  void run();

  Swarm &swarm() { return swarm_; }
  /// The last step's quantities.
  const Record &record() const { return record_; }
  /// L2 norm of the error of the first step against the manufactured solution; taken when it was solved. Only with
  /// -forcing mms.
  double mms_error() const { return mms_errors_[0]; }
  /// The same, summed over the points with their volumes.
  double mms_error_at_points() const { return mms_errors_[1]; }

 private:
  void seed();
  void locate();
  void build_epoch();
  void solve();
  void update_points();
  void monitor_and_output();
  void migrate();
  void reset_mesh();

  void sum_over_points();
  Checkpoint state();

  Setup &setup_;
  Swarm swarm_;
  MpmOperators operators_;
  StaticSolver solver_;
  std::optional<PointEpoch> epoch_;
  std::optional<PointProbes> probes_;
  std::optional<PointsWriter> series_;
  PointsOnMesh on_mesh_;
  bool located_ = false;  ///< cell and ξ of every point are those of its x
  VecHandle delta_u_, local_;
  CeedVectorHandle ceed_delta_u_;
  Record record_;
  std::vector<double> diagnostics_;  ///< of the last step, num_points × num_diagnostic; empty when nobody asks
  std::array<double, 2> mms_errors_{};
};

}  // namespace hg
