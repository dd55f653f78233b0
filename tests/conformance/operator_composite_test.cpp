// Composite operators: the sum of their parts.
#include <algorithm>
#include <cstdlib>

#include "backends.hpp"
#include "oracle/affine_operator.hpp"
#include "oracle/instance.hpp"

namespace {

using namespace hg::test;

class CompositeTest : public BackendTest {};

/// Cases that share the lengths of their active vectors: the mesh of the first, cut and mixed anew.
std::vector<Case> parts(Random &random, bool at_points, int count) {
  std::vector<Case> cases;
  CaseWishes wishes{.dim = 2, .at_points = at_points, .is_square = true, .max_comp = 3};
  cases.push_back(random_case(random, wishes));
  while (static_cast<int>(cases.size()) < count) {
    Case other = random_case(random, wishes);
    // Stretch or fold the L-vector of the active space to the length of the first.
    Space &space = other.spaces[0];
    const CeedSize want = cases[0].spaces[0].l_size;
    if (space.elem_size * space.num_comp > want) continue;
    const CeedInt num_nodes = static_cast<CeedInt>(want / space.num_comp);
    space.comp_stride = num_nodes;
    space.offsets.clear();
    for (CeedInt e = 0; e < other.num_elem; e++) {
      for (const CeedInt node : random.distinct(space.elem_size, num_nodes)) space.offsets.push_back(node);
    }
    space.l_size = want;
    bool is_clean = true;  // a passive vector of that space would have the old length
    for (const Field &field : other.inputs) is_clean = is_clean && (field.space != 0 || field.is_active());
    if (is_clean) cases.push_back(std::move(other));
  }
  return cases;
}

void check_sum(Ceed ceed, bool at_points) {
  for (int seed = 0; seed < num_cases(12); seed++) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(4000 + static_cast<std::uint64_t>(seed));
    const std::vector<Case> cases = parts(random, at_points, 3);
    std::vector<Instance> instances;
    Operator all;
    ok(CeedOperatorCreateComposite(ceed, all.out()));
    for (const Case &c : cases) {
      instances.emplace_back(ceed, c);
      ok(CeedOperatorCompositeAddSub(all, instances.back().op));
    }
    const CeedSize n = cases[0].input_size();
    const Values in = random.reals(n), before = random.reals(n);
    Values want(n, 0), want_matrix(n * n, 0), want_diagonal(n, 0);
    CeedSize terms = 0;
    for (const Case &c : cases) {
      const Values part = apply(c, in).active, a = matrix(c);
      for (CeedSize i = 0; i < n; i++) want[i] += part[i];
      for (CeedSize i = 0; i < n * n; i++) want_matrix[i] += a[i];
      terms += num_terms(c);
    }
    for (CeedSize i = 0; i < n; i++) want_diagonal[i] = want_matrix[i * n + i];
    const CeedScalar tol = tolerance(terms);
    expect_close(apply_to(ceed, all, in), want, tol, "sum");
    const Vector u = make_vector(ceed, in), v = make_vector(ceed, before);
    ok(CeedOperatorApplyAdd(all, u, v, CEED_REQUEST_IMMEDIATE));
    for (CeedSize i = 0; i < n; i++) want[i] += before[i];
    expect_close(values_of(v), want, tol, "added sum");
    ok(CeedOperatorLinearAssembleDiagonal(all, v, CEED_REQUEST_IMMEDIATE));
    expect_close(values_of(v), want_diagonal, tol, "diagonal", max_norm(want_matrix));
    expect_close(dense_from_coordinates(all, ceed, n, n), want_matrix, tol, "matrix");
  }
}

TEST_P(CompositeTest, IsTheSumOfItsPartsAtQuadraturePoints) {
  check_sum(ceed, false);
}
TEST_P(CompositeTest, IsTheSumOfItsPartsAtPoints) {
  check_sum(ceed, true);
}

