// Point location on one rank: the pure core, without PETSc objects.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "grids.hpp"
#include "swarm/locate.hpp"

namespace {
using namespace hg;

struct GridCase {
  const char *name;
  void (*map)(double *);
  bool affine;
  bool cube;  // the domain is the unit cube
};
std::ostream &operator<<(std::ostream &out, const GridCase &c) {
  return out << c.name;
}

class LocateCells : public testing::TestWithParam<GridCase> {
 protected:
  CellGrid grid = make_box_grid({5, 4, 6}, {0, 0, 0}, {1, 1, 1}, GetParam().map);
  HexLocator locator{grid};
};

INSTANTIATE_TEST_SUITE_P(Grids, LocateCells,
                         testing::Values(GridCase{"box", nullptr, true, true},
                                         GridCase{"parallelepiped", test::shear, true, false},
                                         GridCase{"bent", test::bend_cube, false, true},
                                         GridCase{"ring", test::ring, false, false}),
                         [](const auto &info) { return std::string(info.param.name); });

double gap(const HexLocator &locator, const Location &at, const double x[3]) {
  double y[3];
  locator.map(at.index, at.xi, y);
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

TEST_P(LocateCells, knows_which_cells_are_affine) {
  EXPECT_EQ(locator.num_affine(), GetParam().affine ? grid.num_cells() : 0);
}

TEST_P(LocateCells, walk_and_find_return_the_cell_and_coordinate_a_point_was_made_from) {
  test::Random random(1);
  for (int i = 0; i < 3000; i++) {
    const auto c = static_cast<std::int32_t>(random() * grid.num_cells());
    const auto start = static_cast<std::int32_t>(random() * grid.num_cells());
    double xi[3], x[3];
    for (double &t : xi) t = 0.9999 * (2.0 * random() - 1.0);
    locator.map(c, xi, x);
    std::vector<std::int32_t> cells{start, -1};
    std::vector<double> found(6), points{x[0], x[1], x[2], x[0], x[1], x[2]};
    std::vector<PointPlace> place(2);
    ASSERT_EQ(locator.locate(points, cells, found, place), 2u) << "from cell " << start << " to " << c;
    for (int k = 0; k < 2; k++) {
      ASSERT_EQ(place[k], PointPlace::kInside);
      ASSERT_EQ(cells[k], c);
      for (int d = 0; d < 3; d++) ASSERT_NEAR(found[3 * k + d], xi[d], 2e-13);
    }
  }
}

TEST_P(LocateCells, volume_is_the_integral_of_the_jacobian) {
  double total = 0.0;
  for (std::int32_t c = 0; c < grid.num_cells(); c++) {
    // 4-point Gauss along each axis, independent of the 2-point rule in the code.
    const double g[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
    const double w[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
    double volume = 0.0, J[9];
    for (int q = 0; q < 64; q++) {
      const double xi[3] = {g[q % 4], g[q / 4 % 4], g[q / 16]};
      volume += w[q % 4] * w[q / 4 % 4] * w[q / 16] * locator.jacobian(c, xi, J);
    }
    ASSERT_NEAR(locator.cell_volume(c), volume, 1e-14);
    total += volume;
  }
  if (GetParam().cube) {
    EXPECT_NEAR(total, 1.0, 1e-13);
  }
}

TEST_P(LocateCells, jacobian_is_the_derivative_of_the_map) {
  const double xi[3] = {0.3, -0.6, 0.8}, h = 1e-6;
  double J[9];
  const double det = locator.jacobian(17, xi, J);
  for (int j = 0; j < 3; j++) {
    double plus[3] = {xi[0], xi[1], xi[2]}, minus[3] = {xi[0], xi[1], xi[2]}, xp[3], xm[3];
    plus[j] += h;
    minus[j] -= h;
    locator.map(17, plus, xp);
    locator.map(17, minus, xm);
    for (int i = 0; i < 3; i++) EXPECT_NEAR(J[3 * i + j], (xp[i] - xm[i]) / (2 * h), 1e-9);
  }
  EXPECT_GT(std::abs(det), 0.0);
}

// A point on a face, an edge or a vertex touches 2, 4 or 8 cells: from each of them, and without a guess, the same
// cell.
TEST_P(LocateCells, owner_of_a_point_on_a_face_edge_or_vertex_does_not_depend_on_the_start) {
  const auto cell = [](int i, int j, int k) { return i + 5 * (j + 4 * k); };
  for (int on = 1; on < 8; on++) {  // bit d: the point is on the cell's upper face in direction d
    const int i = 2, j = 1, k = 3;
    double xi[3], x[3];
    for (int d = 0; d < 3; d++) xi[d] = on >> d & 1 ? 1.0 : 0.123 * (d + 1);
    locator.map(cell(i, j, k), xi, x);
    std::int32_t least = -1;
    std::vector<std::int32_t> touching;
    for (int s = 0; s < 8; s++) {
      if ((s & on) != s) continue;
      touching.push_back(cell(i + (s & 1), j + (s >> 1 & 1), k + (s >> 2 & 1)));
      if (least < 0 || cell_less(grid.cell_corners(touching.back()), grid.cell_corners(least))) least = touching.back();
    }
    ASSERT_EQ(touching.size(), 1u << __builtin_popcount(on));
    const Location found = locator.find(x);
    ASSERT_EQ(found.place, PointPlace::kInside);
    EXPECT_EQ(found.index, least);
    for (const std::int32_t start : touching) {
      const Location at = locator.walk(x, start);
      ASSERT_EQ(at.place, PointPlace::kInside);
      EXPECT_EQ(at.index, least) << "from cell " << start;
      EXPECT_LT(gap(locator, at, x), 1e-14);
    }
    for (const std::int32_t start : {0, grid.num_cells() - 1, cell(4, 0, 5)}) {
      std::vector<std::int32_t> cells{start};
      std::vector<double> far(3);
      std::vector<PointPlace> place(1);
      ASSERT_EQ(locator.locate(std::span<const double>(x, 3), cells, far, place), 1u);
      EXPECT_EQ(cells[0], least) << "from cell " << start;
    }
  }
}

TEST_P(LocateCells, points_on_the_domain_boundary_are_inside) {
  test::Random random(7);
  for (int i = 0; i < 200; i++) {
    const int d = i % 3, side = i / 3 % 2;
    const int n[3] = {5, 4, 6}, stride[3] = {1, 5, 20};
    int c = 0;
    double xi[3], x[3];
    for (int e = 0; e < 3; e++) {
      const int at = e == d ? side * (n[e] - 1) : static_cast<int>(random() * n[e]);
      c += at * stride[e];
      xi[e] = e == d ? 2.0 * side - 1.0 : 1.8 * random() - 0.9;
    }
    locator.map(c, xi, x);
    EXPECT_EQ(locator.find(x).index, c);
    const Location at = locator.walk(x, 60);
    ASSERT_EQ(at.place == PointPlace::kInside || GetParam().map == test::ring, true);
    if (at.place == PointPlace::kInside) {
      EXPECT_EQ(at.index, c);
    }
  }
}

TEST_P(LocateCells, points_outside_are_reported_outside) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const double far[][3] = {{-9, 0.5, 0.5},     {0.5, 9, 0.5}, {0.5, 0.5, -9},
                           {1e300, -1e300, 0}, {inf, 0, 0},   {0.5, nan, 0.5}};
  for (const auto &x : far) {
    std::vector<std::int32_t> cells{33, -1};
    std::vector<double> xi(6), points{x[0], x[1], x[2], x[0], x[1], x[2]};
    std::vector<PointPlace> place(2);
    EXPECT_EQ(locator.locate(points, cells, xi, place), 0u) << x[0] << " " << x[1] << " " << x[2];
    EXPECT_EQ(place[0], PointPlace::kOutside);
    EXPECT_EQ(place[1], PointPlace::kOutside);
  }
  // Just outside every face, by more than the tolerance.
  for (int c = 0; c < grid.num_cells(); c++) {
    for (int f = 0; f < 6; f++) {
      if (grid.neighbours[6 * c + f] != CellGrid::kBoundary || GetParam().map == test::ring) continue;
      double xi[3] = {0.1, -0.2, 0.3}, x[3];
      xi[f / 2] = (f % 2 ? 1.0 : -1.0) * (1.0 + 1e-8);
      locator.map(c, xi, x);
      EXPECT_EQ(locator.walk(x, c).place, PointPlace::kOutside) << "cell " << c << " face " << f;
      EXPECT_EQ(locator.find(x).place, PointPlace::kOutside) << "cell " << c << " face " << f;
    }
  }
}

// The closest point of the domain is known where the domain is the unit cube.
class LocateNearest : public LocateCells {};
INSTANTIATE_TEST_SUITE_P(Cubes, LocateNearest,
                         testing::Values(GridCase{"box", nullptr, true, true},
                                         GridCase{"bent", test::bend_cube, false, true}),
                         [](const auto &info) { return std::string(info.param.name); });

TEST_P(LocateNearest, nearest_is_the_closest_point_of_the_mesh) {
  test::Random random(3);
  for (int i = 0; i < 50; i++) {
    double x[3], expected = 0.0;
    for (int d = 0; d < 3; d++) {
      x[d] = 2.0 * random() - 0.5;
      const double out = std::max({-x[d], x[d] - 1.0, 0.0});
      expected += out * out;
    }
    Location where;
    const double distance = locator.nearest(x, where);
    ASSERT_EQ(where.place, PointPlace::kInside);
    double y[3];
    locator.map(where.index, where.xi, y);
    EXPECT_NEAR(std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]), distance, 1e-14);
    // On the box the clamp is the projection; bent cells give a point of the mesh that is not far from it.
    if (GetParam().affine) {
      EXPECT_NEAR(distance, std::sqrt(expected), 1e-12);
    } else {
      EXPECT_GE(distance, std::sqrt(expected) - 1e-12);
      EXPECT_LE(distance, std::sqrt(expected) + 0.15);
    }
  }
}

// On the three-quarter ring straight walks end at the inner boundary: locate() must fall back on the hash grid.
TEST(LocateConcave, walk_that_meets_the_boundary_is_found_by_the_hash_grid) {
  const CellGrid grid = make_box_grid({24, 3, 2}, {0, 0, 0}, {1, 1, 1}, test::ring);
  const HexLocator locator(grid);
  std::size_t stopped = 0;
  for (std::int32_t c = 0; c < grid.num_cells(); c++) {
    const double xi[3] = {0.2, -0.3, 0.4};
    double x[3];
    locator.map(c, xi, x);
    stopped += locator.walk(x, 0).place == PointPlace::kOutside;
    std::vector<std::int32_t> cells{0};
    std::vector<double> found(3);
    std::vector<PointPlace> place(1);
    ASSERT_EQ(locator.locate(std::span<const double>(x, 3), cells, found, place), 1u);
    EXPECT_EQ(cells[0], c);
  }
  EXPECT_GT(stopped, 0u) << "the test does not reach what it is for";
}

// Irregular vertices: the three cells around the middle edge of a hexagon, in every cell numbering.
TEST(LocateIrregular, owner_does_not_depend_on_the_numbering) {
  const double s = std::sqrt(3.0) / 2.0;
  const double ring[6][2] = {{1, 0}, {0.5, s}, {-0.5, s}, {-1, 0}, {-0.5, -s}, {0.5, -s}};
  std::vector<std::array<double, 24>> hexes;
  for (int q = 0; q < 3; q++) {  // quads (centre, a, b, c) with b opposite the centre
    const double *a = ring[2 * q], *b = ring[(2 * q + 1) % 6], *c = ring[(2 * q + 2) % 6];
    std::array<double, 24> x{};
    for (int k = 0; k < 2; k++) {
      const double corner[4][2] = {{0, 0}, {a[0], a[1]}, {c[0], c[1]}, {b[0], b[1]}};
      for (int v = 0; v < 4; v++) {
        x[3 * (v + 4 * k)] = corner[v][0];
        x[3 * (v + 4 * k) + 1] = corner[v][1];
        x[3 * (v + 4 * k) + 2] = k;
      }
    }
    hexes.push_back(x);
  }
  std::vector<int> order{0, 1, 2};
  std::map<int, std::array<double, 24>> owner;  // by point on the shared edge and on the shared faces
  do {
    CellGrid grid;
    for (const int q : order) grid.corners.insert(grid.corners.end(), hexes[q].begin(), hexes[q].end());
    grid.neighbours.assign(18, CellGrid::kBoundary);
    const auto place_of = [&](int q) {
      return static_cast<std::int32_t>(std::find(order.begin(), order.end(), q % 3) - order.begin());
    };
    for (int q = 0; q < 3; q++) {  // face ξ1 = -1 holds (centre, a), face ξ0 = -1 holds (centre, c = a of the next)
      grid.neighbours[6 * place_of(q) + 2] = place_of(q + 2);
      grid.neighbours[6 * place_of(q) + 0] = place_of(q + 1);
    }
    const HexLocator locator(grid);
    for (int p = 0; p < 4; p++) {
      double x[3] = {0, 0, 0.4};
      if (p < 3) {
        x[0] = 0.3 * ring[2 * p][0];
        x[1] = 0.3 * ring[2 * p][1];
      }
      const Location found = locator.find(x);
      ASSERT_EQ(found.place, PointPlace::kInside);
      std::array<double, 24> corners;
      std::copy_n(grid.cell_corners(found.index).begin(), 24, corners.begin());
      if (!owner.count(p)) owner[p] = corners;
      EXPECT_EQ(owner[p], corners) << "point " << p;
      for (std::int32_t start = 0; start < 3; start++) {
        EXPECT_EQ(locator.walk(x, start).index, found.index) << "point " << p << " from " << start;
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(LocateBad, inverted_and_flat_cells_are_refused_by_name) {
  CellGrid grid = make_box_grid({3, 1, 1}, {0, 0, 0}, {3, 1, 1});
  CellGrid inverted = grid;
  for (int b = 0; b < 4; b++)
    std::swap_ranges(&inverted.corners[24 + 6 * b], &inverted.corners[24 + 6 * b + 3],
                     &inverted.corners[24 + 6 * b + 3]);
  try {
    HexLocator locator(inverted);
    FAIL() << "an inverted cell was accepted";
  } catch (const std::invalid_argument &e) {
    EXPECT_NE(std::string(e.what()).find("mesh cell 1 is inverted or flat"), std::string::npos) << e.what();
  }
  CellGrid flat = grid;
  for (int b = 0; b < 8; b++) flat.corners[48 + 3 * b + 2] = 0.0;
  try {
    HexLocator locator(flat);
    FAIL() << "a flat cell was accepted";
  } catch (const std::invalid_argument &e) {
    EXPECT_NE(std::string(e.what()).find("mesh cell 2"), std::string::npos) << e.what();
  }
}

TEST(LocateRemote, walk_stops_at_a_rank_border_and_ties_look_across_it) {
  // Cells 1 and 2 of a row of four; 0 and 3 are on other ranks.
  const CellGrid all = make_box_grid({4, 1, 1}, {0, 0, 0}, {4, 1, 1});
  CellGrid grid;
  grid.corners.assign(all.corners.begin() + 24, all.corners.begin() + 72);
  grid.neighbours.assign(12, CellGrid::kBoundary);
  grid.neighbours[1] = 1;
  grid.neighbours[6] = 0;
  for (const int side : {0, 1}) {
    CellGrid::RemoteFace face;
    face.rank = 5 + side;
    face.cell = 11 * side;
    std::copy_n(all.corners.begin() + 72 * side, 24, face.corners.begin());
    grid.remote.push_back(face);
    grid.neighbours[side ? 7 : 0] = CellGrid::remote_link(side);
  }
  const HexLocator locator(grid);
  const auto at = [&](double x, int start) {
    const double p[3] = {x, 0.5, 0.5};
    return locator.walk(p, start);
  };
  EXPECT_EQ(at(0.5, 1).place, PointPlace::kRemote);
  EXPECT_EQ(at(0.5, 1).index, 0);
  EXPECT_EQ(at(3.5, 0).place, PointPlace::kRemote);
  EXPECT_EQ(at(3.5, 0).index, 1);
  EXPECT_EQ(at(9.5, 0).place, PointPlace::kRemote) << "outside too, but that is for the other rank to say";
  EXPECT_EQ(at(2.5, 0).place, PointPlace::kInside);
  // On the border x = 1 cell 0 is smaller: the other rank owns; on x = 3 cell 2 is smaller: this rank does.
  EXPECT_EQ(at(1.0, 0).place, PointPlace::kRemote);
  EXPECT_EQ(at(3.0, 0).place, PointPlace::kInside);
  EXPECT_EQ(at(3.0, 0).index, 1);
}

}  // namespace
