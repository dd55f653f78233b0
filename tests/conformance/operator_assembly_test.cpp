// Assembly: reuse of what was assembled, rectangular operators, many elements.
#include <cstdlib>
#include <memory>

#include "backends.hpp"
#include "oracle/affine_operator.hpp"
#include "oracle/blend_operator.hpp"
#include "oracle/elliptic.hpp"
#include "oracle/instance.hpp"

namespace {

using namespace hg::test;

class AssemblyTest : public BackendTest {};

/// Row sums of the mass matrix are the integrals of the basis functions, and Poisson's are zero; the matrix is
/// symmetric.
TEST_P(AssemblyTest, GivesTheMatricesOfTheGallery) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (const Elliptic kind : {Elliptic::mass, Elliptic::poisson}) {
      const Box mesh(dim, 2, 3, bent);
      const EllipticOperator op(ceed, mesh, kind, 1, 4);
      const CeedSize n = op.size();
      const Values a = dense_from_coordinates(op.op, ceed, n, n), ones(n, 1);
      Values row_sums(n, 0), transposed(n * n);
      for (CeedSize i = 0; i < n; i++) {
        for (CeedSize j = 0; j < n; j++) {
          row_sums[i] += a[i * n + j];
          transposed[j * n + i] = a[i * n + j];
        }
      }
      expect_close(row_sums, op.apply(ones), tolerance(n), "row sums", max_norm(a));
      expect_close(transposed, a, tolerance(64), "symmetry");
    }
  }
}

/// Trial and test functions in two spaces: a rectangular matrix.
TEST_P(AssemblyTest, GivesRectangularMatrices) {
  int found = 0;
  for (int seed = 0; seed < 60; seed++) {
    Random random(5000 + static_cast<std::uint64_t>(seed));
    const Case c = random_case(random, {.dim = 1 + seed % 2, .is_bilinear = true, .max_comp = 2});
    if (c.input_size() == c.output_size()) continue;
    found++;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(c));
    const Instance instance(ceed, c);
    expect_close(dense_from_coordinates(instance.op, ceed, c.output_size(), c.input_size()), matrix(c),
                 tolerance(num_terms(c)), "rectangular matrix");
    // It has no diagonal.
    const Vector diagonal = make_vector(ceed, c.output_size(), 0);
    EXPECT_GT(CeedOperatorLinearAssembleDiagonal(instance.op, diagonal, CEED_REQUEST_IMMEDIATE), 0);
    if (HasFailure()) return;
  }
  EXPECT_GE(found, 10);
}

/// What is kept is used until an update is asked for.
TEST_P(AssemblyTest, KeepsTheQFunctionWhenAsked) {
  const Box mesh(2, 2, 3);
  AffineOperator op(ceed, mesh, 4, 1, {2, 0, 0, false});
  const auto trace = [&] {
    const Vector v = make_vector(ceed, mesh.num_nodes, 0);
    ok(CeedOperatorLinearAssembleDiagonal(op.op, v, CEED_REQUEST_IMMEDIATE));
    return dot(values_of(v), Values(mesh.num_nodes, 1));
  };
  const CeedScalar two = trace();
  op.set_context({3, 0, 0, false});
  const CeedScalar tol = 1e-12 * two;
  EXPECT_NEAR(trace(), 1.5 * two, tol) << "without reuse each assembly is new";
  ok(CeedOperatorSetQFunctionAssemblyReuse(op.op, true));
  EXPECT_NEAR(trace(), 1.5 * two, tol);
  op.set_context({4, 0, 0, false});
  ok(CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(op.op, false));
  EXPECT_NEAR(trace(), 1.5 * two, tol) << "the QFunction that was kept";
  ok(CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(op.op, true));
  EXPECT_NEAR(trace(), 2 * two, tol) << "the QFunction anew";
  ok(CeedOperatorSetQFunctionAssemblyReuse(op.op, false));
  op.set_context({5, 0, 0, false});
  EXPECT_NEAR(trace(), 2.5 * two, tol);
  ok(CeedOperatorAssemblyDataStrip(op.op));
  EXPECT_NEAR(trace(), 2.5 * two, tol);
}

TEST_P(AssemblyTest, BuildsOrUpdatesTheQFunction) {
  const Box mesh(1, 3, 3);
  AffineOperator op(ceed, mesh, 4, 1, {2, 0, 0, false});
  CeedVector assembled = nullptr;
  CeedElemRestriction rstr = nullptr;
  ok(CeedOperatorLinearAssembleQFunctionBuildOrUpdate(op.op, &assembled, &rstr, CEED_REQUEST_IMMEDIATE));
  Vector held(assembled);
  Restriction held_rstr(rstr);
  const Values before = values_of(held);
  op.set_context({-4, 0, 0, false});
  ok(CeedOperatorLinearAssembleQFunctionBuildOrUpdate(op.op, held.address(), held_rstr.address(),
                                                      CEED_REQUEST_IMMEDIATE));
  Values want = before;
  for (CeedScalar &value : want) value *= -2;
  expect_close(values_of(held), want, tolerance(4), "updated QFunction");
  CeedInt num_comp = 0;
  ok(CeedElemRestrictionGetNumComponents(held_rstr, &num_comp));
  EXPECT_EQ(num_comp, 1);
}

