// What bases tell about themselves, and the reference's basis for one element.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "../../backends/ref/basis.hpp"
#include "conformance/basis_cases.hpp"

namespace hg::test {
namespace {

class BasisInterface : public testing::Test {
 protected:
  CeedHandle ceed{open(reference_resource)};
};

std::string view_of(CeedBasis basis) {
  char *text = nullptr;
  std::size_t size = 0;
  std::FILE *stream = open_memstream(&text, &size);
  ok(CeedBasisView(basis, stream));
  std::fclose(stream);
  const std::string view(text, size);
  std::free(text);
  return view;
}

TEST_F(BasisInterface, TellsItsSizes) {
  for (const BasisCase &c : {BasisCase{1, 4, 3, 5, CEED_GAUSS}, BasisCase{2, 1, 4, 2, CEED_GAUSS_LOBATTO},
                             BasisCase{3, 3, 2, 3, CEED_GAUSS}}) {
    const Basis basis = make_basis(ceed, c);
    CeedInt dim, num_comp, P, Q, P_1d, Q_1d, topology_dim;
    CeedElemTopology topology;
    CeedFESpace space;
    bool is_tensor;
    ok(CeedBasisGetDimension(basis, &dim));
    ok(CeedBasisGetNumComponents(basis, &num_comp));
    ok(CeedBasisGetNumNodes(basis, &P));
    ok(CeedBasisGetNumNodes1D(basis, &P_1d));
    ok(CeedBasisGetNumQuadraturePoints(basis, &Q));
    ok(CeedBasisGetNumQuadraturePoints1D(basis, &Q_1d));
    ok(CeedBasisGetTopology(basis, &topology));
    ok(CeedBasisGetTopologyDimension(topology, &topology_dim));
    ok(CeedBasisGetFESpace(basis, &space));
    ok(CeedBasisIsTensor(basis, &is_tensor));
    EXPECT_EQ(dim, c.dim);
    EXPECT_EQ(num_comp, c.num_comp);
    EXPECT_EQ(P, c.num_nodes());
    EXPECT_EQ(P_1d, c.P);
    EXPECT_EQ(Q, c.num_qpts());
    EXPECT_EQ(Q_1d, c.Q);
    EXPECT_EQ(topology_dim, c.dim);
    EXPECT_EQ(topology, c.dim == 1 ? CEED_TOPOLOGY_LINE : c.dim == 2 ? CEED_TOPOLOGY_QUAD : CEED_TOPOLOGY_HEX);
    EXPECT_EQ(space, CEED_FE_SPACE_H1);
    EXPECT_TRUE(is_tensor);
    for (const auto &[mode, want] :
         {std::pair{CEED_EVAL_NONE, 1}, {CEED_EVAL_INTERP, 1}, {CEED_EVAL_GRAD, c.dim}, {CEED_EVAL_WEIGHT, 1}}) {
      CeedInt got = 0;
      ok(CeedBasisGetNumQuadratureComponents(basis, mode, &got));
      EXPECT_EQ(got, want) << CeedEvalModes[mode];
    }
    const CeedScalar *q_ref, *q_weights;
    ok(CeedBasisGetQRef(basis, &q_ref));
    ok(CeedBasisGetQWeights(basis, &q_weights));
    EXPECT_EQ(Values(q_ref, q_ref + c.Q), points_1d(c.Q, c.quad_mode));
    EXPECT_NEAR(dot({q_weights, static_cast<std::size_t>(c.Q)}, Values(c.Q, 1.0)), 2, 1e-15);
    Ceed owner = nullptr;
    ok(CeedBasisGetCeed(basis, &owner));
    EXPECT_EQ(owner, ceed.get());
    ok(CeedDestroy(&owner));
    EXPECT_EQ(CeedBasisReturnCeed(basis), ceed.get());
  }
}

// Operators of several threads may share a basis: its full matrices are made once, whoever asks first.
TEST_F(BasisInterface, ServesSeveralThreads) {
  const Basis basis = make_basis(ceed, {3, 1, 4, 5, CEED_GAUSS});
  const CeedScalar *interp[4] = {}, *grad[4] = {};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; t++) {
    threads.emplace_back([&, t] {
      ok(CeedBasisGetGrad(basis, &grad[t]));
      ok(CeedBasisGetInterp(basis, &interp[t]));
    });
  }
  for (std::thread &thread : threads) thread.join();
  for (int t = 1; t < 4; t++) {
    EXPECT_EQ(interp[t], interp[0]);
    EXPECT_EQ(grad[t], grad[0]);
  }
}

TEST_F(BasisInterface, CopiesCountReferences) {
  CeedBasis basis = nullptr, copy = nullptr;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 4, 4, CEED_GAUSS, &basis));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 5, 4, CEED_GAUSS, &copy));
  ok(CeedBasisReferenceCopy(basis, &copy));
  ok(CeedBasisDestroy(&basis));
  EXPECT_EQ(basis, nullptr);
  CeedInt P = 0;
  ok(CeedBasisGetNumNodes1D(copy, &P));
  EXPECT_EQ(P, 4);
  ok(CeedBasisDestroy(&copy));
  ok(CeedBasisDestroy(&copy));  // NULL is fine
}

