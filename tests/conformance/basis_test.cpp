// Bases at their quadrature points.
#include "basis_cases.hpp"

#include <gtest/gtest.h>

#include "backends.hpp"

namespace hg::test {
namespace {

class BasisTest : public BackendTest {};
TEST_P(BasisTest, WritesOutputsThatHaveNoValuesYet) {
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 2, CEED_GAUSS, basis.out()));
  const Vector u = make_vector(ceed, Values{1, 1});
  for (const CeedEvalMode mode : {CEED_EVAL_INTERP, CEED_EVAL_WEIGHT}) {
    Vector v;
    ok(CeedVectorCreate(ceed, 2, v.out()));
    const CeedVector from = mode == CEED_EVAL_WEIGHT ? CEED_VECTOR_NONE : u.get();
    ok(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, mode, from, v));
    expect_close(values_of(v), Values{1, 1}, tolerance(2), "of ones");
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, BasisTest, testing::ValuesIn(usable_backends()), backend_name);

constexpr CeedEvalMode modes[] = {CEED_EVAL_INTERP, CEED_EVAL_GRAD};

// A polynomial of degree P-1 is in the space: its values and derivatives are exact whatever the number of points.
TEST_P(BasisTest, EvaluatesPolynomialsExactly) {
  Random random(1);
  for (const BasisCase &c : basis_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    const Polynomial polynomial(c.dim, c.num_comp, c.P - 1, random);
    const Values u = polynomial.at_points(tensor_grid(c.dim, nodes_1d(c.P)), false);
    const Values x = tensor_grid(c.dim, points_1d(c.Q, c.quad_mode));
    for (const CeedEvalMode mode : modes) {
      const Values want = polynomial.at_points(x, mode == CEED_EVAL_GRAD);
      const Values got = apply(ceed, basis, 1, CEED_NOTRANSPOSE, mode, u, static_cast<CeedSize>(want.size()));
      expect_close(got, want, basis_tolerance(c), CeedEvalModes[mode], 1);
    }
  }
}

// A polynomial of degree P is not in the space, and is interpolated at the nodes: the test above sees the degree.
TEST_P(BasisTest, DoesNotEvaluateHigherDegrees) {
  const BasisCase c = {1, 1, 3, 4, CEED_GAUSS};
  const Basis basis = make_basis(ceed, c);
  Values u = nodes_1d(c.P);
  for (CeedScalar &x : u) x = x * x * x;
  Values want = points_1d(c.Q, c.quad_mode);  // x^3 through -1, 0, 1 is x
  expect_close(apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, c.Q), want, basis_tolerance(c), "x^3");
}

// One node, in the middle: the constants.
TEST_P(BasisTest, OneNodeGivesTheConstants) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const BasisCase c = {dim, 2, 1, 3, CEED_GAUSS};
    const Basis basis = make_basis(ceed, c);
    const CeedSize n = c.num_qpts();
    Values want(static_cast<std::size_t>(2 * n), 4);
    std::fill_n(want.begin(), n, -3);
    EXPECT_EQ(apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, {-3, 4}, 2 * n), want);
    EXPECT_EQ(apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, {-3, 4}, 2 * n * dim),
              Values(static_cast<std::size_t>(2 * n * dim), 0.0));
  }
}

TEST_P(BasisTest, AgreesWithTheReference) {
  Random random(8);
  for (const BasisCase &c : basis_cases()) {
    if (c.P > 5) continue;
    SCOPED_TRACE(testing::Message() << c);
    for (const CeedEvalMode mode : modes) {
      const CeedInt num_elem = 3;
      const CeedSize at_nodes = static_cast<CeedSize>(num_elem) * c.num_nodes() * c.num_comp;
      const CeedSize at_points = static_cast<CeedSize>(num_elem) * c.num_qpts() * c.num_comp * q_comp(c, mode);
      const Values u = random.reals(at_nodes), v = random.reals(at_points);
      expect_like_reference(
          ceed,
          [&](Ceed any) {
            const Basis basis = make_basis(any, c);
            Values both = apply(any, basis, num_elem, CEED_NOTRANSPOSE, mode, u, at_points);
            const Values back = apply(any, basis, num_elem, CEED_TRANSPOSE, mode, v, at_nodes);
            both.insert(both.end(), back.begin(), back.end());
            return both;
          },
          basis_tolerance(c), CeedEvalModes[mode]);
    }
  }
}

TEST_P(BasisTest, TransposeIsTheAdjoint) {
  Random random(2);
  for (const BasisCase &c : basis_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    for (const CeedEvalMode mode : modes) {
      const CeedSize num_in = static_cast<CeedSize>(c.num_nodes()) * c.num_comp;
      const CeedSize num_out = static_cast<CeedSize>(c.num_qpts()) * c.num_comp * q_comp(c, mode);
      expect_adjoint([&](const Values &u) { return apply(ceed, basis, 1, CEED_NOTRANSPOSE, mode, u, num_out); },
                     [&](const Values &v) { return apply(ceed, basis, 1, CEED_TRANSPOSE, mode, v, num_in); }, num_in,
                     num_out, random, basis_tolerance(c), CeedEvalModes[mode]);
    }
  }
}

