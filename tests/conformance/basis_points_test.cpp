// Bases at arbitrary points.
#include "basis_cases.hpp"

#include <gtest/gtest.h>

#include "backends.hpp"

namespace hg::test {
namespace {

class BasisPointsTest : public BackendTest {};
INSTANTIATE_TEST_SUITE_P(Backends, BasisPointsTest, testing::ValuesIn(usable_backends()), backend_name);

constexpr CeedEvalMode modes[] = {CEED_EVAL_INTERP, CEED_EVAL_GRAD};

void expect_exact_polynomials(Ceed ceed, const BasisCase &c, Random &random) {
  SCOPED_TRACE(testing::Message() << c);
  const Basis basis = make_basis(ceed, c);
  const Polynomial polynomial(c.dim, c.num_comp, c.P - 1, random);
  const Values u = polynomial.at_points(tensor_grid(c.dim, nodes_1d(c.P)), false);
  const CeedInt num_points = random.integer(1, 20);
  Values x = random.reals(static_cast<CeedSize>(num_points) * c.dim);
  for (CeedInt d = 0; d < c.dim; d++) x[d * num_points] = d % 2 == 0 ? -1 : 1;  // a corner
  for (const CeedEvalMode mode : modes) {
    const Values want = polynomial.at_points(x, mode == CEED_EVAL_GRAD);
    const Values got =
        apply_at_points(ceed, basis, {num_points}, CEED_NOTRANSPOSE, mode, x, u, static_cast<CeedSize>(want.size()));
    expect_close(got, want, basis_tolerance(c), CeedEvalModes[mode], 1);
  }
}

TEST_P(BasisPointsTest, EvaluatesPolynomialsExactly) {
  Random random(1);
  for (const BasisCase &c : basis_cases()) {
    if (c.Q >= c.P) expect_exact_polynomials(ceed, c, random);
  }
}

// A Lagrange basis is known from its nodes, however few its quadrature points are.
TEST_P(BasisPointsTest, EvaluatesPolynomialsExactlyWithFewQuadraturePoints) {
  Random random(8);
  for (const BasisCase &c : basis_cases()) {
    if (c.Q < c.P) expect_exact_polynomials(ceed, c, random);
  }
}

void expect_quadrature_action(Ceed ceed, const BasisCase &c, Random &random) {
  SCOPED_TRACE(testing::Message() << c);
  const Basis basis = make_basis(ceed, c);
  const Values x = tensor_grid(c.dim, points_1d(c.Q, c.quad_mode));
  for (const CeedEvalMode mode : modes) {
    for (const CeedTransposeMode t_mode : {CEED_NOTRANSPOSE, CEED_TRANSPOSE}) {
      CeedSize num_in = static_cast<CeedSize>(c.num_nodes()) * c.num_comp;
      CeedSize num_out = static_cast<CeedSize>(c.num_qpts()) * c.num_comp * q_comp(c, mode);
      if (t_mode == CEED_TRANSPOSE) std::swap(num_in, num_out);
      const Values u = random.reals(num_in);
      expect_close(apply_at_points(ceed, basis, {c.num_qpts()}, t_mode, mode, x, u, num_out),
                   apply(ceed, basis, 1, t_mode, mode, u, num_out), 1e-13, CeedEvalModes[mode], 1);
    }
  }
}

TEST_P(BasisPointsTest, AtQuadraturePointsIsTheQuadratureAction) {
  Random random(2);
  for (const BasisCase &c : basis_cases()) {
    if (c.Q >= c.P) expect_quadrature_action(ceed, c, random);
  }
}

TEST_P(BasisPointsTest, AtFewQuadraturePointsIsTheQuadratureAction) {
  Random random(9);
  for (const BasisCase &c : basis_cases()) {
    if (c.Q < c.P) expect_quadrature_action(ceed, c, random);
  }
}

TEST_P(BasisPointsTest, TransposeIsTheAdjoint) {
  Random random(3);
  for (const BasisCase &c : basis_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    const CeedInt num_points = random.integer(1, 20);
    const Values x = random.reals(static_cast<CeedSize>(num_points) * c.dim);
    for (const CeedEvalMode mode : modes) {
      const CeedSize num_in = static_cast<CeedSize>(c.num_nodes()) * c.num_comp;
      const CeedSize num_out = static_cast<CeedSize>(num_points) * c.num_comp * q_comp(c, mode);
      expect_adjoint(
          [&](const Values &u) {
            return apply_at_points(ceed, basis, {num_points}, CEED_NOTRANSPOSE, mode, x, u, num_out);
          },
          [&](const Values &v) {
            return apply_at_points(ceed, basis, {num_points}, CEED_TRANSPOSE, mode, x, v, num_in);
          },
          num_in, num_out, random, basis_tolerance(c), CeedEvalModes[mode]);
    }
  }
}

// Elements with any number of points, none too, follow one another.
TEST_P(BasisPointsTest, CountsMayDifferBetweenElements) {
  Random random(4);
  const std::vector<std::vector<CeedInt>> counts = {{3, 0, 1, 8, 9, 17, 0, 27}, {0, 0, 5}, {0}, {0, 0}, {}, {64, 1, 7}};
  for (const BasisCase &c : {BasisCase{1, 2, 4, 3, CEED_GAUSS}, BasisCase{2, 1, 3, 4, CEED_GAUSS_LOBATTO},
                             BasisCase{3, 3, 3, 4, CEED_GAUSS}, BasisCase{3, 2, 1, 2, CEED_GAUSS}}) {
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    for (const auto &num_points : counts) {
      CeedInt total = 0;
      for (const CeedInt n : num_points) total += n;
      const auto num_elem = static_cast<CeedInt>(num_points.size());
      const Values x = random.reals(static_cast<CeedSize>(total) * c.dim);
      for (const CeedEvalMode mode : modes) {
        const CeedInt at_nodes = c.num_nodes() * c.num_comp, at_point = c.num_comp * q_comp(c, mode);
        const Values u = random.reals(static_cast<CeedSize>(num_elem) * at_nodes);
        const Values v = random.reals(static_cast<CeedSize>(total) * at_point);
        Values want_v, want_u;
        CeedInt first = 0;
        for (CeedInt e = 0; e < num_elem; first += num_points[e], e++) {
          const auto slice = [](const Values &values, CeedInt start, CeedInt size) {
            return Values(values.begin() + start, values.begin() + start + size);
          };
          const CeedInt n = num_points[e];
          const Values x_e = slice(x, first * c.dim, n * c.dim);
          const Values bu = apply_at_points(ceed, basis, {n}, CEED_NOTRANSPOSE, mode, x_e,
                                            slice(u, e * at_nodes, at_nodes), n * at_point);
          const Values btv = apply_at_points(ceed, basis, {n}, CEED_TRANSPOSE, mode, x_e,
                                             slice(v, first * at_point, n * at_point), at_nodes);
          if (n == 0) {
            EXPECT_EQ(btv, Values(static_cast<std::size_t>(at_nodes), 0.0));
          }
          want_v.insert(want_v.end(), bu.begin(), bu.end());
          want_u.insert(want_u.end(), btv.begin(), btv.end());
        }
        expect_close(apply_at_points(ceed, basis, num_points, CEED_NOTRANSPOSE, mode, x, u, total * at_point), want_v,
                     basis_tolerance(c), CeedEvalModes[mode]);
        expect_close(apply_at_points(ceed, basis, num_points, CEED_TRANSPOSE, mode, x, v, num_elem * at_nodes), want_u,
                     basis_tolerance(c), CeedEvalModes[mode]);
      }
    }
  }
}

TEST_P(BasisPointsTest, WeightsAreOne) {
  const Basis basis = make_basis(ceed, {3, 2, 3, 4, CEED_GAUSS});
  const CeedInt num_points[] = {4, 0, 9};
  const Vector x = make_vector(ceed, 39, 0.25), weights = make_vector(ceed, 13, 17);
  ok(CeedBasisApplyAtPoints(basis, 3, num_points, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, x, CEED_VECTOR_NONE, weights));
  EXPECT_EQ(values_of(weights), Values(13, 1.0));
}

TEST_P(BasisPointsTest, AddsOnlyWhenAskedTo) {
  Random random(5);
  const BasisCase c = {3, 2, 3, 4, CEED_GAUSS};
  const Basis basis = make_basis(ceed, c);
  const CeedInt num_points = 13, at_nodes = c.num_nodes() * c.num_comp;
  const Vector x = make_vector(ceed, random.reals(num_points * c.dim));
  for (const CeedEvalMode mode : modes) {
    const Values start = random.reals(at_nodes + 5);
    const Vector in = make_vector(ceed, random.reals(num_points * c.num_comp * q_comp(c, mode)));
    const Vector out = make_vector(ceed, start);
    ok(CeedBasisApplyAtPoints(basis, 1, &num_points, CEED_TRANSPOSE, mode, x, in, out));
    const Values once = values_of(out);
    EXPECT_EQ(Values(once.begin() + at_nodes, once.end()), Values(5, 0.0)) << "beyond the element";
    set_values(out, start);
    ok(CeedBasisApplyAddAtPoints(basis, 1, &num_points, CEED_TRANSPOSE, mode, x, in, out));
    Values want = start;
    for (std::size_t i = 0; i < want.size(); i++) want[i] += once[i];
    expect_close(values_of(out), want, basis_tolerance(c), CeedEvalModes[mode]);
  }
}

// The derivative is that of the value: central differences, whose error falls at rate 2.
TEST_P(BasisPointsTest, GradientIsTheDerivative) {
  Random random(6);
  const BasisCase c = {3, 2, 5, 6, CEED_GAUSS};
  const Basis basis = make_basis(ceed, c);
  const Values u = random.reals(static_cast<CeedSize>(c.num_nodes()) * c.num_comp), x = random.reals(c.dim, -0.9, 0.9);
  const Values gradient = apply_at_points(ceed, basis, {1}, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, x, u, c.num_comp * c.dim);
  CeedScalar errors[2] = {};
  const CeedScalar steps[2] = {0.02, 0.01};
  for (int s = 0; s < 2; s++) {
    for (CeedInt d = 0; d < c.dim; d++) {
      Values ahead = x, behind = x;
      ahead[d] += steps[s];
      behind[d] -= steps[s];
      const Values f = apply_at_points(ceed, basis, {1}, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, ahead, u, c.num_comp);
      const Values b = apply_at_points(ceed, basis, {1}, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, behind, u, c.num_comp);
      for (CeedInt k = 0; k < c.num_comp; k++) {
        const CeedScalar difference = (f[k] - b[k]) / (2 * steps[s]) - gradient[d * c.num_comp + k];
        errors[s] += difference * difference;
      }
    }
  }
  const CeedScalar rate = 0.5 * std::log2(errors[0] / errors[1]);
  EXPECT_GT(rate, 1.9);
  EXPECT_LT(rate, 2.1);
}

// The user's functions, known at Q points, are polynomials of degree Q-1, whatever the number of nodes.
TEST_P(BasisPointsTest, UserMatricesArePolynomialsThroughTheirValues) {
  Random random(7);
  const CeedInt dim = 2, P = 3, Q = 5;
  const Polynomial functions(1, P, Q - 1, random);  // P functions of degree Q-1
  const Values q_ref = points_1d(Q, CEED_GAUSS);
  Values interp(Q * P), grad(Q * P), q_weight(Q, 1);
  for (CeedInt q = 0; q < Q; q++) {
    for (CeedInt j = 0; j < P; j++) {
      interp[q * P + j] = functions.at(j, &q_ref[q]);
      grad[q * P + j] = functions.at(j, &q_ref[q], 0);
    }
  }
  Basis basis;
  ok(CeedBasisCreateTensorH1(ceed, dim, 1, P, Q, interp.data(), grad.data(), q_ref.data(), q_weight.data(),
                             basis.out()));
  const Values x = random.reals(dim), u = random.reals(P * P);
  Values value(1, 0), gradient(dim, 0);
  for (CeedInt n = 0; n < P * P; n++) {
    const CeedInt i = n % P, j = n / P;
    value[0] += u[n] * functions.at(i, &x[0]) * functions.at(j, &x[1]);
    gradient[0] += u[n] * functions.at(i, &x[0], 0) * functions.at(j, &x[1]);
    gradient[1] += u[n] * functions.at(i, &x[0]) * functions.at(j, &x[1], 0);
  }
  expect_close(apply_at_points(ceed, basis, {1}, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, x, u, 1), value, 1e-13, "value",
               1);
  expect_close(apply_at_points(ceed, basis, {1}, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, x, u, dim), gradient, 1e-13,
               "gradient", 1);
}

TEST_P(BasisPointsTest, RefusesBadInput) {
  const Basis basis = make_basis(ceed, {3, 2, 2, 3, CEED_GAUSS});
  const Vector nodes = make_vector(ceed, 16, 1), x = make_vector(ceed, 15, 0), values = make_vector(ceed, 10, 1),
               gradients = make_vector(ceed, 30, 1);
  const CeedInt five = 5, six = 6, negative[] = {6, -1}, two[] = {2, 3};
  const char *too_short = "Input/output vectors too short for basis and evaluation mode";
  const auto apply = [&](CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode, CeedEvalMode mode,
                         CeedVector u, CeedVector v) {
    return CeedBasisApplyAtPoints(basis, num_elem, num_points, t_mode, mode, x, u, v);
  };
  expect_error(apply(1, &five, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, nodes, values), CEED_ERROR_DIMENSION, {too_short});
  expect_error(apply(1, &six, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, gradients), CEED_ERROR_DIMENSION,
               {too_short, "x_ref", "18"});
  expect_error(apply(2, two, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, values), CEED_ERROR_DIMENSION, {too_short});
  expect_error(apply(1, &five, CEED_TRANSPOSE, CEED_EVAL_GRAD, values, nodes), CEED_ERROR_DIMENSION, {too_short});
  expect_error(apply(2, negative, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, values), CEED_ERROR_DIMENSION,
               {"element 1", "-1"});
  expect_error(apply(1, nullptr, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, values), CEED_ERROR_INCOMPLETE,
               {"num_points"});
  expect_error(apply(1, &five, CEED_TRANSPOSE, CEED_EVAL_WEIGHT, values, nodes), CEED_ERROR_UNSUPPORTED,
               {"CEED_EVAL_WEIGHT"});
  expect_error(apply(1, &five, CEED_NOTRANSPOSE, CEED_EVAL_NONE, nodes, values), CEED_ERROR_UNSUPPORTED, {});
  expect_error(CeedBasisApplyAddAtPoints(basis, 1, &five, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, x, nodes, values),
               CEED_ERROR_UNSUPPORTED, {"CEED_TRANSPOSE"});
  expect_error(
      CeedBasisApplyAtPoints(basis, 1, &five, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, CEED_VECTOR_NONE, nodes, values),
      CEED_ERROR_INCOMPATIBLE, {"x_ref"});
  // The user's matrices at fewer points than nodes say nothing about other points.
  const Values matrix(2 * 3, 0.5), points = points_1d(2, CEED_GAUSS), weights(2, 1);
  Basis unknown;
  ok(CeedBasisCreateTensorH1(ceed, 1, 1, 3, 2, matrix.data(), matrix.data(), points.data(), weights.data(),
                             unknown.out()));
  expect_error(CeedBasisApplyAtPoints(unknown, 1, &five, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, x, nodes, values),
               CEED_ERROR_UNSUPPORTED, {"P_1d is 3", "Q_1d is 2"});
  // Nothing was left locked.
  ok(apply(1, &five, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, nodes, gradients));
}

}  // namespace
}  // namespace hg::test