TEST_F(BasisInterface, NoneIsNoBasis) {
  CeedBasis none = CEED_BASIS_NONE;
  CeedInt value = 0;
  for (const CeedEvalMode mode : {CEED_EVAL_NONE, CEED_EVAL_INTERP, CEED_EVAL_WEIGHT}) {
    ok(CeedBasisGetNumQuadratureComponents(none, mode, &value));
    EXPECT_EQ(value, 1);
  }
  EXPECT_EQ(CeedBasisGetDimension(none, &value), CEED_ERROR_INCOMPATIBLE);
  CeedBasis copy = nullptr;
  ok(CeedBasisReferenceCopy(none, &copy));
  EXPECT_EQ(copy, CEED_BASIS_NONE);
  ok(CeedBasisDestroy(&copy));
}

// The format is part of the interface: scripts read it.
TEST_F(BasisInterface, ViewHasTheFieldsFormat) {
  const Basis basis = make_basis(ceed, {2, 2, 2, 2, CEED_GAUSS});
  EXPECT_EQ(view_of(basis),
            "CeedBasis in a H^1 space on a quadrilateral element\n"
            "  P: 2\n"
            "  Q: 2\n"
            "  dimension: 2\n"
            "  field components: 2\n"
            "  qref1d:   \t -0.57735027\t  0.57735027\n"
            "  qweight1d:\t  1.00000000\t  1.00000000\n"
            "  interp1d:\n"
            "    [0]\t  0.78867513\t  0.21132487\n"
            "    [1]\t  0.21132487\t  0.78867513\n"
            "  grad1d:\n"
            "    [0]\t -0.50000000\t  0.50000000\n"
            "    [1]\t -0.50000000\t  0.50000000\n");
  const Basis one_point = make_basis(ceed, {1, 1, 2, 1, CEED_GAUSS});
  ok(CeedBasisSetNumViewTabs(one_point, 1));
  EXPECT_EQ(view_of(one_point),
            "  CeedBasis in a H^1 space on a line element\n"
            "    P: 2\n"
            "    Q: 1\n"
            "    dimension: 1\n"
            "    field components: 1\n"
            "    qref1d:   \t  0.00000000\n"
            "    qweight1d:\t  2.00000000\n"
            "    interp1d: \t  0.50000000\t  0.50000000\n"
            "    grad1d:   \t -0.50000000\t  0.50000000\n");
}

