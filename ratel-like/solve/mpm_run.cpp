#include "solve/mpm_run.hpp"

#include <cmath>

#include "mesh/lend.hpp"
#include "options/error.hpp"
#include "solve/stages.hpp"
#include "swarm/migrate.hpp"

namespace hg {

MpmRun::MpmRun(Setup &setup)
    : setup_(setup),
      swarm_(setup.comm),
      operators_(*setup.mesh, setup.materials, setup.swarm.void_stiffness),
      solver_(*setup.mesh, operators_, *setup.boundary, setup.options),
      on_mesh_(setup) {
  petsc_check(DMCreateGlobalVector(setup.mesh->dm, delta_u_.put()));
  petsc_check(DMCreateLocalVector(setup.mesh->dm, local_.put()));
  petsc_check(VecZeroEntries(delta_u_));
  ceed_check(CeedVectorCreate(setup.ceed, setup.mesh->local_size, ceed_delta_u_.put()));
  if (!setup.output.swarm.empty()) series_.emplace(setup.comm, setup.output.swarm);
  PetscInt last_step = -1;
  if (setup.checkpoint.restart.empty()) {
    seed();
  } else {
    Checkpoint restored;
    restored.swarm = &swarm_;
    read_checkpoint(setup.comm, setup.checkpoint.restart, *setup.grid, restored);
    setup.clock.restore({restored.step, restored.time, restored.dt, restored.scalars.at("nominal")});
    solver_.set_residual_scale(restored.scalars.at("residual_scale"));
    last_step = restored.step;
    if (series_) series_->resume(last_step);
    on_mesh_.resume(last_step);
  }
  probes_.emplace(*setup.mesh, *setup.locator, swarm_, setup.probe_places);
  record_.regions.resize(setup.options.regions.size());
  record_.reactions.resize(setup.boundary->faces().size());
  setup.monitors->begin(last_step);
}

void MpmRun::seed() {
  const auto material = [&](std::int32_t cell, const double x[3]) -> PointMaterial {
    const int region = setup_.regions->of_point(cell, std::span<const double, 3>(x, 3));
    if (region < 0) return {.region = -1};
    const ElasticParameters &parameters = setup_.materials[region].parameters;
    return {.region = region, .rho0 = parameters.rho, .K = parameters.bulk_modulus(), .mu = parameters.shear_modulus()};
  };
  seed_swarm(setup_.swarm, *setup_.grid, *setup_.locator, material, swarm_);
  if (swarm_.global_size() == 0) fail("no material point lies in a region of -material");
}

void MpmRun::run() {
  setup_.announce(swarm_.global_size());
  if (series_ && setup_.clock.step() == 0) {
    diagnostics_.assign(static_cast<std::size_t>(swarm_.local_size()) * num_diagnostic, 0.);
    monitor_and_output();
  }
  while (!setup_.clock.done()) {
    locate();
    build_epoch();
    solve();
    update_points();
    monitor_and_output();
    migrate();
    reset_mesh();
  }
}

void MpmRun::locate() {
  if (located_) return;  // migrate() has done it
  StageScope stage(Stage::migrate);
  locate_points(setup_.swarm, *setup_.grid, *setup_.locator, swarm_);
  located_ = true;
}

void MpmRun::build_epoch() {
  StageScope stage(Stage::update);
  epoch_.emplace(setup_.ceed, setup_.mesh->num_cells, swarm_);
  operators_.attach(*epoch_, swarm_);
  solver_.operators_changed(operators_.active_cells());
}

void MpmRun::solve() {
  StageScope stage(Stage::solve);
  Clock &clock = setup_.clock;
  for (;;) {
    const SolveResult result =
        solver_.solve({.t_from = clock.time(), .t = clock.next_time(), .increment = true}, delta_u_);
    record_.newton_iterations = result.newton_iterations;
    record_.linear_iterations = result.linear_iterations;
    if (result.converged) return;
    setup_.say_rejected(clock.time(), clock.dt(), result.reason);
    clock.reject(result.reason);
    petsc_check(VecZeroEntries(delta_u_));
  }
}

void MpmRun::update_points() {
  StageScope stage(Stage::update);
  Clock &clock = setup_.clock;
  record_.reactions = solver_.reactions(delta_u_);
  solver_.to_local(delta_u_, local_);
  {
    Lend lend(local_, ceed_delta_u_, Access::read);
    const std::vector<RegionIntegrals> mine = operators_.integrals(ceed_delta_u_);
    for (std::size_t r = 0; r < mine.size(); ++r) record_.regions[r].strain_energy = mine[r].strain_energy;
    if (setup_.options.forcing.kind == BodyForce::Kind::mms && clock.step() == 0) {
      const double amplitude = mms_amplitude * mms_factor(clock.next_time(), clock.max_time());
      mms_errors_ = {operators_.mms_error_squared_on_mesh(amplitude, ceed_delta_u_),
                     operators_.mms_error_squared(amplitude, ceed_delta_u_)};
      MPI_Allreduce(MPI_IN_PLACE, mms_errors_.data(), 2, MPI_DOUBLE, MPI_SUM, setup_.comm);
      for (double &error : mms_errors_) error = std::sqrt(error);
    }
    if (series_ || on_mesh_.wanted()) diagnostics_ = operators_.point_diagnostics(ceed_delta_u_);
    operators_.update_points(ceed_delta_u_, clock.dt(), swarm_);
  }
  record_.dt = clock.dt();
  located_ = false;
  clock.accept();
}

void MpmRun::sum_over_points() {
  const PointField<double> u(swarm_, field::u), v(swarm_, field::v), V(swarm_, field::V), V0(swarm_, field::V0),
      rho0(swarm_, field::rho0);
  const PointField<std::int32_t> region(swarm_, field::region);
  // For each region: mass, volume, strain energy, mass times u; at the end the momentum.
  std::vector<double> sums(6 * record_.regions.size() + 3, 0.);
  for (std::size_t r = 0; r < record_.regions.size(); ++r) sums[6 * r + 2] = record_.regions[r].strain_energy;
  double *momentum = sums.data() + 6 * record_.regions.size();
  for (std::size_t p = 0; p < region.size(); ++p) {
    double *sum = sums.data() + 6 * region[p];
    const double mass = rho0[p] * V0[p];
    sum[0] += mass;
    sum[1] += V[p];
    for (int c = 0; c < 3; ++c) {
      sum[3 + c] += mass * u[3 * p + c];
      momentum[c] += mass * v[3 * p + c];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, setup_.comm);
  const std::array<double, 3> g = setup_.acceleration(setup_.clock.time());
  for (std::size_t r = 0; r < record_.regions.size(); ++r) {
    const double *sum = sums.data() + 6 * r;
    Record::Region &here = record_.regions[r];
    here.mass = sum[0];
    here.volume = sum[1];
    here.strain_energy = sum[2];
    for (int c = 0; c < 3; ++c) {
      here.mean_displacement[c] = sum[0] > 0 ? sum[3 + c] / sum[0] : 0.;
      here.body_force[c] = sum[0] * g[c];
    }
  }
  for (int c = 0; c < 3; ++c) record_.momentum[c] = momentum[c];
}

void MpmRun::monitor_and_output() {
  StageScope stage(Stage::output);
  const PetscInt step = setup_.clock.step();
  const bool last = setup_.clock.done();
  record_.step = step;
  record_.time = setup_.clock.time();
  if (step > 0) {
    sum_over_points();
    record_.probes = probes_->evaluate(swarm_);
    setup_.say_step(record_);
    setup_.monitors->write(record_);
    setup_.clock.monitor(delta_u_);
  }
  if (series_ && setup_.output.due(step, last)) {
    const auto n = static_cast<std::size_t>(swarm_.local_size());
    std::vector<double> stress(6 * n), pressure(n), von_mises(n), energy(n);
    for (std::size_t p = 0; p < n; ++p) {
      const double *values = diagnostics_.data() + p * num_diagnostic;
      std::copy_n(values, 6, stress.data() + 6 * p);
      pressure[p] = values[6];
      von_mises[p] = values[7];
      energy[p] = values[9];
    }
    const ExtraPointField extra[] = {{"cauchy_stress", 6, stress},
                                     {"pressure", 1, pressure},
                                     {"von_mises_stress", 1, von_mises},
                                     {"strain_energy_density", 1, energy}};
    series_->write(step, setup_.clock.time(), swarm_, extra);
  }
  if (on_mesh_.due(step, last)) {
    const PetscScalar *delta_u;
    petsc_check(VecGetArrayRead(local_, &delta_u));
    on_mesh_.write(step, setup_.clock.time(), last, operators_, swarm_, diagnostics_,
                   {delta_u, static_cast<std::size_t>(setup_.mesh->local_size)});
    petsc_check(VecRestoreArrayRead(local_, &delta_u));
  }
  if (!setup_.checkpoint.file.empty() && step > 0 && (last || step % setup_.checkpoint.interval == 0)) {
    write_checkpoint(setup_.comm, setup_.checkpoint.file, *setup_.grid, state());
  }
}

Checkpoint MpmRun::state() {
  const Clock::State clock = setup_.clock.state();
  Checkpoint state;
  state.step = clock.step;
  state.time = clock.time;
  state.dt = clock.dt;
  state.scalars["nominal"] = clock.nominal;
  state.scalars["residual_scale"] = solver_.residual_scale();
  state.swarm = &swarm_;
  return state;
}

void MpmRun::migrate() {
  // Locating, shipping, and the checks of count and mass are one call: the cells it finds serve the next step.
  locate();
}

void MpmRun::reset_mesh() {
  petsc_check(VecZeroEntries(delta_u_));
}

}  // namespace hg