TEST_P(BasisTest, WeightsIntegrate) {
  Random random(3);
  for (const BasisCase &c : basis_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    const Vector weights = make_vector(ceed, c.num_qpts(), 17);
    ok(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, weights));
    // A polynomial of the rule's degree against the closed form, int x^k = 2/(k+1) for even k.
    const CeedInt degree = c.quad_mode == CEED_GAUSS ? 2 * c.Q - 1 : 2 * c.Q - 3;
    const Values w = values_of(weights), x = tensor_grid(c.dim, points_1d(c.Q, c.quad_mode));
    for (const CeedInt k : {0, degree, degree - 1}) {
      CeedScalar sum = 0;
      for (CeedInt q = 0; q < c.num_qpts(); q++) {
        CeedScalar f = w[q];
        for (CeedInt d = 0; d < c.dim; d++) f *= std::pow(x[d * c.num_qpts() + q], k);
        sum += f;
      }
      EXPECT_NEAR(sum, k % 2 == 0 ? std::pow(2.0 / (k + 1), c.dim) : 0, 1e-13) << "degree " << k;
    }
  }
}

// One element after another, each laid out as a single one.
TEST_P(BasisTest, ElementsFollowOneAnother) {
  Random random(4);
  for (const BasisCase &c : {BasisCase{1, 2, 3, 4, CEED_GAUSS}, BasisCase{2, 3, 2, 3, CEED_GAUSS},
                             BasisCase{3, 2, 3, 2, CEED_GAUSS_LOBATTO}}) {
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    const CeedInt num_elem = 11;
    for (const CeedEvalMode mode : modes) {
      for (const CeedTransposeMode t_mode : {CEED_NOTRANSPOSE, CEED_TRANSPOSE}) {
        CeedSize num_in = static_cast<CeedSize>(c.num_nodes()) * c.num_comp;
        CeedSize num_out = static_cast<CeedSize>(c.num_qpts()) * c.num_comp * q_comp(c, mode);
        if (t_mode == CEED_TRANSPOSE) std::swap(num_in, num_out);
        const Values u = random.reals(num_elem * num_in);
        Values want;
        for (CeedInt e = 0; e < num_elem; e++) {
          const Values one(u.begin() + e * num_in, u.begin() + (e + 1) * num_in);
          const Values v = apply(ceed, basis, 1, t_mode, mode, one, num_out);
          want.insert(want.end(), v.begin(), v.end());
        }
        expect_close(apply(ceed, basis, num_elem, t_mode, mode, u, num_elem * num_out), want, basis_tolerance(c),
                     CeedTransposeModes[t_mode]);
      }
    }
    Values want;
    const Vector one = make_vector(ceed, c.num_qpts(), 17), many = make_vector(ceed, num_elem * c.num_qpts(), 17);
    ok(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, one));
    ok(CeedBasisApply(basis, num_elem, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, many));
    for (CeedInt e = 0; e < num_elem; e++) {
      const Values w = values_of(one);
      want.insert(want.end(), w.begin(), w.end());
    }
    expect_close(values_of(many), want, basis_tolerance(c), "weights");
  }
}

// Apply sets all of a transpose's vector, ApplyAdd adds.
TEST_P(BasisTest, AddsOnlyWhenAskedTo) {
  Random random(5);
  const BasisCase c = {3, 2, 3, 4, CEED_GAUSS};
  const Basis basis = make_basis(ceed, c);
  const CeedSize at_nodes = static_cast<CeedSize>(c.num_nodes()) * c.num_comp;
  for (const CeedEvalMode mode : modes) {
    const Values v = random.reals(static_cast<CeedSize>(c.num_qpts()) * c.num_comp * q_comp(c, mode));
    const Values start = random.reals(at_nodes + 5);
    const Vector in = make_vector(ceed, v), out = make_vector(ceed, start);
    ok(CeedBasisApply(basis, 1, CEED_TRANSPOSE, mode, in, out));
    const Values once = values_of(out);
    EXPECT_EQ(Values(once.begin() + at_nodes, once.end()), Values(5, 0.0)) << "beyond the element";
    set_values(out, start);
    ok(CeedBasisApplyAdd(basis, 1, CEED_TRANSPOSE, mode, in, out));
    Values want = start;
    for (std::size_t i = 0; i < want.size(); i++) want[i] += once[i];
    expect_close(values_of(out), want, basis_tolerance(c), CeedEvalModes[mode]);
  }
}