TEST_F(BasisInterface, RefusesBadSizesAndMissingMatrices) {
  Basis basis;
  const auto create = [&](CeedInt dim, CeedInt num_comp, CeedInt P, CeedInt Q, CeedQuadMode mode) {
    return CeedBasisCreateTensorH1Lagrange(ceed, dim, num_comp, P, Q, mode, basis.out());
  };
  expect_error(create(0, 1, 2, 2, CEED_GAUSS), CEED_ERROR_DIMENSION, {"dim is 0", "1 to 3"});
  expect_error(create(4, 1, 2, 2, CEED_GAUSS), CEED_ERROR_DIMENSION, {"dim is 4", "1 to 3"});
  expect_error(create(1, 0, 2, 2, CEED_GAUSS), CEED_ERROR_DIMENSION, {"num_comp is 0"});
  expect_error(create(2, 1, 0, 2, CEED_GAUSS), CEED_ERROR_DIMENSION, {"nodes", "is 0"});
  expect_error(create(2, 1, 2, -3, CEED_GAUSS), CEED_ERROR_DIMENSION, {"quadrature points", "is -3"});
  expect_error(create(2, 1, 2, 1, CEED_GAUSS_LOBATTO), CEED_ERROR_DIMENSION, {"Q is 1", "Lobatto"});
  expect_error(create(3, 1, 2000, 2, CEED_GAUSS), CEED_ERROR_DIMENSION, {"2000"});
  EXPECT_EQ(basis.get(), nullptr);
  const CeedScalar m[4] = {1, 0, 0, 1}, q[2] = {-1, 1};
  const auto user = [&](const CeedScalar *interp, const CeedScalar *grad, const CeedScalar *x, const CeedScalar *w) {
    return CeedBasisCreateTensorH1(ceed, 1, 1, 2, 2, interp, grad, x, w, basis.out());
  };
  expect_error(user(nullptr, m, q, q), CEED_ERROR_INCOMPLETE, {"interp_1d"});
  expect_error(user(m, nullptr, q, q), CEED_ERROR_INCOMPLETE, {"grad_1d"});
  expect_error(user(m, m, nullptr, q), CEED_ERROR_INCOMPLETE, {"q_ref_1d"});
  expect_error(user(m, m, q, nullptr), CEED_ERROR_INCOMPLETE, {"q_weight_1d"});
  EXPECT_EQ(basis.get(), nullptr);
}

TEST_F(BasisInterface, CollocatedGradientDifferentiatesAtTheQuadraturePoints) {
  for (CeedInt P = 1; P <= 9; P++) {
    for (CeedInt Q = P; Q <= P + 2; Q++) {
      const Basis basis = make_basis(ceed, {1, 1, P, Q, CEED_GAUSS});
      Values d(static_cast<std::size_t>(Q) * Q), product(static_cast<std::size_t>(Q) * P, 0);
      ok(CeedBasisGetCollocatedGrad(basis, d.data()));
      const CeedScalar *interp, *grad;
      ok(CeedBasisGetInterp1D(basis, &interp));
      ok(CeedBasisGetGrad1D(basis, &grad));
      for (CeedInt i = 0; i < Q; i++) {
        for (CeedInt k = 0; k < Q; k++) {
          for (CeedInt j = 0; j < P; j++) product[i * P + j] += d[i * Q + k] * interp[k * P + j];
        }
      }
      expect_close(product, Values(grad, grad + Q * P), 1e-13, "D B = G", 1);
    }
  }
  // The least of all such matrices: it takes to zero what is orthogonal to the space.
  const Basis basis = make_basis(ceed, {1, 1, 2, 3, CEED_GAUSS});
  Values d(9), image(3, 0);
  ok(CeedBasisGetCollocatedGrad(basis, d.data()));
  const CeedScalar orthogonal[3] = {1, -2, 1};  // to 1 and x at three symmetric points
  for (CeedInt i = 0; i < 3; i++) {
    for (CeedInt j = 0; j < 3; j++) image[i] += d[i * 3 + j] * orthogonal[j];
  }
  expect_close(image, Values(3, 0.0), 1e-14, "orthogonal complement", 1);
  const Basis few = make_basis(ceed, {1, 1, 3, 2, CEED_GAUSS});
  expect_error(CeedBasisGetCollocatedGrad(few, d.data()), CEED_ERROR_DIMENSION, {"2 rows", "3 columns"});
}

