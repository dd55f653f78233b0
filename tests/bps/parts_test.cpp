/// @file
/// The parts that both bake-off programs share: boxes, points, work counts, lists of numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "ceed_handles.hpp"
#include "cells.hpp"
#include "number_list.hpp"
#include "points.hpp"
#include "problem.hpp"

namespace hg::bps {
namespace {

TEST(Problems, AreTheSixOfTheBakeOff) {
  ASSERT_EQ(all_problems().size(), 6u);
  for (const Problem &problem : all_problems()) EXPECT_EQ(find_problem(problem.name)->name, problem.name);
  EXPECT_EQ(find_problem("bp7"), nullptr);
  EXPECT_EQ(find_problem("bp1")->q_1d(3), 5);
  EXPECT_EQ(find_problem("bp6")->q_1d(3), 4);
  EXPECT_EQ(find_problem("bp5")->quad_mode(), CEED_GAUSS_LOBATTO);
  EXPECT_EQ(find_problem("bp4")->num_stored(), 6);
  EXPECT_EQ(find_problem("bp2")->num_stored(), 1);
}

/// Bytes for each DoF tend to 16 + 4 P³/p³ + 8 nq nd / DoFs, and flops for one cell follow the contraction formula.
TEST(Problems, CountTheirWork) {
  const Problem &bp3 = *find_problem("bp3");
  const Work work = work_at_quadrature(bp3, 1, 1000, 1331);
  EXPECT_DOUBLE_EQ(work.bytes, 16. * 1331 + 4. * 8 * 1000 + 8. * 6 * 27 * 1000);
  EXPECT_DOUBLE_EQ(work.held_bytes, work.bytes - 16. * 1331);
  // P = 2, Q = 3: a chain is 2 (8·3 + 4·9 + 2·27) = 228; three derivative sets, forward and transposed
  EXPECT_DOUBLE_EQ(work.flops, 1000 * (6 * 228. + 15 * 27));
  const Work at_points = work_at_points(*find_problem("bp2"), 2, 10, 1000, 270);
  EXPECT_DOUBLE_EQ(at_points.bytes, 16. * 1000 + 4. * 27 * 10 + 8. * 4 * 270);
  EXPECT_DOUBLE_EQ(at_points.held_bytes, at_points.bytes - 16. * 1000 + 4. * 270);
  EXPECT_DOUBLE_EQ(at_points.flops, 270 * (6 * 2. * (27 + 9 + 3) + 3));
}

TEST(Box, HasTheSizeThatWasAskedFor) {
  for (CeedInt degree = 1; degree <= 8; degree++)
    for (CeedInt num_comp : {1, 3})
      for (double dofs : {1e4, 1e5, 1e6}) {
        double got = num_comp;
        for (CeedInt n : box_for_dofs(dofs, degree, num_comp)) got *= n * degree + 1;
        EXPECT_NEAR(got / dofs, 1, dofs < 2e4 ? 0.35 : 0.15) << "p = " << degree << ", " << dofs << " DoFs";
      }
}

TEST(Box, NodesAreSharedAndTheBoundaryIsMasked) {
  const BoxMesh mesh({3, 2, 4}, 2, 3);
  const Cells cells = mesh.cells();
  EXPECT_EQ(cells.num_elem, 24);
  EXPECT_EQ(cells.num_dofs, 3 * 7 * 5 * 9);
  const std::set<CeedInt> nodes(cells.dof_offsets.begin(), cells.dof_offsets.end());
  EXPECT_EQ(static_cast<CeedSize>(nodes.size()), cells.num_dofs / 3) << "every node belongs to a cell";
  EXPECT_EQ(*nodes.rbegin(), cells.num_dofs - 3);
  const auto mask = mesh.interior_mask();
  EXPECT_EQ(std::accumulate(mask.begin(), mask.end(), 0.), 3 * 5 * 3 * 7);
}

TEST(Box, TheDeformationKeepsTheFacesAndIsNotTrivial) {
  for (double s : {0.1, 0.5, 0.7}) {
    EXPECT_NEAR(deform({0, s, 0.3})[0], 0, 1e-15);
    EXPECT_NEAR(deform({s, 1, 0.3})[1], 1, 1e-15);
    EXPECT_NEAR(deform({s, 0.2, 1})[2], 1, 1e-15);
  }
  EXPECT_GT(std::abs(deform({0.5, 0.5, 0.5})[0] - 0.5), 0.02);
}

class Points : public testing::TestWithParam<Placement> {};

TEST_P(Points, FillTheirCells) {
  const BoxMesh mesh({2, 3, 2}, 1, 1);
  const PointCloud cloud = place_points(mesh.cells(), *find_problem("bp5"), 2, GetParam(), 27);
  ASSERT_EQ(cloud.per_cell, 27);
  ASSERT_EQ(cloud.weights.size(), 27u * 12);
  ASSERT_EQ(cloud.coordinates.size(), 3 * cloud.weights.size());
  EXPECT_TRUE(std::ranges::all_of(cloud.coordinates, [](double x) { return -1 <= x && x <= 1; }));
  for (int cell = 0; cell < 12; cell++) {
    double volume = 0, first_moment = 0;
    for (int i = 27 * cell; i < 27 * (cell + 1); i++) {
      volume += cloud.weights[i];
      first_moment += cloud.weights[i] * cloud.coordinates[3 * i + 1];
    }
    EXPECT_NEAR(volume, 8, 1e-13);
    if (GetParam() != Placement::random) {
      EXPECT_NEAR(first_moment, 0, 1e-13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, Points,
                         testing::Values(Placement::uniform, Placement::gauss, Placement::random,
                                         Placement::quadrature),
                         [](const auto &info) { return std::string(name(info.param)); });

/// The points of a cell depend on where it is, not on its number: two cells exchanged take their points along.
TEST(Points, RandomOnesBelongToTheirCell) {
  const BoxMesh mesh({2, 1, 1}, 1, 1);
  Cells cells = mesh.cells();
  const Problem &problem = *find_problem("bp1");
  const PointCloud cloud = place_points(cells, problem, 1, Placement::random, 5);
  std::vector<CeedInt> exchanged(cells.vertex_offsets.begin() + 8, cells.vertex_offsets.end());
  exchanged.insert(exchanged.end(), cells.vertex_offsets.begin(), cells.vertex_offsets.begin() + 8);
  cells.vertex_offsets = exchanged;
  const PointCloud other = place_points(cells, problem, 1, Placement::random, 5);
  for (int i = 0; i < 15; i++) {
    EXPECT_EQ(cloud.coordinates[i], other.coordinates[15 + i]);
    EXPECT_NE(cloud.coordinates[i], cloud.coordinates[15 + i]);
  }
}

TEST(Points, RefuseACountThatIsNoCube) {
  EXPECT_THROW(require_point_count(Placement::uniform, 20), Error);
  EXPECT_THROW(require_point_count(Placement::gauss, 9), Error);
  EXPECT_THROW(require_point_count(Placement::random, 0), Error);
  EXPECT_NO_THROW(require_point_count(Placement::random, 20));
  EXPECT_NO_THROW(require_point_count(Placement::uniform, 125));
}

TEST(NumberLists, ReadRangesAndNameWhatIsBad) {
  EXPECT_EQ(parse_integers("--degree", "1-3,6", 1, 8), (std::vector<CeedInt>{1, 2, 3, 6}));
  EXPECT_EQ(parse_reals("--dofs", "1e4,20000", 8, 2e9), (std::vector<double>{1e4, 2e4}));
  for (const char *bad : {"", "0", "9", "3-1", "1,", "x", "1-", "-1", "1.5", "1-9", "2 3"}) {
    try {
      parse_integers("--degree", bad, 1, 8);
      ADD_FAILURE() << "'" << bad << "' was read";
    } catch (const Error &error) {
      EXPECT_NE(std::string(error.what()).find("--degree"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("1 to 8"), std::string::npos) << error.what();
    }
  }
  for (const char *bad : {"", "x", "1e", "7", "nan", "inf", "1e4,"})
    EXPECT_THROW(parse_reals("--dofs", bad, 8, 2e9), Error);
}

}  // namespace
}  // namespace hg::bps