/// Sub-operators with other active lengths in and out, one of them without an active input.
TEST_P(CompositeTest, TakesPartsWithoutActiveInput) {
  const Box mesh(1, 3, 3);
  const AffineOperator affine(ceed, mesh, 4, 1, {2, 0, 0, false});
  // A load: v = c from a passive vector.
  QFunction qf;
  ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_INTERP, CEED_EVAL_INTERP, qf.out()));
  const Values c = Random(5).reals(mesh.num_nodes);
  const Vector passive = make_vector(ceed, c);
  Operator load, all;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, load.out()));
  ok(CeedOperatorSetField(load, "input", affine.rstr, affine.basis, passive));
  ok(CeedOperatorSetField(load, "output", affine.rstr, affine.basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(all, affine.op));
  ok(CeedOperatorCompositeAddSub(all, load));

  const Values u = Random(6).reals(mesh.num_nodes);
  Values want = apply_to(ceed, affine.op, u);
  const Vector v = make_vector(ceed, mesh.num_nodes, 1e30);
  ok(CeedOperatorApply(load, CEED_VECTOR_NONE, v, CEED_REQUEST_IMMEDIATE));
  const Values loads = values_of(v);
  for (std::size_t i = 0; i < want.size(); i++) want[i] += loads[i];
  expect_close(apply_to(ceed, all, u), want, tolerance(20), "sum with a load");
}

TEST_P(CompositeTest, ListsItsParts) {
  const Box mesh(1, 2, 2);
  const AffineOperator first(ceed, mesh, 3, 1, {1, 0, 0, false}), second(ceed, mesh, 3, 1, {2, 0, 0, false});
  ok(CeedOperatorSetName(second.op, "the second"));
  Operator all;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(all, first.op));
  ok(CeedOperatorCompositeAddSub(all, second.op));
  CeedInt count = 0;
  CeedOperator *subs = nullptr, found = nullptr;
  ok(CeedOperatorCompositeGetNumSub(all, &count));
  ASSERT_EQ(count, 2);
  ok(CeedOperatorCompositeGetSubList(all, &subs));
  EXPECT_EQ(subs[0], first.op.get());
  EXPECT_EQ(subs[1], second.op.get());
  ok(CeedOperatorCompositeGetSubByName(all, "the second", &found));
  EXPECT_EQ(found, second.op.get());
  ok(CeedOperatorCompositeGetSubByName(all, "a third", &found));
  EXPECT_EQ(found, nullptr);
  bool is_composite = false, is_sequential = true;
  ok(CeedOperatorIsComposite(all, &is_composite));
  EXPECT_TRUE(is_composite);
  ok(CeedOperatorIsComposite(first.op, &is_composite));
  EXPECT_FALSE(is_composite);
  ok(CeedOperatorCompositeIsSequential(all, &is_sequential));
  EXPECT_FALSE(is_sequential);
  ok(CeedOperatorCompositeSetSequential(all, true));
  ok(CeedOperatorCompositeIsSequential(all, &is_sequential));
  EXPECT_TRUE(is_sequential);
}

/// Sub-operators outlive the handles of those who made them.
TEST_P(CompositeTest, KeepsItsParts) {
  const Box mesh(1, 2, 2);
  Operator all;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  {
    const AffineOperator part(ceed, mesh, 3, 1, {1, 0, 0, false});
    ok(CeedOperatorCompositeAddSub(all, part.op));
  }
  const Values ones(mesh.num_nodes, 1);
  EXPECT_NEAR(dot(ones, apply_to(ceed, all, ones)), 4, 100 * tolerance(4));
}

/// The flops of a composite are those of its parts.
TEST_P(CompositeTest, CountsTheFlopsOfItsParts) {
  const Box mesh(1, 2, 2);
  const AffineOperator first(ceed, mesh, 3, 1, {1, 0, 0, false}), second(ceed, mesh, 5, 1, {2, 0, 0, false});
  ok(CeedQFunctionSetUserFlopsEstimate(first.qf, 3));
  ok(CeedQFunctionSetUserFlopsEstimate(second.qf, 3));
  Operator all;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(all, first.op));
  ok(CeedOperatorCompositeAddSub(all, second.op));
  CeedSize total = 0, a = 0, b = 0;
  ok(CeedOperatorGetFlopsEstimate(all, &total));
  ok(CeedOperatorGetFlopsEstimate(first.op, &a));
  ok(CeedOperatorGetFlopsEstimate(second.op, &b));
  EXPECT_EQ(total, a + b);
  EXPECT_GT(b, a);
}

