// Operators of FEM and MPM through the C interface: derivatives, symmetry, patch tests, rigid motions, loads, updates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "operators_fixture.hpp"

namespace hg::test {
namespace {

const ElasticParameters soft{.E = 2., .nu = 0.3, .rho = 1.5}, stiff{.E = 7., .nu = 0.2, .rho = 4.};

/// What the operators stand on; the operators themselves are in `ops`.
struct Case {
  std::string name;
  PetscInt order = 1;
  bool points = false;
  PointPlacement placement = PointPlacement::kGauss;
  PetscInt per_cell = 8;
  bool bent = true;
  bool history = false;     ///< points start with a random F_n
  bool two_regions = true;  ///< the half x < 1/2 is stiff
  bool hole = false;        ///< cells without points: x > 2/3
};

std::ostream &operator<<(std::ostream &out, const Case &c) {
  return out << c.name;
}

struct Body {
  /// With `other`, the body stands on the other's mesh, so that local arrays of both can be compared.
  Body(const Case &which, const Material &soft_material, const Material &stiff_material, const Body *other = nullptr) {
    if (other) {
      ceed = other->ceed;
      mesh = other->mesh;
    } else {
      ceed = std::make_shared<CeedHandle>(make_ceed());
      MeshOptions options;
      options.order = which.order;
      if (which.bent) options.deform = bend;
      mesh = box_mesh(*ceed, "3,2,2", options);
    }
    fillings = {{&stiff_material, stiff}, {&soft_material, soft}};
    if (!which.two_regions) fillings.erase(fillings.begin());
    const auto choose = [which](const double *x) {
      if (which.hole && x[0] > 2. / 3.) return -1;
      return which.two_regions && x[0] > 0.5 ? 1 : 0;
    };
    if (which.points) {
      auto mpm = std::make_unique<MpmOperators>(*mesh, fillings);
      points = std::make_unique<Points>(*mesh, fillings, which.placement, which.per_cell, choose);
      if (which.history) give_history(points->swarm, 0.1, 5);
      mpm->attach(*points->epoch, points->swarm);
      ops = std::move(mpm);
    } else {
      regions.resize(fillings.size());
      if (which.two_regions) regions[0].box = std::array<double, 6>{-1., -1., -1., 0.5, 2., 2.};
      map = std::make_unique<RegionMap>(*mesh, regions);
      ops = std::make_unique<FemOperators>(*mesh, *map, fillings);
    }
  }
  std::vector<double> residual(const std::vector<double> &u) const { return apply(*mesh, ops->residual(), u); }
  std::vector<double> jacobian(const std::vector<double> &u) const { return apply(*mesh, ops->jacobian(), u); }
  RegionIntegrals totals(const std::vector<double> &u) const {
    RegionIntegrals sum;
    for (const RegionIntegrals &part : ops->integrals(vector(u))) {
      sum.volume += part.volume;
      sum.mass += part.mass;
      sum.strain_energy += part.strain_energy;
      for (int c = 0; c < 3; c++) sum.mass_displacement[c] += part.mass_displacement[c];
    }
    sum.volume = sum_ranks(sum.volume);
    sum.mass = sum_ranks(sum.mass);
    sum.strain_energy = sum_ranks(sum.strain_energy);
    for (double &value : sum.mass_displacement) value = sum_ranks(value);
    return sum;
  }
  MpmOperators &mpm() { return dynamic_cast<MpmOperators &>(*ops); }

  CeedVectorHandle vector(const std::vector<double> &values) const { return make_vector(*ceed, values); }
  CeedVectorHandle empty() const {
    CeedVectorHandle v;
    ceed_check(CeedVectorCreate(*ceed, mesh->local_size, v.put()));
    return v;
  }

