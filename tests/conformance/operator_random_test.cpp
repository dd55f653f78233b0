// Random operators at quadrature points and at material points against the oracle.
#include <algorithm>

#include "backends.hpp"
#include "oracle/instance.hpp"

namespace {

using namespace hg::test;

/// The seeds of the cases: each names a case for ever.
const int num_seeds = num_cases(60);

class RandomOperator : public BackendTest {
 protected:
  /// Runs `check` on `count` random cases.
  template <typename F>
  void for_cases(CaseWishes wishes, int count, F &&check) {
    for (int seed = 0; seed < count && !HasFatalFailure(); seed++) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(1000 + static_cast<std::uint64_t>(seed));
      if (wishes.dim == 0 || seed >= 3) wishes.dim = 1 + seed % 3;
      const Case c = random_case(random, wishes);
      SCOPED_TRACE(describe(c));
      check(c, random);
      if (HasFailure()) break;  // one broken case says enough
    }
  }
};

/// The case without orientations: these may add functions that cancel, and rounding is relative to what cancelled.
Case without_orientations(Case c) {
  for (Space &space : c.spaces) space.orientation.clear();
  return c;
}

/// Passive inputs must be as they were; passive outputs are compared.
void expect_passive(const Case &c, const Instance &instance, const Outcome &want, CeedScalar tol) {
  for (std::size_t i = 0; i < c.passive.size(); i++) {
    const Values got = values_of(instance.passive[i]);
    if (is_output(c, static_cast<int>(i))) {
      expect_close(got, want.passive[i], tol, "passive output " + std::to_string(i));
    } else {
      EXPECT_EQ(got, c.passive[i]) << "passive input " << i << " was changed";
    }
  }
}

void check_apply(Ceed ceed, const Case &c, Random &random) {
  const Instance instance(ceed, c);
  const CeedScalar tol = tolerance(num_terms(c));
  for (int repeat = 0; repeat < 2; repeat++) {
    const Values in = random.reals(c.input_size());
    const Outcome want = apply(c, in);
    expect_close(apply(instance, c, in), want.active, tol, "active output",
                 max_norm(hg::test::apply(without_orientations(c), in).active));
    expect_passive(c, instance, want, tol);
  }
}

TEST_P(RandomOperator, AppliesAtQuadraturePoints) {
  for_cases({}, num_seeds, [&](const Case &c, Random &random) { check_apply(ceed, c, random); });
}

TEST_P(RandomOperator, AppliesInMixedSpaces) {
  int num_tabulated[4] = {}, num_tensor = 0;
  for_cases({.mixes_spaces = true}, num_seeds, [&](const Case &c, Random &random) {
    check_apply(ceed, c, random);
    for (const Space &space : c.spaces) {
      if (space.is_tabulated()) num_tabulated[space.kind]++;
      if (space.P_1d > 0) num_tensor++;
    }
  });
  for (const CeedFESpace kind : {CEED_FE_SPACE_H1, CEED_FE_SPACE_HDIV, CEED_FE_SPACE_HCURL}) {
    EXPECT_GE(num_tabulated[kind], num_cases(10)) << CeedFESpaces[kind];
  }
  EXPECT_GE(num_tensor, num_cases(10));
}

TEST_P(RandomOperator, AppliesTensorProductsOfMatrices) {
  int num_given = 0;
  for_cases({.has_matrices = true}, num_seeds, [&](const Case &c, Random &random) {
    check_apply(ceed, c, random);
    for (const Space &space : c.spaces) num_given += !space.interp_1d.empty();
  });
  EXPECT_GE(num_given, num_cases(10));
}

TEST_P(RandomOperator, AppliesAtPoints) {
  for_cases({.at_points = true}, num_seeds, [&](const Case &c, Random &random) { check_apply(ceed, c, random); });
}

TEST_P(RandomOperator, AppliesWithOrientations) {
  for_cases({.is_oriented = true}, num_seeds, [&](const Case &c, Random &random) { check_apply(ceed, c, random); });
  for_cases({.at_points = true, .is_oriented = true}, num_seeds,
            [&](const Case &c, Random &random) { check_apply(ceed, c, random); });
  for_cases({.is_oriented = true, .mixes_spaces = true}, num_seeds,
            [&](const Case &c, Random &random) { check_apply(ceed, c, random); });
}

