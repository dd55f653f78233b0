/// @file
/// bps: the bake-off problems on distributed meshes, solved with PETSc.
#include <fmt/format.h>
#include <petscksp.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <vector>

#include "bps_options.hpp"
#include "library.hpp"
#include "plex_mesh.hpp"
#include "plex_solver.hpp"
#include "record.hpp"

namespace {

using namespace hg::bps;

constexpr const char *help =
    "The CEED bake-off problems BP1 to BP6 on a deformed box, at quadrature points or at material points,\n"
    "with the operator from ceed.h and CG from PETSc.\n";

struct Run {
  std::string resource;
  Problem problem;
  CeedInt degree;
};

std::array<PetscInt, 3> cells_of(const BpsOptions &options, CeedInt degree, int ranks) {
  if (options.num_cells) return *options.num_cells;
  const auto box = box_for_dofs(options.local_nodes * ranks, degree, 1);
  return {box[0], box[1], box[2]};
}

std::unique_ptr<Bakeoff> make_bakeoff(Ceed ceed, const Run &run, const Cells &cells, const BpsOptions &options) {
  if (!options.swarm) return std::make_unique<Bakeoff>(ceed, run.problem, run.degree, cells);
  const CeedInt q = run.degree + 2, per_cell = options.points_per_cell > 0 ? options.points_per_cell : q * q * q;
  return std::make_unique<Bakeoff>(ceed, run.problem, run.degree, cells,
                                   place_points(cells, run.problem, run.degree, *options.swarm, per_cell));
}

double sum_over_ranks(MPI_Comm comm, double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm);
  return value;
}

/// All ranks have the same library: none counts, or all do.
std::optional<CeedOperatorMemory> sum_over_ranks(MPI_Comm comm, std::optional<CeedOperatorMemory> memory) {
  if (!memory) return {};
  for (CeedSize *part : {&memory->program, &memory->restrictions, &memory->bases, &memory->vectors, &memory->assembly,
                         &memory->backend, &memory->total}) {
    *part = std::llround(sum_over_ranks(comm, double(*part)));
  }
  return memory;
}

/// Seconds of the first application, then of others, the fastest first: halo exchange included, on the slowest rank.
std::vector<double> time_applications(MPI_Comm comm, Mat A, Vec x, Vec y, int repetitions) {
  std::vector<double> seconds;
  for (int i = 0; i < repetitions + 1; i++) {
    MPI_Barrier(comm);
    const double start = MPI_Wtime();
    ok(MatMult(A, x, y));
    seconds.push_back(MPI_Wtime() - start);
  }
  MPI_Allreduce(MPI_IN_PLACE, seconds.data(), repetitions + 1, MPI_DOUBLE, MPI_MAX, comm);
  std::ranges::sort(seconds.begin() + 1, seconds.end());
  return seconds;
}

