// Points moving over cells and ranks: each is found where a run on one rank finds it.
#include <gtest/gtest.h>

#include "points_fixture.hpp"

namespace hg::test {
namespace {

enum class Kind { kBox, kBent, kRotated };

std::unique_ptr<Mesh> make_mesh(MPI_Comm comm, Ceed ceed, Kind kind) {
  MeshOptions options;
  if (kind == Kind::kRotated) {
    const std::string file =
        write_rotated_gmsh("migrate_points_np" + std::to_string(ranks()) + ".msh", 4);  // collective on the world
    ScopedOptions scoped{{"-dm_plex_filename", file}};
    return std::make_unique<Mesh>(comm, ceed, options);
  }
  if (kind == Kind::kBent) options.deform = bend_cube;
  ScopedOptions scoped{{"-dm_plex_box_faces", "6,5,4"}};
  return std::make_unique<Mesh>(comm, ceed, options);
}

// A swirl that stays in the unit cube and crosses several cells.
void swirl(const double *x, double *d) {
  const double bump = 2.0 * x[0] * (1 - x[0]) * x[1] * (1 - x[1]) * x[2] * (1 - x[2]) * 8;
  d[0] = bump * (0.5 - x[1]);
  d[1] = bump * (x[0] - 0.5);
  d[2] = 0.3 * bump * (0.5 - x[2]);
}

class Migrate : public testing::TestWithParam<Kind> {
 protected:
  CeedHandle ceed = make_ceed();
};

std::string kind_name(const testing::TestParamInfo<Kind> &info) {
  const char *names[] = {"box", "bent", "rotated_frames"};
  return names[static_cast<int>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Meshes, Migrate, testing::Values(Kind::kBox, Kind::kBent, Kind::kRotated), kind_name);

void expect_same(const PointsOnMesh &a, const PointsOnMesh &b) {
  const auto pa = gather_points(a), pb = gather_points(b);
  ASSERT_EQ(pa.size(), pb.size());
  for (const auto &[id, p] : pa) {
    ASSERT_TRUE(pb.count(id));
    const PointRecord &q = pb.at(id);
    ASSERT_EQ(p.cell_id, q.cell_id) << "point " << id << " at " << p.x[0] << " " << p.x[1] << " " << p.x[2];
    for (int d = 0; d < 3; d++) {
      ASSERT_EQ(p.x[d], q.x[d]);
      ASSERT_NEAR(p.xi[d], q.xi[d], 1e-13);
    }
    ASSERT_EQ(p.mass, q.mass);
  }
}

TEST_P(Migrate, points_end_in_the_cells_that_one_rank_finds) {
  PointsOnMesh spread(make_mesh(PETSC_COMM_WORLD, ceed, GetParam()), {.points_per_cell = 27});
  PointsOnMesh alone(make_mesh(PETSC_COMM_SELF, ceed, GetParam()), {.points_per_cell = 27});
  const PetscInt count = spread.swarm.global_size();
  const double mass = spread.swarm.total_mass();
  PetscInt moved = 0;
  for (int step = 0; step < 4; step++) {
    spread.displace(swirl);
    alone.displace(swirl);
    const MigrateStats stats = spread.locate();
    const MigrateStats none = alone.locate();
    moved += stats.moved;
    EXPECT_EQ(none.moved, 0);
    EXPECT_EQ(stats.removed + stats.projected + none.removed + none.projected, 0);
    EXPECT_EQ(spread.swarm.global_size(), count);
    EXPECT_NEAR(spread.swarm.total_mass(), mass, 1e-13);
    EXPECT_LT(largest_gap(spread), 1e-14);
    expect_same(spread, alone);
  }
  if (ranks() > 1) {
    EXPECT_GT(moved, 0) << "no point crossed a border: the test tests nothing";
  }
}

// Uniform points moved by the right fraction of a cell lie on faces, edges and vertices, all of them at once.
TEST_P(Migrate, points_on_faces_edges_and_vertices_have_the_same_owner_on_every_partition) {
  PointsOnMesh spread(make_mesh(PETSC_COMM_WORLD, ceed, GetParam()), {.points_per_cell = 8});
  PointsOnMesh alone(make_mesh(PETSC_COMM_SELF, ceed, GetParam()), {.points_per_cell = 8});
  for (PointsOnMesh *points : {&spread, &alone}) {
    const PointField<double> x(points->swarm, field::x), xi(points->swarm, field::x_ref);
    const PointField<std::int32_t> cell(points->swarm, field::cell);
    const PointField<std::int64_t> id(points->swarm, field::id);
    for (PetscInt p = 0; p < points->swarm.local_size(); p++) {
      double to[3];
      // Bits of the id choose the directions in which the point goes to the face it is nearer to.
      for (int d = 0; d < 3; d++)
        to[d] = (id[p] * 2654435761 >> (7 + d) & 1) ? std::copysign(1.0, xi[3 * p + d]) : 0.25;
      points->locator.map(cell[p], to, &x[3 * p]);
    }
  }
  // A place on a face computed from either side differs by rounding; what must agree is the owner of the same x.
  const auto places = [&](PointsOnMesh &points) {
    std::map<std::int64_t, std::array<double, 3>> all;
    for (const auto &[id, r] : gather_points(points)) all[id] = {r.x[0], r.x[1], r.x[2]};
    return all;
  };
  const auto from = places(spread);
  {
    const PointField<double> x(alone.swarm, field::x);
    const PointField<std::int64_t> id(alone.swarm, field::id);
    for (PetscInt p = 0; p < alone.swarm.local_size(); p++) std::copy_n(from.at(id[p]).begin(), 3, &x[3 * p]);
  }
  spread.locate();
  alone.locate();
  EXPECT_LT(largest_gap(spread), 1e-14);
  expect_same(spread, alone);
}

TEST_P(Migrate, all_points_in_one_cell_and_ranks_without_points) {
  PointsOnMesh points(make_mesh(PETSC_COMM_WORLD, ceed, GetParam()), {.points_per_cell = 8});
  const PetscInt count = points.swarm.global_size();
  const double mass = points.swarm.total_mass();
  points.displace([](const double *x, double *d) {
    for (int k = 0; k < 3; k++) d[k] = 0.93 + 0.001 * x[k] - x[k];
  });
  points.locate();
  const PetscInt here = points.swarm.local_size();
  EXPECT_TRUE(here == 0 || here == count);
  EXPECT_EQ(points.swarm.global_size(), count);
  EXPECT_NEAR(points.swarm.total_mass(), mass, 1e-13);
  const PointEpoch epoch(ceed, points.mesh->num_cells, points.swarm);
  EXPECT_EQ(epoch.max_points(), here);
  EXPECT_EQ(epoch.num_empty_cells(), points.mesh->num_cells - (here > 0));
  // And out again, to where they were seeded.
  {
    const PointField<double> x(points.swarm, field::x), X0(points.swarm, field::X0);
    std::copy(X0.data(), X0.data() + X0.size(), x.data());
  }
  points.locate();
  EXPECT_LT(largest_gap(points), 1e-14);
  for (const auto &[id, p] : gather_points(points)) EXPECT_EQ(p.cell_id, id / 8);
}

TEST_P(Migrate, same_answer_twice_bitwise) {
  std::vector<double> first;
  for (int run = 0; run < 2; run++) {
    PointsOnMesh points(make_mesh(PETSC_COMM_WORLD, ceed, GetParam()), {.points_per_cell = 8});
    for (int step = 0; step < 3; step++) {
      points.displace(swirl);
      points.locate();
    }
    const PointField<double> x(points.swarm, field::x);
    if (run == 0) {
      first.assign(x.data(), x.data() + x.size());
    } else {
      EXPECT_EQ(first, std::vector<double>(x.data(), x.data() + x.size())) << "storage order or values differ";
    }
  }
}

class Outside : public testing::Test {
 protected:
  CeedHandle ceed = make_ceed();
  PointsOnMesh make(OutsidePolicy policy) {
    return PointsOnMesh(make_mesh(PETSC_COMM_WORLD, ceed, Kind::kBox), {.points_per_cell = 8, .outside = policy});
  }
  // The layer of points nearest to x = 1 (120 / 6 cells × 4 points) leaves.
  static void leave(const double *x, double *d) {
    if (x[0] > 1 - 1.0 / 18) d[0] = 0.5;
  }
};

TEST_F(Outside, error_names_the_point_on_every_rank) {
  PointsOnMesh points = make(OutsidePolicy::kError);
  points.displace(leave);
  try {
    points.locate();
    FAIL() << "points outside were accepted";
  } catch (const Error &e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("80 points are outside the mesh: point "), std::string::npos) << text;
    EXPECT_NE(text.find("at (1.4"), std::string::npos) << text;
    EXPECT_NE(text.find("nearest cell "), std::string::npos) << text;
    EXPECT_NE(text.find("at distance 0.4"), std::string::npos) << text;
  }
}

TEST_F(Outside, one_point_with_nan_is_an_error_under_every_policy) {
  for (const OutsidePolicy policy : {OutsidePolicy::kError, OutsidePolicy::kProject, OutsidePolicy::kRemove}) {
    PointsOnMesh points = make(policy);
    {
      const PointField<double> x(points.swarm, field::x);
      const PointField<std::int64_t> id(points.swarm, field::id);
      for (PetscInt p = 0; p < points.swarm.local_size(); p++) {
        if (id[p] == 123) x[3 * p + 1] = std::nan("");
      }
    }
    try {
      points.locate();
      FAIL() << "a point at NaN was accepted";
    } catch (const Error &e) {
      EXPECT_NE(std::string(e.what()).find("1 point is outside the mesh: point 123 "), std::string::npos) << e.what();
    }
  }
}

TEST_F(Outside, project_moves_points_back_to_the_boundary) {
  PointsOnMesh points = make(OutsidePolicy::kProject);
  points.displace(leave);
  const MigrateStats stats = points.locate();
  EXPECT_EQ(stats.projected, 80);
  EXPECT_EQ(points.swarm.global_size(), 960);
  EXPECT_LT(largest_gap(points), 1e-14);
  const PointField<double> x(points.swarm, field::x), X0(points.swarm, field::X0), u(points.swarm, field::u);
  PetscInt on_boundary = 0, all = 0;
  for (std::size_t i = 0; i < x.size(); i++) EXPECT_EQ(u[i], x[i] - X0[i]);
  for (PetscInt p = 0; p < points.swarm.local_size(); p++) on_boundary += std::abs(x[3 * p] - 1.0) < 1e-14;
  MPI_Allreduce(&on_boundary, &all, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_EQ(all, 80);
}

TEST_F(Outside, remove_takes_points_and_mass_off) {
  PointsOnMesh points = make(OutsidePolicy::kRemove);
  const double mass = points.swarm.total_mass();
  points.displace(leave);
  const MigrateStats stats = points.locate();
  EXPECT_EQ(stats.removed, 80);
  EXPECT_NEAR(stats.removed_mass, mass / 12, 1e-13);
  EXPECT_EQ(points.swarm.global_size(), 880);
  EXPECT_NEAR(points.swarm.total_mass(), mass * 11 / 12, 1e-13);
  EXPECT_LT(largest_gap(points), 1e-14);
  for (const auto &[id, p] : gather_points(points)) EXPECT_LT(p.x[0], 1 - 1.0 / 18);
}

// Three quarters of a ring: straight walks end at the inner wall, whatever the partition.
TEST(MigrateConcave, points_beyond_a_wall_are_found) {
  CeedHandle ceed = make_ceed();
  MeshOptions options;
  options.deform = ring;
  ScopedOptions scoped{{"-dm_plex_box_faces", "24,3,2"}};
  PointsOnMesh points(std::make_unique<Mesh>(PETSC_COMM_WORLD, ceed, options), {.points_per_cell = 8});
  PointsOnMesh alone(std::make_unique<Mesh>(PETSC_COMM_SELF, ceed, options), {.points_per_cell = 8});
  for (PointsOnMesh *p : {&points, &alone}) {  // every point jumps to the mirrored angle
    p->displace([](const double *x, double *d) {
      // angle a from the y axis becomes 270° - a: (sin, cos) -> (-cos, -sin).
      d[0] = -x[1] - x[0];
      d[1] = -x[0] - x[1];
    });
    p->locate();
  }
  EXPECT_LT(largest_gap(points), 1e-13);
  expect_same(points, alone);
}

TEST(MigrateGrid, faces_between_ranks_are_paired) {
  CeedHandle ceed = make_ceed();
  for (const Kind kind : {Kind::kBox, Kind::kRotated}) {
    const auto mesh = make_mesh(PETSC_COMM_WORLD, ceed, kind);
    const CellGrid grid = build_cell_grid(*mesh);
    long outer = 0, borders = 0, all[2];
    for (std::size_t i = 0; i < grid.neighbours.size(); i++) {
      const auto cell = static_cast<std::int32_t>(i / 6);
      const int f = static_cast<int>(i % 6);
      const std::int32_t n = grid.neighbours[i];
      double centre[3] = {0, 0, 0};
      for (int b = 0; b < 8; b++) {
        if ((b >> (f / 2) & 1) != f % 2) continue;
        for (int d = 0; d < 3; d++) centre[d] += grid.cell_corners(cell)[3 * b + d] / 4;
      }
      const bool on_cube = std::any_of(centre, centre + 3, [](double t) { return t == 0.0 || t == 1.0; });
      ASSERT_EQ(n == CellGrid::kBoundary, on_cube);
      outer += n == CellGrid::kBoundary;
      if (n >= 0) {
        // The neighbour sees this cell across one of its faces.
        int back = 0;
        for (int g = 0; g < 6; g++) back += grid.neighbours[6 * static_cast<std::size_t>(n) + g] == cell;
        ASSERT_EQ(back, 1);
      } else if (n != CellGrid::kBoundary) {
        borders++;
        const CellGrid::RemoteFace &face = grid.remote.at(CellGrid::remote_index(n));
        ASSERT_NE(face.rank, my_rank());
        int shared = 0;  // the two cells have four vertices in common
        for (int a = 0; a < 8; a++) {
          for (int b = 0; b < 8; b++)
            shared += std::equal(&face.corners[3 * a], &face.corners[3 * a] + 3, &grid.cell_corners(cell)[3 * b]);
        }
        ASSERT_EQ(shared, 4);
      }
    }
    const long mine[2] = {outer, borders};
    MPI_Allreduce(mine, all, 2, MPI_LONG, MPI_SUM, PETSC_COMM_WORLD);
    EXPECT_EQ(all[0], kind == Kind::kBox ? 2 * (30 + 24 + 20) : 96);
    EXPECT_EQ(all[1] % 2, 0);
    EXPECT_EQ(all[1] > 0, ranks() > 1);
  }
}

}  // namespace
}  // namespace hg::test