void check_apply_add(Ceed ceed, const Case &c, Random &random) {
  const Instance instance(ceed, c);
  const CeedScalar tol = tolerance(num_terms(c));
  const Values in = random.reals(c.input_size()), before = random.reals(c.output_size());
  const Outcome action = apply(c, in);
  Vector u, v;
  if (c.input_size() > 0) u = make_vector(ceed, in);
  if (c.output_size() > 0) v = make_vector(ceed, before);
  const CeedVector in_vec = u ? u.get() : CEED_VECTOR_NONE, out_vec = v ? v.get() : CEED_VECTOR_NONE;

  ok(CeedOperatorApplyAdd(instance.op, in_vec, out_vec, CEED_REQUEST_IMMEDIATE));
  Outcome want = action;
  for (std::size_t i = 0; i < before.size(); i++) want.active[i] += before[i];
  for (std::size_t k = 0; k < c.passive.size(); k++) {
    for (std::size_t i = 0; i < c.passive[k].size(); i++) want.passive[k][i] += c.passive[k][i];
  }
  if (v) expect_close(values_of(v), want.active, tol, "active output of ApplyAdd");
  expect_passive(c, instance, want, tol);

  ok(CeedOperatorApplyAddActive(instance.op, in_vec, out_vec, CEED_REQUEST_IMMEDIATE));
  for (std::size_t i = 0; i < before.size(); i++) want.active[i] += action.active[i];
  if (v) expect_close(values_of(v), want.active, tol, "active output of ApplyAddActive");
  want.passive = action.passive;
  expect_passive(c, instance, want, tol);
}

TEST_P(RandomOperator, AddsAtQuadraturePoints) {
  for_cases({}, num_seeds, [&](const Case &c, Random &random) { check_apply_add(ceed, c, random); });
}

TEST_P(RandomOperator, AddsInMixedSpaces) {
  for_cases({.mixes_spaces = true}, num_seeds,
            [&](const Case &c, Random &random) { check_apply_add(ceed, c, random); });
}

TEST_P(RandomOperator, AddsAtPoints) {
  for_cases({.at_points = true}, num_seeds, [&](const Case &c, Random &random) { check_apply_add(ceed, c, random); });
}

void check_assembled_qfunction(Ceed ceed, const Case &c) {
  const Instance instance(ceed, c);
  Vector assembled;
  Restriction rstr;
  ok(CeedOperatorLinearAssembleQFunction(instance.op, assembled.out(), rstr.out(), CEED_REQUEST_IMMEDIATE));
  const std::vector<Values> got = by_element(rstr, assembled);
  ASSERT_EQ(static_cast<CeedInt>(got.size()), c.num_elem);
  for (CeedInt e = 0; e < c.num_elem; e++) {
    Values want;
    for (CeedInt q = 0; q < c.num_points[e]; q++) {
      const Values d = qfunction_matrix(c, e, q);
      CeedInt num_in = 0;
      for (const Field &field : c.inputs) num_in += field.is_active() ? c.size(field) : 0;
      const CeedInt num_out = static_cast<CeedInt>(d.size()) / num_in;
      for (CeedInt i = 0; i < num_in; i++) {
        for (CeedInt o = 0; o < num_out; o++) want.push_back(d[o * num_in + i]);
      }
    }
    expect_close(got[e], want, tolerance(num_terms(c)), "QFunction of element " + std::to_string(e));
  }
}

TEST_P(RandomOperator, AssemblesTheQFunctionAtQuadraturePoints) {
  for_cases({.is_bilinear = true}, num_seeds, [&](const Case &c, Random &) { check_assembled_qfunction(ceed, c); });
}

TEST_P(RandomOperator, AssemblesTheQFunctionInMixedSpaces) {
  for_cases({.is_bilinear = true, .mixes_spaces = true}, num_seeds,
            [&](const Case &c, Random &) { check_assembled_qfunction(ceed, c); });
}

TEST_P(RandomOperator, AssemblesTheQFunctionAtPoints) {
  for_cases({.at_points = true, .is_bilinear = true}, num_seeds,
            [&](const Case &c, Random &) { check_assembled_qfunction(ceed, c); });
}

void check_diagonal(Ceed ceed, const Case &c, Random &random) {
  const Instance instance(ceed, c);
  const CeedSize n = c.input_size();
  const Values a = matrix(c);
  Values want(n);
  for (CeedSize i = 0; i < n; i++) want[i] = a[i * n + i];
  const CeedScalar tol = tolerance(num_terms(c));
  const Vector diagonal = make_vector(ceed, n, 1e30);
  ok(CeedOperatorLinearAssembleDiagonal(instance.op, diagonal, CEED_REQUEST_IMMEDIATE));
  // Terms of both signs cancel in a diagonal; rounding is relative to the matrix.
  const CeedScalar scale = std::max(max_norm(a), max_norm(matrix(without_orientations(c))));
  expect_close(values_of(diagonal), want, tol, "diagonal", scale);
  const Values before = random.reals(n);
  set_values(diagonal, before);
  ok(CeedOperatorLinearAssembleAddDiagonal(instance.op, diagonal, CEED_REQUEST_IMMEDIATE));
  for (CeedSize i = 0; i < n; i++) want[i] += before[i];
  expect_close(values_of(diagonal), want, tol, "added diagonal", scale);
}

