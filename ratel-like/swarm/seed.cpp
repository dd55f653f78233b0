#include <cmath>
#include <string>
#include <vector>

#include "options/error.hpp"
#include "options/options.hpp"
#include "swarm/swarm.hpp"

namespace hg {
namespace {

/// Number whose cube is n, or 0.
PetscInt cube_root(PetscInt n) {
  const auto r = static_cast<PetscInt>(std::lround(std::cbrt(static_cast<double>(n))));
  return r * r * r == n ? r : 0;
}

/// SplitMix64: a good 64-bit mix of a counter.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// In (-1, 1), a function of its arguments alone, so that no partition changes it.
double random_coordinate(std::uint64_t seed, std::uint64_t id, int direction) {
  const std::uint64_t bits = mix(mix(mix(seed) ^ id) + static_cast<std::uint64_t>(direction));
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-51 - 1.0;
}

/// Reference places and weights (summing to 8) of the points of every cell; empty for random places.
struct CellRule {
  std::vector<double> xi, weight;
};

CellRule tensor_rule(const SwarmOptions &options) {
  const PetscInt n = cube_root(options.points_per_cell);
  std::vector<PetscReal> x(n), w(n);
  if (options.placement == PointPlacement::kGauss) {
    petsc_check(PetscDTGaussQuadrature(n, -1.0, 1.0, x.data(), w.data()));
  } else {
    for (PetscInt i = 0; i < n; i++) x[i] = (2.0 * i + 1.0) / n - 1.0;
    std::fill(w.begin(), w.end(), 2.0 / n);
  }
  CellRule rule;
  for (PetscInt k = 0; k < n; k++) {
    for (PetscInt j = 0; j < n; j++) {
      for (PetscInt i = 0; i < n; i++) {
        rule.xi.insert(rule.xi.end(), {x[i], x[j], x[k]});
        rule.weight.push_back(w[i] * w[j] * w[k]);
      }
    }
  }
  return rule;
}

}  // namespace

void SwarmOptions::check() const {
  if (points_per_cell < 1) {
    fail("-mpm_num_points_per_cell %" PetscInt_FMT ": expected at least 1", points_per_cell);
  }
  if (placement != PointPlacement::kCellRandom && !cube_root(points_per_cell)) {
    fail("-mpm_num_points_per_cell %" PetscInt_FMT
         ": expected a cube (1, 8, 27, 64, ...) for -mpm_point_location_type %s",
         points_per_cell, placement == PointPlacement::kGauss ? "gauss" : "uniform");
  }
}

SwarmOptions SwarmOptions::read(MPI_Comm comm) {
  OptionGroup group(comm, "", "Material points");
  SwarmOptions o;
  o.points_per_cell = group.integer("mpm_num_points_per_cell", "points seeded in each cell; a cube unless cell_random",
                                    o.points_per_cell, Range::at_least(1));
  const std::string where = group.choice("mpm_point_location_type", "where points are seeded in a cell",
                                         {"uniform", "gauss", "cell_random"}, "uniform");
  o.placement = where == "uniform" ? PointPlacement::kUniform
                                   : (where == "gauss" ? PointPlacement::kGauss : PointPlacement::kCellRandom);
  o.seed = group.integer("mpm_seed", "seed of cell_random", o.seed);
  const std::string outside = group.choice("mpm_point_outside", "what becomes of a point that leaves the mesh",
                                           {"error", "project", "remove"}, "error");
  o.outside = outside == "error" ? OutsidePolicy::kError
                                 : (outside == "project" ? OutsidePolicy::kProject : OutsidePolicy::kRemove);
  o.void_stiffness =
      group.real("mpm_void_stiffness",
                 "stiffness of cells that have lost their points, as a fraction of the softest region's; "
                 "it falls to zero where points fill half of a cell",
                 o.void_stiffness, Range::at_least(0));
  o.check();
  return o;
}

void seed_swarm(const SwarmOptions &options, const CellGrid &grid, const HexLocator &locator,
                const PointMaterialFn &material, Swarm &swarm) {
  options.check();
  if (swarm.local_size() != 0) {
    fail("seeding wants an empty set of points, found %" PetscInt_FMT, swarm.local_size());
  }
  const std::int64_t per_cell = options.points_per_cell;
  const bool random = options.placement == PointPlacement::kCellRandom;
  const CellRule rule = random ? CellRule{} : tensor_rule(options);

  struct Seed {
    double x[3], xi[3], V;
    PointMaterial material;
    std::int64_t id;
    std::int32_t cell;
  };
  std::vector<Seed> seeds;
  seeds.reserve(static_cast<std::size_t>(grid.num_cells() * per_cell));
  for (std::int32_t c = 0; c < grid.num_cells(); c++) {
    const double volume = locator.cell_volume(c);
    for (std::int64_t k = 0; k < per_cell; k++) {
      Seed s;
      s.cell = c;
      s.id = grid.cell_ids[c] * per_cell + k;
      for (int d = 0; d < 3; d++) {
        s.xi[d] = random
                      ? random_coordinate(static_cast<std::uint64_t>(options.seed), static_cast<std::uint64_t>(s.id), d)
                      : rule.xi[3 * k + d];
      }
      locator.map(c, s.xi, s.x);
      if (options.placement == PointPlacement::kGauss) {
        double J[9];
        s.V = rule.weight[k] * locator.jacobian(c, s.xi, J);
      } else {
        s.V = volume / static_cast<double>(per_cell);
      }
      s.material = material(c, s.x);
      if (s.material.region >= 0) seeds.push_back(s);
    }
  }

  swarm.resize(static_cast<PetscInt>(seeds.size()));
  const PointField<double> x(swarm, field::x), X0(swarm, field::X0), u(swarm, field::u), v(swarm, field::v);
  const PointField<double> F(swarm, field::F), V(swarm, field::V), V0(swarm, field::V0), rho0(swarm, field::rho0);
  const PointField<double> moduli(swarm, field::material), x_ref(swarm, field::x_ref);
  const PointField<std::int32_t> region(swarm, field::region), cell(swarm, field::cell);
  const PointField<std::int64_t> id(swarm, field::id);
  for (std::size_t p = 0; p < seeds.size(); p++) {
    const Seed &s = seeds[p];
    for (int d = 0; d < 3; d++) {
      x[3 * p + d] = X0[3 * p + d] = s.x[d];
      u[3 * p + d] = v[3 * p + d] = 0.0;
      x_ref[3 * p + d] = s.xi[d];
    }
    for (int d = 0; d < 9; d++) F[9 * p + d] = d % 4 == 0 ? 1.0 : 0.0;
    V[p] = V0[p] = s.V;
    rho0[p] = s.material.rho0;
    moduli[2 * p] = s.material.K;
    moduli[2 * p + 1] = s.material.mu;
    region[p] = s.material.region;
    id[p] = s.id;
    cell[p] = s.cell;
  }
}

}  // namespace hg
