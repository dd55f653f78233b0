// Speed of the operators of a solid at material points, rank by rank; prints one JSON record.
//   solid-bench -options_file ratel-like/examples/sinker-mpm.yml -dm_plex_box_faces 20,20,20 [-reps 20]
// All options of honeyguide that say what the problem is. Best times: `residual` stores the linearisation, `jacobian`
// is one application; `attach` is what a new point epoch costs, `first` the first application of each operator after
// it. Seconds, and millions of points a second.
#include <ceed.h>
#include <petscsys.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "mesh/lend.hpp"
#include "operators/mpm_operators.hpp"
#include "options/error.hpp"
#include "solve/setup.hpp"
#include "swarm/epoch.hpp"
#include "swarm/migrate.hpp"

namespace {
using namespace hg;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <typename Work>
double best_of(PetscInt reps, Work &&work) {
  double best = std::numeric_limits<double>::max();
  for (PetscInt rep = 0; rep < reps; rep++) {
    const double start = seconds();
    work();
    best = std::min(best, seconds() - start);
  }
  return best;
}

/// A displacement that compresses and shears a little, so that no term of the material vanishes.
void deform(const Mesh &mesh, CeedVector u) {
  CeedScalar *values = nullptr;
  ceed_check(CeedVectorGetArrayWrite(u, CEED_MEM_HOST, &values));
  std::uint64_t state = 88172645463325252ull;
  for (PetscInt i = 0; i < mesh.local_size; i++) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    values[i] = 1e-4 * static_cast<double>(state >> 11) * 0x1p-53;
  }
  ceed_check(CeedVectorRestoreArray(u, &values));
}

void run(PetscInt reps) {
  Setup setup(PETSC_COMM_SELF);
  const Mesh &mesh = *setup.mesh;
  Swarm swarm(setup.comm);
  seed_swarm(
      setup.swarm, *setup.grid, *setup.locator,
      [&](std::int32_t cell, const double x[3]) -> PointMaterial {
        const int region = setup.regions->of_point(cell, std::span<const double, 3>(x, 3));
        const ElasticParameters &parameters = setup.materials[region].parameters;
        return {
            .region = region, .rho0 = parameters.rho, .K = parameters.bulk_modulus(), .mu = parameters.shear_modulus()};
      },
      swarm);
  locate_points(setup.swarm, *setup.grid, *setup.locator, swarm);
  const PointEpoch epoch(setup.ceed, mesh.num_cells, swarm);
  MpmOperators operators(mesh, setup.materials, setup.swarm.void_stiffness);
  const double attach = best_of(3, [&] { operators.attach(epoch, swarm); });
  CeedVectorHandle u, v, d, entries;
  for (CeedVectorHandle *each : {&u, &v, &d}) ceed_check(CeedVectorCreate(setup.ceed, mesh.local_size, each->put()));
  deform(mesh, u);
  const auto apply = [&](CeedOperator op) {
    return [&, op] { ceed_check(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE)); };
  };
  const double first_residual = best_of(1, apply(operators.residual()));
  const double residual = best_of(reps, apply(operators.residual()));
  const double first_jacobian = best_of(1, apply(operators.jacobian()));
  const double jacobian = best_of(reps, apply(operators.jacobian()));
  const auto diagonal = [&] {
    ceed_check(CeedOperatorLinearAssembleDiagonal(operators.jacobian(), d, CEED_REQUEST_IMMEDIATE));
  };
  const double first_diagonal = best_of(1, diagonal), best_diagonal = best_of(reps, diagonal);
  CeedSize num_entries = 0;
  CeedInt *rows = nullptr, *columns = nullptr;
  const double symbolic = best_of(
      1, [&] { ceed_check(CeedOperatorLinearAssembleSymbolic(operators.jacobian(), &num_entries, &rows, &columns)); });
  std::free(rows);
  std::free(columns);
  ceed_check(CeedVectorCreate(setup.ceed, num_entries, entries.put()));
  const auto matrix = [&] { ceed_check(CeedOperatorLinearAssemble(operators.jacobian(), entries)); };
  matrix();
  const double best_matrix = best_of(std::min<PetscInt>(reps, 5), matrix);

  const char *resource = nullptr;
  ceed_check(CeedGetResource(setup.ceed, &resource));
  const double points = static_cast<double>(swarm.local_size()), cells = mesh.num_cells, million = 1e-6 * points;
  std::printf(
      "{\"program\": \"solid-bench\", \"ceed\": \"%s\", \"cells\": %.0f, \"points\": %.0f, \"dofs\": %lld, \"attach\": "
      "%.4e, "
      "\"first\": {\"residual\": %.4e, \"jacobian\": %.4e, \"diagonal\": %.4e}, "
      "\"residual\": %.4e, \"jacobian\": %.4e, \"diagonal\": %.4e, \"symbolic\": %.4e, \"matrix\": %.4e, "
      "\"residual_mpoints_per_s\": %.3f, \"jacobian_mpoints_per_s\": %.3f, \"diagonal_us_per_cell\": %.2f, "
      "\"matrix_us_per_cell\": %.2f}\n",
      resource, cells, points, static_cast<long long>(mesh.local_size), attach, first_residual, first_jacobian,
      first_diagonal, residual, jacobian, best_diagonal, symbolic, best_matrix, million / residual, million / jacobian,
      1e6 * best_diagonal / cells, 1e6 * best_matrix / cells);
}

}  // namespace

int main(int argc, char **argv) {
  if (PetscInitialize(&argc, &argv, nullptr, nullptr)) return 1;
  try {
    hg::PetscErrorScope errors;
    PetscInt reps = 20;
    hg::petsc_check(PetscOptionsGetInt(nullptr, nullptr, "-reps", &reps, nullptr));
    run(reps);
  } catch (const std::exception &e) {
    hg::abort_run(e.what());
  }
  return PetscFinalize();
}