TEST_P(RandomOperator, AssemblesTheDiagonalAtQuadraturePoints) {
  for_cases({.is_square = true, .max_comp = 4}, num_seeds,
            [&](const Case &c, Random &random) { check_diagonal(ceed, c, random); });
}

TEST_P(RandomOperator, AssemblesTheDiagonalInMixedSpaces) {
  for_cases({.is_square = true, .max_comp = 4, .mixes_spaces = true}, num_seeds,
            [&](const Case &c, Random &random) { check_diagonal(ceed, c, random); });
}

TEST_P(RandomOperator, AssemblesTheDiagonalAtPoints) {
  for_cases({.at_points = true, .is_square = true, .max_comp = 4}, num_seeds,
            [&](const Case &c, Random &random) { check_diagonal(ceed, c, random); });
}

TEST_P(RandomOperator, AssemblesTheDiagonalWithOrientations) {
  for (const bool at_points : {false, true}) {
    for_cases({.at_points = at_points, .is_square = true, .max_comp = 4, .is_oriented = true}, num_seeds,
              [&](const Case &c, Random &random) { check_diagonal(ceed, c, random); });
  }
  for_cases({.is_square = true, .max_comp = 4, .is_oriented = true, .mixes_spaces = true}, num_seeds,
            [&](const Case &c, Random &random) { check_diagonal(ceed, c, random); });
}

void check_matrix(Ceed ceed, const Case &c) {
  const Instance instance(ceed, c);
  const Values want = matrix(c);
  const Values got = dense_from_coordinates(instance.op, ceed, c.output_size(), c.input_size());
  expect_close(got, want, tolerance(num_terms(c)), "assembled matrix", max_norm(matrix(without_orientations(c))));
}

TEST_P(RandomOperator, AssemblesTheMatrixAtQuadraturePoints) {
  for_cases({.is_square = true, .max_comp = 3}, num_seeds, [&](const Case &c, Random &) { check_matrix(ceed, c); });
}

/// Several active bases too: the matrix has a block for each pair.
TEST_P(RandomOperator, AssemblesTheMatrixInMixedSpaces) {
  int num_several = 0;
  for_cases({.is_bilinear = true, .max_comp = 3, .mixes_spaces = true}, num_seeds, [&](const Case &c, Random &) {
    check_matrix(ceed, c);
    for (const std::vector<Field> *fields : {&c.inputs, &c.outputs}) {
      for (const Field &field : *fields) num_several += field.is_active() && field.space != fields->front().space;
    }
  });
  EXPECT_GE(num_several, num_cases(10));
}

TEST_P(RandomOperator, AssemblesTheMatrixAtPoints) {
  for_cases({.at_points = true, .is_square = true, .max_comp = 3}, num_seeds,
            [&](const Case &c, Random &) { check_matrix(ceed, c); });
}

TEST_P(RandomOperator, AssemblesTheMatrixWithOrientations) {
  for (const bool at_points : {false, true}) {
    for_cases({.at_points = at_points, .is_square = true, .max_comp = 3, .is_oriented = true}, num_seeds,
              [&](const Case &c, Random &) { check_matrix(ceed, c); });
  }
  for_cases({.is_bilinear = true, .max_comp = 3, .is_oriented = true, .mixes_spaces = true}, num_seeds,
            [&](const Case &c, Random &) { check_matrix(ceed, c); });
}

TEST_P(RandomOperator, SaysItsSizes) {
  for_cases({}, num_seeds, [&](const Case &c, Random &) {
    const Instance instance(ceed, c);
    ok(CeedOperatorCheckReady(instance.op));
    CeedSize in = 0, out = 0;
    ok(CeedOperatorGetActiveVectorLengths(instance.op, &in, &out));
    EXPECT_EQ(in, c.input_size() > 0 ? c.input_size() : -1);
    EXPECT_EQ(out, c.output_size() > 0 ? c.output_size() : -1);
    CeedInt num_elem = 0, num_qpts = 0;
    ok(CeedOperatorGetNumElements(instance.op, &num_elem));
    ok(CeedOperatorGetNumQuadraturePoints(instance.op, &num_qpts));
    EXPECT_EQ(num_elem, c.num_elem);
    EXPECT_EQ(num_qpts, c.max_points());
  });
}

INSTANTIATE_TEST_SUITE_P(Backends, RandomOperator, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
