#include "right.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "conformance/oracle/random_operator.hpp"
#include "graph.hpp"

namespace hg::fuzz {

using namespace hg::test;

namespace {

void expect_near(const Values &got, const Values &want, CeedScalar tol, CeedScalar scale, const std::string &what) {
  if (got.size() != want.size()) {
    throw Defect(what + ": " + std::to_string(got.size()) + " values; expected " + std::to_string(want.size()));
  }
  const CeedScalar difference = max_difference(got, want), allowed = tol * std::max(max_norm(want), scale);
  if (!(difference <= allowed)) {
    throw Defect(what + ": wrong by " + std::to_string(difference) + "; expected at most " + std::to_string(allowed));
  }
}

/// Orientations may add functions that cancel, and rounding is relative to what cancelled.
Case without_orientations(Case c) {
  for (Space &space : c.spaces) space.orientation.clear();
  return c;
}

/// Products that the oracle forms for one application.
CeedSize work(const Case &c) {
  CeedSize per_point = 0;
  for (const std::vector<Field> *fields : {&c.inputs, &c.outputs}) {
    for (const Field &field : *fields) {
      if (field.mode != CEED_EVAL_WEIGHT) {
        per_point += static_cast<CeedSize>(c.size(field)) * std::max(c.spaces[field.space].elem_size, 1);
      }
    }
  }
  return per_point * c.total_points();
}

void expect_passive(const Instance &instance, const Case &c, const std::vector<Values> &want, CeedScalar tol) {
  for (std::size_t i = 0; i < c.passive.size(); i++) {
    const bool is_written = is_output(c, static_cast<int>(i));
    expect_near(values_of(instance.passive[i]), is_written ? want[i] : c.passive[i], is_written ? tol : 0, 1,
                "passive vector " + std::to_string(i) + " of " + describe(c));
  }
}

CeedScalar scale_of(const Case &c, const Values &in) {
  return std::max<CeedScalar>(1, max_norm(hg::test::apply(without_orientations(c), in).active));
}

Values some_input(const Case &c) {
  Random random(7);
  return random.reals(c.input_size());
}

void check_added(const Instance &instance, const Case &c) {
  Random random(11);
  const Values in = some_input(c), before = random.reals(c.output_size());
  const Outcome action = apply(c, in);
  Vector u, v;
  if (c.input_size() > 0) u = make_vector(instance.ceed, in);
  if (c.output_size() > 0) v = make_vector(instance.ceed, before);
  ok(CeedOperatorApplyAddActive(instance.op, u ? u.get() : CEED_VECTOR_NONE, v ? v.get() : CEED_VECTOR_NONE,
                                CEED_REQUEST_IMMEDIATE));
  Values want = action.active;
  for (std::size_t i = 0; i < before.size(); i++) want[i] += before[i];
  const CeedScalar tol = tolerance(num_terms(c));
  if (v) expect_near(values_of(v), want, tol, scale_of(c, in), "added action of " + describe(c));
  expect_passive(instance, c, action.passive, tol);
}

void check_diagonal(const Instance &instance, const Case &c) {
  const CeedSize n = c.input_size();
  const Values a = matrix(c);
  Values want(n);
  for (CeedSize i = 0; i < n; i++) want[i] = a[i * n + i];
  const Vector diagonal = make_vector(instance.ceed, n, 1e30);
  ok(CeedOperatorLinearAssembleDiagonal(instance.op, diagonal, CEED_REQUEST_IMMEDIATE));
  expect_near(values_of(diagonal), want, tolerance(num_terms(c)),
              std::max<CeedScalar>(1, max_norm(matrix(without_orientations(c)))), "diagonal of " + describe(c));
}

void check_matrix(const Instance &instance, const Case &c) {
  const Values got = dense_from_coordinates(instance.op, instance.ceed, c.output_size(), c.input_size());
  expect_near(got, matrix(c), tolerance(num_terms(c)),
              std::max<CeedScalar>(1, max_norm(matrix(without_orientations(c)))), "matrix of " + describe(c));
}

/// Two operators side by side act as their sum.
void check_composite(const Instance &instance, const Case &c) {
  Operator sum;
  ok(CeedOperatorCreateComposite(instance.ceed, sum.out()));
  ok(CeedOperatorCompositeAddSub(sum, instance.op));
  ok(CeedOperatorCompositeAddSub(sum, instance.op));
  const Values in = some_input(c);
  Outcome want = apply(c, in);
  for (CeedScalar &value : want.active) value *= 2;
  for (Values &values : want.passive) {
    for (CeedScalar &value : values) value *= 2;
  }
  Vector u, v;
  if (c.input_size() > 0) u = make_vector(instance.ceed, in);
  if (c.output_size() > 0) v = make_vector(instance.ceed, c.output_size(), 1e30);
  ok(CeedOperatorApply(sum, u ? u.get() : CEED_VECTOR_NONE, v ? v.get() : CEED_VECTOR_NONE, CEED_REQUEST_IMMEDIATE));
  const CeedScalar tol = tolerance(num_terms(c));
  if (v) expect_near(values_of(v), want.active, tol, scale_of(c, in), "sum of twice " + describe(c));
  expect_passive(instance, c, want.passive, tol);
}

}  // namespace

Case small_case(Random &bytes) {
  const std::uint8_t flags = bytes.next_byte();
  CaseWishes wishes;
  wishes.dim = 1 + (flags & 3) % 3;
  wishes.at_points = (flags & 4) != 0;
  wishes.is_square = (flags & 8) != 0;
  wishes.is_bilinear = (flags & 16) != 0;
  wishes.is_oriented = (flags & 32) != 0;
  wishes.mixes_spaces = (flags & 64) != 0 && !wishes.at_points;
  wishes.has_matrices = (flags & 128) != 0;
  wishes.max_comp = 3;
  wishes.is_small = true;
  return random_case(bytes, wishes);
}

void expect_action(const Instance &instance, const Case &c) {
  const Values in = some_input(c);
  const Outcome want = apply(c, in);
  const CeedScalar tol = tolerance(num_terms(c));
  expect_near(apply(instance, c, in), want.active, tol, scale_of(c, in), "action of " + describe(c));
  expect_passive(instance, c, want.passive, tol);
}

void run_right(Random &bytes) {
  const std::uint8_t checks = bytes.next_byte();
  const Case c = small_case(bytes);
  if (work(c) > 40000) return;
  const CeedHandle ceed(open(backend_of(checks >> 6)));
  {
    const Instance instance(ceed, c);
    if ((checks & 1) == 0) expect_action(instance, c);
    if ((checks & 2) != 0) check_added(instance, c);
    if ((checks & 32) != 0) check_composite(instance, c);
    const bool is_linear =
        c.input_size() > 0 && c.output_size() > 0 &&
        std::all_of(c.outputs.begin(), c.outputs.end(), [](auto &field) { return field.is_active(); });
    const CeedSize entries = c.input_size() * c.output_size();
    if (is_linear && entries <= 20000) {
      // The oracle's matrix is of a square case where there is one active space.
      if ((checks & 4) != 0) check_matrix(instance, c);
      if ((checks & 8) != 0 && c.input_size() == c.output_size()) check_diagonal(instance, c);
    }
    if ((checks & 16) != 0) expect_action(instance, c);  // assembly left nothing behind
  }
}

void run_assembled(Random &bytes) {
  const std::uint8_t flags = bytes.next_byte();
  OperatorWishes wishes;
  wishes.dim = 1 + (flags & 3) % 3;
  wishes.at_points = (flags & 4) != 0;
  wishes.is_square = (flags & 8) != 0;
  wishes.max_comp = 2;
  wishes.max_active_spaces = 2;
  const Layout layout = random_layout(bytes, wishes);
  const CeedHandle ceed(open(backend_of(flags >> 6)));
  std::deque<RandomOperator> parts;
  const int num_parts = 1 + (flags >> 4 & 1);
  for (int i = 0; i < num_parts; i++) {
    parts.emplace_back(ceed, bytes, wishes, layout);
    if ((flags & 32) != 0) wishes.at_points = !wishes.at_points;
  }
  Operator sum;
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  for (const RandomOperator &part : parts) ok(CeedOperatorCompositeAddSub(sum, part));
  const CeedOperator op = num_parts > 1 ? sum.get() : static_cast<CeedOperator>(parts[0]);
  constexpr CeedSize terms = 4000;
  const Values want = dense_by_unit_vectors(ceed, op);
  expect_near(dense_from_coordinates(op, ceed, layout.out, layout.in), want, tolerance(terms), 1,
              "matrix" + parts[0].description());
  if (layout.in != layout.out) return;
  Values diagonal(layout.in);
  for (CeedSize i = 0; i < layout.in; i++) diagonal[i] = want[i * layout.in + i];
  const Vector vec = make_vector(ceed, layout.in, 1e30);
  ok(CeedOperatorLinearAssembleDiagonal(op, vec, CEED_REQUEST_IMMEDIATE));
  expect_near(values_of(vec), diagonal, tolerance(terms), std::max<CeedScalar>(1, max_norm(want)),
              "diagonal" + parts[0].description());
}

}  // namespace hg::fuzz
