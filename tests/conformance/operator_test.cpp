// Operators of real programs: mass and Poisson from the gallery, identity and scale, contexts, vector lengths, the
// semantics of Apply and its kin.
#include "backends.hpp"
#include "oracle/affine_operator.hpp"
#include "oracle/elliptic.hpp"
#include "qfunctions/squared_mass.h"

namespace {

using namespace hg::test;

class OperatorTest : public BackendTest {};

/// Integral of 1 over a box: the volume of the mapped cube, exactly integrated where the map is polynomial.
TEST_P(OperatorTest, MassOfOneIsTheVolume) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (CeedInt P_1d = 2; P_1d <= (dim == 3 ? 3 : 5); P_1d++) {
      SCOPED_TRACE(std::to_string(dim) + "D, P_1d " + std::to_string(P_1d));
      CeedScalar volume = 1;
      // A shear keeps the volume, the stretch multiplies it.
      const Box mesh(dim, 3, P_1d, [&](const Values &x) {
        Values place = x;
        for (CeedInt d = 0; d < dim; d++) place[d] = (d + 2) * x[d] + 0.3 * x[(d + 1) % dim] * (d + 1 < dim);
        return place;
      });
      for (CeedInt d = 0; d < dim; d++) volume *= d + 2;
      const EllipticOperator mass(ceed, mesh, Elliptic::mass, 1, P_1d + 1);
      const Values ones(mass.size(), 1);
      const Values got = {dot(ones, mass.apply(ones))}, want = {volume};
      expect_close(got, want, tolerance(mesh.num_nodes), "volume");
      Random random(7);
      expect_adjoint([&](const Values &u) { return mass.apply(u); }, [&](const Values &u) { return mass.apply(u); },
                     mass.size(), mass.size(), random, tolerance(mesh.num_nodes), "symmetry of the mass operator");
    }
  }
}

/// ∇1 = 0; the energy of u = x_d is the volume, on a bent mesh as well (isoparametric elements hold linear functions).
TEST_P(OperatorTest, PoissonOfLinearFunctions) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (CeedInt P_1d = 2; P_1d <= (dim == 3 ? 3 : 4); P_1d++) {
      SCOPED_TRACE(std::to_string(dim) + "D, P_1d " + std::to_string(P_1d));
      const Box mesh(dim, 2, P_1d, bent);
      const EllipticOperator poisson(ceed, mesh, Elliptic::poisson, 1, P_1d + 2);
      const EllipticOperator mass(ceed, mesh, Elliptic::mass, 1, P_1d + 2);
      const CeedScalar tol = 10 * tolerance(mesh.num_nodes);
      const Values ones(poisson.size(), 1), zeros(poisson.size(), 0);
      expect_close(poisson.apply(ones), zeros, tol, "Poisson of 1", 1);
      const Values volume = {dot(ones, mass.apply(ones))};
      for (CeedInt d = 0; d < dim; d++) {
        const Values x(mesh.coordinates.begin() + d * mesh.num_nodes,
                       mesh.coordinates.begin() + (d + 1) * mesh.num_nodes);
        const Values energy = {dot(x, poisson.apply(x))};
        expect_close(energy, volume, tol, "energy of a coordinate");
      }
      Random random(8);
      expect_adjoint([&](const Values &u) { return poisson.apply(u); },
                     [&](const Values &u) { return poisson.apply(u); }, poisson.size(), poisson.size(), random, tol,
                     "symmetry of the Poisson operator");
    }
  }
}

/// Three components are three times one component.
TEST_P(OperatorTest, VectorOperatorsActOnEachComponent) {
  Random random(9);
  for (const Elliptic kind : {Elliptic::mass, Elliptic::poisson}) {
    for (CeedInt dim = 1; dim <= 3; dim++) {
      SCOPED_TRACE(std::to_string(dim) + "D " + (kind == Elliptic::mass ? "mass" : "Poisson"));
      const Box mesh(dim, 2, 3, bent);
      const EllipticOperator one(ceed, mesh, kind, 1, 4), three(ceed, mesh, kind, 3, 4);
      Values u = random.reals(3 * one.size()), want;
      for (CeedInt c = 0; c < 3; c++) {
        const Values part = one.apply(Values(u.begin() + c * one.size(), u.begin() + (c + 1) * one.size()));
        want.insert(want.end(), part.begin(), part.end());
      }
      expect_close(three.apply(u), want, tolerance(mesh.elem_size), "vector operator");
    }
  }
}

