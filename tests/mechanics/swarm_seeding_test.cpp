// Seeding: the same points on every partition, with weights that integrate what they should.
#include <gtest/gtest.h>

#include "options/options.hpp"
#include "points_fixture.hpp"

namespace hg::test {
namespace {

std::unique_ptr<Mesh> make_mesh(MPI_Comm comm, Ceed ceed, void (*deform)(double *)) {
  ScopedOptions scoped{{"-dm_plex_box_faces", "4,3,5"}};
  MeshOptions options;
  if (deform) options.deform = deform;
  return std::make_unique<Mesh>(comm, ceed, options);
}

double integrate(const std::map<std::int64_t, PointRecord> &points, double (*f)(const double *)) {
  double sum = 0.0;
  for (const auto &[id, p] : points) sum += p.V * f(p.x);
  return sum;
}

struct SeedCase {
  const char *name;
  PointPlacement placement;
  PetscInt per_cell;
  void (*deform)(double *);
};

class Seeding : public testing::TestWithParam<SeedCase> {
 protected:
  CeedHandle ceed = make_ceed();
  SwarmOptions options{.points_per_cell = GetParam().per_cell, .placement = GetParam().placement};
};

INSTANTIATE_TEST_SUITE_P(Placements, Seeding,
                         testing::Values(SeedCase{"uniform_1", PointPlacement::kUniform, 1, nullptr},
                                         SeedCase{"uniform_27_bent", PointPlacement::kUniform, 27, bend_cube},
                                         SeedCase{"gauss_8", PointPlacement::kGauss, 8, nullptr},
                                         SeedCase{"gauss_64_bent", PointPlacement::kGauss, 64, bend_cube},
                                         SeedCase{"random_10", PointPlacement::kCellRandom, 10, nullptr},
                                         SeedCase{"random_5_bent", PointPlacement::kCellRandom, 5, bend_cube}),
                         [](const auto &info) { return std::string(info.param.name); });

TEST_P(Seeding, same_points_on_every_partition) {
  const PointsOnMesh spread(make_mesh(PETSC_COMM_WORLD, ceed, GetParam().deform), options);
  const PointsOnMesh alone(make_mesh(PETSC_COMM_SELF, ceed, GetParam().deform), options);
  const auto a = gather_points(spread), b = gather_points(alone);
  ASSERT_EQ(a.size(), 60u * GetParam().per_cell);
  ASSERT_EQ(a.size(), b.size());
  for (const auto &[id, p] : a) {
    ASSERT_TRUE(b.count(id)) << "id " << id;
    const PointRecord &q = b.at(id);
    EXPECT_EQ(id / GetParam().per_cell, p.cell_id);
    EXPECT_EQ(p.cell_id, q.cell_id);
    for (int d = 0; d < 3; d++) {
      EXPECT_EQ(p.x[d], q.x[d]);
      EXPECT_EQ(p.xi[d], q.xi[d]);
    }
    EXPECT_EQ(p.V, q.V);
  }
}

TEST_P(Seeding, fields_at_rest) {
  const PointsOnMesh points(make_mesh(PETSC_COMM_WORLD, ceed, GetParam().deform), options);
  EXPECT_EQ(points.swarm.global_size(), 60 * GetParam().per_cell);
  EXPECT_NEAR(points.swarm.total_mass(), 2.5, 1e-13);
  EXPECT_LE(largest_gap(points), 1e-15);
  const Swarm &s = points.swarm;
  const PointField<double> x(s, field::x), X0(s, field::X0), u(s, field::u), v(s, field::v), F(s, field::F);
  const PointField<double> V(s, field::V), V0(s, field::V0), moduli(s, field::material);
  const PointField<std::int32_t> region(s, field::region);
  for (PetscInt p = 0; p < s.local_size(); p++) {
    for (int d = 0; d < 3; d++) {
      ASSERT_EQ(x[3 * p + d], X0[3 * p + d]);
      ASSERT_EQ(u[3 * p + d], 0.0);
      ASSERT_EQ(v[3 * p + d], 0.0);
    }
    for (int d = 0; d < 9; d++) ASSERT_EQ(F[9 * p + d], d % 4 == 0 ? 1.0 : 0.0);
    ASSERT_EQ(V[p], V0[p]);
    ASSERT_GT(V[p], 0.0);
    ASSERT_EQ(moduli[2 * p], 3.0);
    ASSERT_EQ(moduli[2 * p + 1], 1.0);
    ASSERT_EQ(region[p], 0);
  }
}

TEST_P(Seeding, weights_sum_to_the_volume_and_are_equal_unless_gauss) {
  const PointsOnMesh points(make_mesh(PETSC_COMM_WORLD, ceed, GetParam().deform), options);
  const auto all = gather_points(points);
  EXPECT_NEAR(integrate(all, [](const double *) { return 1.0; }), 1.0, 1e-13);
  if (GetParam().placement != PointPlacement::kGauss) {
    std::map<std::int64_t, double> in_cell;
    for (const auto &[id, p] : all) {
      in_cell.emplace(p.cell_id, p.V);
      EXPECT_EQ(in_cell[p.cell_id], p.V);
    }
  } else {
    // n points integrate degree 2 n - 1 in each direction of a box, and nearly so in a bent cell.
    const double got = integrate(all, [](const double *x) { return x[0] * x[0] * x[0] * x[1] * x[1] * x[2]; });
    EXPECT_NEAR(got, 1.0 / 24, GetParam().deform ? 1e-9 : 1e-15);
  }
}

TEST(SeedingRegions, the_caller_chooses_where_points_are_and_what_they_are_made_of) {
  CeedHandle ceed = make_ceed();
  const auto material = [](std::int32_t, const double *x) -> PointMaterial {
    if (x[2] > 0.5) return {.region = -1};
    return x[0] < 0.5 ? PointMaterial{1, 10, 100, 50} : PointMaterial{2, 20, 200, 80};
  };
  const PointsOnMesh points(make_mesh(PETSC_COMM_WORLD, ceed, nullptr), {.points_per_cell = 8}, material);
  // 5 layers of 2 points in z: the lower 5 of 10 layers.
  EXPECT_EQ(points.swarm.global_size(), 240);
  EXPECT_NEAR(points.swarm.total_mass(), 0.25 * 10 + 0.25 * 20, 1e-13);
  const PointField<double> x(points.swarm, field::x), moduli(points.swarm, field::material);
  const PointField<std::int32_t> region(points.swarm, field::region);
  for (PetscInt p = 0; p < points.swarm.local_size(); p++) {
    EXPECT_LT(x[3 * p + 2], 0.5);
    EXPECT_EQ(region[p], x[3 * p] < 0.5 ? 1 : 2);
    EXPECT_EQ(moduli[2 * p], x[3 * p] < 0.5 ? 100 : 200);
  }
}

TEST(SeedingOptions, read_and_checked) {
  {
    ScopedOptions scoped{{"-mpm_num_points_per_cell", "64"},
                         {"-mpm_point_location_type", "gauss"},
                         {"-mpm_seed", "7"},
                         {"-mpm_point_outside", "project"}};
    const SwarmOptions o = SwarmOptions::read(PETSC_COMM_WORLD);
    EXPECT_EQ(o.points_per_cell, 64);
    EXPECT_EQ(o.placement, PointPlacement::kGauss);
    EXPECT_EQ(o.seed, 7);
    EXPECT_EQ(o.outside, OutsidePolicy::kProject);
  }
  const auto message = [](const char *count, const char *where) -> std::string {
    ScopedOptions scoped{{"-mpm_num_points_per_cell", count}, {"-mpm_point_location_type", where}};
    try {
      SwarmOptions::read(PETSC_COMM_WORLD);
    } catch (const Error &e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("10", "uniform").find("-mpm_num_points_per_cell 10: expected a cube"), std::string::npos);
  EXPECT_NE(message("10", "gauss").find("expected a cube"), std::string::npos);
  EXPECT_EQ(message("10", "cell_random"), "");
  EXPECT_NE(message("0", "cell_random").find("mpm_num_points_per_cell"), std::string::npos);
  EXPECT_NE(message("8", "nowhere").find("mpm_point_location_type"), std::string::npos);
}

TEST(SeedingTwice, is_refused) {
  CeedHandle ceed = make_ceed();
  PointsOnMesh points(make_mesh(PETSC_COMM_SELF, ceed, nullptr), {});
  EXPECT_THROW(seed_swarm(points.options, points.grid, points.locator, everywhere, points.swarm), Error);
}

TEST(PointFieldAccess, wrong_name_or_type_is_refused) {
  const Swarm swarm(PETSC_COMM_SELF);
  EXPECT_THROW(PointField<double>(swarm, "velocity"), Error);
  EXPECT_THROW(PointField<double>(swarm, field::id), Error);
  EXPECT_THROW(PointField<std::int64_t>(swarm, field::x), Error);
  EXPECT_THROW(PointField<std::int64_t>(swarm, field::cell), Error);
  EXPECT_EQ(PointField<std::int64_t>(swarm, field::id).size(), 0u);
}

}  // namespace
}  // namespace hg::test
