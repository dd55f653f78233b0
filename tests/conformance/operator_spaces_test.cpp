// Operators on Raviart-Thomas, Nédélec and Lagrange elements: identities of the spaces, several active bases, and what
// fields refuse.
#include "backends.hpp"
#include "oracle/instance.hpp"
#include "oracle/tabulated.hpp"
#include "qfunctions/saddle_point.h"
#include "qfunctions/weighted.h"

namespace {

using namespace hg::test;

class SpacesOperator : public BackendTest {
 protected:
  static constexpr CeedInt num_elem = 2;

  /// Elements that share nothing: degree of freedom n of element e is number e * size + first + n.
  Restriction apart(CeedInt P, CeedInt size, CeedInt first) {
    std::vector<CeedInt> offsets;
    for (CeedInt e = 0; e < num_elem; e++) {
      for (CeedInt n = 0; n < P; n++) offsets.push_back(e * size + first + n);
    }
    Restriction rstr;
    ok(CeedElemRestrictionCreate(ceed, num_elem, P, 1, 1, static_cast<CeedSize>(num_elem) * size, CEED_MEM_HOST,
                                 CEED_COPY_VALUES, offsets.data(), rstr.out()));
    return rstr;
  }

  /// A QFunction whose context is one number.
  QFunction qfunction(CeedQFunctionUser function, const char *source, CeedInt number) {
    QFunction qf;
    Context context;
    ok(CeedQFunctionContextCreate(ceed, context.out()));
    ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof number, &number));
    ok(CeedQFunctionCreateInterior(ceed, 1, function, source, qf.out()));
    ok(CeedQFunctionSetContext(qf, context));
    ok(CeedQFunctionSetContextWritable(qf, false));
    ok(CeedQFunctionAddInput(qf, "w", 1, CEED_EVAL_WEIGHT));
    return qf;
  }

  /// The matrix ∫ v u, or of the derivatives, of one element.
  Values gram(const Tabulated &element, CeedEvalMode mode) {
    const CeedInt size = element.q_comp(mode), P = element.P;
    const QFunction qf = qfunction(weighted, weighted_loc, size);
    ok(CeedQFunctionAddInput(qf, "u", size, mode));
    ok(CeedQFunctionAddOutput(qf, "v", size, mode));
    Operator op;
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    const Basis basis = element.make(ceed, 1);
    const Restriction rstr = apart(P, P, 0);
    ok(CeedOperatorSetField(op, "w", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE));
    ok(CeedOperatorSetField(op, "u", rstr, basis, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "v", rstr, basis, CEED_VECTOR_ACTIVE));
    const CeedInt n = num_elem * P;
    const Values all = dense_from_coordinates(op, ceed, n, n);
    Values block;
    for (CeedInt i = 0; i < P; i++) {
      for (CeedInt j = 0; j < P; j++) {
        block.push_back(all[i * n + j]);
        EXPECT_EQ(all[i * n + P + j], 0) << "elements share nothing";
      }
    }
    // The action is that of the matrix.
    Random random(1);
    const Values u = random.reals(n);
    const Vector in = make_vector(ceed, u), out = make_vector(ceed, n, 1e30);
    ok(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
    Values want;
    for (CeedInt i = 0; i < n; i++) want.push_back(dot({&all[static_cast<std::size_t>(i) * n], u.size()}, u));
    expect_close(values_of(out), want, tolerance(element.Q * P), "action", max_norm(all));
    return block;
  }
};

/// B^T A B for A n by n, B n by m.
Values congruent(const Values &a, const Values &b, CeedInt n, CeedInt m) {
  Values result(static_cast<std::size_t>(m) * m, 0);
  for (CeedInt i = 0; i < m; i++) {
    for (CeedInt j = 0; j < m; j++) {
      for (CeedInt k = 0; k < n; k++) {
        for (CeedInt l = 0; l < n; l++) result[i * m + j] += b[k * m + i] * a[k * n + l] * b[l * m + j];
      }
    }
  }
  return result;
}

CeedScalar volume(const Tabulated &element) {
  return dot(element.q_weights, Values(element.q_weights.size(), 1));
}

/// Fluxes out of the faces as degrees of freedom: each function has the divergence 1/|K|.
TEST_P(SpacesOperator, DivDivOfRaviartThomas) {
  for (const char *shape : {"triangle", "quadrilateral", "tetrahedron", "hexahedron"}) {
    SCOPED_TRACE(shape);
    const Tabulated rt = tabulated(std::string("RT0 ") + shape, 2);
    expect_close(gram(rt, CEED_EVAL_DIV), Values(static_cast<std::size_t>(rt.P) * rt.P, 1 / volume(rt)), 1e-13,
                 "div-div matrix");
  }
}