/// Points that are nodes (Gauss-Lobatto, as many as nodes): the mass matrix is diagonal.
TEST_P(OperatorTest, CollocatedMassIsDiagonal) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const Box mesh(dim, 2, 3);
    const EllipticOperator mass(ceed, mesh, Elliptic::mass, 1, 3, CEED_GAUSS_LOBATTO);
    Random random(10);
    const Values ones(mass.size(), 1), diagonal = mass.apply(ones), u = random.reals(mass.size());
    Values want(u.size());
    for (std::size_t i = 0; i < u.size(); i++) want[i] = diagonal[i] * u[i];
    expect_close(mass.apply(u), want, tolerance(mesh.elem_size), "collocated mass");
  }
}

/// An operator for a restriction and basis between two L-vectors with the QFunction "identity".
struct IdentityOperator {
  IdentityOperator(Ceed ceed, const Box &mesh, CeedInt num_comp, CeedInt Q_1d, CeedEvalMode in, CeedEvalMode out)
      : size(num_comp * (in == CEED_EVAL_GRAD ? mesh.dim : 1)) {
    rstr = mesh.restriction(ceed, num_comp);
    const CeedInt Q = CeedIntPow(Q_1d, mesh.dim);
    ok(CeedElemRestrictionCreateStrided(ceed, mesh.num_elem, Q, size, static_cast<CeedSize>(mesh.num_elem) * Q * size,
                                        CEED_STRIDES_BACKEND, rstr_q.out()));
    ok(CeedBasisCreateTensorH1Lagrange(ceed, mesh.dim, num_comp, mesh.P_1d, Q_1d, CEED_GAUSS, basis.out()));
    ok(CeedQFunctionCreateIdentity(ceed, size, in, out, qf.out()));
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    const auto set = [&](const char *name, CeedEvalMode mode) {
      if (mode == CEED_EVAL_NONE) {
        ok(CeedOperatorSetField(op, name, rstr_q, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
      } else {
        ok(CeedOperatorSetField(op, name, rstr, basis, CEED_VECTOR_ACTIVE));
      }
    };
    set("input", in);
    set("output", out);
  }
  CeedInt size;
  Restriction rstr, rstr_q;
  Basis basis;
  QFunction qf;
  Operator op;
};

/// Nodes to points with one operator, and points to nodes with its transpose.
TEST_P(OperatorTest, IdentityGivesTheBasisAndItsTranspose) {
  Random random(11);
  for (const CeedEvalMode mode : {CEED_EVAL_INTERP, CEED_EVAL_GRAD}) {
    for (CeedInt num_comp = 1; num_comp <= 9; num_comp += 4) {
      const Box mesh(2, 2, 3);
      const IdentityOperator to_points(ceed, mesh, num_comp, 4, mode, CEED_EVAL_NONE);
      const IdentityOperator back(ceed, mesh, num_comp, 4, mode, mode);
      IdentityOperator from_points(ceed, mesh, num_comp * (mode == CEED_EVAL_GRAD ? 2 : 1), 4, CEED_EVAL_NONE,
                                   CEED_EVAL_NONE);
      // NONE in, `mode` out: the restriction of the points belongs to all components of the derivative.
      ok(CeedQFunctionCreateIdentity(ceed, to_points.size, CEED_EVAL_NONE, mode, from_points.qf.out()));
      ok(CeedOperatorCreate(ceed, from_points.qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, from_points.op.out()));
      ok(CeedOperatorSetField(from_points.op, "input", to_points.rstr_q, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
      ok(CeedOperatorSetField(from_points.op, "output", to_points.rstr, to_points.basis, CEED_VECTOR_ACTIVE));
      const CeedSize num_dofs = static_cast<CeedSize>(mesh.num_nodes) * num_comp;
      const CeedSize num_values = static_cast<CeedSize>(mesh.num_elem) * 16 * to_points.size;
      expect_adjoint([&](const Values &u) { return apply_to(ceed, to_points.op, u); },
                     [&](const Values &w) { return apply_to(ceed, from_points.op, w); }, num_dofs, num_values, random,
                     tolerance(mesh.elem_size), "basis and its transpose");
      const Values u = random.reals(num_dofs);
      expect_close(apply_to(ceed, back.op, u), apply_to(ceed, from_points.op, apply_to(ceed, to_points.op, u)),
                   tolerance(16 * mesh.elem_size), "there and back");
    }
  }
}

/// The scaling QFunctions of the gallery, on stored values.
TEST_P(OperatorTest, ScalesStoredValues) {
  Random random(12);
  const CeedInt num_elem = 3, Q = 5, num_comp = 4;
  const auto strided = [&](CeedInt comp) {
    Restriction rstr;
    ok(CeedElemRestrictionCreateStrided(ceed, num_elem, Q, comp, static_cast<CeedSize>(num_elem) * Q * comp,
                                        std::vector<CeedInt>{1, Q, Q * comp}.data(), rstr.out()));
    return rstr;
  };
  const Values u = random.reals(num_elem * Q * num_comp);
  for (const CeedInt scale_comp : {num_comp, 1}) {
    const Restriction rstr_u = strided(num_comp), rstr_s = strided(scale_comp);
    const Values s = random.reals(num_elem * Q * scale_comp);
    const Vector scale = make_vector(ceed, s);
    QFunction qf;
    ok(CeedQFunctionCreateInteriorByName(ceed, scale_comp == 1 ? "Scale (scalar)" : "Scale", qf.out()));
    ok(CeedQFunctionAddInput(qf, "input", num_comp, CEED_EVAL_NONE));
    ok(CeedQFunctionAddInput(qf, "scale", scale_comp, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "output", num_comp, CEED_EVAL_NONE));
    Context context;
    ok(CeedQFunctionContextCreate(ceed, context.out()));
    ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof num_comp,
                                   const_cast<CeedInt *>(&num_comp)));
    ok(CeedQFunctionSetContext(qf, context));
    Operator op;
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "input", rstr_u, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "scale", rstr_s, CEED_BASIS_NONE, scale));
    ok(CeedOperatorSetField(op, "output", rstr_u, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    Values want(u.size());
    for (CeedInt e = 0; e < num_elem; e++) {
      for (CeedInt c = 0; c < num_comp; c++) {
        for (CeedInt q = 0; q < Q; q++) {
          const CeedInt i = q + Q * (c + num_comp * e), j = scale_comp == 1 ? q + Q * e : i;
          want[i] = u[i] * s[j];
        }
      }
    }
    expect_close(apply_to(ceed, op, u), want, tolerance(1), "scaled values");
  }
}

TEST_P(OperatorTest, ReadsTheContextAtEachApplication) {
  const Box mesh(2, 2, 3);
  AffineOperator op(ceed, mesh, 4, 1, {2, 0, 0, false});
  const Values ones(mesh.num_nodes, 1);
  // ∫ factor (shift + 1) over the reference elements, each of area 4.
  const auto integral = [&] { return dot(ones, apply_to(ceed, op.op, ones)); };
  const CeedScalar area = 4.0 * mesh.num_elem, tol = tolerance(mesh.num_nodes) * area * 10;
  EXPECT_NEAR(integral(), 2 * area, tol);
  op.set_context({3, 0.5, 0, false});
  EXPECT_NEAR(integral(), 4.5 * area, tol);
  // Through write access.
  AffineContext *data = nullptr;
  ok(CeedQFunctionContextGetData(op.context, CEED_MEM_HOST, &data));
  data->factor = -1;
  ok(CeedQFunctionContextRestoreData(op.context, &data));
  EXPECT_NEAR(integral(), -1.5 * area, tol);
  EXPECT_NEAR(integral(), -1.5 * area, tol);
}

/// Whatever multiple of points a QFunction asks for, results do not change.
TEST_P(OperatorTest, RoundsPointsUpToTheVectorLength) {
  const Box mesh(2, 2, 3);
  Random random(13);
  const Values u = random.reals(mesh.num_nodes);
  const AffineOperator plain(ceed, mesh, 3, 1, {2, 0.25, 0, false});
  const Values want = apply_to(ceed, plain.op, u);
  for (const CeedInt vec_length : {2, 4, 8, 16}) {
    SCOPED_TRACE("vec_length " + std::to_string(vec_length));
    // The context says what Q must be a multiple of; the function fails otherwise.
    const AffineOperator padded(ceed, mesh, 3, vec_length, {2, 0.25, vec_length, false});
    expect_close(apply_to(ceed, padded.op, u), want, tolerance(9), "padded operator");
  }
}

TEST_P(OperatorTest, ReportsTheErrorOfItsQFunction) {
  const Box mesh(1, 2, 2);
  const AffineOperator op(ceed, mesh, 3, 1, {1, 0, 7, false});  // 3 points are no multiple of 7: the function returns 1
  const Vector u = make_vector(ceed, mesh.num_nodes, 1), v = make_vector(ceed, mesh.num_nodes, 0);
  EXPECT_NE(CeedOperatorApply(op.op, u, v, CEED_REQUEST_IMMEDIATE), 0);
}

/// A nonlinear function: the action changes as it must, and again with new passive values.
TEST_P(OperatorTest, SeesNewPassiveValues) {
  const Box mesh(1, 3, 3);
  const Restriction rstr = mesh.restriction(ceed, 1);
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 5, CEED_GAUSS, basis.out()));
  QFunction qf;
  ok(CeedQFunctionCreateInterior(ceed, 1, squared_mass, squared_mass_loc, qf.out()));
  ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "c", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "w", 1, CEED_EVAL_WEIGHT));
  ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
  const Vector c = make_vector(ceed, mesh.num_nodes, 2);
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "u", rstr, basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "c", rstr, basis, c));
  ok(CeedOperatorSetField(op, "w", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE));
  ok(CeedOperatorSetField(op, "v", rstr, basis, CEED_VECTOR_ACTIVE));
  const Values ones(mesh.num_nodes, 1);
  const CeedScalar length = 2.0 * mesh.num_elem, tol = 100 * tolerance(mesh.num_nodes);
  // ∫ c u²
  for (const CeedScalar u : {1.0, 3.0}) {
    const CeedScalar total = dot(ones, apply_to(ceed, op, Values(mesh.num_nodes, u)));
    EXPECT_NEAR(total, 2 * u * u * length, tol * u * u);
  }
  ok(CeedVectorSetValue(c, -5));
  EXPECT_NEAR(dot(ones, apply_to(ceed, op, ones)), -5 * length, tol);
}

