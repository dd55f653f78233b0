// Speed of point location and of a new point epoch on one core; prints one JSON record for each kind of mesh.
//   locate-bench [-points 1000000] [-cells 20] [-reps 5]
// Points move by up to 0.3 of a cell in each step, as in a run; `walk` locates from the cell before, `hash` without a
// guess, `epoch` is the counting sort and the reference coordinates' vector, `points` the first restriction at points;
// `location_sort_epoch` is what a step pays for new points: locate_points with its checks, then the epoch.
#include <ceed.h>
#include <petscsys.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "options/error.hpp"
#include "swarm/epoch.hpp"
#include "swarm/locate.hpp"
#include "swarm/migrate.hpp"

namespace {
using namespace hg;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void bend(double *x) {
  const double s = 0.08 * std::sin(M_PI * x[0]) * std::sin(M_PI * x[1]) * std::sin(M_PI * x[2]);
  x[0] += s;
  x[1] -= s;
  x[2] += s;
}
void shear(double *x) {
  x[0] += 0.2 * x[1], x[1] += 0.1 * x[2];
}

struct Times {
  std::vector<double> all;
  double best() const { return *std::min_element(all.begin(), all.end()); }
  double median() {
    std::sort(all.begin(), all.end());
    return all[all.size() / 2];
  }
};

void run(const char *name, void (*map)(double *), int n, PetscInt points, int reps, Ceed ceed) {
  const CellGrid grid = make_box_grid({n, n, n}, {0, 0, 0}, {1, 1, 1}, map);
  const HexLocator locator(grid);
  const std::int32_t num_cells = grid.num_cells();
  Swarm swarm(PETSC_COMM_SELF);
  swarm.resize(points);
  std::uint64_t state = 88172645463325252ull;
  const auto random = [&] {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  Times walk, hash, epoch_time, rstr_time, total;
  {
    PointField<double> x(swarm, field::x), xi(swarm, field::x_ref);
    PointField<std::int32_t> cell(swarm, field::cell);
    for (PetscInt p = 0; p < points; p++) {  // cell by cell, as seeding leaves them
      cell[p] = static_cast<std::int32_t>(static_cast<std::int64_t>(p) * num_cells / points);
      for (int d = 0; d < 3; d++) xi[3 * p + d] = 2.0 * random() - 1.0;
      locator.map(cell[p], &xi[3 * p], &x[3 * p]);
    }
  }
  std::size_t inside = 0, crossed = 0;
  std::vector<PointPlace> place(points);
  for (int rep = 0; rep < reps; rep++) {
    {
      PointField<double> x(swarm, field::x), xi(swarm, field::x_ref);
      PointField<std::int32_t> cell(swarm, field::cell);
      std::vector<std::int32_t> old(cell.data(), cell.data() + points);
      for (PetscInt p = 0; p < points;
           p++) {  // a move that stays in the domain: towards a place in the cell's own frame
        const std::int32_t c = cell[p];
        double to[3];
        for (int d = 0; d < 3; d++) {
          to[d] = xi[3 * p + d] + 0.6 * (2.0 * random() - 1.0);
          if (grid.neighbours[6 * static_cast<std::size_t>(c) + 2 * d] == CellGrid::kBoundary)
            to[d] = std::max(to[d], -0.999);
          if (grid.neighbours[6 * static_cast<std::size_t>(c) + 2 * d + 1] == CellGrid::kBoundary)
            to[d] = std::min(to[d], 0.999);
        }
        locator.map(c, to, &x[3 * p]);
      }
      std::vector<std::int32_t> found(old);
      std::vector<double> found_xi(3 * points);
      const double t = seconds();
      inside = locator.locate(x.span(), found, found_xi, place);
      walk.all.push_back(seconds() - t);
      for (PetscInt p = 0; p < points; p++) crossed += old[p] != found[p];
    }
    const double t0 = seconds();
    locate_points({}, grid, locator, swarm);
    const double t2 = seconds();
    PointEpoch epoch(ceed, num_cells, swarm);
    const double t3 = seconds();
    epoch.points(3);
    const double t4 = seconds();
    epoch_time.all.push_back(t3 - t2);
    rstr_time.all.push_back(t4 - t3);
    total.all.push_back(t3 - t0);
    if (rep == 0) {
      PointField<double> x(swarm, field::x);
      std::vector<std::int32_t> unknown(points, -1);
      std::vector<double> xi(3 * points);
      locator.find(&x[0]);  // builds the hash grid
      const double t5 = seconds();
      locator.locate(x.span(), unknown, xi, place);
      hash.all.push_back(seconds() - t5);
    }
  }
  const double us = 1e6 / static_cast<double>(points);
  std::printf(
      "{\"mesh\": \"%s\", \"cells\": %d, \"points\": %lld, \"inside\": %zu, \"crossed\": %.3f, \"walk_us\": %.4f, "
      "\"walk_median_us\": %.4f, \"hash_us\": %.4f, \"epoch_us\": %.4f, \"points_us\": %.4f, "
      "\"location_sort_epoch_us\": %.4f, \"mpoints_per_s\": %.3f}\n",
      name, num_cells, static_cast<long long>(points), inside,
      static_cast<double>(crossed) / (static_cast<double>(points) * reps), walk.best() * us, walk.median() * us,
      hash.best() * us, epoch_time.best() * us, rstr_time.best() * us, total.best() * us, 1.0 / (walk.best() * us));
}

}  // namespace

int main(int argc, char **argv) {
  if (PetscInitialize(&argc, &argv, nullptr, nullptr)) return 1;
  try {
    hg::PetscErrorScope errors;
    PetscInt points = 1000000, cells = 20, reps = 5;
    hg::petsc_check(PetscOptionsGetInt(nullptr, nullptr, "-points", &points, nullptr));
    hg::petsc_check(PetscOptionsGetInt(nullptr, nullptr, "-cells", &cells, nullptr));
    hg::petsc_check(PetscOptionsGetInt(nullptr, nullptr, "-reps", &reps, nullptr));
    Ceed ceed;
    hg::ceed_check(CeedInit("/cpu/self/ref/serial", &ceed));
    const int n = static_cast<int>(cells), r = static_cast<int>(reps);
    run("box", nullptr, n, points, r, ceed);
    run("parallelepiped", shear, n, points, r, ceed);
    run("general", bend, n, points, r, ceed);
    CeedDestroy(&ceed);
  } catch (const std::exception &e) {
    hg::abort_run(e.what());
  }
  return PetscFinalize();
}
