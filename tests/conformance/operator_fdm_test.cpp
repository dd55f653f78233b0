// The element-wise inverse by fast diagonalisation.
#include "backends.hpp"
#include "oracle/instance.hpp"
#include "oracle/tabulated.hpp"
#include "qfunctions/helmholtz.h"

namespace {

using namespace hg::test;

/// Mass and stiffness on elements that are boxes, with a coefficient at each point.
struct Problem {
  CeedInt dim, P_1d, Q_1d, num_comp, num_elem;
  HelmholtzContext context;
  Values coefficient;            ///< (point, element)
  std::vector<CeedInt> offsets;  ///< (node, element): component c of node n is number c * num_nodes + n
  CeedInt num_nodes;
  bool at_points = false;  ///< with the quadrature points for points, and weights that are passive

  CeedInt P() const { return CeedIntPow(P_1d, dim); }
  CeedInt Q() const { return CeedIntPow(Q_1d, dim); }
  CeedSize size() const { return static_cast<CeedSize>(num_comp) * num_nodes; }
};

/// Elements that share no node, random sides, and one coefficient for each element.
Problem boxes(Random &random, CeedInt dim, CeedScalar mass) {
  Problem p{};
  p.dim = dim;
  p.P_1d = random.integer(2, dim == 3 ? 4 : 6);
  p.Q_1d = p.P_1d + random.integer(0, 1);
  p.num_comp = random.integer(1, 3);
  p.num_elem = random.integer(1, 3);
  p.context = {dim, p.num_comp, mass, {}};
  for (CeedScalar &k : p.context.stiffness) k = random.real(0.1, 3);
  for (CeedInt e = 0; e < p.num_elem; e++) {
    p.coefficient.insert(p.coefficient.end(), static_cast<std::size_t>(p.Q()), random.real(0.5, 2));
  }
  p.num_nodes = p.num_elem * p.P();
  for (CeedInt i = 0; i < p.num_nodes; i++) p.offsets.push_back(i);
  return p;
}

struct Pair {
  Pair(Ceed ceed, const Problem &p) {
    const CeedInt Q = p.Q();
    ok(CeedElemRestrictionCreate(ceed, p.num_elem, p.P(), p.num_comp, p.num_nodes, p.size(), CEED_MEM_HOST,
                                 CEED_COPY_VALUES, p.offsets.data(), rstr.out()));
    ok(CeedBasisCreateTensorH1Lagrange(ceed, p.dim, p.num_comp, p.P_1d, p.Q_1d, CEED_GAUSS, basis.out()));
    ok(CeedQFunctionContextCreate(ceed, context.out()));
    ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof p.context,
                                   const_cast<HelmholtzContext *>(&p.context)));
    ok(CeedQFunctionCreateInterior(ceed, 1, helmholtz, helmholtz_loc, qf.out()));
    ok(CeedQFunctionSetContext(qf, context));
    ok(CeedQFunctionSetContextWritable(qf, false));
    ok(CeedQFunctionAddInput(qf, "w", 1, p.at_points ? CEED_EVAL_NONE : CEED_EVAL_WEIGHT));
    ok(CeedQFunctionAddInput(qf, "c", 1, CEED_EVAL_NONE));
    ok(CeedQFunctionAddInput(qf, "u", p.num_comp, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf, "du", p.num_comp * p.dim, CEED_EVAL_GRAD));
    ok(CeedQFunctionAddOutput(qf, "v", p.num_comp, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddOutput(qf, "dv", p.num_comp * p.dim, CEED_EVAL_GRAD));
    coefficient = make_vector(ceed, p.coefficient);
    if (p.at_points) {
      ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
      make_points(ceed, p);
      ok(CeedOperatorSetField(op, "w", rstr_q, CEED_BASIS_NONE, weights));
    } else {
      ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
      ok(CeedElemRestrictionCreateStrided(ceed, p.num_elem, Q, 1, static_cast<CeedSize>(p.num_elem) * Q,
                                          CEED_STRIDES_BACKEND, rstr_q.out()));
      ok(CeedOperatorSetField(op, "w", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE));
    }
    ok(CeedOperatorSetField(op, "c", rstr_q, CEED_BASIS_NONE, coefficient));
    for (const char *name : {"u", "du", "v", "dv"}) ok(CeedOperatorSetField(op, name, rstr, basis, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorCreateFDMElementInverse(op, inverse.out(), CEED_REQUEST_IMMEDIATE));
  }

  void make_points(Ceed ceed, const Problem &p) {
    Values x_1d(static_cast<std::size_t>(p.Q_1d)), w_1d(x_1d.size());
    ok(CeedGaussQuadrature(p.Q_1d, x_1d.data(), w_1d.data()));
    const CeedInt Q = p.Q(), total = p.num_elem * Q;
    std::vector<CeedInt> list;
    for (CeedInt e = 0; e <= p.num_elem; e++) list.push_back(p.num_elem + 1 + e * Q);
    for (CeedInt i = 0; i < total; i++) list.push_back(i);
    Values x, w;
    for (CeedInt i = 0; i < total; i++) {
      CeedScalar weight = 1;
      for (CeedInt d = 0, rest = i % Q; d < p.dim; d++, rest /= p.Q_1d) {
        x.push_back(x_1d[rest % p.Q_1d]);
        weight *= w_1d[rest % p.Q_1d];
      }
      w.push_back(weight);
    }
    ok(CeedElemRestrictionCreateAtPoints(ceed, p.num_elem, total, 1, total, CEED_MEM_HOST, CEED_COPY_VALUES,
                                         list.data(), rstr_q.out()));
    ok(CeedElemRestrictionCreateAtPoints(ceed, p.num_elem, total, p.dim, static_cast<CeedSize>(total) * p.dim,
                                         CEED_MEM_HOST, CEED_COPY_VALUES, list.data(), rstr_x.out()));
    points = make_vector(ceed, x);
    weights = make_vector(ceed, w);
    ok(CeedOperatorAtPointsSetPoints(op, rstr_x, points));
  }

  Restriction rstr, rstr_q, rstr_x;
  Basis basis;
  Context context;
  QFunction qf;
  Vector coefficient, points, weights;
  Operator op, inverse;
};

class FdmTest : public BackendTest {
 protected:
  Values act(CeedOperator op, const Values &u) {
    const Vector in = make_vector(ceed, u), out = make_vector(ceed, static_cast<CeedSize>(u.size()), 1e30);
    ok(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
    return values_of(out);
  }
};

/// Constant coefficients on boxes: the inverse of the operator, from the left and from the right.
TEST_P(FdmTest, InvertsSeparableOperators) {
  Random random(1);
  for (int round = 0; round < 12; round++) {
    for (const bool at_points : {false, true}) {
      Problem p = boxes(random, 1 + round % 3, random.real(0.1, 2));
      p.at_points = at_points;
      SCOPED_TRACE(testing::Message() << p.dim << "D, P_1d " << p.P_1d << ", Q_1d " << p.Q_1d << ", " << p.num_comp
                                      << " components, " << p.num_elem << " elements"
                                      << (at_points ? ", at points" : ""));
      const Pair pair(ceed, p);
      const Values u = random.reals(p.size());
      expect_close(act(pair.inverse, act(pair.op, u)), u, 1e-10, "F A u", 1);
      expect_close(act(pair.op, act(pair.inverse, u)), u, 1e-10, "A F u", 1);
      CeedSize in = 0, out = 0;
      ok(CeedOperatorGetActiveVectorLengths(pair.inverse, &in, &out));
      EXPECT_EQ(in, p.size());
      EXPECT_EQ(out, p.size());
    }
  }
}

/// Mass or stiffness alone. Without mass the constants are in the kernel: A F A = A.
TEST_P(FdmTest, InvertsMassAndStiffnessAlone) {
  Random random(2);
  for (CeedInt dim = 1; dim <= 3; dim++) {
    Problem mass = boxes(random, dim, 1.5), stiffness = boxes(random, dim, 0);
    for (CeedScalar &k : mass.context.stiffness) k = 0;
    const Pair mass_pair(ceed, mass), stiffness_pair(ceed, stiffness);
    const Values u = random.reals(mass.size()), v = random.reals(stiffness.size());
    expect_close(act(mass_pair.inverse, act(mass_pair.op, u)), u, 1e-11, "mass", 1);
    const Values image = act(stiffness_pair.op, v);
    expect_close(act(stiffness_pair.op, act(stiffness_pair.inverse, image)), image, 1e-9, "stiffness", 1);
    // The kernel is multiplied by a large number, not by infinity.
    const Values amplified = act(stiffness_pair.inverse, Values(v.size(), 1));
    EXPECT_GT(max_norm(amplified), 1e2);
    EXPECT_LT(max_norm(amplified), 1e8);
  }
}

/// Shared nodes: the sum of the elements' inverses.
TEST_P(FdmTest, AddsTheInversesOfTheElements) {
  Random random(3);
  for (CeedInt dim = 1; dim <= 2; dim++) {
    Problem apart = boxes(random, dim, 1);
    apart.num_comp = apart.context.num_comp = 2;
    apart.num_elem = 3;
    apart.coefficient = {};
    for (CeedInt e = 0; e < 3; e++) {
      apart.coefficient.insert(apart.coefficient.end(), static_cast<std::size_t>(apart.Q()), random.real(0.5, 2));
    }
    apart.num_nodes = 3 * apart.P();
    apart.offsets.clear();
    for (CeedInt i = 0; i < apart.num_nodes; i++) apart.offsets.push_back(i);
    Problem shared = apart;
    shared.num_nodes = apart.P() + 2;
    shared.offsets.clear();
    for (CeedInt e = 0; e < 3; e++) {
      const auto nodes = random.distinct(apart.P(), shared.num_nodes);
      shared.offsets.insert(shared.offsets.end(), nodes.begin(), nodes.end());
    }
    const Pair apart_pair(ceed, apart), shared_pair(ceed, shared);
    const Values u = random.reals(shared.size());
    Values gathered(static_cast<std::size_t>(apart.size())), want(u.size(), 0);
    const auto for_each = [&](auto &&f) {
      for (CeedInt c = 0; c < 2; c++) {
        for (CeedInt i = 0; i < apart.num_nodes; i++) {
          f(c * apart.num_nodes + i, c * shared.num_nodes + shared.offsets[i]);
        }
      }
    };
    for_each([&](CeedInt own, CeedInt common) { gathered[own] = u[common]; });
    const Values inverted = act(apart_pair.inverse, gathered);
    for_each([&](CeedInt own, CeedInt common) { want[common] += inverted[own]; });
    expect_close(act(shared_pair.inverse, u), want, 1e-12, "sum over elements");
  }
}

/// Coefficients between a and b in an element: symmetric, positive definite, and x^T F x is within a factor of b/a of
/// x^T A^-1 x, that is y^T A y / y^T x in [a/b, b/a] for y = F x.
TEST_P(FdmTest, IsAPositivePreconditionerForVariableCoefficients) {
  Random random(4);
  for (int round = 0; round < 9; round++) {
    Problem p = boxes(random, 1 + round % 3, random.real(0.1, 2));
    const CeedScalar least = 0.2, most = 3;
    p.coefficient = random.reals(static_cast<CeedSize>(p.coefficient.size()), least, most);
    const Pair pair(ceed, p);
    for (int trial = 0; trial < 5; trial++) {
      const Values x = random.reals(p.size()), y = act(pair.inverse, x), z = random.reals(p.size());
      EXPECT_GT(dot(x, y), 0);
      EXPECT_NEAR(dot(z, y), dot(x, act(pair.inverse, z)), 1e-11 * max_norm(y) * static_cast<CeedScalar>(p.size()));
      const CeedScalar quotient = dot(y, act(pair.op, y)) / dot(y, x);
      EXPECT_GE(quotient, least / most);
      EXPECT_LE(quotient, most / least);
    }
  }
}

/// Elements without material, and operators of the other sign.
TEST_P(FdmTest, TakesZeroAndNegativeElements) {
  Random random(5);
  Problem p = boxes(random, 2, 1);
  p.num_elem = 2;
  p.num_nodes = 2 * p.P();
  p.offsets.clear();
  for (CeedInt i = 0; i < p.num_nodes; i++) p.offsets.push_back(i);
  p.coefficient.assign(2 * static_cast<std::size_t>(p.Q()), -1.5);
  std::fill_n(p.coefficient.begin(), p.Q(), 0);
  const Pair pair(ceed, p);
  const Values u = random.reals(p.size());
  Values want = u;
  for (CeedInt c = 0; c < p.num_comp; c++) std::fill_n(want.begin() + c * p.num_nodes, p.P(), 0);
  expect_close(act(pair.inverse, act(pair.op, u)), want, 1e-10, "negative elements", 1);
  const Values inverted = act(pair.inverse, u);
  for (CeedInt c = 0; c < p.num_comp; c++) {
    for (CeedInt n = 0; n < p.P(); n++) EXPECT_EQ(inverted[c * p.num_nodes + n], 0);
  }
}

/// A process without elements has an inverse, too: zero.
TEST_P(FdmTest, TakesNoElements) {
  Random random(7);
  Problem p = boxes(random, 2, 1);
  p.num_elem = 0;
  p.num_nodes = 5;
  p.offsets.clear();
  p.coefficient.clear();
  const Pair pair(ceed, p);
  const Values u = random.reals(p.size());
  EXPECT_EQ(act(pair.inverse, u), Values(u.size(), 0));
}

TEST_P(FdmTest, RefusesOtherOperators) {
  Random random(6);
  const Problem p = boxes(random, 2, 1);
  const Pair pair(ceed, p);
  Operator composite, inverse;
  ok(CeedOperatorCreateComposite(ceed, composite.out()));
  ok(CeedOperatorCompositeAddSub(composite, pair.op));
  expect_error(CeedOperatorCreateFDMElementInverse(composite, inverse.out(), CEED_REQUEST_IMMEDIATE),
               CEED_ERROR_UNSUPPORTED, {"composite"});
  expect_error(CeedOperatorCreateFDMElementInverse(pair.op, nullptr, CEED_REQUEST_IMMEDIATE), CEED_ERROR_INCOMPLETE,
               {"fdm_inv"});
  // Without tensor product, and from one basis to another.
  const Tabulated element = tabulated("P1 triangle", 2);
  const Basis triangle = element.make(ceed, 1);
  Basis fine, coarse;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 4, CEED_GAUSS, fine.out()));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 4, CEED_GAUSS, coarse.out()));
  const auto make = [&](CeedBasis in, CeedInt P_in, CeedBasis out, CeedInt P_out) {
    QFunction qf;
    ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_INTERP, CEED_EVAL_INTERP, qf.out()));
    Operator op;
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    const std::vector<CeedInt> offsets = {0, 1, 2};
    Restriction rstr_in, rstr_out;
    for (auto &[P, rstr] : {std::pair{P_in, &rstr_in}, {P_out, &rstr_out}}) {
      ok(CeedElemRestrictionCreate(ceed, 1, P, 1, 1, P, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), rstr->out()));
    }
    ok(CeedOperatorSetField(op, "input", rstr_in, in, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "output", rstr_out, out, CEED_VECTOR_ACTIVE));
    return op;
  };
  expect_error(
      CeedOperatorCreateFDMElementInverse(make(triangle, 3, triangle, 3), inverse.out(), CEED_REQUEST_IMMEDIATE),
      CEED_ERROR_UNSUPPORTED, {"no tensor product"});
  expect_error(CeedOperatorCreateFDMElementInverse(make(fine, 3, coarse, 2), inverse.out(), CEED_REQUEST_IMMEDIATE),
               CEED_ERROR_INCOMPATIBLE, {"different bases"});
  Basis few;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 2, CEED_GAUSS, few.out()));
  expect_error(CeedOperatorCreateFDMElementInverse(make(few, 3, few, 3), inverse.out(), CEED_REQUEST_IMMEDIATE),
               CEED_ERROR_DIMENSION, {"3 nodes", "2 quadrature points"});
  EXPECT_EQ(inverse.get(), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Backends, FdmTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
