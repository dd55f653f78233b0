#include "solve/setup.hpp"

#include <cstdlib>

#include "options/error.hpp"
#include "swarm/migrate.hpp"

namespace hg {

namespace {

CeedHandle open_ceed(const std::string &resource) {
  // A Ceed that does not exist cannot keep its message, and the library would abort.
  setenv("CEED_ERROR_HANDLER", "return", 0);
  CeedHandle ceed;
  try {
    ceed_check(CeedInit(resource.c_str(), ceed.put()));
  } catch (const Error &error) {
    fail("option -ceed: no backend for '%s' on this machine: %s", resource.c_str(), error.what());
  }
  keep_ceed_errors(ceed);
  return ceed;
}

// Points in a cell, as far as its centroid tells, so that ranks get equal work.
std::function<PetscInt(const double *)> point_weight(const RunOptions &options, PetscInt points_per_cell) {
  for (const Region &region : options.regions) {
    if (!region.box) return {};
  }
  return [regions = options.regions, points_per_cell](const double *x) -> PetscInt {
    for (const Region &region : regions) {
      const auto &box = *region.box;
      if (x[0] >= box[0] && x[1] >= box[1] && x[2] >= box[2] && x[0] <= box[3] && x[1] <= box[4] && x[2] <= box[5]) {
        return points_per_cell;
      }
    }
    return 0;
  };
}

RecordNames names_of(const RunOptions &options, const Places &places, const BoundaryConditions &boundary) {
  RecordNames names;
  for (const Region &region : options.regions) names.regions.push_back(region.name.empty() ? "body" : region.name);
  for (std::size_t i = 0; i < places.size(); ++i) names.probes.push_back("probe" + std::to_string(i));
  constexpr const char *kinds[] = {"clamp", "slip", "mms"};
  for (const BoundaryFace &face : boundary.faces()) {
    names.reactions.push_back(kinds[static_cast<int>(face.kind)] + std::to_string(face.face));
  }
  return names;
}

}  // namespace

OutputOptions OutputOptions::read(MPI_Comm comm) {
  OutputOptions output;
  OptionGroup group(comm, "", "Output");
  output.swarm = group.string("ts_monitor_swarm", "prefix of HDF5 and XDMF files of the points after steps (mpm)", "");
  output.diagnostics = group.string("ts_monitor_diagnostic_quantities",
                                    "prefix of VTU files of displacement and stress on the mesh after steps", "");
  output.view = group.string("view_diagnostic_quantities", "the same at the end of the run only", "");
  output.interval = group.integer("output_interval", "steps between these outputs", 1, Range::at_least(1));
  output.quiet = group.boolean("quiet", "do not print a line for each step", false);
  return output;
}

Setup::Setup(MPI_Comm comm_in)
    : comm(comm_in),
      options(RunOptions::read(comm)),
      materials(read_region_materials(comm, options.regions)),
      swarm(SwarmOptions::read(comm)),
      output(OutputOptions::read(comm)),
      checkpoint(CheckpointOptions::read(comm)),
      probe_places(read_probes(comm)),
      clock(comm),
      ceed(open_ceed(options.ceed)) {
  const bool mpm = options.method == Method::mpm;
  MeshOptions mesh_options{.order = options.order};
  if (mpm) mesh_options.cell_weight = point_weight(options, swarm.points_per_cell);
  mesh = std::make_unique<Mesh>(comm, ceed, mesh_options);
  regions = std::make_unique<RegionMap>(*mesh, options.regions);
  if (!mpm) regions->require_all_cells();
  boundary = std::make_unique<BoundaryConditions>(*mesh, comm);
  grid = std::make_unique<CellGrid>(build_cell_grid(*mesh));
  locator = std::make_unique<HexLocator>(*grid);
  monitors = std::make_unique<Monitors>(comm, names_of(options, probe_places, *boundary));
}

std::array<double, 3> Setup::acceleration(double t) const {
  if (options.forcing.kind != BodyForce::Kind::body) return {0, 0, 0};
  return vector_at(options.forcing.times, options.forcing.vectors, options.forcing.ramp, t);
}

void Setup::announce(PetscInt num_points) const {
  if (output.quiet) return;
  const char *resource;
  ceed_check(CeedGetResource(ceed, &resource));
  int ranks;
  MPI_Comm_size(comm, &ranks);
  petsc_check(PetscPrintf(comm, "%s, %" PetscInt_FMT " cells of order %" PetscInt_FMT,
                          options.method == Method::mpm ? "implicit MPM" : "FEM", mesh->num_cells_global, mesh->order));
  if (num_points) petsc_check(PetscPrintf(comm, ", %" PetscInt_FMT " points", num_points));
  petsc_check(PetscPrintf(comm, ", %d rank%s, %s\n", ranks, ranks > 1 ? "s" : "", resource));
}

void Setup::say_step(const Record &record) const {
  if (output.quiet) return;
  petsc_check(PetscPrintf(comm, "step %" PetscInt_FMT "  t %g  dt %g  Newton %" PetscInt_FMT "  linear %" PetscInt_FMT,
                          record.step, record.time, record.dt, record.newton_iterations, record.linear_iterations));
  if (!record.probes.empty()) {  // the others are in the table of -ts_monitor_quantities
    const auto &u = record.probes.front();
    petsc_check(PetscPrintf(comm, "  u (%.6g, %.6g, %.6g)", u[0], u[1], u[2]));
  }
  petsc_check(PetscPrintf(comm, "\n"));
}

void Setup::say_rejected(double t, double dt, const std::string &reason) const {
  if (output.quiet) return;
  petsc_check(PetscPrintf(comm, "step from t %g with dt %g rejected, halving: %s\n", t, dt, reason.c_str()));
}

}  // namespace hg