/// A part of a mesh may have no elements.
TEST_P(OperatorTest, WorksWithoutElements) {
  const CeedInt num_nodes = 4;
  Restriction rstr;
  ok(CeedElemRestrictionCreate(ceed, 0, 3, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, nullptr, rstr.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 4, CEED_GAUSS, basis.out()));
  QFunction qf;
  ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_INTERP, CEED_EVAL_INTERP, qf.out()));
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "input", rstr, basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "output", rstr, basis, CEED_VECTOR_ACTIVE));
  const Values zeros(num_nodes, 0), ones(num_nodes, 1);
  EXPECT_EQ(apply_to(ceed, op, ones), zeros);
  const Vector u = make_vector(ceed, ones), v = make_vector(ceed, num_nodes, 3);
  ok(CeedOperatorApplyAdd(op, u, v, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(v), Values(num_nodes, 3));
  ok(CeedOperatorLinearAssembleDiagonal(op, v, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(v), zeros);
}

/// The flops of an application: at least what its QFunction is said to take, growing with the elements.
TEST_P(OperatorTest, EstimatesFlops) {
  CeedSize previous = 0;
  for (const CeedInt n : {1, 2, 4}) {
    const Box mesh(2, n, 3);
    const AffineOperator op(ceed, mesh, 4, 1, {1, 0, 0, false});
    ok(CeedQFunctionSetUserFlopsEstimate(op.qf, 3));
    CeedSize flops = 0;
    ok(CeedOperatorGetFlopsEstimate(op.op, &flops));
    const CeedSize at_points = static_cast<CeedSize>(mesh.num_elem) * 16 * 3;
    EXPECT_GT(flops, at_points);
    // A dense contraction of each direction in turn and back is an upper bound within a small factor.
    EXPECT_LT(flops, at_points + mesh.num_elem * 2 * 4 * (4 * 3 * 3 + 4 * 4 * 3) + 100 * mesh.num_elem);
    if (previous > 0) {
      EXPECT_EQ(flops, 4 * previous);
    }
    previous = flops;
  }
}

/// What the core counts follows from the mesh; what a backend keeps is there after the first application, and applying
/// again adds nothing.
TEST_P(OperatorTest, CountsItsMemory) {
  constexpr CeedInt P_1d = 3, Q_1d = 4;
  for (const CeedInt n : {1, 3}) {
    const Box mesh(3, n, P_1d);
    const EllipticOperator poisson(ceed, mesh, Elliptic::poisson, 1, Q_1d);
    const Values in(poisson.size(), 1);
    poisson.apply(in);
    CeedOperatorMemory memory{}, again{};
    ok(CeedOperatorGetMemory(poisson.op, &memory));
    EXPECT_EQ(memory.restrictions, static_cast<CeedSize>(sizeof(CeedInt)) * mesh.num_elem * P_1d * P_1d * P_1d);
    EXPECT_EQ(memory.vectors, static_cast<CeedSize>(sizeof(CeedScalar)) * mesh.num_elem * 6 * Q_1d * Q_1d * Q_1d);
    EXPECT_GE(memory.bases, static_cast<CeedSize>(2 * P_1d * Q_1d * sizeof(CeedScalar)));
    EXPECT_GT(memory.program, 0);
    EXPECT_GE(memory.backend, 0);
    for (int i = 0; i < 3; i++) poisson.apply(in);
    ok(CeedOperatorGetMemory(poisson.op, &again));
    EXPECT_EQ(again.total, memory.total);
  }
}

/// Vectors may be longer than the points; what lies beyond them stays.
TEST_P(OperatorTest, QFunctionsWriteTheirPoints) {
  constexpr CeedInt Q = 4, length = 7;
  QFunction mass;
  ok(CeedQFunctionCreateInteriorByName(ceed, "MassApply", mass.out()));
  const Vector u = make_vector(ceed, length, 3), weights = make_vector(ceed, length, 5),
               v = make_vector(ceed, length, 0);
  Values want(length, 7);
  ok(CeedVectorSetArray(v, CEED_MEM_HOST, CEED_COPY_VALUES, want.data()));  // a device does not have them
  CeedVector in[] = {u, weights}, out[] = {v};
  ok(CeedQFunctionApply(mass, Q, in, out));
  for (CeedInt q = 0; q < Q; q++) want[q] = 15;
  expect_close(values_of(v), want, 0, "output");
}

/// Once or twice, it acts as one that was not.
TEST_P(OperatorTest, IsPreparedAheadOfTime) {
  const Box mesh(2, 2, 3);
  const EllipticOperator poisson(ceed, mesh, Elliptic::poisson, 1, 3), other(ceed, mesh, Elliptic::poisson, 1, 3);
  const Values in(poisson.size(), 1);
  ok(CeedOperatorPrepare(poisson.op));
  ok(CeedOperatorPrepareFor(poisson.op, CEED_USE_ASSEMBLE_DIAGONAL));
  ok(CeedOperatorPrepare(poisson.op));
  expect_close(poisson.apply(in), other.apply(in), tolerance(100), "action");
}

TEST_P(OperatorTest, KeepsNamesAndFields) {
  const Box mesh(1, 2, 2);
  const AffineOperator op(ceed, mesh, 3, 1, {1, 0, 0, false});
  ok(CeedOperatorSetName(op.op, "affine mass"));
  const char *name = nullptr;
  ok(CeedOperatorGetName(op.op, &name));
  EXPECT_STREQ(name, "affine mass");
  CeedInt num_in = 0, num_out = 0;
  CeedOperatorField *in = nullptr, *out = nullptr;
  ok(CeedOperatorGetFields(op.op, &num_in, &in, &num_out, &out));
  ASSERT_EQ(num_in, 2);
  ASSERT_EQ(num_out, 1);
  ok(CeedOperatorFieldGetName(in[0], &name));
  EXPECT_STREQ(name, "u");
  CeedElemRestriction rstr = nullptr;
  CeedBasis basis = nullptr;
  CeedVector vec = nullptr;
  ok(CeedOperatorFieldGetData(out[0], &name, &rstr, &basis, &vec));
  const Restriction held_rstr(rstr);
  const Basis held_basis(basis);
  const Vector held_vec(vec);
  EXPECT_STREQ(name, "v");
  EXPECT_EQ(rstr, op.rstr.get());
  EXPECT_EQ(basis, op.basis.get());
  EXPECT_EQ(vec, CEED_VECTOR_ACTIVE);
  CeedOperatorField field = nullptr;
  ok(CeedOperatorGetFieldByName(op.op, "w", &field));
  EXPECT_EQ(field, in[1]);
  ok(CeedOperatorGetFieldByName(op.op, "nothing", &field));
  EXPECT_EQ(field, nullptr);
}

INSTANTIATE_TEST_SUITE_P(Backends, OperatorTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
