#include "solve/clock.hpp"

#include <algorithm>

#include "options/error.hpp"
#include "options/options.hpp"

namespace hg {

Clock::Clock(MPI_Comm comm) {
  OptionGroup group(comm, "", "Time");
  max_time_ = group.real("ts_max_time", "time at which the run ends [s]", 1., Range::positive());
  nominal_dt_ =
      group.real("ts_dt", "size of a step [s]; default: a tenth of -ts_max_time", max_time_ / 10, Range::positive());
  max_steps_ = group.integer("ts_max_steps", "steps after which the run ends in any case", 100000, Range::at_least(0));
  smallest_ = group.real("ts_adapt_dt_min", "smallest step that is tried; default: 1e-6 of -ts_max_time [s]",
                         1e-6 * max_time_, Range::positive());
  petsc_check(TSCreate(comm, ts_.put()));
  petsc_check(TSMonitorSetFromOptions(ts_, "-ts_monitor", "Monitor time and step size", "TSMonitorDefault",
                                      TSMonitorDefault, nullptr));
  petsc_check(TSMonitorSetFromOptions(ts_, "-ts_monitor_solution", "View the solution vector", "TSMonitorSolution",
                                      TSMonitorSolution, nullptr));
  dt_ = nominal_dt_;
}

double Clock::nominal_time(PetscInt index) const {
  const double t = static_cast<double>(index) * nominal_dt_;
  return t > max_time_ * (1 - 1e-12) ? max_time_ : t;
}

bool Clock::done() const {
  return time_ >= max_time_ || step_ >= max_steps_;
}

double Clock::next_time() const {
  const double end = nominal_time(nominal_ + 1);
  // A rest that is too small to be a step joins this one.
  return time_ + dt_ > end - 1e-6 * nominal_dt_ ? end : time_ + dt_;
}

void Clock::accept() {
  const double next = next_time();
  if (next == nominal_time(nominal_ + 1)) ++nominal_;
  time_ = next;
  dt_ = std::min(2 * dt_, nominal_dt_);
  ++step_;
}

void Clock::reject(const std::string &reason) {
  dt_ = dt() / 2;
  if (dt_ < smallest_) {
    fail("the step from t = %g s failed at the smallest step, %g s (half of it is below -ts_adapt_dt_min %g s): %s",
         time_, 2 * dt_, smallest_, reason.c_str());
  }
}

void Clock::monitor(Vec u) {
  petsc_check(TSSetTime(ts_, time_));
  petsc_check(TSSetTimeStep(ts_, dt_));
  petsc_check(TSSetStepNumber(ts_, step_));
  petsc_check(TSMonitor(ts_, step_, time_, u));
}

void Clock::restore(const State &state) {
  step_ = state.step;
  time_ = state.time;
  dt_ = state.dt;
  nominal_ = static_cast<PetscInt>(state.nominal);
}

}  // namespace hg
