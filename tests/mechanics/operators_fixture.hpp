// A small body with operators on it, by quadrature or by points, for the tests of operators.
#pragma once

#include <functional>
#include <memory>

#include "mesh_fixture.hpp"
#include "operators/fem_operators.hpp"
#include "operators/mpm_operators.hpp"
#include "qfunction_harness.hpp"

namespace hg::test {

/// Local arrays in and out of an operator.
inline std::vector<double> apply(const Mesh &mesh, CeedOperator op, const std::vector<double> &local) {
  const CeedVectorHandle in = make_vector(mesh.ceed, local);
  CeedVectorHandle out;
  ceed_check(CeedVectorCreate(mesh.ceed, mesh.local_size, out.put()));
  ceed_check(CeedVectorSetValue(out, 777.));  // an operator must overwrite
  ceed_check(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
  return to_host(out);
}

inline double sum_ranks(double mine) {
  double sum = 0.;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sum;
}

/// Σ over ranks of an unassembled local result times a local array that is the same on all ranks.
inline double pair(const std::vector<double> &unassembled, const std::vector<double> &values) {
  return sum_ranks(dot(unassembled, values));
}

/// Adds shared nodes of a local result over ranks.
inline std::vector<double> assembled(const Mesh &mesh, std::vector<double> local) {
  mesh.sum_shared(mesh.order, 3, local);
  return local;
}

/// Values at nodes of a function of their position.
inline std::vector<double> at_nodes(const Mesh &mesh, const std::function<void(const double *x, double *u)> &f) {
  const std::vector<double> &x = mesh.node_coordinates(mesh.order);
  std::vector<double> u(x.size());
  for (std::size_t n = 0; n < x.size(); n += 3) f(x.data() + n, u.data() + n);
  return u;
}

/// A smooth displacement of the given size.
inline std::vector<double> wave(const Mesh &mesh, double size, double phase) {
  return at_nodes(mesh, [=](const double *x, double *u) {
    for (int c = 0; c < 3; c++) {
      u[c] = size * std::sin(2. * x[c] + 1.5 * x[(c + 1) % 3] - x[(c + 2) % 3] + phase + c) + 0.2 * size * x[0] * x[1];
    }
  });
}

/// Whether a local node lies on the boundary of the unit cube.
inline bool on_boundary(const double *x) {
  for (int c = 0; c < 3; c++) {
    if (x[c] < 1e-10 || x[c] > 1. - 1e-10) return true;
  }
  return false;
}

/// Largest entry at nodes inside the unit cube, over all ranks, of an unassembled local result.
inline double inner_maximum(const Mesh &mesh, const std::vector<double> &unassembled) {
  const std::vector<double> total = assembled(mesh, unassembled);
  const std::vector<double> &x = mesh.node_coordinates(mesh.order);
  double mine = 0., largest = 0.;
  for (std::size_t n = 0; n < x.size(); n += 3) {
    if (on_boundary(x.data() + n)) continue;
    for (int c = 0; c < 3; c++) mine = std::max(mine, std::abs(total[n + c]));
  }
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return largest;
}

/// Points in every cell of a mesh for which `choose` gives a region.
struct Points {
  Points(const Mesh &mesh, std::span<const RegionMaterial> regions, PointPlacement placement, PetscInt per_cell,
         const std::function<int(const double *x)> &choose)
      : swarm(PETSC_COMM_WORLD) {
    grid.corners = mesh.corner_coords;
    for (PetscInt neighbour : mesh.neighbours) grid.neighbours.push_back(static_cast<std::int32_t>(neighbour));
    int rank;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    for (CeedInt c = 0; c < mesh.num_cells; c++) grid.cell_ids.push_back(1000 * rank + c);
    const HexLocator locator(grid);
    SwarmOptions options;
    options.points_per_cell = per_cell;
    options.placement = placement;
    seed_swarm(
        options, grid, locator,
        [&](std::int32_t, const double x[3]) {
          const int region = choose(x);
          if (region < 0) return PointMaterial{-1, 0., 0., 0.};
          const ElasticParameters &p = regions[region].parameters;
          return PointMaterial{region, p.rho, p.bulk_modulus(), p.shear_modulus()};
        },
        swarm);
    epoch = std::make_unique<PointEpoch>(mesh.ceed, mesh.num_cells, swarm);
  }
  CellGrid grid;
  Swarm swarm;
  std::unique_ptr<PointEpoch> epoch;
};

/// Gives every point a random history F_n near I, with V = J_n V0.
inline void give_history(Swarm &swarm, double size, unsigned seed) {
  Random random(seed);
  const PointField<double> F(swarm, field::F), V(swarm, field::V), V0(swarm, field::V0);
  for (std::size_t p = 0; p < V.size(); p++) {
    const Tensor A = random.near_identity(size);
    std::copy(A.begin(), A.end(), F.data() + 9 * p);
    V[p] = V0[p] * determinant(A);
  }
}

}  // namespace hg::test