TEST_F(BasisInterface, CollocatedMeansThatNodesAreQuadraturePoints) {
  const auto is_collocated = [&](const BasisCase &c) {
    bool answer = false;
    ok(CeedBasisIsCollocated(make_basis(ceed, c), &answer));
    return answer;
  };
  for (CeedInt P = 2; P <= 9; P++) {
    EXPECT_TRUE(is_collocated({2, 1, P, P, CEED_GAUSS_LOBATTO}));
    EXPECT_FALSE(is_collocated({2, 1, P, P, CEED_GAUSS}));
    EXPECT_FALSE(is_collocated({2, 1, P, P + 1, CEED_GAUSS_LOBATTO}));
  }
}

// T_k(cos t) = cos(k t).
CeedScalar chebyshev_sum(const CeedScalar *coefficients, CeedInt size, CeedInt stride, CeedScalar x) {
  CeedScalar sum = 0;
  for (CeedInt k = 0; k < size; k++) sum += coefficients[k * stride] * std::cos(k * std::acos(x));
  return sum;
}

TEST_F(BasisInterface, ChebyshevCoefficientsGiveTheBasisFunctions) {
  for (CeedInt P = 1; P <= 9; P++) {
    for (CeedInt Q = 1; Q <= P + 3; Q++) {
      const Basis basis = make_basis(ceed, {1, 1, P, Q, CEED_GAUSS});
      const CeedScalar *interp, *coefficients;
      CeedInt size = 0;
      ok(CeedBasisGetInterp1D(basis, &interp));
      Values at_points(static_cast<std::size_t>(Q) * P), exact, through;
      ok(CeedBasisGetChebyshevInterp1D(basis, at_points.data()));
      ok(CeedBasisGetChebyshevCoefficients1D(basis, &size, &coefficients));
      EXPECT_EQ(size, P);
      for (const CeedScalar x : points_1d(Q, CEED_GAUSS)) {
        for (CeedInt j = 0; j < P; j++) {
          exact.push_back(chebyshev_sum(coefficients + j, size, P, x));
          through.push_back(chebyshev_sum(at_points.data() + j, Q, P, x));
        }
      }
      const Values want(interp, interp + Q * P);
      expect_close(exact, want, 1e-13, "coefficients", 1);
      expect_close(through, want, 1e-13, "coefficients from quadrature points", 1);
    }
  }
}

TEST_F(BasisInterface, EvaluatesAtOnePoint) {
  Random random(1);
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const BasisCase c = {dim, 1, 4, 3, CEED_GAUSS};
    const Basis basis = make_basis(ceed, c);
    const CeedInt P = c.num_nodes();
    const Values x = random.reals(dim), u = random.reals(P);
    Values interp(P), grad(static_cast<std::size_t>(dim) * P), value(1), gradient(dim);
    ok(CeedBasisEvaluateAtPoint(basis, x.data(), interp.data(), grad.data()));
    value[0] = dot(interp, u);
    for (CeedInt d = 0; d < dim; d++) gradient[d] = dot({&grad[d * P], static_cast<std::size_t>(P)}, u);
    expect_close(value, apply_at_points(ceed, basis, {1}, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, x, u, 1), 1e-13, "", 1);
    expect_close(gradient, apply_at_points(ceed, basis, {1}, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, x, u, dim), 1e-13, "",
                 1);
    ok(CeedBasisEvaluateAtPoint(basis, x.data(), nullptr, nullptr));
    expect_error(CeedBasisEvaluateAtPoint(basis, nullptr, interp.data(), nullptr), CEED_ERROR_INCOMPLETE, {"x_ref"});
  }
}