/// The same at points, where moved points make what was kept useless.
TEST_P(AssemblyTest, KeepsTheQFunctionAtPoints) {
  const CeedInt num_elem = 2;
  const CeedInt nodes[6] = {0, 1, 2, 2, 3, 4}, few[6] = {3, 5, 6, 0, 2, 1}, many[9] = {3, 6, 9, 5, 0, 3, 2, 4, 1};
  Random random(99);
  Restriction rstr;
  ok(CeedElemRestrictionCreate(ceed, num_elem, 3, 1, 1, 5, CEED_MEM_HOST, CEED_COPY_VALUES, nodes, rstr.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 3, CEED_GAUSS, basis.out()));
  const auto make_points = [&](const CeedInt *offsets, CeedInt count, Restriction &points_rstr) {
    ok(CeedElemRestrictionCreateAtPoints(ceed, num_elem, count, 1, count, CEED_MEM_HOST, CEED_COPY_VALUES, offsets,
                                         points_rstr.out()));
  };
  Restriction rstr_few, rstr_many;
  make_points(few, 3, rstr_few);
  make_points(many, 6, rstr_many);
  const Vector x_few = make_vector(ceed, random.reals(3)), x_many = make_vector(ceed, random.reals(6)),
               s_few = make_vector(ceed, random.reals(3)), s_many = make_vector(ceed, random.reals(6));
  const auto make_operator = [&](CeedElemRestriction at, CeedVector s, CeedVector x) {
    return make_blend(ceed, 7,
                      {{CEED_EVAL_GRAD, 1, rstr, basis, CEED_VECTOR_ACTIVE}, {CEED_EVAL_NONE, 1, at, CEED_BASIS_NONE, s}},
                      {{CEED_EVAL_INTERP, 1, rstr, basis, CEED_VECTOR_ACTIVE}}, {at, x});
  };
  const auto diagonal = [&](CeedOperator op) {
    const Vector v = make_vector(ceed, 5, 1e30);
    ok(CeedOperatorLinearAssembleDiagonal(op, v, CEED_REQUEST_IMMEDIATE));
    return values_of(v);
  };
  const Operator op = make_operator(rstr_few, s_few, x_few);
  ok(CeedOperatorSetQFunctionAssemblyReuse(op, true));
  const Values first = diagonal(op);
  set_values(s_few, random.reals(3));
  EXPECT_EQ(diagonal(op), first) << "the QFunction that was kept";
  ok(CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(op, true));
  expect_close(diagonal(op), diagonal(make_operator(rstr_few, s_few, x_few)), tolerance(50), "new values");
  ok(CeedOperatorAtPointsSetPoints(op, rstr_many, x_many));
  ok(CeedOperatorSetField(op, "in1", rstr_many, CEED_BASIS_NONE, s_many));
  expect_close(diagonal(op), diagonal(make_operator(rstr_many, s_many, x_many)), tolerance(50), "moved points");
  const Vector s_other = make_vector(ceed, random.reals(6));
  ok(CeedOperatorSetField(op, "in1", rstr_many, CEED_BASIS_NONE, s_other));
  expect_close(diagonal(op), diagonal(make_operator(rstr_many, s_other, x_many)), tolerance(50), "another field");
}

/// Thousands of elements: assembly in pieces gives what it gives at once.
TEST_P(AssemblyTest, AssemblesManyElements) {
  const Box mesh(2, 60, 2);
  const EllipticOperator op(ceed, mesh, Elliptic::poisson, 3, 5);
  const CeedSize n = op.size();
  // The diagonal by colours: on a structured mesh, nodes three apart share no element.
  Values want(n, 0);
  const CeedInt line = 61;
  for (CeedInt colour = 0; colour < 27; colour++) {
    Values probe(n, 0);
    const auto is_lit = [&](CeedSize i) {
      const CeedSize node = i % mesh.num_nodes, comp = i / mesh.num_nodes;
      return comp == colour / 9 && node % line % 3 == colour % 3 && node / line % 3 == colour / 3 % 3;
    };
    for (CeedSize i = 0; i < n; i++) probe[i] = is_lit(i) ? 1 : 0;
    const Values column = op.apply(probe);
    for (CeedSize i = 0; i < n; i++) {
      if (is_lit(i)) want[i] = column[i];
    }
  }
  const Vector diagonal = make_vector(ceed, n, 0);
  ok(CeedOperatorLinearAssembleDiagonal(op.op, diagonal, CEED_REQUEST_IMMEDIATE));
  expect_close(values_of(diagonal), want, tolerance(200), "diagonal");
}

INSTANTIATE_TEST_SUITE_P(Backends, AssemblyTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
