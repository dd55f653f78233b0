// Assembly: reuse of what was assembled, counts that do not fit in 32 bits, rectangular operators.
#include <cstdlib>
#include <memory>

#include "backends.hpp"
#include "oracle/affine_operator.hpp"
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

/// Entries are counted past 2³¹: 1,200,000 elements of 3 components at degree 2, 27 nodes each.
TEST_P(AssemblyTest, CountsEntriesBeyond32Bits) {
  const CeedInt num_elem = 1200000;
  Restriction rstr;
  // All elements share their nodes: only the count matters.
  std::vector<CeedInt> offsets(static_cast<std::size_t>(num_elem) * 27);
  for (std::size_t i = 0; i < offsets.size(); i++) offsets[i] = static_cast<CeedInt>(i % 27);
  ok(CeedElemRestrictionCreate(ceed, num_elem, 27, 3, 27, 81, CEED_MEM_HOST, CEED_USE_POINTER, offsets.data(),
                               rstr.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 3, 3, 3, 2, CEED_GAUSS, basis.out()));
  QFunction qf;
  ok(CeedQFunctionCreateIdentity(ceed, 3, CEED_EVAL_INTERP, CEED_EVAL_INTERP, qf.out()));
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "input", rstr, basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "output", rstr, basis, CEED_VECTOR_ACTIVE));
  CeedSize count = 0;
  ok(CeedOperatorLinearAssembleGetNumEntries(op, &count));
  EXPECT_EQ(count, CeedSize{1200000} * 81 * 81);
  EXPECT_GT(count, CeedSize{1} << 31);
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