// A process without elements has nothing to add: its composite is zero, for vectors of any length.
TEST_P(CompositeTest, NoSubOperatorsIsZero) {
  Operator none;
  ok(CeedOperatorCreateComposite(ceed, none.out()));
  const Values some = {1, 2, 3}, zero(3, 0);
  const Vector u = make_vector(ceed, some), v = make_vector(ceed, some);
  ok(CeedOperatorApplyAdd(none, u, v, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(v), some);
  ok(CeedOperatorApply(none, u, v, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(v), zero);
  ok(CeedVectorSetValue(v, 7));
  ok(CeedOperatorLinearAssembleDiagonal(none, v, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(v), zero);
  CeedSize num_entries = -1;
  CeedInt *rows = nullptr, *cols = nullptr;
  ok(CeedOperatorLinearAssembleSymbolic(none, &num_entries, &rows, &cols));
  EXPECT_EQ(num_entries, 0);
  std::free(rows);
  std::free(cols);
}

/// Nor has one that is a part of another: the others decide what vectors there are.
TEST_P(CompositeTest, PartsWithoutSubOperatorsCountForNothing) {
  const Box mesh(1, 3, 3);
  const AffineOperator part(ceed, mesh, 4, 1, {1, 0, 0, false});
  const Values u = Random(8).reals(mesh.num_nodes), want = apply_to(ceed, part.op, u);
  for (const bool is_first : {true, false}) {
    Operator nothing, of_nothing, all;
    ok(CeedOperatorCreateComposite(ceed, nothing.out()));
    ok(CeedOperatorCreateComposite(ceed, of_nothing.out()));
    ok(CeedOperatorCreateComposite(ceed, all.out()));
    ok(CeedOperatorCompositeAddSub(of_nothing, nothing));
    if (!is_first) ok(CeedOperatorCompositeAddSub(all, part.op));
    ok(CeedOperatorCompositeAddSub(all, nothing));
    ok(CeedOperatorCompositeAddSub(all, of_nothing));
    if (is_first) ok(CeedOperatorCompositeAddSub(all, part.op));
    ok(CeedOperatorCheckReady(all));
    CeedSize in = 0, out = 0;
    ok(CeedOperatorGetActiveVectorLengths(all, &in, &out));
    EXPECT_EQ(in, mesh.num_nodes);
    EXPECT_EQ(out, mesh.num_nodes);
    expect_close(apply_to(ceed, all, u), want, tolerance(mesh.num_nodes), "with parts of nothing");
    // Alone it is zero.
    const Vector v = make_vector(ceed, 3, 5.0), w = make_vector(ceed, 3, 1.0);
    ok(CeedOperatorApply(of_nothing, w, v, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(values_of(v), Values(3, 0.0));
    ok(CeedVectorSetValue(v, 5.0));
    ok(CeedOperatorLinearAssembleDiagonal(of_nothing, v, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(values_of(v), Values(3, 0.0));
  }
}

TEST_P(CompositeTest, RefusesToContainItself) {
  const Box mesh(1, 2, 2);
  const AffineOperator part(ceed, mesh, 3, 1, {1, 0, 0, false});
  Operator inner, middle, outer;
  for (Operator *op : {&inner, &middle, &outer}) ok(CeedOperatorCreateComposite(ceed, op->out()));
  ok(CeedOperatorSetName(inner, "inner"));
  ok(CeedOperatorSetName(outer, "outer"));
  ok(CeedOperatorCompositeAddSub(outer, middle));
  ok(CeedOperatorCompositeAddSub(middle, inner));
  expect_error(CeedOperatorCompositeAddSub(inner, inner), CEED_ERROR_MINOR, {"inner"});
  expect_error(CeedOperatorCompositeAddSub(inner, middle), CEED_ERROR_MINOR, {"inner"});
  expect_error(CeedOperatorCompositeAddSub(inner, outer), CEED_ERROR_MINOR, {"inner"});
  // The same part twice is another matter.
  ok(CeedOperatorCompositeAddSub(inner, part.op));
  ok(CeedOperatorCompositeAddSub(outer, inner));
  const Values u = Random(9).reals(mesh.num_nodes);
  Values want = apply_to(ceed, part.op, u);
  for (CeedScalar &value : want) value *= 2;
  expect_close(apply_to(ceed, outer, u), want, tolerance(mesh.num_nodes), "twice the part");
}

/// Whether entry i of the active input is read by a case.
std::vector<bool> used_entries(const Case &c) {
  std::vector<bool> is_used(static_cast<std::size_t>(c.input_size()));
  for (const Field &field : c.inputs) {
    for (CeedInt e = 0; field.is_active() && e < c.num_elem; e++) {
      for (CeedInt q = 0; q < c.num_points[e]; q++) {
        for (const auto &value : terms(c, field, e, q)) {
          for (const Term &term : value) is_used[term.index] = true;
        }
      }
    }
  }
  return is_used;
}

TEST_P(CompositeTest, CountsTheSubOperatorsThatReadAnEntry) {
  for (int seed = 0; seed < 12; seed++) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(4500 + static_cast<std::uint64_t>(seed));
    const std::vector<Case> cases = parts(random, false, 4);
    std::vector<Instance> instances;
    Operator all, nested;
    ok(CeedOperatorCreateComposite(ceed, all.out()));
    ok(CeedOperatorCreateComposite(ceed, nested.out()));
    for (const Case &c : cases) instances.emplace_back(ceed, c);
    // The last two together are the third part.
    for (int i = 0; i < 4; i++) ok(CeedOperatorCompositeAddSub(i < 2 ? all : nested, instances[i].op));
    ok(CeedOperatorCompositeAddSub(all, nested));
    const CeedSize n = cases[0].input_size();
    const Vector mult = make_vector(ceed, n + 1, 9.0);
    const auto expect_parts = [&](std::vector<CeedInt> skipped) {
      const auto is_in = [&](CeedInt part) { return std::count(skipped.begin(), skipped.end(), part) == 0; };
      ok(CeedOperatorCompositeGetMultiplicity(all, static_cast<CeedInt>(skipped.size()), skipped.data(), mult));
      std::vector<std::vector<bool>> used;
      for (const Case &c : cases) used.push_back(used_entries(c));
      Values want(static_cast<std::size_t>(n) + 1, 0.0);
      for (CeedSize i = 0; i < n; i++) {
        want[i] += is_in(0) && used[0][i] ? 1 : 0;
        want[i] += is_in(1) && used[1][i] ? 1 : 0;
        want[i] += is_in(2) && (used[2][i] || used[3][i]) ? 1 : 0;
      }
      EXPECT_EQ(values_of(mult), want);
    };
    expect_parts({});
    expect_parts({1});
    expect_parts({2, 0, 2});
    expect_parts({0, 1, 2});
    // Asking does not end the making.
    ok(CeedOperatorCompositeAddSub(all, instances[0].op));
  }
}

TEST_P(CompositeTest, RefusesBadMultiplicities) {
  Random random(4600);
  const Instance instance(ceed, random_case(random, {.is_square = true}));
  Operator all, empty;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCreateComposite(ceed, empty.out()));
  ok(CeedOperatorCompositeAddSub(all, instance.op));
  CeedSize n = 0;
  ok(CeedOperatorGetActiveVectorLengths(all, &n, nullptr));
  const Vector mult = make_vector(ceed, n, 1.0), shorter = make_vector(ceed, n - 1, 1.0);
  CeedInt beyond = 1, below = -1;
  const auto get = [&](CeedOperator op, CeedInt count, CeedInt *indices, CeedVector vec) {
    return CeedOperatorCompositeGetMultiplicity(op, count, indices, vec);
  };
  expect_error(get(instance.op, 0, nullptr, mult), CEED_ERROR_MINOR, {"not composite"});
  expect_error(get(all, 1, &beyond, mult), CEED_ERROR_DIMENSION, {"to skip is 1", "[0, 1)"});
  expect_error(get(all, 1, &below, mult), CEED_ERROR_DIMENSION, {"to skip is -1"});
  expect_error(get(all, 1, nullptr, mult), CEED_ERROR_MINOR, {"1 indices to skip"});
  expect_error(get(all, -1, &beyond, mult), CEED_ERROR_MINOR, {"-1 indices to skip"});
  expect_error(get(all, 0, nullptr, shorter), CEED_ERROR_DIMENSION,
               {"has " + std::to_string(n - 1) + " entries", "size " + std::to_string(n)});
  ok(get(empty, 0, nullptr, mult));
  EXPECT_EQ(values_of(mult), Values(static_cast<std::size_t>(n), 0.0));
}

INSTANTIATE_TEST_SUITE_P(Backends, CompositeTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