TEST_P(BasisTest, FullMatricesAreTheAction) {
  Random random(6);
  for (const BasisCase &c : {BasisCase{1, 1, 4, 3, CEED_GAUSS}, BasisCase{2, 1, 3, 4, CEED_GAUSS_LOBATTO},
                             BasisCase{3, 1, 3, 2, CEED_GAUSS}}) {
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    const CeedInt P = c.num_nodes(), Q = c.num_qpts();
    const Values u = random.reals(P);
    for (const CeedEvalMode mode : modes) {
      const CeedScalar *matrix = nullptr;
      ok(mode == CEED_EVAL_GRAD ? CeedBasisGetGrad(basis, &matrix) : CeedBasisGetInterp(basis, &matrix));
      Values want(static_cast<std::size_t>(Q) * q_comp(c, mode), 0);
      for (std::size_t q = 0; q < want.size(); q++) {
        for (CeedInt n = 0; n < P; n++) want[q] += matrix[q * P + n] * u[n];
      }
      expect_close(apply(ceed, basis, 1, CEED_NOTRANSPOSE, mode, u, static_cast<CeedSize>(want.size())), want,
                   basis_tolerance(c), CeedEvalModes[mode]);
    }
  }
}

TEST_P(BasisTest, UserMatricesAreTakenAsTheyAre) {
  Random random(7);
  const CeedInt P = 3, Q = 4;
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const Values interp = random.reals(Q * P), grad = random.reals(Q * P), q_ref = random.reals(Q),
                 q_weight = random.reals(Q);
    Basis basis;
    ok(CeedBasisCreateTensorH1(ceed, dim, 2, P, Q, interp.data(), grad.data(), q_ref.data(), q_weight.data(),
                               basis.out()));
    const CeedInt num_nodes = CeedIntPow(P, dim), num_qpts = CeedIntPow(Q, dim);
    const Values u = random.reals(2 * num_nodes);
    for (CeedInt g = -1; g < dim; g++) {
      Values want(static_cast<std::size_t>(num_qpts) * 2, 0);
      for (CeedInt c = 0; c < 2; c++) {
        for (CeedInt q = 0; q < num_qpts; q++) {
          for (CeedInt n = 0; n < num_nodes; n++) {
            CeedScalar product = u[c * num_nodes + n];
            for (CeedInt d = 0, q_rest = q, n_rest = n; d < dim; d++, q_rest /= Q, n_rest /= P) {
              product *= (d == g ? grad : interp)[(q_rest % Q) * P + n_rest % P];
            }
            want[c * num_qpts + q] += product;
          }
        }
      }
      Values got = apply(ceed, basis, 1, CEED_NOTRANSPOSE, g < 0 ? CEED_EVAL_INTERP : CEED_EVAL_GRAD, u,
                         static_cast<CeedSize>(want.size()) * (g < 0 ? 1 : dim));
      if (g > 0) got.erase(got.begin(), got.begin() + g * static_cast<CeedSize>(want.size()));
      got.resize(want.size());
      expect_close(got, want, tolerance(num_nodes), "user basis");
    }
  }
}

TEST_P(BasisTest, RefusesBadInput) {
  const BasisCase c = {3, 2, 2, 3, CEED_GAUSS};
  const Basis basis = make_basis(ceed, c);
  const Vector nodes = make_vector(ceed, 16, 1), points = make_vector(ceed, 54, 1),
               gradients = make_vector(ceed, 162, 1);
  const char *too_short = "Input/output vectors too short for basis and evaluation mode";
  expect_error(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, nodes, points), CEED_ERROR_DIMENSION,
               {too_short});
  expect_error(CeedBasisApply(basis, 2, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, gradients), CEED_ERROR_DIMENSION,
               {too_short});
  expect_error(CeedBasisApply(basis, 1, CEED_TRANSPOSE, CEED_EVAL_GRAD, points, nodes), CEED_ERROR_DIMENSION,
               {too_short});
  expect_error(CeedBasisApply(basis, 2, CEED_TRANSPOSE, CEED_EVAL_INTERP, gradients, nodes), CEED_ERROR_DIMENSION,
               {too_short});
  expect_error(CeedBasisApply(basis, 4, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, points),
               CEED_ERROR_DIMENSION, {too_short});
  expect_error(CeedBasisApply(basis, -1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, points), CEED_ERROR_DIMENSION,
               {"num_elem", "-1"});
  expect_error(CeedBasisApply(basis, 1, CEED_TRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, points),
               CEED_ERROR_UNSUPPORTED, {"CEED_EVAL_WEIGHT"});
  expect_error(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_DIV, nodes, points), CEED_ERROR_UNSUPPORTED,
               {"4", "CEED_EVAL_GRAD"});
  expect_error(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_NONE, nodes, points), CEED_ERROR_UNSUPPORTED, {});
  expect_error(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, CEED_VECTOR_NONE, points),
               CEED_ERROR_INCOMPATIBLE, {"u", "16"});
  expect_error(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, gradients, gradients),
               CEED_ERROR_INCOMPATIBLE, {"same vector"});
  expect_error(CeedBasisApplyAdd(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, points), CEED_ERROR_UNSUPPORTED,
               {"CEED_TRANSPOSE"});
  // These belong to no Ceed whose handler could be told.
  EXPECT_EQ(CeedBasisApply(CEED_BASIS_NONE, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, points),
            CEED_ERROR_INCOMPATIBLE);
  EXPECT_EQ(CeedBasisApply(nullptr, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, points), CEED_ERROR_INCOMPLETE);
  // Nothing was left locked.
  ok(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, nodes, gradients));
}

}  // namespace
}  // namespace hg::test
