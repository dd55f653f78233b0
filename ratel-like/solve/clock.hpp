/// @file
/// Time of a quasistatic run: steps of -ts_dt that are halved when they fail and grow again.
#pragma once

#include <petscts.h>

#include <string>

#include "options/handle.hpp"

namespace hg {

/// The times t_k = k · ts_dt are always met, whatever was halved between them; the last is -ts_max_time. Options:
/// -ts_dt, -ts_max_time, -ts_max_steps, -ts_adapt_dt_min; a PETSc TS holds the monitors (-ts_monitor,
/// -ts_monitor_solution).
class Clock {
 public:
  /// Defaults: -ts_max_time 1, -ts_dt a tenth of it, smallest step 1e-6 of it. Collective.
  explicit Clock(MPI_Comm comm);

  bool done() const;
  PetscInt step() const { return step_; }  ///< steps taken, halved ones counted each
  double time() const { return time_; }    ///< [s]
  double max_time() const { return max_time_; }
  /// Where the step ahead ends.
  double next_time() const;
  double dt() const { return next_time() - time_; }

  /// The step ahead was taken.
  void accept();
  /// The step ahead failed: halve it. Throws hg::Error with time, size and reason if that is below the smallest step.
  void reject(const std::string &reason);
  /// Shows the state to the monitors of -ts_monitor...; u is a global vector.
  void monitor(Vec u);

  /// State for a checkpoint.
  struct State {
    PetscInt step = 0;
    double time = 0, dt = 0;
    double nominal = 0;  ///< whole steps of -ts_dt passed
  };
  State state() const { return {step_, time_, dt_, static_cast<double>(nominal_)}; }
  void restore(const State &state);

 private:
  double nominal_time(PetscInt index) const;

  TsHandle ts_;
  double nominal_dt_, max_time_, smallest_, dt_, time_ = 0;
  PetscInt max_steps_, step_ = 0, nominal_ = 0;
};

}  // namespace hg
