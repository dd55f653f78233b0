// Every material: stress against energy, Jacobian against stress, objectivity, rest, composition with a history.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "options/error.hpp"
#include "qfunction_harness.hpp"

namespace hg::test {
namespace {

constexpr CeedInt sizes[] = {1, 7, 16};

/// A random state at Q points: cell geometry, F_n, moduli, displacement gradient of the given size.
Fields random_state(CeedInt Q, unsigned seed, double history, double increment) {
  Random random(seed);
  Fields fields;
  auto &q_data = fields["q_data"], &F = fields["F"], &moduli = fields["moduli"];
  q_data.resize(10 * Q), F.resize(9 * Q), moduli.resize(2 * Q);
  for (CeedInt i = 0; i < Q; i++) {
    q_data[i] = random.uniform(0.5, 2.);
    set(q_data, Q, i, random.near_identity(0.3), 1);
    set(F, Q, i, random.near_identity(history));
    moduli[i] = random.uniform(1., 3.);
    moduli[Q + i] = random.uniform(0.5, 1.);
  }
  fields["u"] = random.vector(9 * Q, -increment, increment);
  return fields;
}

double total_energy(const Material &material, CeedInt Q, const Fields &fields) {
  double sum = 0.;
  for (double value : call(material.energy, Q, fields, "energy")) sum += value;
  return sum;
}

std::vector<double> apply_jacobian(const Material &material, CeedInt Q, Fields at, const std::vector<double> &delta) {
  Fields out = call(material.residual, Q, at);
  if (material.num_linearization) at["linearization"] = out["linearization"];
  at["u"] = delta;
  return call(material.jacobian, Q, at, "v");
}

/// The displacement gradient du whose physical gradient is H, that is du[d][c] = Σ_j H[c][j] ∂x_j/∂X_d.
void set_gradient(Fields &fields, CeedInt Q, CeedInt i, const Tensor &H) {
  const Tensor dxdX = inverse(get(fields["q_data"], Q, i, 1));
  set(fields["u"], Q, i, transpose(multiply(H, dxdX)));
}

class EveryMaterial : public testing::TestWithParam<const Material *> {
 protected:
  const Material &material = *GetParam();
  bool objective() const { return material.name != "elasticity-linear"; }
};

// ψ(u + h δ) − ψ(u) − h P̃:∇δ falls with h²: the residual is the derivative of the energy, history included.
TEST_P(EveryMaterial, ResidualIsTheDerivativeOfTheEnergy) {
  for (CeedInt Q : sizes) {
    for (double history : {0., 0.2}) {
      Fields at = random_state(Q, 10 + Q, history, 0.1);
      const auto delta = Random(20 + Q).vector(9 * Q, -0.1, 0.1);
      const double slope = dot(call(material.residual, Q, at, "v"), delta);
      double remainder[3];
      for (int k = 0; k < 3; k++) {
        const double h = 0.1 / (1 << k);
        Fields moved = at;
        moved["u"] = plus(at["u"], h, delta);
        remainder[k] = std::abs(total_energy(material, Q, moved) - total_energy(material, Q, at) - h * slope);
      }
      for (int k = 0; k < 2; k++)
        EXPECT_NEAR(std::log2(remainder[k] / remainder[k + 1]), 2., 0.1) << Q << " " << history;
      // and by central differences, where the remainder is of third order
      Fields ahead = at, behind = at;
      const double h = 1e-4;
      ahead["u"] = plus(at["u"], h, delta);
      behind["u"] = plus(at["u"], -h, delta);
      EXPECT_NEAR((total_energy(material, Q, ahead) - total_energy(material, Q, behind)) / (2 * h), slope,
                  1e-8 * (1. + std::abs(slope)));
    }
  }
}

TEST_P(EveryMaterial, JacobianIsTheDerivativeOfTheResidual) {
  for (CeedInt Q : sizes) {
    for (double history : {0., 0.2}) {
      Fields at = random_state(Q, 30 + Q, history, 0.1);
      const auto delta = Random(40 + Q).vector(9 * Q, -0.1, 0.1);
      const auto base = call(material.residual, Q, at, "v");
      const auto slope = apply_jacobian(material, Q, at, delta);
      double remainder[3];
      for (int k = 0; k < 3; k++) {
        const double h = 0.1 / (1 << k);
        Fields moved = at;
        moved["u"] = plus(at["u"], h, delta);
        remainder[k] = distance(call(material.residual, Q, moved, "v"), plus(base, h, slope));
      }
      if (objective()) {
        for (int k = 0; k < 2; k++)
          EXPECT_NEAR(std::log2(remainder[k] / remainder[k + 1]), 2., 0.1) << Q << " " << history;
      } else {
        EXPECT_LT(remainder[0], 1e-14 * norm(base)) << "the linear material has no remainder";
      }
      Fields ahead = at, behind = at;
      const double h = 1e-4;
      ahead["u"] = plus(at["u"], h, delta);
      behind["u"] = plus(at["u"], -h, delta);
      const auto difference =
          plus(call(material.residual, Q, ahead, "v"), -1., call(material.residual, Q, behind, "v"));
      EXPECT_LT(norm(plus(difference, -2. * h, slope)), 1e-8 * 2. * h * norm(slope));
    }
  }
}

TEST_P(EveryMaterial, JacobianIsSymmetric) {
  const CeedInt Q = 13;
  const Fields at = random_state(Q, 50, 0.2, 0.1);
  const auto a = Random(51).vector(9 * Q, -1., 1.), b = Random(52).vector(9 * Q, -1., 1.);
  const double ab = dot(apply_jacobian(material, Q, at, a), b), ba = dot(apply_jacobian(material, Q, at, b), a);
  EXPECT_NEAR(ab, ba, 1e-13 * std::abs(ab));
}

TEST_P(EveryMaterial, NoStressAndNoEnergyAtRest) {
  const CeedInt Q = 7;
  Fields at = random_state(Q, 60, 0., 0.);
  for (double value : call(material.residual, Q, at, "v")) EXPECT_EQ(value, 0.);
  for (double value : call(material.energy, Q, at, "energy")) EXPECT_EQ(value, 0.);
}

TEST_P(EveryMaterial, TranslationsAndSmallRotationsGiveNoStress) {
  const CeedInt Q = 7;
  Fields at = random_state(Q, 61, 0., 0.);
  Random random(62);
  for (CeedInt i = 0; i < Q; i++) {
    const double a = 1e-9 * random.uniform(-1, 1), b = 1e-9 * random.uniform(-1, 1), c = 1e-9 * random.uniform(-1, 1);
    set_gradient(at, Q, i, {0., a, b, -a, 0., c, -b, -c, 0.});
  }
  EXPECT_LT(norm(call(material.residual, Q, at, "v")), 1e-16);
}

// The energy of R F Qᵀ is the energy of F, and P̃ turns with R.
TEST_P(EveryMaterial, ObjectivityAndIsotropy) {
  if (!objective()) GTEST_SKIP() << "linear elasticity is not objective";
  const CeedInt Q = 5;
  Random random(70);
  Fields at = random_state(Q, 71, 0.2, 0.1), turned = at, isotropic = at;
  std::vector<Tensor> R(Q);
  for (CeedInt i = 0; i < Q; i++) {
    const Tensor dXdx = get(at["q_data"], Q, i, 1);
    Tensor dF = transpose(get(at["u"], Q, i));
    dF = multiply(dF, dXdx);
    for (int k = 0; k < 9; k += 4) dF[k] += 1.;
    R[i] = random.rotation();
    Tensor H = multiply(R[i], dF);
    for (int k = 0; k < 9; k += 4) H[k] -= 1.;
    set_gradient(turned, Q, i, H);
    set(isotropic["F"], Q, i, multiply(get(at["F"], Q, i), random.rotation()));
  }
  const auto energy = call(material.energy, Q, at, "energy");
  const auto energy_turned = call(material.energy, Q, turned, "energy");
  const auto energy_isotropic = call(material.energy, Q, isotropic, "energy");
  const auto v = call(material.residual, Q, at, "v"), v_turned = call(material.residual, Q, turned, "v");
  for (CeedInt i = 0; i < Q; i++) {
    EXPECT_NEAR(energy_turned[i], energy[i], 1e-13);
    EXPECT_NEAR(energy_isotropic[i], energy[i], 1e-13);
    const Tensor expected = multiply(get(v, Q, i), transpose(R[i]));  // v[d][c] = Σ_j dXdx[d][j] P̃[c][j]
    const Tensor found = get(v_turned, Q, i);
    for (int c = 0; c < 9; c++) EXPECT_NEAR(found[c], expected[c], 1e-13);
  }
}

// One step on the mesh of the step, with history F_n, is one step of the whole F on the undeformed mesh.
TEST_P(EveryMaterial, HistoryComposesToTheTotalLagrangianForm) {
  const CeedInt Q = 7;
  Fields at = random_state(Q, 80, 0.2, 0.1), total = at;
  for (CeedInt i = 0; i < Q; i++) {
    const Tensor F_n = get(at["F"], Q, i), dXdx = get(at["q_data"], Q, i, 1);
    Tensor dF = multiply(transpose(get(at["u"], Q, i)), dXdx);
    for (int k = 0; k < 9; k += 4) dF[k] += 1.;
    Tensor H = multiply(dF, F_n);
    for (int k = 0; k < 9; k += 4) H[k] -= 1.;
    total["q_data"][i] = at["q_data"][i] / determinant(F_n);
    set(total["q_data"], Q, i, multiply(dXdx, F_n), 1);
    set(total["F"], Q, i, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    set_gradient(total, Q, i, H);
  }
  const auto v = call(material.residual, Q, at, "v"), v_total = call(material.residual, Q, total, "v");
  EXPECT_LT(distance(v, v_total), 1e-13 * norm(v));
  EXPECT_LT(distance(call(material.energy, Q, at, "energy"), call(material.energy, Q, total, "energy")), 1e-13);
}

// To first order in a small strain every material is the linear one, and no digits are lost on the way.
TEST_P(EveryMaterial, SmallStrainsKeepTheirDigits) {
  const CeedInt Q = 7;
  for (double size : {1e-4, 1e-7, 1e-10}) {
    Fields at = random_state(Q, 90, 0., size);
    const Material &linear = find_material("elasticity-linear");
    const auto v = call(material.residual, Q, at, "v"), v_linear = call(linear.residual, Q, at, "v");
    EXPECT_LT(distance(v, v_linear), (20. * size + 1e-14) * norm(v_linear));
    const auto e = call(material.energy, Q, at, "energy"), e_linear = call(linear.energy, Q, at, "energy");
    EXPECT_LT(distance(e, e_linear), (20. * size + 1e-14) * norm(e_linear));
  }
}

TEST_P(EveryMaterial, DiagnosticsAgreeWithResidualAndEnergy) {
  const CeedInt Q = 7;
  Fields at = random_state(Q, 95, 0.2, 0.1);
  const auto d = call(material.diagnostic, Q, at, "diagnostic");
  const auto v = call(material.residual, Q, at, "v"), energy = call(material.energy, Q, at, "energy");
  for (CeedInt i = 0; i < Q; i++) {
    const Tensor F_n = get(at["F"], Q, i), dXdx = get(at["q_data"], Q, i, 1);
    Tensor dF = multiply(transpose(get(at["u"], Q, i)), dXdx);
    for (int k = 0; k < 9; k += 4) dF[k] += 1.;
    const double w = at["q_data"][i], J_n = determinant(F_n), J = J_n * determinant(dF);
    EXPECT_NEAR(d[8 * Q + i], J, 1e-14);
    EXPECT_NEAR(d[9 * Q + i] * w / J_n, energy[i], 1e-14);
    double s[6];
    for (int c = 0; c < 6; c++) s[c] = d[c * Q + i];
    EXPECT_NEAR(d[6 * Q + i], -(s[0] + s[1] + s[2]) / 3., 1e-14);
    const double mises = std::sqrt(
        0.5 * ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) + (s[2] - s[0]) * (s[2] - s[0])) +
        3. * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
    EXPECT_NEAR(d[7 * Q + i], mises, 1e-13);
    if (!objective()) continue;  // linear: σ is P, not J⁻¹ P Fᵀ
    // P̃ = σ (J/J_n) ΔF⁻ᵀ, and v[d][c] = w Σ_j dXdx[d][j] P̃[c][j]
    const Tensor sigma = {s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]};
    const Tensor P = multiply(sigma, transpose(inverse(dF)));
    const Tensor expected = multiply(dXdx, transpose(P)), found = get(v, Q, i);
    for (int c = 0; c < 9; c++) EXPECT_NEAR(found[c], w * J / J_n * expected[c], 1e-13);
  }
}

TEST_P(EveryMaterial, InvertedPointIsNotANumber) {
  if (!objective()) GTEST_SKIP() << "linear elasticity has no inverted state";
  const CeedInt Q = 3;
  for (double stretch : {0., -0.5}) {
    Fields at = random_state(Q, 97, 0., 0.01);
    set_gradient(at, Q, 1, {stretch - 1., 0., 0., 0., 0., 0., 0., 0., 0.});
    // an exact det F = 0 needs exact geometry
    set(at["q_data"], Q, 1, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1);
    set(at["u"], Q, 1, {stretch - 1., 0., 0., 0., 0., 0., 0., 0., 0.});
    const auto v = call(material.residual, Q, at, "v"), energy = call(material.energy, Q, at, "energy");
    EXPECT_FALSE(std::isfinite(norm(v)));
    EXPECT_TRUE(std::isnan(energy[1]));
    EXPECT_TRUE(std::isfinite(energy[0]) && std::isfinite(energy[2])) << "the neighbours are untouched";
    for (int c = 0; c < 9; c++) EXPECT_TRUE(std::isfinite(v[c * Q]) && std::isfinite(v[c * Q + 2]));
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryMaterial, testing::ValuesIn(materials().begin(), materials().end()),
                         [](const auto &info) {
                           std::string name(info.param->name);
                           for (char &c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

// Closed form of the residual: v[d][c] = w Σ_j dXdx[d][j] (2μ ε + λ tr(ε) I)[c][j].
TEST(Linear, ResidualIsHookesLaw) {
  const CeedInt Q = 7;
  const Fields at = random_state(Q, 130, 0., 0.1);
  const auto v = call(find_material("elasticity-linear").residual, Q, at, "v");
  for (CeedInt i = 0; i < Q; i++) {
    const Tensor dXdx = get(at.at("q_data"), Q, i, 1), H = multiply(transpose(get(at.at("u"), Q, i)), dXdx);
    const double mu = at.at("moduli")[Q + i], lambda = at.at("moduli")[i] - 2. / 3. * mu;
    Tensor sigma;
    for (int k = 0; k < 9; k++) {
      sigma[k] = mu * (H[k] + transpose(H)[k]) + (k % 4 ? 0. : lambda * (H[0] + H[4] + H[8]));
    }
    const Tensor expected = multiply(dXdx, transpose(sigma)), found = get(v, Q, i);
    for (int c = 0; c < 9; c++) EXPECT_NEAR(found[c], at.at("q_data")[i] * expected[c], 1e-14);
  }
}

TEST(NeoHookean, InitialAndCurrentFormsAgree) {
  const Material &initial = find_material("elasticity-neo-hookean-initial");
  const Material &current = find_material("elasticity-neo-hookean-current");
  for (CeedInt Q : sizes) {
    Fields at = random_state(Q, 100 + Q, 0.2, 0.1);
    const auto delta = Random(110 + Q).vector(9 * Q, -1., 1.);
    const auto a = call(initial.residual, Q, at, "v"), b = call(current.residual, Q, at, "v");
    EXPECT_LT(distance(a, b), 1e-13 * norm(a));
    const auto da = apply_jacobian(initial, Q, at, delta), db = apply_jacobian(current, Q, at, delta);
    EXPECT_LT(distance(da, db), 1e-13 * norm(da));
  }
}

// Closed forms of Cauchy stress: uniaxial stretch diag(s, 1, 1) and simple shear x + γ y.
TEST(NeoHookean, UniaxialStretchAndSimpleShear) {
  for (const char *name : {"elasticity-neo-hookean-initial", "elasticity-neo-hookean-current"}) {
    const Material &material = find_material(name);
    const CeedInt Q = 1;
    for (double amount : {-0.4, 0.1, 0.8}) {
      Fields at = random_state(Q, 120, 0., 0.);
      const double K = at["moduli"][0], mu = at["moduli"][1], lambda = K - 2. / 3. * mu, s = 1. + amount;
      // a history of a third of the stretch, so that the increment is the rest
      const double s_n = 1. + amount / 3.;
      set(at["F"], Q, 0, {s_n, 0, 0, 0, 1, 0, 0, 0, 1});
      set_gradient(at, Q, 0, {s / s_n - 1., 0, 0, 0, 0, 0, 0, 0, 0});
      auto d = call(material.diagnostic, Q, at, "diagnostic");
      EXPECT_NEAR(d[0], (mu + 0.5 * lambda) * (s * s - 1.) / s, 1e-13);
      EXPECT_NEAR(d[1], 0.5 * lambda * (s * s - 1.) / s, 1e-13);
      EXPECT_NEAR(d[2], d[1], 1e-14);
      for (int c = 3; c < 6; c++) EXPECT_NEAR(d[c], 0., 1e-14);
      EXPECT_NEAR(d[9], 0.5 * mu * (s * s - 1.) - mu * std::log(s) + 0.25 * lambda * (s * s - 1. - 2. * std::log(s)),
                  1e-13);

      set(at["F"], Q, 0, {1, amount / 3., 0, 0, 1, 0, 0, 0, 1});
      set_gradient(at, Q, 0, {0, amount - amount / 3., 0, 0, 0, 0, 0, 0, 0});
      d = call(material.diagnostic, Q, at, "diagnostic");
      EXPECT_NEAR(d[0], mu * amount * amount, 1e-13);
      EXPECT_NEAR(d[5], mu * amount, 1e-13);
      for (int c : {1, 2, 3, 4}) EXPECT_NEAR(d[c], 0., 1e-13);
      EXPECT_NEAR(d[8], 1., 1e-14);
    }
  }
}

TEST(Materials, AreFoundByNameAndAlias) {
  for (const Material *material : materials()) {
    EXPECT_EQ(&find_material(material->name), material);
    for (std::string_view alias : material->aliases) EXPECT_EQ(&find_material(alias), material);
  }
  EXPECT_EQ(find_material("elasticity-mpm-neo-hookean-current").name, "elasticity-neo-hookean-current");
  try {
    find_material("jelly");
    FAIL() << "no error";
  } catch (const Error &error) {
    EXPECT_NE(std::string(error.what()).find("jelly"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("elasticity-linear"), std::string::npos);
  }
}

TEST(Materials, ElasticConstants) {
  const ElasticParameters p{.E = 2.5, .nu = 0.25, .rho = 1.};
  EXPECT_DOUBLE_EQ(p.bulk_modulus(), 2.5 / 1.5);
  EXPECT_DOUBLE_EQ(p.shear_modulus(), 1.);
  EXPECT_DOUBLE_EQ(p.lame_lambda(), 2.5 * 0.25 / (1.25 * 0.5));
}

}  // namespace
}  // namespace hg::test
