// QFunctions that are not of one material: geometry, integrals, loads, the manufactured solution, the point update.
#include <gtest/gtest.h>

#include <cmath>

#include "qfunction_harness.hpp"
#include "qfunctions/bc/body_force.h"
#include "qfunctions/bc/mms_linear.h"
#include "qfunctions/common/geometry.h"
#include "qfunctions/common/integrals.h"
#include "qfunctions/mpm/geometry_points.h"
#include "qfunctions/mpm/point_update.h"

struct NamedQFunction {
  CeedQFunctionUser function;
  const char *source;
};
extern "C" const NamedQFunction qfunctions_as_c[];
extern "C" const CeedInt num_qfunctions_as_c;

namespace hg::test {
namespace {

using Array = std::vector<double>;

std::vector<Array> run(CeedQFunctionUser function, CeedInt Q, const std::vector<Array> &in,
                       const std::vector<CeedInt> &out_sizes, void *context = nullptr) {
  std::vector<const CeedScalar *> inputs;
  std::vector<CeedScalar *> outputs;
  std::vector<Array> out;
  for (const Array &array : in) inputs.push_back(array.data());
  for (CeedInt size : out_sizes) out.emplace_back(std::size_t(size) * Q, 12345.);
  for (Array &array : out) outputs.push_back(array.data());
  EXPECT_EQ(function(context, Q, inputs.data(), outputs.data()), 0);
  return out;
}

Array run_one(CeedQFunctionUser function, CeedInt Q, const std::vector<Array> &in,
              const std::vector<CeedInt> &out_sizes, void *context = nullptr) {
  return run(function, Q, in, out_sizes, context)[0];
}

constexpr CeedInt Q = 7;

Array near_identities(unsigned seed, double size) {
  Random random(seed);
  Array field(9 * Q);
  for (CeedInt i = 0; i < Q; i++) set(field, Q, i, random.near_identity(size));
  return field;
}

TEST(TensorForms, DeterminantMinusOneAndLogKeepTheirDigits) {
  for (double size : {0.3, 1e-3, 1e-8, 1e-14}) {
    Random random(1);
    for (int trial = 0; trial < 20; trial++) {
      const Array H = random.vector(9, -size, size);
      long double A[9];
      for (int k = 0; k < 9; k++) A[k] = H[k];
      const long double exact = A[0] + A[4] + A[8] + A[0] * A[4] - A[1] * A[3] + A[0] * A[8] - A[2] * A[6] +
                                A[4] * A[8] - A[5] * A[7] + A[0] * (A[4] * A[8] - A[5] * A[7]) -
                                A[1] * (A[3] * A[8] - A[5] * A[6]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
      EXPECT_NEAR(hg_determinant_minus_one(H.data()), double(exact), 1e-15 * size);
      const double x = random.uniform(-size, size);
      const long double X = x;
      // the defining series, summed in extended precision, where the difference would cancel
      long double phi = X - std::log1p(X);
      if (size < 0.1) {
        phi = 0;
        for (int k = 30; k >= 2; k--) phi += (k % 2 ? -1 : 1) * std::pow(X, k) / k;
      }
      EXPECT_NEAR(hg_x_minus_log1p(x), double(phi), 4e-16 * double(phi) * (size > 0.1 ? 100. : 1.));
    }
  }
  EXPECT_NEAR(hg_x_minus_log1p(0.2), hg_x_minus_log1p(0.2 * (1 + 1e-15)), 1e-16) << "both branches meet";
  EXPECT_TRUE(std::isnan(hg_x_minus_log1p(-1.5)));
}

TEST(Geometry, WeightAndInverseOfTheMapping) {
  Random random(2);
  const Array dx = near_identities(3, 0.3), w = random.vector(Q, 0.1, 1.);
  const Array q_data = run(HgGeometry, Q, {dx, w}, {10})[0], points = run(HgGeometryPoints, Q, {dx, w}, {10})[0];
  for (CeedInt i = 0; i < Q; i++) {
    const Tensor dxdX = transpose(get(dx, Q, i));  // dx[d][c] = ∂x_c/∂X_d
    EXPECT_NEAR(q_data[i], w[i] * determinant(dxdX), 1e-15);
    EXPECT_EQ(points[i], w[i]);
    const Tensor identity = multiply(get(q_data, Q, i, 1), dxdX);
    for (int c = 0; c < 9; c++) {
      EXPECT_NEAR(identity[c], c % 4 == 0, 1e-14);
      EXPECT_EQ(get(q_data, Q, i, 1)[c], get(points, Q, i, 1)[c]);
    }
  }
}

TEST(Integrals, MassWeightAndSums) {
  Random random(4);
  const Array q_data = random.vector(10 * Q, 0.5, 1.5);
  for (CeedInt num_comp : {1, 3, 6}) {
    HgMassContext context{num_comp};
    const Array u = random.vector(num_comp * Q, -1., 1.), v = run(HgMass, Q, {q_data, u}, {num_comp}, &context)[0];
    EXPECT_EQ(run_one(HgCopy, Q, {u}, {num_comp}, &context), u);
    for (CeedInt k = 0; k < num_comp * Q; k++) EXPECT_DOUBLE_EQ(v[k], q_data[k % Q] * u[k]);
  }
  EXPECT_EQ(run(HgWeight, Q, {q_data}, {1})[0], Array(q_data.begin(), q_data.begin() + Q));

  const Array F = near_identities(5, 0.2), rho = random.vector(Q, 1., 2.), u = random.vector(3 * Q, -1., 1.);
  const Array du = random.vector(9 * Q, -0.1, 0.1);
  const Array sums = run(HgIntegrals, Q, {q_data, F, rho, u, du}, {5})[0];
  for (CeedInt i = 0; i < Q; i++) {
    Tensor dF = multiply(transpose(get(du, Q, i)), get(q_data, Q, i, 1));
    for (int k = 0; k < 9; k += 4) dF[k] += 1.;
    const double mass = q_data[i] * rho[i] / determinant(get(F, Q, i));
    EXPECT_NEAR(sums[i], q_data[i] * determinant(dF), 1e-14);
    EXPECT_NEAR(sums[Q + i], mass, 1e-14);
    for (int c = 0; c < 3; c++) EXPECT_NEAR(sums[(2 + c) * Q + i], mass * u[c * Q + i], 1e-14);
  }
}

TEST(BodyForce, IsMassTimesAcceleration) {
  Random random(6);
  const Array q_data = random.vector(10 * Q, 0.5, 1.5), F = near_identities(7, 0.2), rho = random.vector(Q, 1., 2.);
  HgBodyForceContext context{{1., -2., 3.}};
  const Array v = run(HgBodyForce, Q, {q_data, F, rho}, {3}, &context)[0];
  for (CeedInt i = 0; i < Q; i++) {
    for (int c = 0; c < 3; c++) {
      EXPECT_NEAR(v[c * Q + i], q_data[i] * rho[i] / determinant(get(F, Q, i)) * context.acceleration[c], 1e-14);
    }
  }
}

// The force is −∇·σ of the displacement: σ by central differences of u, its divergence by central differences again.
TEST(MmsLinear, ForceBalancesTheStressOfTheDisplacement) {
  Random random(8);
  const double K = 1.7, mu = 0.6, amplitude = 1e-3, h = 1e-4;
  const auto stress = [&](const double *x, double *sigma) {
    double H[9];
    for (int j = 0; j < 3; j++) {
      double ahead[3] = {x[0], x[1], x[2]}, behind[3] = {x[0], x[1], x[2]}, u[3], v[3];
      ahead[j] += h, behind[j] -= h;
      hg_mms_linear_displacement(ahead, amplitude, u);
      hg_mms_linear_displacement(behind, amplitude, v);
      for (int i = 0; i < 3; i++) H[3 * i + j] = (u[i] - v[i]) / (2 * h);
    }
    for (int k = 0; k < 9; k++) {
      sigma[k] = mu * (H[k] + H[3 * (k % 3) + k / 3]) + (k % 4 ? 0. : (K - 2. / 3. * mu) * (H[0] + H[4] + H[8]));
    }
  };
  Array q_data = random.vector(10 * Q, 0.5, 1.5), x = random.vector(3 * Q, 0., 1.), moduli(2 * Q, K);
  for (CeedInt i = 0; i < Q; i++) moduli[Q + i] = mu;
  HgMmsLinearContext context{amplitude};
  const Array v = run(HgMmsLinearForce, Q, {q_data, x, moduli}, {3}, &context)[0];
  for (CeedInt i = 0; i < Q; i++) {
    double divergence[3] = {0., 0., 0.};
    for (int j = 0; j < 3; j++) {
      double ahead[3], behind[3], s[9], t[9];
      for (int c = 0; c < 3; c++) ahead[c] = behind[c] = x[c * Q + i];
      ahead[j] += h, behind[j] -= h;
      stress(ahead, s);
      stress(behind, t);
      for (int c = 0; c < 3; c++) divergence[c] += (s[3 * c + j] - t[3 * c + j]) / (2 * h);
    }
    for (int c = 0; c < 3; c++) EXPECT_NEAR(v[c * Q + i], -q_data[i] * divergence[c], 2e-6) << "of " << divergence[c];
  }
}

// ‖u‖ over the cube is A₀ √(14/8); the error QFunction with u = 0 integrates it (the midpoint rule is exact here).
TEST(MmsLinear, NormOfTheSolution) {
  const int n = 8;
  const CeedInt points = n * n * n;
  Array q_data(10 * points, 1. / points), x(3 * points), u(3 * points, 0.);
  for (int i = 0; i < points; i++) {
    x[i] = (i % n + 0.5) / n, x[points + i] = (i / n % n + 0.5) / n, x[2 * points + i] = (i / n / n + 0.5) / n;
  }
  HgMmsLinearContext context{1e-3};
  double sum = 0.;
  for (double e : run_one(HgMmsLinearError, points, {q_data, x, u}, {1}, &context)) sum += e;
  EXPECT_NEAR(std::sqrt(sum), 1e-3 * std::sqrt(14. / 8.), 1e-17);

  for (CeedInt i = 0; i < points; i++) {
    const double at[3] = {x[i], x[points + i], x[2 * points + i]};
    double exact[3];
    hg_mms_linear_displacement(at, 1e-3, exact);
    for (int c = 0; c < 3; c++) u[c * points + i] = exact[c];
  }
  for (double e : run_one(HgMmsLinearError, points, {q_data, x, u}, {1}, &context)) EXPECT_EQ(e, 0.);
}

TEST(PointUpdate, FollowsTheIncrement) {
  Random random(9);
  const Array q_data = random.vector(10 * Q, 0.5, 1.5), F = near_identities(10, 0.2), x = random.vector(3 * Q, 0., 1.);
  const Array u = random.vector(3 * Q, -1., 1.), delta = random.vector(3 * Q, -0.1, 0.1);
  Array grad = random.vector(9 * Q, -0.05, 0.05);
  set(grad, Q, 3, {0, 0, 0, 0, 0, 0, 0, 0, 0});
  HgPointUpdateContext context{0.25};
  const auto out = run(HgPointUpdate, Q, {q_data, F, x, u, delta, grad}, {3, 3, 3, 9, 1}, &context);
  for (CeedInt i = 0; i < Q; i++) {
    Tensor dF = multiply(transpose(get(grad, Q, i)), get(q_data, Q, i, 1));
    for (int k = 0; k < 9; k += 4) dF[k] += 1.;
    const Tensor expected = multiply(dF, get(F, Q, i)), found = get(out[3], Q, i);
    for (int c = 0; c < 9; c++) EXPECT_NEAR(found[c], expected[c], 1e-15);
    EXPECT_NEAR(out[4][i], determinant(dF) * q_data[i], 1e-15);
    for (int c = 0; c < 3; c++) {
      EXPECT_DOUBLE_EQ(out[0][c * Q + i], x[c * Q + i] + delta[c * Q + i]);
      EXPECT_DOUBLE_EQ(out[1][c * Q + i], u[c * Q + i] + delta[c * Q + i]);
      EXPECT_DOUBLE_EQ(out[2][c * Q + i], delta[c * Q + i] / 0.25);
    }
  }
  EXPECT_EQ(get(out[3], Q, 3), get(F, Q, 3)) << "a translation changes no F";
  EXPECT_EQ(out[4][3], q_data[3]) << "and no volume";

  Array identity_q_data(10 * Q, 0.), turned_inside_out(9 * Q, 0.);
  for (CeedInt i = 0; i < Q; i++) {
    identity_q_data[i] = 1.;
    set(identity_q_data, Q, i, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1);
  }
  turned_inside_out[2] = -1.5;
  const auto inverted =
      run(HgPointUpdate, Q, {identity_q_data, F, x, u, delta, turned_inside_out}, {3, 3, 3, 9, 1}, &context);
  for (CeedInt i = 0; i < Q; i++) EXPECT_EQ(std::isnan(inverted[4][i]), i == 2);
}

/// The QFunction of this name as C11 compiled it.
CeedQFunctionUser as_c(const std::string &name) {
  for (CeedInt k = 0; k < num_qfunctions_as_c; k++) {
    const std::string source = qfunctions_as_c[k].source;
    if (source.substr(source.rfind(':') + 1) == name) return qfunctions_as_c[k].function;
  }
  return nullptr;
}

TEST(Language, HeadersCompileAsCAndGiveTheSameNumbers) {
  Random random(11);
  Fields at{{"q_data", random.vector(10 * Q, 0.5, 1.5)},
            {"F", near_identities(12, 0.2)},
            {"moduli", random.vector(2 * Q, 1., 2.)},
            {"u", random.vector(9 * Q, -0.05, 0.05)}};
  for (const Material *material : materials()) {
    for (const QFunctionSpec &cpp : {material->residual, material->jacobian, material->energy, material->diagnostic}) {
      const Fields expected = call(cpp, Q, at);
      if (expected.contains("linearization")) at["linearization"] = expected.at("linearization");
      QFunctionSpec c = cpp;
      c.function = as_c(cpp.name);
      ASSERT_NE(c.function, nullptr) << cpp.name;
      const Fields found = call(c, Q, at);
      for (const auto &[name, values] : expected) {
        EXPECT_LE(distance(found.at(name), values), 1e-14 * norm(values)) << cpp.name << " " << name;
        EXPECT_GT(norm(values), 0.) << cpp.name << " " << name;
      }
    }
  }
}

}  // namespace
}  // namespace hg::test
