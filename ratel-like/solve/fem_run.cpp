#include "solve/fem_run.hpp"

#include <cmath>

#include "mesh/lend.hpp"
#include "options/error.hpp"
#include "solve/stages.hpp"

namespace hg {

FemRun::FemRun(Setup &setup)
    : setup_(setup),
      operators_(*setup.mesh, *setup.regions, setup.materials, static_cast<CeedInt>(setup.options.q_extra)),
      solver_(*setup.mesh, operators_, *setup.boundary, setup.options),
      probes_(*setup.mesh, *setup.locator, setup.probe_places) {
  petsc_check(DMCreateGlobalVector(setup.mesh->dm, u_.put()));
  petsc_check(VecDuplicate(u_, previous_.put()));
  petsc_check(DMCreateLocalVector(setup.mesh->dm, local_.put()));
  petsc_check(VecZeroEntries(u_));
  petsc_check(VecZeroEntries(local_));
  ceed_check(CeedVectorCreate(setup.ceed, setup.mesh->local_size, ceed_u_.put()));
  solver_.operators_changed(std::vector<char>(setup.mesh->num_cells, 1));
  if (!setup.output.diagnostics.empty()) series_.emplace(setup.comm, setup.output.diagnostics);
  if (!setup.output.view.empty()) view_.emplace(setup.comm, setup.output.view);
  PetscInt last_step = -1;
  if (!setup.checkpoint.restart.empty()) {
    Checkpoint restored;
    restored.vectors["u"] = u_;
    read_checkpoint(setup.comm, setup.checkpoint.restart, *setup.grid, restored);
    setup.clock.restore({restored.step, restored.time, restored.dt, restored.scalars.at("nominal")});
    solver_.set_residual_scale(restored.scalars.at("residual_scale"));
    solver_.set_time(restored.time);
    last_step = restored.step;
    if (series_) series_->resume(last_step);
  }
  measure();
  setup.monitors->begin(last_step);
}

void FemRun::run() {
  setup_.announce(0);
  if (setup_.clock.step() == 0) output(false);
  while (!setup_.clock.done()) {
    solve();
    monitor();
    output(setup_.clock.done());
  }
}

void FemRun::solve() {
  StageScope stage(Stage::solve);
  Clock &clock = setup_.clock;
  petsc_check(VecCopy(u_, previous_));
  for (;;) {
    const SolveResult result = solver_.solve({.t_from = clock.time(), .t = clock.next_time()}, u_);
    record_.newton_iterations = result.newton_iterations;
    record_.linear_iterations = result.linear_iterations;
    if (result.converged) break;
    setup_.say_rejected(clock.time(), clock.dt(), result.reason);
    clock.reject(result.reason);
    petsc_check(VecCopy(previous_, u_));
  }
  record_.dt = clock.dt();
  clock.accept();
}

void FemRun::measure() {
  solver_.to_local(u_, local_);
  std::vector<RegionIntegrals> mine;
  {
    Lend lend(local_, ceed_u_, Access::read);
    mine = operators_.integrals(ceed_u_);
  }
  const std::array<double, 3> g = setup_.acceleration(setup_.clock.time());
  const std::array<double, 3> before = mass_displacement_;
  mass_displacement_ = {};
  record_.regions.assign(mine.size(), {});
  for (std::size_t r = 0; r < mine.size(); ++r) {
    double sums[6] = {mine[r].volume,
                      mine[r].mass,
                      mine[r].strain_energy,
                      mine[r].mass_displacement[0],
                      mine[r].mass_displacement[1],
                      mine[r].mass_displacement[2]};
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, setup_.comm);
    Record::Region &region = record_.regions[r];
    region.volume = sums[0];
    region.mass = sums[1];
    region.strain_energy = sums[2];
    for (int c = 0; c < 3; ++c) {
      region.mean_displacement[c] = sums[1] > 0 ? sums[3 + c] / sums[1] : 0.;
      region.body_force[c] = sums[1] * g[c];
      mass_displacement_[c] += sums[3 + c];
    }
  }
  for (int c = 0; c < 3; ++c) {
    record_.momentum[c] = record_.dt > 0 ? (mass_displacement_[c] - before[c]) / record_.dt : 0.;
  }
  const PetscScalar *array;
  petsc_check(VecGetArrayRead(local_, &array));
  record_.probes = probes_.evaluate({array, static_cast<std::size_t>(setup_.mesh->local_size)});
  petsc_check(VecRestoreArrayRead(local_, &array));
}

