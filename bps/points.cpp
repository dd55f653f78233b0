#include "points.hpp"

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "ceed_handles.hpp"

namespace hg::bps {

namespace {

constexpr std::array<std::pair<std::string_view, Placement>, 5> placements{{
    {"uniform", Placement::uniform},
    {"gauss", Placement::gauss},
    {"random", Placement::random},
    {"quadrature", Placement::quadrature},
    {"cell-random", Placement::random},
}};

/// A one-dimensional rule on [−1, 1].
struct Rule {
  std::vector<CeedScalar> points, weights;
};

Rule make_rule(CeedInt n, int (*fill)(CeedInt, CeedScalar *, CeedScalar *)) {
  Rule rule{std::vector<CeedScalar>(n), std::vector<CeedScalar>(n)};
  check(nullptr, fill(n, rule.points.data(), rule.weights.data()));
  return rule;
}

Rule midpoint_rule(CeedInt n) {
  Rule rule;
  for (CeedInt i = 0; i < n; i++) {
    rule.points.push_back(-1 + (2 * i + 1.) / n);
    rule.weights.push_back(2. / n);
  }
  return rule;
}

CeedInt cube_root(CeedInt per_cell, Placement placement) {
  const auto n = static_cast<CeedInt>(std::lround(std::cbrt(per_cell)));
  if (n < 1 || n * n * n != per_cell) {
    throw Error(std::to_string(per_cell) + " points a cell: placement " + std::string(name(placement)) +
                " needs a cube of a whole number (1, 8, 27, 64, 125, …)");
  }
  return n;
}

PointCloud tensor_points(CeedInt num_elem, const Rule &rule) {
  const std::size_t n = rule.points.size();
  PointCloud cloud;
  cloud.per_cell = static_cast<CeedInt>(n * n * n);
  for (CeedInt e = 0; e < num_elem; e++)
    for (std::size_t k = 0; k < n; k++)
      for (std::size_t j = 0; j < n; j++)
        for (std::size_t i = 0; i < n; i++) {
          cloud.coordinates.insert(cloud.coordinates.end(), {rule.points[i], rule.points[j], rule.points[k]});
          cloud.weights.push_back(rule.weights[i] * rule.weights[j] * rule.weights[k]);
        }
  return cloud;
}

/// A seed from the middle of a cell: the same cell has the same points however the mesh is numbered or divided.
std::uint64_t cell_seed(const Cells &cells, CeedInt e) {
  std::uint64_t seed = 20260722;
  for (int d = 0; d < 3; d++) {
    double sum = 0;
    for (int v = 0; v < 8; v++) sum += cells.coordinates[cells.vertex_offsets[8 * e + v] + d];
    seed = (seed ^ static_cast<std::uint64_t>(std::llround(sum * 1e8))) * 0x9E3779B97F4A7C15u;
    seed ^= seed >> 29;
  }
  return seed;
}

PointCloud random_points(const Cells &cells, CeedInt per_cell) {
  PointCloud cloud;
  cloud.per_cell = per_cell;
  cloud.weights.assign(static_cast<std::size_t>(cells.num_elem) * per_cell, 8. / per_cell);
  cloud.coordinates.reserve(3 * cloud.weights.size());
  for (CeedInt e = 0; e < cells.num_elem; e++) {
    std::mt19937_64 generator(cell_seed(cells, e));
    // 53 random bits: the same numbers from every standard library
    for (CeedInt i = 0; i < 3 * per_cell; i++)
      cloud.coordinates.push_back(-1 + std::ldexp(double(generator() >> 11), -52));
  }
  return cloud;
}

}  // namespace

std::optional<Placement> find_placement(std::string_view name) {
  for (const auto &[known, placement] : placements)
    if (known == name) return placement;
  return {};
}

std::string_view name(Placement placement) {
  for (const auto &[known, candidate] : placements)
    if (candidate == placement) return known;
  return "unknown";
}

void require_point_count(Placement placement, CeedInt per_cell) {
  if (placement == Placement::uniform || placement == Placement::gauss) cube_root(per_cell, placement);
  if (placement == Placement::random && per_cell < 1)
    throw Error(std::to_string(per_cell) + " points a cell: at least one is needed");
}

PointCloud place_points(const Cells &cells, const Problem &problem, CeedInt degree, Placement placement,
                        CeedInt per_cell) {
  require_point_count(placement, per_cell);
  switch (placement) {
    case Placement::uniform:
      return tensor_points(cells.num_elem, midpoint_rule(cube_root(per_cell, placement)));
    case Placement::gauss:
      return tensor_points(cells.num_elem, make_rule(cube_root(per_cell, placement), CeedGaussQuadrature));
    case Placement::quadrature:
      return tensor_points(
          cells.num_elem,
          make_rule(problem.q_1d(degree), problem.is_collocated ? CeedLobattoQuadrature : CeedGaussQuadrature));
    case Placement::random:
      break;
  }
  return random_points(cells, per_cell);
}

}  // namespace hg::bps