  std::shared_ptr<CeedHandle> ceed;
  std::shared_ptr<Mesh> mesh;
  std::vector<RegionMaterial> fillings;
  std::vector<Region> regions;
  std::unique_ptr<RegionMap> map;
  std::unique_ptr<Points> points;
  std::unique_ptr<SolidOperators> ops;
};

const Material &linear = find_material("elasticity-linear");
const Material &initial = find_material("elasticity-neo-hookean-initial");
const Material &current = find_material("elasticity-neo-hookean-current");

const Case fem_1{.name = "fem_order1"}, fem_2{.name = "fem_order2", .order = 2};
const Case gauss_1{.name = "points_gauss_order1", .points = true};
const Case gauss_2{.name = "points_gauss_order2", .order = 2, .points = true, .per_cell = 27};
const Case random_2{.name = "points_random_order2",
                    .order = 2,
                    .points = true,
                    .placement = PointPlacement::kCellRandom,
                    .per_cell = 30,
                    .history = true};
const Case hole_1{
    .name = "points_hole_order1", .points = true, .placement = PointPlacement::kUniform, .history = true, .hole = true};

class EveryBody : public testing::TestWithParam<std::tuple<Case, const Material *>> {
 protected:
  Case which = std::get<0>(GetParam());
  const Material &material = *std::get<1>(GetParam());
  bool objective() const { return &material != &linear; }
};

TEST_P(EveryBody, ResidualIsTheDerivativeOfTheEnergy) {
  const Body body(which, material, material);
  const auto u = wave(*body.mesh, 0.03, 0.), delta = wave(*body.mesh, 0.03, 1.);
  const double slope = pair(body.residual(u), delta), energy = body.totals(u).strain_energy;
  double remainder[3];
  for (int k = 0; k < 3; k++) {
    const double h = 1. / (1 << k);
    remainder[k] = std::abs(body.totals(plus(u, h, delta)).strain_energy - energy - h * slope);
  }
  EXPECT_GT(energy, 0.);
  for (int k = 0; k < 2; k++) EXPECT_NEAR(std::log2(remainder[k] / remainder[k + 1]), 2., 0.1);
}

TEST_P(EveryBody, JacobianIsTheDerivativeOfTheResidual) {
  const Body body(which, material, material);
  const auto u = wave(*body.mesh, 0.03, 0.), delta = wave(*body.mesh, 0.03, 1.);
  const auto base = body.residual(u);
  body.residual(plus(u, 0.3, delta));  // leaves the linearisation elsewhere
  body.ops->linearize(body.vector(u));
  const auto slope = body.jacobian(delta);
  double remainder[3];
  for (int k = 0; k < 3; k++) {
    const double h = 1. / (1 << k);
    const auto left = plus(body.residual(plus(u, h, delta)), -1., plus(base, h, slope));
    remainder[k] = std::sqrt(sum_ranks(dot(left, left)));
  }
  if (objective()) {
    for (int k = 0; k < 2; k++) EXPECT_NEAR(std::log2(remainder[k] / remainder[k + 1]), 2., 0.15);
  } else {
    EXPECT_LT(remainder[0], 1e-13 * std::sqrt(sum_ranks(dot(base, base))));
  }
}

TEST_P(EveryBody, JacobianIsSymmetric) {
  const Body body(which, material, material);
  body.ops->linearize(body.vector(wave(*body.mesh, 0.03, 0.)));
  const auto a = wave(*body.mesh, 1., 2.), b = wave(*body.mesh, 1., 3.);
  const double ab = pair(body.jacobian(a), b), ba = pair(body.jacobian(b), a);
  EXPECT_NEAR(ab, ba, 1e-12 * std::abs(ab));
  EXPECT_GT(pair(body.jacobian(a), a), 0.);
}

// Internal forces do no work on a translation, nor, at equilibrium of moments, on a small rotation of the deformed
// body.
TEST_P(EveryBody, InternalForcesBalance) {
  const Body body(which, material, material);
  const auto u = wave(*body.mesh, 0.05, 0.);
  const auto r = body.residual(u);
  const double scale = std::sqrt(sum_ranks(dot(r, r)));
  ASSERT_GT(scale, 1e-3);
  for (int c = 0; c < 3; c++) {
    const auto translation =
        at_nodes(*body.mesh, [c](const double *, double *v) { v[0] = v[1] = v[2] = 0., v[c] = 1.; });
    EXPECT_NEAR(pair(r, translation), 0., 1e-12 * scale);
    if (!objective()) continue;
    // v = e_c × (x + u)
    auto y = at_nodes(*body.mesh, [](const double *x, double *v) { std::copy(x, x + 3, v); });
    y = plus(y, 1., u);
    std::vector<double> rotation(y.size(), 0.);
    for (std::size_t n = 0; n < y.size(); n += 3) {
      rotation[n + (c + 1) % 3] = -y[n + (c + 2) % 3];
      rotation[n + (c + 2) % 3] = y[n + (c + 1) % 3];
    }
    EXPECT_NEAR(pair(r, rotation), 0., 1e-12 * scale);
  }
}

TEST_P(EveryBody, RigidMotionsGiveNoForce) {
  if (which.history) GTEST_SKIP() << "points with a random history are stressed at rest";
  const Body body(which, material, material);
  const Tensor R = objective() ? Random(8).rotation() : Tensor{1, 1e-9, 2e-9, -1e-9, 1, 3e-9, -2e-9, -3e-9, 1};
  const auto u = at_nodes(*body.mesh, [&](const double *x, double *v) {
    for (int i = 0; i < 3; i++) v[i] = R[3 * i] * x[0] + R[3 * i + 1] * x[1] + R[3 * i + 2] * x[2] - x[i] + 0.4 * i;
  });
  for (double force : body.residual(u)) EXPECT_NEAR(force, 0., 1e-13);
  const RegionIntegrals totals = body.totals(u);
  EXPECT_NEAR(totals.strain_energy, 0., 1e-13);
  // of fields that are zero, nothing: not even rounding
  for (double force : body.residual(std::vector<double>(u.size(), 0.))) EXPECT_EQ(force, 0.);
}

TEST_P(EveryBody, LoadAndIntegrals) {
  const Body body(which, material, material);
  const auto u = wave(*body.mesh, 0.03, 0.);
  const RegionIntegrals totals = body.totals(u);
  if (!which.history) {
    EXPECT_NEAR(body.totals(std::vector<double>(u.size(), 0.)).volume, 1., 1e-13);
  }
  const CeedVectorHandle f = body.empty();
  for (const std::array<double, 3> g : {std::array<double, 3>{0., 0., -9.81}, std::array<double, 3>{1., -2., 3.}}) {
    body.ops->body_force(g, f);
    const auto force = to_host(f);
    for (int c = 0; c < 3; c++) {
      const auto unit = at_nodes(*body.mesh, [c](const double *, double *v) { v[0] = v[1] = v[2] = 0., v[c] = 1.; });
      EXPECT_NEAR(pair(force, unit), totals.mass * g[c], 1e-12 * totals.mass * 10.);
    }
    // its work on u is g · ∫ρ u
    double work = 0.;
    for (int c = 0; c < 3; c++) work += g[c] * totals.mass_displacement[c];
    EXPECT_NEAR(pair(force, u), work, 1e-12 * std::abs(work));
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, EveryBody,
                         testing::Combine(testing::Values(fem_1, fem_2, gauss_1, gauss_2, random_2, hole_1),
                                          testing::ValuesIn(materials().begin(), materials().end())),
                         [](const auto &info) {
                           std::string name = std::get<0>(info.param).name + "_";
                           name += std::get<1>(info.param)->name;
                           for (char &c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

// Two materials in one body are one composite: the same tests hold, and each region has its own share of the energy.
TEST(Composite, TwoMaterials) {
  for (const Case &which : {fem_2, gauss_2, random_2}) {
    SCOPED_TRACE(which.name);
    const Body body(which, current, linear);
    const auto u = wave(*body.mesh, 0.03, 0.), delta = wave(*body.mesh, 0.03, 1.);
    const auto base = body.residual(u), slope = body.jacobian(delta);
    double remainder[2];
    for (int k = 0; k < 2; k++) {
      const double h = 1. / (1 << k);
      const auto left = plus(body.residual(plus(u, h, delta)), -1., plus(base, h, slope));
      remainder[k] = std::sqrt(sum_ranks(dot(left, left)));
    }
    EXPECT_NEAR(std::log2(remainder[0] / remainder[1]), 2., 0.15);
    double energy = 0.;
    for (const RegionIntegrals &part : body.ops->integrals(body.vector(u))) energy += part.strain_energy;
    EXPECT_GT(sum_ranks(energy), 0.);
    const Body one(which, linear, linear, &body);
    const auto ones = one.ops->integrals(one.vector(u)), twos = body.ops->integrals(body.vector(u));
    EXPECT_NEAR(sum_ranks(ones[0].strain_energy), sum_ranks(twos[0].strain_energy), 1e-13)
        << "the region of the same material has the same energy";
    EXPECT_GT(std::abs(sum_ranks(ones[1].strain_energy - twos[1].strain_energy)), 1e-6);
    EXPECT_NEAR(sum_ranks(ones[0].mass), sum_ranks(twos[0].mass), 1e-13);
  }
}

// Points at Gauss locations with V = w det J and no history are a quadrature rule: MPM is FEM, to rounding.
TEST(Methods, PointsAtGaussLocationsAreFem) {
  for (PetscInt order : {1, 2, 3}) {
    Case fem{.name = "", .order = order, .two_regions = false}, mpm = fem;
    mpm.points = true;
    mpm.per_cell = (order + 1) * (order + 1) * (order + 1);
    for (const Material *material : materials()) {
      const Body a(fem, *material, *material), b(mpm, *material, *material, &a);
      const auto u = wave(*a.mesh, 0.03, 0.), delta = wave(*a.mesh, 1., 1.);
      const auto ra = a.residual(u), rb = b.residual(u), ja = a.jacobian(delta), jb = b.jacobian(delta);
      EXPECT_LT(distance(ra, rb), 1e-12 * std::max(norm(ra), 1e-3));
      EXPECT_LT(distance(ja, jb), 1e-12 * std::max(norm(ja), 1e-3));
      EXPECT_NEAR(a.totals(u).strain_energy, b.totals(u).strain_energy, 1e-13);
    }
  }
}

std::vector<double> linear_field(const Mesh &mesh) {
  const Tensor A = Random(11).near_identity(0.1);
  return at_nodes(mesh, [A](const double *x, double *v) {
    for (int i = 0; i < 3; i++) v[i] = A[3 * i] * x[0] + A[3 * i + 1] * x[1] + A[3 * i + 2] * x[2] - x[i];
  });
}

// u = A x: no force at inner nodes. Exact on bent cells at every order for FEM and for Gauss points. Uniform points of
// equal weight are exact on straight cells: there what they leave of ∫ ∂N/∂x at order 2 cancels between neighbours.
TEST(Patch, LinearDisplacement) {
  std::vector<Case> patches;
  for (PetscInt order : {1, 2, 3}) {
    const PetscInt per_cell = (order + 1) * (order + 1) * (order + 1);
    patches.push_back({.name = "fem", .order = order, .two_regions = false});
    patches.push_back({.name = "gauss", .order = order, .points = true, .per_cell = per_cell, .two_regions = false});
    for (PetscInt n : {1, 2, 3}) {
      if (order == 3 || (order == 2 && n == 1)) continue;
      patches.push_back({.name = "uniform " + std::to_string(n),
                         .order = order,
                         .points = true,
                         .placement = PointPlacement::kUniform,
                         .per_cell = n * n * n,
                         .bent = false,
                         .two_regions = false});
    }
  }
  for (const Case &patch : patches) {
    for (const Material *material : materials()) {
      SCOPED_TRACE(patch.name + " order " + std::to_string(patch.order) + " " + std::string(material->name));
      const Body body(patch, *material, *material);
      const auto r = body.residual(linear_field(*body.mesh));
      ASSERT_GT(std::sqrt(sum_ranks(dot(r, r))), 1e-3) << "the boundary must carry the load";
      EXPECT_LT(inner_maximum(*body.mesh, r), 1e-14);
    }
  }
}

// The plain rule's error in ∫ ∂N/∂x falls with the square of the distance between points. On straight cells it shows in
// the forces on the boundary, at order 2; at order 1 it is zero.
TEST(Patch, DefectOfUniformPointsFallsAtRateTwo) {
  for (PetscInt order : {1, 2}) {
    SCOPED_TRACE("order " + std::to_string(order));
    double defect[3];
    for (int k = 0; k < 3; k++) {
      const PetscInt n = 2 << k;
      const Case exact{.name = "", .order = order, .bent = false, .two_regions = false};
      Case plain = exact;
      plain.points = true, plain.placement = PointPlacement::kUniform, plain.per_cell = n * n * n;
      const Body fem(exact, current, current), body(plain, current, current, &fem);
      const auto u = linear_field(*body.mesh);
      const auto error = plus(body.residual(u), -1., fem.residual(u));
      defect[k] = std::sqrt(sum_ranks(dot(error, error)));
      if (order == 1) {
        EXPECT_LT(defect[k], 1e-13);
      }
    }
    if (order == 1) continue;
    for (int k = 0; k < 2; k++) EXPECT_NEAR(std::log2(defect[k] / defect[k + 1]), 2., 0.2) << defect[k];
  }
}

TEST(PointUpdate, LinearFieldsAreExactAndEnergyIsCarriedOver) {
  for (const Case &which : {gauss_2, random_2, hole_1}) {
    SCOPED_TRACE(which.name);
    Body body(which, current, current);
    Swarm &swarm = body.points->swarm;
    const auto copy = [&](const char *name) {
      const PointField<double> field(swarm, name);
      return std::vector<double>(field.span().begin(), field.span().end());
    };
    const auto x = copy(field::x), F = copy(field::F), V = copy(field::V), u = copy(field::u);
    // small enough to stay in the cells, so that the epoch's places can be used again for the energy
    const Tensor A{1 + 1e-3, 2e-4, -3e-4, 1e-4, 1 - 5e-4, 2e-4, 3e-4, -2e-4, 1 + 7e-4};
    const auto delta = at_nodes(*body.mesh, [&](const double *p, double *v) {
      for (int i = 0; i < 3; i++) v[i] = A[3 * i] * p[0] + A[3 * i + 1] * p[1] + A[3 * i + 2] * p[2] - p[i] + 0.01 * i;
    });
    const CeedVectorHandle delta_u = body.vector(delta);
    const RegionIntegrals before = body.totals(delta);
    const auto diagnostics = body.mpm().point_diagnostics(delta_u);
    body.mpm().update_points(delta_u, 0.5, swarm);
    const auto x_new = copy(field::x), F_new = copy(field::F), V_new = copy(field::V), u_new = copy(field::u);
    const auto v_new = copy(field::v);
    for (std::size_t p = 0; p < V.size(); p++) {
      Tensor F_p;
      std::copy_n(F.data() + 9 * p, 9, F_p.begin());
      const Tensor expected = multiply(A, F_p);
      for (int c = 0; c < 9; c++) EXPECT_NEAR(F_new[9 * p + c], expected[c], 1e-13);
      EXPECT_NEAR(V_new[p], determinant(A) * V[p], 1e-14);
      for (int c = 0; c < 3; c++) {
        const double *at = x.data() + 3 * p;
        const double d = A[3 * c] * at[0] + A[3 * c + 1] * at[1] + A[3 * c + 2] * at[2] - at[c] + 0.01 * c;
        EXPECT_NEAR(x_new[3 * p + c], at[c] + d, 1e-14);
        EXPECT_NEAR(u_new[3 * p + c], u[3 * p + c] + d, 1e-14);
        EXPECT_NEAR(v_new[3 * p + c], d / 0.5, 1e-13);
      }
    }
    // the same state, now as history: the energy and the stress of no increment
    body.mpm().attach(*body.points->epoch, swarm);
    const std::vector<double> zero(delta.size(), 0.);
    const RegionIntegrals after = body.totals(zero);
    EXPECT_NEAR(after.strain_energy, before.strain_energy, 1e-13);
    EXPECT_NEAR(after.mass, before.mass, 1e-13);
    EXPECT_NEAR(after.volume, before.volume, 1e-13);
    const auto carried = body.mpm().point_diagnostics(body.vector(zero));
    EXPECT_LT(distance(diagnostics, carried), 1e-11 * std::max(1., norm(diagnostics)));
  }
}

TEST(PointUpdate, AnInvertedPointStopsItAndLeavesTheSwarm) {
  int size;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (size > 1) GTEST_SKIP() << "one rank is enough";
  Body body(gauss_1, current, current);
  const auto flip = at_nodes(*body.mesh, [](const double *x, double *v) { v[0] = -2. * x[0], v[1] = v[2] = 0.; });
  const PointField<double> F(body.points->swarm, field::F);
  const std::vector<double> before(F.span().begin(), F.span().end());
  try {
    body.mpm().update_points(body.vector(flip), 1., body.points->swarm);
    FAIL() << "no error";
  } catch (const Error &error) {
    EXPECT_NE(std::string(error.what()).find("inverted point"), std::string::npos) << error.what();
  }
  EXPECT_EQ(before, std::vector<double>(F.span().begin(), F.span().end()));
  const auto r = body.residual(flip);
  EXPECT_FALSE(std::isfinite(norm(r))) << "and the solver sees it in the residual";
}

TEST(Points, NoneAtAllGiveZero) {
  Case which = gauss_1;
  which.hole = true;
  Body body(which, current, linear);
  Points none(*body.mesh, body.fillings, PointPlacement::kGauss, 8, [](const double *) { return -1; });
  body.mpm().attach(*none.epoch, none.swarm);
  const auto u = wave(*body.mesh, 0.1, 0.);
  for (double force : body.residual(u)) EXPECT_EQ(force, 0.);
  for (double force : body.jacobian(u)) EXPECT_EQ(force, 0.);
  CeedVectorHandle f = body.vector(u);
  body.ops->body_force({1., 1., 1.}, f);
  for (double force : to_host(f)) EXPECT_EQ(force, 0.);
  body.mpm().update_points(body.vector(u), 1., none.swarm);
  EXPECT_EQ(body.totals(u).mass, 0.);
  EXPECT_TRUE(body.mpm().point_diagnostics(body.vector(u)).empty());
}

// The void is linear elasticity with the softest region's moduli times a factor, in cells that are less than half full.
TEST(Void, SupportsCellsByHowMuchTheyHaveLost) {
  const double stiffness = 0.02;
  for (const auto &[filled, factor] : {std::pair(0., 1.), std::pair(1. / 3., 1. / 3.), std::pair(2. / 3., 0.)}) {
    // Of the third layer of cells, 2/3 < x < 1, the points fill this part.
    const double end = 2. / 3. + filled / 3.;
    const Body body({.name = "box", .order = 2, .bent = false}, current, linear);
    const Points points(*body.mesh, body.fillings, PointPlacement::kUniform, 27,
                        [end](const double *x) { return x[0] > end ? -1 : x[0] > 0.5; });
    MpmOperators plain(*body.mesh, body.fillings), held(*body.mesh, body.fillings, stiffness);
    plain.attach(*points.epoch, points.swarm);
    held.attach(*points.epoch, points.swarm);
    EXPECT_EQ(std::ranges::count(held.active_cells(), 1), body.mesh->num_cells);
    EXPECT_EQ(sum_ranks(std::ranges::count(plain.active_cells(), 1)), filled > 0. ? 12. : 8.);

    const Tensor H = Random(17).near_identity(0.1);
    const auto u = at_nodes(*body.mesh, [&](const double *x, double *v) {
      for (int i = 0; i < 3; i++) v[i] = 0.1 * (H[3 * i] * x[0] + H[3 * i + 1] * x[1] + H[3 * i + 2] * x[2]) + 0.3;
    });
    double trace = 0., square = 0.;
    for (int i = 0; i < 3; i++) {
      trace += 0.1 * H[4 * i];
      for (int j = 0; j < 3; j++) square += std::pow(0.05 * (H[3 * i + j] + H[3 * j + i]), 2);
    }
    const double twice_energy =
        factor * stiffness / 3. * (2. * soft.shear_modulus() * square + soft.lame_lambda() * trace * trace);
    for (const bool linearised : {false, true}) {
      if (linearised) {
        plain.linearize(body.vector(u));
        held.linearize(body.vector(u));
      }
      const auto force = plus(apply(*body.mesh, linearised ? held.jacobian() : held.residual(), u), -1.,
                              apply(*body.mesh, linearised ? plain.jacobian() : plain.residual(), u));
      EXPECT_NEAR(pair(force, u), twice_energy, 1e-13) << filled;
      const auto along = at_nodes(*body.mesh, [](const double *, double *v) { v[0] = 1., v[1] = 2., v[2] = -1.; });
      EXPECT_NEAR(pair(force, along), 0., 1e-14);
    }
    // It has no mass and takes no load.
    const CeedVectorHandle with = body.empty(), without = body.empty();
    held.body_force({1., 2., 3.}, with);
    plain.body_force({1., 2., 3.}, without);
    EXPECT_EQ(to_host(with), to_host(without));
    EXPECT_EQ(held.integrals(body.vector(u))[1].strain_energy, plain.integrals(body.vector(u))[1].strain_energy);
  }
}

// ∫|u_mms|² with u = 0, and the interpolated solution, which is closer the finer the space.
TEST(Mms, ErrorOfInterpolantAndResidualOfForce) {
  double previous = 1.;
  for (PetscInt order : {1, 2, 3, 4}) {
    const Case which{.name = "", .order = order, .two_regions = false};
    const Body body(which, linear, linear);
    const double amplitude = 1e-3;
    const auto exact = at_nodes(*body.mesh, [&](const double *x, double *u) {
      const double s = -std::cos(2 * M_PI * x[0]) * std::cos(2 * M_PI * x[1]) * std::cos(2 * M_PI * x[2]);
      for (int c = 0; c < 3; c++) u[c] = (c + 1) * amplitude * s;
    });
    const double error = std::sqrt(sum_ranks(body.ops->mms_error_squared(amplitude, body.vector(exact))));
    EXPECT_LT(error, 0.75 * previous);
    const double on_mesh = std::sqrt(sum_ranks(body.ops->mms_error_squared_on_mesh(amplitude, body.vector(exact))));
    EXPECT_NEAR(on_mesh, error, 1e-12 * error) << "FEM's own points are those of the mesh";
    previous = error;
    // residual(u_mms) balances the force up to the interpolation error
    const CeedVectorHandle f = body.empty();
    body.ops->mms_force(amplitude, f);
    const double force = inner_maximum(*body.mesh, to_host(f));
    const double unbalanced = inner_maximum(*body.mesh, plus(body.residual(exact), -1., to_host(f)));
    if (order == 4) {
      EXPECT_LT(error, 0.02 * 1.3229e-3);
      EXPECT_LT(unbalanced, 0.05 * force);
    }
    const std::vector<double> zero(exact.size(), 0.);
    if (order == 4) {
      EXPECT_NEAR(std::sqrt(sum_ranks(body.ops->mms_error_squared(amplitude, body.vector(zero)))),
                  amplitude * std::sqrt(14. / 8.), 2e-5);
    }
  }
}

TEST(Diagnostics, CellAveragesOfALinearField) {
  const Case which{.name = "", .order = 2};
  Body body(which, current, initial);
  const auto u = at_nodes(*body.mesh, [](const double *x, double *v) { v[0] = 0.2 * x[0], v[1] = v[2] = 0.; });
  const auto cells = dynamic_cast<FemOperators &>(*body.ops).cell_diagnostics(body.vector(u));
  ASSERT_EQ(cells.size(), static_cast<std::size_t>(body.mesh->num_cells) * num_diagnostic);
  for (CeedInt c = 0; c < body.mesh->num_cells; c++) {
    const ElasticParameters &p = body.fillings[body.map->of_cell(c)].parameters;
    const double *d = cells.data() + static_cast<std::size_t>(c) * num_diagnostic;
    EXPECT_NEAR(d[0], (p.shear_modulus() + 0.5 * p.lame_lambda()) * (1.44 - 1.) / 1.2, 1e-13);
    EXPECT_NEAR(d[8], 1.2, 1e-13);
  }
}

}  // namespace
}  // namespace hg::test