/// Gradients of Lagrange functions are Nédélec functions G: curl-curl annihilates them, and G^T M G is the Lagrange
/// functions' stiffness.
TEST_P(SpacesOperator, GradientsAreNedelecFunctions) {
  for (const auto &[shape, h1] : {std::pair{"triangle", "P1 triangle"},
                                  {"quadrilateral", "Q1 quadrilateral"},
                                  {"tetrahedron", "P1 tetrahedron"},
                                  {"hexahedron", "Q1 hexahedron"}}) {
    SCOPED_TRACE(shape);
    const Tabulated nedelec = tabulated(std::string("Nedelec ") + shape, 2), lagrange = tabulated(h1, 2);
    Values gradients(static_cast<std::size_t>(nedelec.P) * lagrange.P);
    for (CeedInt j = 0; j < lagrange.P; j++) {
      PolynomialField gradient;
      for (CeedInt d = 0; d < lagrange.dim; d++) gradient.push_back(lagrange.shapes[j][0].derivative(d));
      const Values dofs = nedelec.interpolate(gradient);
      for (CeedInt i = 0; i < nedelec.P; i++) gradients[i * lagrange.P + j] = dofs[i];
    }
    const Values curl_curl = congruent(gram(nedelec, CEED_EVAL_CURL), gradients, nedelec.P, lagrange.P);
    expect_close(curl_curl, Values(curl_curl.size(), 0), 1e-12, "curl-curl of gradients", 1);
    expect_close(congruent(gram(nedelec, CEED_EVAL_INTERP), gradients, nedelec.P, lagrange.P),
                 gram(lagrange, CEED_EVAL_GRAD), 1e-12, "stiffness");
  }
}

