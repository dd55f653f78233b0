// Dirichlet conditions: which entries are constrained, on any number of ranks, and their values over time.
#include <gtest/gtest.h>

#include <set>

#include "boundary/boundary.hpp"
#include "mesh_fixture.hpp"

namespace hg::test {
namespace {

using V = std::array<double, 3>;

PetscInt global_size(const Mesh &mesh) {
  VecHandle global;
  PetscInt size;
  petsc_check(DMCreateGlobalVector(mesh.dm, global.put()));
  petsc_check(VecGetSize(global, &size));
  return size;
}

TEST(Boundary, ClampedFacesLeaveTheSystem) {
  CeedHandle ceed = make_ceed();
  ScopedOptions options{{"-bc_clamp", "1,2,3,4,5,6"}};
  for (PetscInt p : {1, 2, 3}) {
    auto mesh = box_mesh(ceed, "3,3,3", {.order = p});
    BoundaryConditions boundary(*mesh, PETSC_COMM_WORLD);
    const PetscInt inner = 3 * p - 1;
    EXPECT_EQ(global_size(*mesh), 3 * inner * inner * inner);
  }
}

TEST(Boundary, SlipTakesOnlyItsComponents) {
  CeedHandle ceed = make_ceed();
  ScopedOptions options{{"-bc_slip", "6"}, {"-bc_slip_6_components", "0,2"}, {"-bc_slip_6_translate", "0.5,-0.25"}};
  auto mesh = box_mesh(ceed, "2,3,2", {.order = 2});
  BoundaryConditions boundary(*mesh, PETSC_COMM_WORLD);
  EXPECT_EQ(global_size(*mesh), 3 * 5 * 7 * 5 - 2 * 7 * 5);
  std::vector<double> local(mesh->local_size, 9.);
  boundary.insert(0.5, 0, 0, local);
  const auto &at = mesh->node_coordinates(2);
  for (PetscInt i = 0; i < mesh->local_size; ++i) {
    const bool on_face = at[3 * (i / 3)] < 1e-12;
    const double expected = !on_face || i % 3 == 1 ? 9. : i % 3 == 0 ? 0.25 : -0.125;
    ASSERT_DOUBLE_EQ(local[i], expected);
  }
}

TEST(Boundary, EveryRankKnowsTheConstraintsOfItsNodes) {
  CeedHandle ceed = make_ceed();
  ScopedOptions options{{"-bc_clamp", "1"}};
  auto mesh = gmsh_mesh(ceed, write_rotated_gmsh("boundary_ranks.msh", 4), {.order = 3});
  BoundaryConditions boundary(*mesh, PETSC_COMM_WORLD);
  const auto &at = mesh->node_coordinates(3);
  std::size_t on_face = 0;
  for (std::size_t node = 0; node < at.size() / 3; ++node) on_face += at[3 * node + 2] < 1e-12;
  EXPECT_EQ(boundary.entries().size(), 3 * on_face);
}

TEST(Boundary, RotationIsRigid) {
  BoundaryFace face;
  face.components = {true, true, true};
  face.times = {2};
  face.rotate = {{0, 0, 2, M_PI / 2, 0}};
  const double x[3] = {1, 2, 3};
  const V quarter = face.value(2, x);
  EXPECT_NEAR(quarter[0], -3, 1e-14);
  EXPECT_NEAR(quarter[1], -1, 1e-14);
  EXPECT_NEAR(quarter[2], 0, 1e-14);
  // Half way the angle, not the displacement, is half: distances from the axis stay.
  const V half = face.value(1, x);
  EXPECT_NEAR(std::hypot(x[0] + half[0], x[1] + half[1]), std::hypot(1, 2), 1e-14);
  EXPECT_GT(std::abs(half[0] - quarter[0] / 2), 0.1);
}

TEST(Boundary, TwistGrowsAlongTheAxis) {
  BoundaryFace face;
  face.times = {1};
  face.rotate = {{0, 0, 1, 0, M_PI}};
  const double low[3] = {1, 0, 0}, high[3] = {1, 0, 0.5};
  EXPECT_NEAR(face.value(1, low)[0], 0, 1e-14);
  EXPECT_NEAR(face.value(1, high)[0], -1, 1e-14);
  EXPECT_NEAR(face.value(1, high)[1], 1, 1e-14);
}

TEST(Boundary, IncrementsOfTranslationsAddUp) {
  CeedHandle ceed = make_ceed();
  ScopedOptions options{
      {"-bc_clamp", "5"}, {"-bc_clamp_5_translate", "0.1,0,0,0.3,0.1,0"}, {"-bc_clamp_5_times", "0.5,1"}};
  auto mesh = box_mesh(ceed, "2,2,2", {});
  BoundaryConditions boundary(*mesh, PETSC_COMM_WORLD);
  std::vector<double> total(mesh->local_size, 0.), sum(mesh->local_size, 0.), part(mesh->local_size, 0.);
  boundary.insert(1, 0, 0, total);
  for (int k = 0; k < 4; ++k) {
    boundary.insert(0.25 * (k + 1), 0.25 * k, 1, part);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
  }
  double largest = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(sum[i], total[i], 1e-14);
    largest = std::max(largest, std::abs(total[i]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  EXPECT_NEAR(largest, 0.3, 1e-14);
}

// A piece of a face that turns, twists and moves, followed from where it is at each time, ends where the whole motion
// puts it; and the increment of a rigid turn is a rigid turn of whatever lies at x now.
TEST(Boundary, IncrementsFollowARotation) {
  BoundaryFace face;
  face.times = {0.5, 1};
  face.translate = {{0.1, 0, 0.2}, {0.3, 0.1, -0.4}};
  face.rotate = {{1, 2, 3, 0.4, 0.3}, {1, 2, 3, 1.1, -0.2}};
  const std::array<double, 3> start{0.3, -0.7, 0.5};
  const auto whole = face.value(1, start);
  std::array<double, 3> x = start;
  for (int k = 0; k < 8; ++k) {
    const auto step = face.increment(0.125 * k, 0.125 * (k + 1), x);
    for (int c = 0; c < 3; ++c) x[c] += step[c];
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(x[c], start[c] + whole[c], 1e-14);

  face.times = {1};
  face.translate.clear();
  face.rotate = {{0, 0, 1, M_PI_2, 0}};
  const double e_x[3] = {1, 0, 0};
  const auto turn = face.increment(2. / 3, 1, e_x);  // the last 30°, of what lies on the x axis then
  EXPECT_NEAR(turn[0], std::cos(M_PI / 6) - 1, 1e-14);
  EXPECT_NEAR(turn[1], std::sin(M_PI / 6), 1e-14);
  EXPECT_NEAR(turn[2], 0, 1e-14);
}

TEST(Boundary, WhatCannotBeMeantIsNamed) {
  CeedHandle ceed = make_ceed();
  const auto message = [&](std::initializer_list<std::pair<std::string, std::string>> pairs) -> std::string {
    ScopedOptions options(pairs);
    auto mesh = box_mesh(ceed, "1,1,1", {});
    try {
      BoundaryConditions boundary(*mesh, PETSC_COMM_WORLD);
    } catch (const Error &error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message({{"-bc_clamp", "7"}}).find("face 7"), std::string::npos);
  EXPECT_NE(message({{"-bc_slip", "1"}}).find("-bc_slip_1_components is missing"), std::string::npos);
  EXPECT_NE(message({{"-bc_slip", "1"}, {"-bc_slip_1_components", "3"}}).find("expected 0, 1 or 2"), std::string::npos);
  EXPECT_NE(message({{"-bc_clamp", "1"}, {"-bc_clamp_1_translate", "1,2"}}).find("-bc_clamp_1_translate: 2 numbers"),
            std::string::npos);
  EXPECT_NE(message({{"-bc_clamp", "1"}, {"-bc_clamp_1_translate", "1,2,3"}, {"-bc_clamp_1_times", "1,2"}})
                .find("1 values for 2 times"),
            std::string::npos);
  EXPECT_NE(message({{"-bc_clamp", "1"}, {"-bc_clamp_1_rotate", "0,0,0,1,0"}}).find("axis is zero"), std::string::npos);
}

}  // namespace
}  // namespace hg::test
