// Projection of point fields to the mesh and back: exactness, conservation, bounds, ranks without points.
#include <gtest/gtest.h>

#include "operators/projection.hpp"
#include "operators_fixture.hpp"

namespace hg::test {
namespace {

struct Body {
  Body(PointPlacement placement, PetscInt per_cell, double end = 2.) {
    MeshOptions options;
    options.order = 2;
    options.deform = bend;
    mesh = box_mesh(ceed, "3,2,2", options);
    fillings = {{&find_material("elasticity-linear"), {.E = 1., .nu = 0.3, .rho = 1.}}};
    points = std::make_unique<Points>(*mesh, fillings, placement, per_cell,
                                      [end](const double *x) { return x[0] < end ? 0 : -1; });
    ops = std::make_unique<MpmOperators>(*mesh, fillings);
    ops->attach(*points->epoch, points->swarm);
  }
  /// Values of f at the points, num_comp each.
  std::vector<double> at_points(CeedInt num_comp, const std::function<double(const double *, int)> &f) const {
    const PointField<double> x(points->swarm, field::x);
    std::vector<double> values;
    for (std::size_t p = 0; p < x.size(); p += 3) {
      for (int c = 0; c < num_comp; c++) values.push_back(f(x.data() + p, c));
    }
    return values;
  }
  double integral(const std::vector<double> &values, CeedInt num_comp, int c) const {
    const PointField<double> V(points->swarm, field::V);
    double sum = 0.;
    for (std::size_t p = 0; p < V.size(); p++) sum += V[p] * values[p * num_comp + c];
    return sum_ranks(sum);
  }
  CeedHandle ceed = make_ceed();
  std::unique_ptr<Mesh> mesh;
  std::vector<RegionMaterial> fillings;
  std::unique_ptr<Points> points;
  std::unique_ptr<MpmOperators> ops;
};

double linear(const double *x, int c) {
  return 1. + c + x[0] - 2. * x[1] + 0.5 * (c + 1) * x[2];
}
double wavy(const double *x, int c) {
  return std::sin(5. * x[0] + c) * std::cos(3. * x[1] - x[2]);
}

TEST(Projection, ConsistentGivesBackWhatTheSpaceHolds) {
  for (CeedInt num_comp : {1, 3, 6}) {
    for (PetscInt order : {1, 2}) {
      SCOPED_TRACE(order);
      const Body body(PointPlacement::kCellRandom, 40);
      PointProjection projection(*body.mesh, order, ProjectionKind::consistent);
      projection.attach(body.ops->points());
      const auto values = body.at_points(num_comp, linear);
      const auto nodal = projection.to_mesh(values, num_comp);
      const std::vector<double> &x = body.mesh->node_coordinates(order);
      ASSERT_EQ(nodal.size(), x.size() / 3 * num_comp);
      for (std::size_t k = 0; k < nodal.size(); k++) {
        EXPECT_NEAR(nodal[k], linear(x.data() + 3 * (k / num_comp), static_cast<int>(k % num_comp)), 1e-8);
      }
      const auto back = projection.to_points(nodal, num_comp);
      ASSERT_EQ(back.size(), values.size());
      for (std::size_t k = 0; k < back.size(); k++) EXPECT_NEAR(back[k], values[k], 1e-8);
    }
  }
}

TEST(Projection, BothKeepTheIntegral) {
  for (const ProjectionKind kind : {ProjectionKind::lumped, ProjectionKind::consistent}) {
    const Body body(PointPlacement::kUniform, 27);
    PointProjection projection(*body.mesh, 1, kind);
    projection.attach(body.ops->points());
    const auto values = body.at_points(3, wavy);
    const auto nodal = projection.to_mesh(values, 3);
    const auto back = projection.to_points(nodal, 3);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(body.integral(back, 3, c), body.integral(values, 3, c), 1e-11);
  }
}

TEST(Projection, LumpedKeepsConstantsAndBounds) {
  const Body body(PointPlacement::kCellRandom, 5, 0.8);
  PointProjection projection(*body.mesh, 1, ProjectionKind::lumped);
  projection.attach(body.ops->points());
  const auto ones = projection.to_mesh(body.at_points(1, [](const double *, int) { return 1.; }), 1);
  const auto &volume = projection.node_volume();
  ASSERT_EQ(ones.size(), volume.size());
  for (std::size_t n = 0; n < ones.size(); n++) EXPECT_NEAR(ones[n], volume[n] > 0. ? 1. : 0., 1e-14);
  const auto values = body.at_points(1, wavy);
  double low = *std::min_element(values.begin(), values.end()), high = *std::max_element(values.begin(), values.end());
  MPI_Allreduce(MPI_IN_PLACE, &low, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &high, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  const auto nodal = projection.to_mesh(values, 1);
  for (std::size_t n = 0; n < nodal.size(); n++) {
    if (volume[n] == 0.) continue;
    EXPECT_GE(nodal[n], low - 1e-14);
    EXPECT_LE(nodal[n], high + 1e-14);
  }
}

// Points in a corner only: nodes without points give zero, and so does a rank without points; nothing hangs.
TEST(Projection, NodesWithoutPointsAreZero) {
  for (const ProjectionKind kind : {ProjectionKind::lumped, ProjectionKind::consistent}) {
    const Body body(PointPlacement::kGauss, 8, 0.3);
    PointProjection projection(*body.mesh, 1, kind);
    projection.attach(body.ops->points());
    const auto nodal = projection.to_mesh(body.at_points(1, [](const double *, int) { return 3.; }), 1);
    const std::vector<double> &x = body.mesh->node_coordinates(1);
    for (std::size_t n = 0; n < nodal.size(); n++) EXPECT_NEAR(nodal[n], x[3 * n] < 0.5 ? 3. : 0., 1e-9) << x[3 * n];
  }
}

TEST(Projection, LumpedAtHigherOrderIsRefused) {
  const Body body(PointPlacement::kGauss, 8);
  try {
    PointProjection(*body.mesh, 2, ProjectionKind::lumped);
    FAIL() << "no error";
  } catch (const Error &error) {
    EXPECT_NE(std::string(error.what()).find("order 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hg::test
