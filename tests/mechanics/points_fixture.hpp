// Points on a mesh, and a way to compare them over partitions: gathered by id on every rank.
#pragma once
#include <array>
#include <map>
#include <memory>

#include "grids.hpp"
#include "mesh_fixture.hpp"
#include "swarm/epoch.hpp"
#include "swarm/migrate.hpp"
#include "swarm/swarm.hpp"

namespace hg::test {

inline int ranks(MPI_Comm comm = PETSC_COMM_WORLD) {
  int n;
  MPI_Comm_size(comm, &n);
  return n;
}
inline int my_rank(MPI_Comm comm = PETSC_COMM_WORLD) {
  int r;
  MPI_Comm_rank(comm, &r);
  return r;
}

inline PointMaterial everywhere(std::int32_t, const double *) {
  return {.region = 0, .rho0 = 2.5, .K = 3, .mu = 1};
}

/// A mesh with its cells and points.
struct PointsOnMesh {
  PointsOnMesh(std::unique_ptr<Mesh> m, const SwarmOptions &o, const PointMaterialFn &material = everywhere)
      : options(o), mesh(std::move(m)), grid(build_cell_grid(*mesh)), locator(grid), swarm(mesh->comm) {
    seed_swarm(options, grid, locator, material, swarm);
  }
  MigrateStats locate() { return locate_points(options, grid, locator, swarm); }
  /// x += move(x), u with it.
  template <class Move>
  void displace(Move &&move) {
    const PointField<double> x(swarm, field::x), u(swarm, field::u);
    for (PetscInt p = 0; p < swarm.local_size(); p++) {
      double d[3] = {0, 0, 0};
      move(&x[3 * p], d);
      for (int k = 0; k < 3; k++) {
        x[3 * p + k] += d[k];
        u[3 * p + k] += d[k];
      }
    }
  }

  SwarmOptions options;
  std::unique_ptr<Mesh> mesh;
  CellGrid grid;
  HexLocator locator;
  Swarm swarm;
};

struct PointRecord {
  std::int64_t id, cell_id;
  double x[3], xi[3], V, mass;
};

/// All points of all ranks, by id; fails if an id occurs twice.
inline std::map<std::int64_t, PointRecord> gather_points(const PointsOnMesh &points) {
  std::vector<PointRecord> mine;
  {
    const Swarm &s = points.swarm;
    const PointField<double> x(s, field::x), xi(s, field::x_ref), V(s, field::V), V0(s, field::V0),
        rho0(s, field::rho0);
    const PointField<std::int64_t> id(s, field::id);
    const PointField<std::int32_t> cell(s, field::cell);
    for (std::size_t p = 0; p < V.size(); p++) {
      PointRecord r{};
      r.id = id[p];
      if (cell[p] < 0 || cell[p] >= points.grid.num_cells()) fail("point %d in cell %d", static_cast<int>(p), cell[p]);
      r.cell_id = points.grid.cell_ids[cell[p]];
      for (int d = 0; d < 3; d++) r.x[d] = x[3 * p + d], r.xi[d] = xi[3 * p + d];
      r.V = V[p];
      r.mass = rho0[p] * V0[p];
      mine.push_back(r);
    }
  }
  const MPI_Comm comm = points.swarm.comm();
  const int size = ranks(comm), bytes = static_cast<int>(mine.size() * sizeof(PointRecord));
  std::vector<int> counts(size), starts(size, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 1; r < size; r++) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<PointRecord> all((starts.back() + counts.back()) / sizeof(PointRecord));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm);
  std::map<std::int64_t, PointRecord> by_id;
  for (const PointRecord &r : all) {
    if (!by_id.emplace(r.id, r).second) fail("point id %lld twice", static_cast<long long>(r.id));
  }
  return by_id;
}

/// The largest distance between a point's x and the place of its ξ in its cell, on this rank.
inline double largest_gap(const PointsOnMesh &points) {
  const PointField<double> x(points.swarm, field::x), xi(points.swarm, field::x_ref);
  const PointField<std::int32_t> cell(points.swarm, field::cell);
  double gap = 0.0;
  for (std::size_t p = 0; p < cell.size(); p++) {
    double y[3];
    points.locator.map(cell[p], &xi[3 * p], y);
    for (int d = 0; d < 3; d++) {
      gap = std::max(gap, std::abs(y[d] - x[3 * p + d]));
      if (!(std::abs(xi[3 * p + d]) <= 1.0 + HexLocator::kFaceTolerance)) return 1e300;
    }
  }
  return gap;
}

}  // namespace hg::test