// Sums of products of the contractions, written out for P = 3, Q = 4 (or one point), two components.
TEST_F(BasisInterface, CountsOperations) {
  const auto flops = [&](CeedInt dim, CeedEvalMode mode) {
    CeedSize count = -1;
    const Basis basis = make_basis(ceed, {dim, 2, 3, 4, CEED_GAUSS});
    ok(CeedBasisGetFlopsEstimate(basis, CEED_NOTRANSPOSE, mode, false, 0, &count));
    return count;
  };
  EXPECT_EQ(flops(1, CEED_EVAL_INTERP), 2 * 2 * (3 * 4));
  EXPECT_EQ(flops(2, CEED_EVAL_INTERP), 2 * 2 * (3 * 4 * 3 + 4 * 3 * 4));
  EXPECT_EQ(flops(3, CEED_EVAL_INTERP), 2 * 2 * (3 * 4 * 9 + 4 * 3 * 4 * 3 + 16 * 3 * 4));
  EXPECT_EQ(flops(1, CEED_EVAL_GRAD), 2 * 2 * (3 * 4));
  EXPECT_EQ(flops(3, CEED_EVAL_GRAD), 2 * 2 * (2 * 3 * 4 * 9 + 3 * 4 * 3 * 4 * 3 + 3 * 16 * 3 * 4));
  EXPECT_EQ(flops(3, CEED_EVAL_WEIGHT), 2 * 64);
  EXPECT_EQ(flops(3, CEED_EVAL_NONE), 0);
  const Basis basis = make_basis(ceed, {3, 2, 3, 4, CEED_GAUSS});
  CeedSize one = 0, ten = 0;
  ok(CeedBasisGetFlopsEstimate(basis, CEED_TRANSPOSE, CEED_EVAL_GRAD, true, 1, &one));
  ok(CeedBasisGetFlopsEstimate(basis, CEED_TRANSPOSE, CEED_EVAL_GRAD, true, 10, &ten));
  EXPECT_GT(one, 0);
  EXPECT_EQ(ten, 10 * one);
}

// What the reference's operators use is what the C calls do.
TEST_F(BasisInterface, ElementBasisIsTheBasisForOneElement) {
  Random random(2);
  for (const BasisCase &c : basis_cases()) {
    if (c.dim == 3 && c.P > 5) continue;
    SCOPED_TRACE(testing::Message() << c);
    const Basis basis = make_basis(ceed, c);
    ref::ElementBasis element_basis;
    ok(ref::ElementBasis::create(basis, &element_basis));
    ASSERT_TRUE(element_basis.can_evaluate_at_points());
    const CeedInt at_nodes = c.num_nodes() * c.num_comp, num_points = random.integer(0, 20);
    const Values u = random.reals(at_nodes), x = random.reals(static_cast<CeedSize>(num_points) * c.dim);
    for (const CeedEvalMode mode : {CEED_EVAL_INTERP, CEED_EVAL_GRAD}) {
      const CeedInt at_point = c.num_comp * q_comp(c, mode);
      const Values v = random.reals(static_cast<CeedSize>(c.num_qpts()) * at_point),
                   v_x = random.reals(static_cast<CeedSize>(num_points) * at_point);
      // Adding to u: subtract it again.
      const auto minus_u = [&](Values sum) {
        for (CeedInt i = 0; i < at_nodes; i++) sum[i] -= u[i];
        return sum;
      };
      Values bu(v.size()), bu_x(v_x.size()), sum = u, sum_x = u;
      element_basis.apply(mode, u.data(), bu.data());
      element_basis.apply_transpose_add(mode, v.data(), sum.data());
      element_basis.set_points(num_points, x.data());
      element_basis.apply_at_points(mode, u.data(), bu_x.data());
      element_basis.apply_transpose_add_at_points(mode, v_x.data(), sum_x.data());
      const CeedScalar tol = basis_tolerance(c);
      expect_close(bu, apply(ceed, basis, 1, CEED_NOTRANSPOSE, mode, u, static_cast<CeedSize>(v.size())), tol, "B u");
      expect_close(minus_u(sum), apply(ceed, basis, 1, CEED_TRANSPOSE, mode, v, at_nodes), tol, "B^T v", 1);
      expect_close(
          bu_x,
          apply_at_points(ceed, basis, {num_points}, CEED_NOTRANSPOSE, mode, x, u, static_cast<CeedSize>(v_x.size())),
          tol, "B u at points");
      expect_close(minus_u(sum_x), apply_at_points(ceed, basis, {num_points}, CEED_TRANSPOSE, mode, x, v_x, at_nodes),
                   tol, "B^T v at points", 1);
    }
  }
}

}  // namespace
}  // namespace hg::test
