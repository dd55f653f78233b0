// The point epoch: sorting by cell, and the restriction at points.
#include <gtest/gtest.h>

#include <set>

#include "points_fixture.hpp"

namespace hg::test {
namespace {

std::vector<double> host_copy(CeedVector v) {
  CeedSize n;
  const CeedScalar *array;
  ceed_check(CeedVectorGetLength(v, &n));
  ceed_check(CeedVectorGetArrayRead(v, CEED_MEM_HOST, &array));
  std::vector<double> copy(array, array + n);
  ceed_check(CeedVectorRestoreArrayRead(v, &array));
  return copy;
}

/// A swarm with points in the given cells, ξ = (0.1, 0.2, 0.3) scaled by the point's number.
Swarm points_in(const std::vector<std::int32_t> &cells) {
  Swarm swarm(PETSC_COMM_SELF);
  swarm.resize(static_cast<PetscInt>(cells.size()));
  const PointField<std::int32_t> cell(swarm, field::cell);
  const PointField<double> xi(swarm, field::x_ref);
  for (std::size_t p = 0; p < cells.size(); p++) {
    cell[p] = cells[p];
    for (int d = 0; d < 3; d++) xi[3 * p + d] = 0.1 * (d + 1) / (1.0 + static_cast<double>(p));
  }
  return swarm;
}

struct EpochCase {
  const char *name;
  std::int32_t num_cells;
  std::vector<std::int32_t> cells;
};

class Epoch : public testing::TestWithParam<EpochCase> {
 protected:
  CeedHandle ceed = make_ceed();
  Swarm swarm = points_in(GetParam().cells);
  PointEpoch epoch{ceed, GetParam().num_cells, swarm};
};

std::vector<std::int32_t> scattered(int num_points, int num_cells) {
  Random random(5);
  std::vector<std::int32_t> cells;
  for (int p = 0; p < num_points; p++) cells.push_back(static_cast<std::int32_t>(random() * random() * num_cells));
  return cells;
}

std::vector<EpochCase> layouts() {
  return {{"ragged", 6, {5, 0, 2, 2, 0, 2, 5, 3}},
          {"all_in_one_cell", 4, {2, 2, 2, 2, 2}},
          {"no_points", 3, {}},
          {"many", 50, scattered(700, 50)}};
}
std::string layout_name(const testing::TestParamInfo<EpochCase> &info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Layouts, Epoch, testing::ValuesIn(layouts()), layout_name);
INSTANTIATE_TEST_SUITE_P(NoCells, Epoch, testing::Values(EpochCase{"no_cells", 0, {}}), layout_name);

class EpochRestriction : public Epoch {};
INSTANTIATE_TEST_SUITE_P(Layouts, EpochRestriction, testing::ValuesIn(layouts()), layout_name);

TEST_P(Epoch, sorts_by_cell_and_keeps_storage_order_within_a_cell) {
  const auto &cells = GetParam().cells;
  ASSERT_EQ(epoch.num_points(), static_cast<int>(cells.size()));
  ASSERT_EQ(epoch.starts().size(), GetParam().num_cells + 1u);
  ASSERT_EQ(epoch.order().size(), cells.size());
  EXPECT_EQ(epoch.starts().front(), 0);
  EXPECT_EQ(epoch.starts().back(), epoch.num_points());
  std::set<std::int32_t> seen;
  int most = 0, empty = 0;
  for (int c = 0; c < GetParam().num_cells; c++) {
    const int n = epoch.starts()[c + 1] - epoch.starts()[c];
    most = std::max(most, n);
    empty += n == 0;
    for (int i = epoch.starts()[c]; i < epoch.starts()[c + 1]; i++) {
      const int p = epoch.order()[i];
      EXPECT_EQ(cells[p], c);
      EXPECT_TRUE(seen.insert(p).second);
      if (i > epoch.starts()[c]) {
        EXPECT_LT(epoch.order()[i - 1], p);
      }
    }
  }
  EXPECT_EQ(epoch.max_points(), most);
  EXPECT_EQ(epoch.num_empty_cells(), empty);
}

TEST_P(Epoch, reference_coordinates_are_in_storage_order) {
  const PointField<double> xi(swarm, field::x_ref);
  const std::vector<double> got = host_copy(epoch.x_ref());
  EXPECT_EQ(got, std::vector<double>(xi.data(), xi.data() + xi.size()));
}

TEST_P(EpochRestriction, gathers_each_point_of_a_cell_and_its_transpose_scatters_back) {
  const auto n = static_cast<int>(GetParam().cells.size());
  for (const CeedInt num_comp : {1, 3, 9}) {
    std::vector<double> values(static_cast<std::size_t>(n) * num_comp);
    for (std::size_t i = 0; i < values.size(); i++) values[i] = 1.0 + static_cast<double>(i);
    const CeedVectorHandle l = epoch.vector(num_comp, values);
    const CeedElemRestriction rstr = epoch.points(num_comp);
    EXPECT_EQ(rstr, epoch.points(num_comp)) << "made once";
    CeedInt elements, points, most;
    ceed_check(CeedElemRestrictionGetNumElements(rstr, &elements));
    ceed_check(CeedElemRestrictionGetNumPoints(rstr, &points));
    ceed_check(CeedElemRestrictionGetMaxPointsInElement(rstr, &most));
    EXPECT_EQ(elements, GetParam().num_cells);
    EXPECT_EQ(points, n);
    EXPECT_EQ(most, epoch.max_points());
    CeedVectorHandle e, back;
    ceed_check(CeedElemRestrictionCreateVector(rstr, back.put(), e.put()));
    ceed_check(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
    // E-vector: cell by cell, component by component, point by point.
    const std::vector<double> got = host_copy(e);
    std::size_t at = 0;
    for (int c = 0; c < GetParam().num_cells; c++) {
      for (CeedInt comp = 0; comp < num_comp; comp++) {
        for (int i = epoch.starts()[c]; i < epoch.starts()[c + 1]; i++, at++) {
          ASSERT_EQ(got.at(at), values[static_cast<std::size_t>(epoch.order()[i]) * num_comp + comp]);
        }
      }
    }
    EXPECT_EQ(at, values.size());
    ceed_check(CeedVectorSetValue(back, 0.0));
    ceed_check(CeedElemRestrictionApply(rstr, CEED_TRANSPOSE, e, back, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(host_copy(back), values) << "every point is in one cell";
  }
}

TEST(EpochBad, unlocated_points_and_wrong_sizes_are_refused) {
  CeedHandle ceed = make_ceed();
  for (const std::int32_t bad : {-1, 4, 1000}) {
    const Swarm swarm = points_in({0, bad, 1});
    try {
      const PointEpoch epoch(ceed, 4, swarm);
      FAIL() << "cell " << bad << " was accepted";
    } catch (const Error &e) {
      EXPECT_NE(std::string(e.what()).find("in cell " + std::to_string(bad) + ", expected 0 to 3"), std::string::npos)
          << e.what();
    }
  }
  const Swarm swarm = points_in({0, 1});
  const PointEpoch epoch(ceed, 4, swarm);
  EXPECT_THROW(epoch.vector(3, std::vector<double>(5)), Error);
}

TEST(EpochLife, can_be_replaced_and_moved) {
  CeedHandle ceed = make_ceed();
  const Swarm first = points_in({0, 1, 1}), second = points_in({3, 2, 1, 0, 0});
  PointEpoch epoch(ceed, 4, first);
  epoch.points(3);
  epoch = PointEpoch(ceed, 4, second);
  EXPECT_EQ(epoch.num_points(), 5);
  CeedInt points;
  ceed_check(CeedElemRestrictionGetNumPoints(epoch.points(3), &points));
  EXPECT_EQ(points, 5);
  EXPECT_EQ(host_copy(epoch.x_ref()).size(), 15u);
}

}  // namespace
}  // namespace hg::test