Record run_one(MPI_Comm comm, const Run &run, const BpsOptions &options) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const Context ceed = open_ceed(run.resource);
  const auto num_cells = cells_of(options, run.degree, ranks);
  const PlexMesh mesh(comm, num_cells, run.problem, run.degree);
  const auto bakeoff = make_bakeoff(ceed, run, mesh.cells(), options);
  PlexOperator plex_operator(ceed, mesh, *bakeoff);
  const Matrix A = plex_operator.matrix();
  PetscVector b, x;
  PetscInt num_dofs = 0, owned_dofs = 0;
  ok(DMCreateGlobalVector(mesh.dm(), b.out()));
  ok(VecDuplicate(b, x.out()));
  ok(VecGetSize(b, &num_dofs));
  ok(VecGetLocalSize(b, &owned_dofs));
  plex_operator.assemble(bakeoff->right_hand_side(), b);

  Record record;
  record.program = "bps";
  record.problem = run.problem.name;
  record.ceed = resource_name(ceed);
  record.degree = run.degree;
  record.q_1d = run.problem.q_1d(run.degree);
  record.elements = mesh.num_global_cells();
  record.dofs = num_dofs;
  record.points = std::llround(sum_over_ranks(comm, double(bakeoff->num_points())));
  if (options.swarm) {
    record.points_per_cell = record.points / record.elements;
    record.placement = name(*options.swarm);
  }
  record.bytes = sum_over_ranks(comm, bakeoff->work().bytes);
  record.flops = sum_over_ranks(comm, bakeoff->work().flops);
  record.ranks = ranks;
  record.cpu = cpu_name();
  record.library_version = library_version();
  auto seconds = time_applications(comm, A, b, x, options.repetitions);
  record.seconds_created = bakeoff->seconds_created();
  MPI_Allreduce(MPI_IN_PLACE, &record.seconds_created, 1, MPI_DOUBLE, MPI_MAX, comm);
  record.seconds_first = seconds.front();
  seconds.erase(seconds.begin());
  record.memory = sum_over_ranks(comm, operator_memory(ceed, bakeoff->op()));
  record.compulsory_memory = sum_over_ranks(comm, bakeoff->work().held_bytes);
  record.repetitions = options.repetitions;
  record.seconds_best = seconds.front();
  record.seconds_median = (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]) / 2;

  const KspResult result = solve(A, b, x);
  record.cg_iterations = static_cast<int>(result.iterations);
  record.cg_converged = result.reason > 0;
  record.cg_seconds = result.seconds;
  if (record.cg_converged) {
    const ErrorSums error = plex_operator.error(x);
    record.error = error.relative_l2();
    record.error_h1 = error.relative_h1();
  }

  const auto print = [&](const std::string &text) { ok(PetscPrintf(comm, "%s", text.c_str())); };
  print(fmt::format("{} on {} rank{}, {}\n", record.problem, ranks, ranks == 1 ? "" : "s", record.ceed));
  print(fmt::format("  mesh          {}×{}×{} cells, p = {}, q = {}{}\n", num_cells[0], num_cells[1], num_cells[2],
                    record.degree, record.q_1d,
                    record.placement ? fmt::format(", {} {} points a cell", *record.points_per_cell, *record.placement)
                                     : std::string()));
  print(fmt::format("  unknowns      {} global DoFs, {} owned by rank 0, {} component{}\n", record.dofs, owned_dofs,
                    run.problem.num_comp, run.problem.num_comp == 1 ? "" : "s"));
  print(fmt::format("  apply         best {:.3e} s, {:.3f} million DoFs/s, {:.3f} million points/s, {:.3f} GB/s\n",
                    record.seconds_best, record.mdofs_per_s(), record.mpoints_per_s(), record.gb_per_s()));
  print(fmt::format("  KSP           {}, {} iterations, residual norm {:.3e}\n", KSPConvergedReasons[result.reason],
                    result.iterations, result.residual));
  print(fmt::format("  CG time       {:.3e} s\n  DoFs/s in CG  {:.3f} million\n", record.cg_seconds,
                    record.cg_mdofs_per_s()));
  print(record.error
            ? fmt::format("  error         {:.3e} in L2, {:.3e} in H1, relative\n", *record.error, *record.error_h1)
            : std::string("  error         not computed: KSP did not converge (see -ksp_max_it)\n"));
  return record;
}

/// Says which options were given but never asked for: most often a spelling mistake.
void report_unused_options(MPI_Comm comm) {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  ok(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  for (PetscInt i = 0; i < count; i++) ok(PetscFPrintf(comm, stderr, "bps: option -%s was not used\n", names[i]));
  ok(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
}

/// Writes what there is on rank 0; a failure is every rank's. Nothing without -json.
void write_on_first_rank(MPI_Comm comm, const BpsOptions &options, const std::vector<Record> &records) {
  if (!options.json) return;
  int rank = 0, failed = 0;
  std::string message = "cannot write the records";
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) {
    try {
      write_records(*options.json, records);
    } catch (const Error &error) {
      message = error.what();
      failed = 1;
    }
  }
  MPI_Bcast(&failed, 1, MPI_INT, 0, comm);
  if (failed) throw CollectiveError(message);
}

void run_all(MPI_Comm comm) {
  BpsOptions options;
  try {
    options = parse_bps_options();
    PetscBool wants_help = PETSC_FALSE;
    ok(PetscOptionsHasHelp(nullptr, &wants_help));
    if (wants_help) return;
    for (const auto &resource : options.resources) open_ceed(resource);
  } catch (const Error &error) {
    throw CollectiveError(error.what());
  }
  std::vector<Record> records;
  write_on_first_rank(comm, options, records);  // a bad file name is worth knowing before the work
  for (const auto &resource : options.resources)
    for (const Problem &problem : options.problems)
      for (const CeedInt degree : options.degrees) {
        records.push_back(run_one(comm, {resource, problem, degree}, options));
        write_on_first_rank(comm, options, records);
      }
  report_unused_options(comm);
}

}  // namespace

int main(int argc, char **argv) {
  if (PetscInitialize(&argc, &argv, nullptr, help)) return 2;
  const MPI_Comm comm = PETSC_COMM_WORLD;
  int rank = 0, code = 0;
  MPI_Comm_rank(comm, &rank);
  try {
    run_all(comm);
  } catch (const CollectiveError &error) {
    if (rank == 0) fmt::print(stderr, "bps: {}\n", error.what());
    code = 2;
  } catch (const std::exception &error) {
    fmt::print(stderr, "bps: rank {}: {}\n", rank, error.what());
    std::fflush(stderr);
    MPI_Abort(comm, 2);
  }
  return PetscFinalize() ? 2 : code;
}