/// A saddle point problem with u in H(div) and constant pressures, for which the tensor product of one node serves on
/// quadrilaterals and hexahedra: two active bases, three outputs, one L-vector.
TEST_P(SpacesOperator, SaddlePointHasTwoActiveBases) {
  for (const char *shape : {"triangle", "quadrilateral", "tetrahedron", "hexahedron"}) {
    SCOPED_TRACE(shape);
    const Tabulated rt = tabulated(std::string("RT0 ") + shape, 2);
    const bool is_box = rt.topology == CEED_TOPOLOGY_QUAD || rt.topology == CEED_TOPOLOGY_HEX;
    const CeedInt P = rt.P, size = P + 1, n = num_elem * size;
    const QFunction qf = qfunction(saddle_point, saddle_point_loc, rt.dim);
    ok(CeedQFunctionAddInput(qf, "u", rt.dim, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf, "div u", 1, CEED_EVAL_DIV));
    ok(CeedQFunctionAddInput(qf, "p", 1, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddOutput(qf, "v", rt.dim, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddOutput(qf, "div v", 1, CEED_EVAL_DIV));
    ok(CeedQFunctionAddOutput(qf, "q", 1, CEED_EVAL_INTERP));
    Operator op;
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    const Basis basis_u = rt.make(ceed, 1);
    Basis basis_p;
    if (is_box) {
      ok(CeedBasisCreateTensorH1Lagrange(ceed, rt.dim, 1, 1, 2, CEED_GAUSS, basis_p.out()));
    } else {
      const Values ones(rt.q_weights.size(), 1);
      ok(CeedBasisCreateH1(ceed, rt.topology, 1, 1, rt.Q, ones.data(), nullptr, nullptr, nullptr, basis_p.out()));
    }
    const Restriction rstr_u = apart(P, size, 0), rstr_p = apart(1, size, P);
    const CeedBasis weight_basis = is_box ? basis_p.get() : basis_u.get();
    ok(CeedOperatorSetField(op, "w", CEED_ELEMRESTRICTION_NONE, weight_basis, CEED_VECTOR_NONE));
    for (const char *name : {"u", "div u", "v", "div v"}) {
      ok(CeedOperatorSetField(op, name, rstr_u, basis_u, CEED_VECTOR_ACTIVE));
    }
    for (const char *name : {"p", "q"}) ok(CeedOperatorSetField(op, name, rstr_p, basis_p, CEED_VECTOR_ACTIVE));
    bool has_tensor_bases = true;
    ok(CeedOperatorHasTensorBases(op, &has_tensor_bases));
    EXPECT_FALSE(has_tensor_bases);
    CeedBasis none = nullptr;
    expect_error(CeedOperatorGetActiveBasis(op, &none), CEED_ERROR_MINOR, {"several active basis"});

    const Values a = dense_from_coordinates(op, ceed, n, n), mass = gram(rt, CEED_EVAL_INTERP);
    Values want(a.size(), 0);
    for (CeedInt e = 0; e < num_elem; e++) {
      const CeedInt first = e * size;
      for (CeedInt i = 0; i < P; i++) {
        for (CeedInt j = 0; j < P; j++) want[(first + i) * n + first + j] = mass[i * P + j];
        // The integral of the divergence is the flux: 1.
        want[(first + i) * n + first + P] = want[(first + P) * n + first + i] = -1;
      }
    }
    expect_close(a, want, 1e-13, "saddle point matrix");
    Random random(2);
    const Values x = random.reals(n);
    const Vector in = make_vector(ceed, x), out = make_vector(ceed, n, 1e30);
    ok(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
    Values action, diagonal_of_a;
    for (CeedInt i = 0; i < n; i++) {
      action.push_back(dot({&a[static_cast<std::size_t>(i) * n], x.size()}, x));
      diagonal_of_a.push_back(a[i * n + i]);
    }
    expect_close(values_of(out), action, 1e-13, "action", 1);
    ok(CeedOperatorLinearAssembleDiagonal(op, out, CEED_REQUEST_IMMEDIATE));
    expect_close(values_of(out), diagonal_of_a, 1e-13, "diagonal", 1);
    // A multiplication and an addition for each entry of the four matrices of u and v, and the pressures' work.
    CeedSize flops = 0;
    ok(CeedQFunctionSetUserFlopsEstimate(qf, 0));
    ok(CeedOperatorGetFlopsEstimate(op, &flops));
    EXPECT_GE(flops, num_elem * 2 * (2 * rt.dim + 2) * rt.Q * P);
  }
}

TEST_P(SpacesOperator, FieldsRefuseWhatTheirSpaceDoesNotHave) {
  const Tabulated rt = tabulated("RT0 quadrilateral", 2);
  const Basis basis = rt.make(ceed, 1);
  const Restriction rstr = apart(rt.P, rt.P, 0), other = apart(5, 5, 0);
  QFunction qf;
  ok(CeedQFunctionCreateInterior(ceed, 1, weighted, weighted_loc, qf.out()));
  ok(CeedQFunctionAddInput(qf, "values", 2, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "scalar", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "gradient", 2, CEED_EVAL_GRAD));
  ok(CeedQFunctionAddInput(qf, "curl", 1, CEED_EVAL_CURL));
  ok(CeedQFunctionAddOutput(qf, "divergence", 1, CEED_EVAL_DIV));
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  const auto set = [&](const char *name, CeedElemRestriction r, CeedBasis b) {
    return CeedOperatorSetField(op, name, r, b, CEED_VECTOR_ACTIVE);
  };
  expect_error(set("scalar", rstr, basis), CEED_ERROR_DIMENSION, {"'scalar'", "size 1", "2 values"});
  expect_error(set("gradient", rstr, basis), CEED_ERROR_UNSUPPORTED, {"'gradient'", "H(div)", "divergence"});
  expect_error(set("curl", rstr, basis), CEED_ERROR_UNSUPPORTED, {"'curl'", "H(div)"});
  expect_error(set("values", other, basis), CEED_ERROR_DIMENSION, {"'values'", "5", "4"});
  Basis no_derivative, other_points;
  ok(CeedBasisCreateHdiv(ceed, rt.topology, 1, rt.P, rt.Q, rt.interp.data(), nullptr, nullptr, nullptr,
                         no_derivative.out()));
  expect_error(set("divergence", rstr, no_derivative), CEED_ERROR_UNSUPPORTED,
               {"'divergence'", "without a matrix", "divergence"});
  ok(set("values", rstr, basis));
  other_points = tabulated("RT0 quadrilateral", 3).make(ceed, 1);
  expect_error(set("divergence", rstr, other_points), CEED_ERROR_DIMENSION, {"'divergence'", "9", "4"});
  ok(set("divergence", rstr, basis));

  Operator at_points;
  ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, at_points.out()));
  expect_error(CeedOperatorSetField(at_points, "values", rstr, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_UNSUPPORTED,
               {"'values'", "tensor-product"});
}

INSTANTIATE_TEST_SUITE_P(Backends, SpacesOperator, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