void FemRun::monitor() {
  StageScope stage(Stage::output);
  measure();
  record_.step = setup_.clock.step();
  record_.time = setup_.clock.time();
  record_.reactions = solver_.reactions(u_);
  setup_.say_step(record_);
  setup_.monitors->write(record_);
  setup_.clock.monitor(u_);
}

void FemRun::write_mesh(MeshWriter &writer) {
  const Mesh &mesh = *setup_.mesh;
  solver_.to_local(u_, local_);
  std::vector<double> diagnostics;
  {
    Lend lend(local_, ceed_u_, Access::read);
    diagnostics = operators_.cell_diagnostics(ceed_u_);
  }
  const auto num_cells = static_cast<std::size_t>(mesh.num_cells);
  std::vector<std::vector<double>> columns(num_diagnostic + 1, std::vector<double>(num_cells));
  std::vector<CellField> cells;
  for (CeedInt d = 0; d < num_diagnostic; ++d) {
    for (std::size_t c = 0; c < num_cells; ++c) columns[d][c] = diagnostics[c * num_diagnostic + d];
    cells.push_back({diagnostic_names[d], columns[d]});
  }
  for (std::size_t c = 0; c < num_cells; ++c) {
    columns[num_diagnostic][c] = setup_.regions->of_cell(static_cast<CeedInt>(c));
  }
  cells.push_back({"region", columns[num_diagnostic]});
  const PetscScalar *array;
  petsc_check(VecGetArrayRead(local_, &array));
  const NodeField displacement{
      .name = "displacement", .components = 3, .values = {array, static_cast<std::size_t>(mesh.local_size)}};
  writer.write(setup_.clock.step(), setup_.clock.time(),
               {.order = mesh.order,
                .num_nodes = mesh.local_size / 3,
                .cell_nodes = mesh.node_offsets(),
                .corners = mesh.corner_coords},
               {&displacement, 1}, cells);
  petsc_check(VecRestoreArrayRead(local_, &array));
}

Checkpoint FemRun::state() {
  const Clock::State clock = setup_.clock.state();
  Checkpoint state;
  state.step = clock.step;
  state.time = clock.time;
  state.dt = clock.dt;
  state.scalars["nominal"] = clock.nominal;
  state.scalars["residual_scale"] = solver_.residual_scale();
  state.vectors["u"] = u_;
  return state;
}

void FemRun::output(bool last) {
  StageScope stage(Stage::output);
  const PetscInt step = setup_.clock.step();
  if (series_ && setup_.output.due(step, last)) write_mesh(*series_);
  if (view_ && last) write_mesh(*view_);
  if (!setup_.checkpoint.file.empty() && step > 0 && (last || step % setup_.checkpoint.interval == 0)) {
    write_checkpoint(setup_.comm, setup_.checkpoint.file, *setup_.grid, state());
  }
}

double FemRun::mms_error() {
  solver_.to_local(u_, local_);
  Lend lend(local_, ceed_u_, Access::read);
  double error =
      operators_.mms_error_squared(mms_amplitude * mms_factor(setup_.clock.time(), setup_.clock.max_time()), ceed_u_);
  MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPI_DOUBLE, MPI_SUM, setup_.comm);
  return std::sqrt(error);
}

}  // namespace hg
