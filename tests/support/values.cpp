#include "values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "errors.hpp"

namespace hg::test {

Vector make_vector(Ceed ceed, std::span<const CeedScalar> values) {
  Vector vec;
  ok(CeedVectorCreate(ceed, static_cast<CeedSize>(values.size()), vec.out()));
  set_values(vec, values);
  return vec;
}

Vector make_vector(Ceed ceed, CeedSize length, CeedScalar value) {
  Vector vec;
  ok(CeedVectorCreate(ceed, length, vec.out()));
  ok(CeedVectorSetValue(vec, value));
  return vec;
}

void set_values(CeedVector vec, std::span<const CeedScalar> values) {
  // The values are copied; the interface takes them without const.
  ok(CeedVectorSetArray(vec, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<CeedScalar *>(values.data())));
}

Values values_of(CeedVector vec) {
  const CeedScalar *array = nullptr;
  ok(CeedVectorGetArrayRead(vec, CEED_MEM_HOST, &array));
  Values values(array, array + length_of(vec));
  ok(CeedVectorRestoreArrayRead(vec, &array));
  return values;
}

CeedSize length_of(CeedVector vec) {
  CeedSize length = 0;
  ok(CeedVectorGetLength(vec, &length));
  return length;
}

CeedScalar tolerance(CeedSize terms) {
  return 8 * std::numeric_limits<CeedScalar>::epsilon() * static_cast<CeedScalar>(terms + 16);
}

CeedScalar max_norm(std::span<const CeedScalar> values) {
  CeedScalar norm = 0;
  for (const CeedScalar value : values) {
    if (!(std::abs(value) <= norm)) norm = std::abs(value);
  }
  return norm;
}

CeedScalar max_difference(std::span<const CeedScalar> got, std::span<const CeedScalar> want) {
  CeedScalar difference = 0;
  for (std::size_t i = 0; i < got.size() && i < want.size(); i++) {
    const CeedScalar d = std::abs(got[i] - want[i]);
    if (std::isnan(d)) return d;
    difference = std::max(difference, d);
  }
  return difference;
}

CeedScalar dot(std::span<const CeedScalar> a, std::span<const CeedScalar> b) {
  CeedScalar sum = 0;
  for (std::size_t i = 0; i < a.size(); i++) sum += a[i] * b[i];
  return sum;
}

void expect_close(std::span<const CeedScalar> got, std::span<const CeedScalar> want, CeedScalar tol,
                  std::string_view what, CeedScalar scale, SourceLocation where) {
  const auto line = where.line();
  if (got.size() != want.size()) {
    ADD_FAILURE_AT(where.file_name(), line) << what << ": " << got.size() << " values, expected " << want.size();
    return;
  }
  const CeedScalar allowed = tol * std::max(max_norm(want), scale);
  std::size_t failures = 0;
  for (std::size_t i = 0; i < got.size(); i++) {
    if (std::abs(got[i] - want[i]) <= allowed) continue;
    if (failures++ < 5) {
      ADD_FAILURE_AT(where.file_name(), line)
          << what << ": value " << i << " of " << got.size() << " is " << got[i] << ", expected " << want[i]
          << ", difference " << got[i] - want[i] << ", allowed " << allowed;
    }
  }
  if (failures > 5) ADD_FAILURE_AT(where.file_name(), line) << what << ": " << failures << " values differ";
}

void expect_adjoint(const std::function<Values(const Values &)> &action,
                    const std::function<Values(const Values &)> &transpose, CeedSize num_in, CeedSize num_out,
                    Random &random, CeedScalar tol, std::string_view what, SourceLocation where) {
  const Values x = random.reals(num_in), y = random.reals(num_out);
  const Values ax = action(x), aty = transpose(y);
  if (ax.size() != y.size() || aty.size() != x.size()) {
    ADD_FAILURE_AT(where.file_name(), where.line()) << what << ": sizes do not fit";
    return;
  }
  const CeedScalar left[] = {dot(y, ax)}, right[] = {dot(aty, x)};
  // Rounding grows with the sum of the magnitudes, which may be far above the sum itself.
  CeedScalar scale = 0;
  for (std::size_t i = 0; i < ax.size(); i++) scale += std::abs(y[i] * ax[i]);
  for (std::size_t i = 0; i < x.size(); i++) scale += std::abs(x[i] * aty[i]);
  expect_close(left, right, tol, what, scale, where);
}

void expect_linear(const std::function<Values(const Values &)> &action, CeedSize num_in, Random &random, CeedScalar tol,
                   std::string_view what, SourceLocation where) {
  const Values x = random.reals(num_in), y = random.reals(num_in);
  const CeedScalar a = random.real(), b = random.real();
  Values z(x.size());
  for (std::size_t i = 0; i < z.size(); i++) z[i] = a * x[i] + b * y[i];
  const Values ax = action(x), ay = action(y);
  Values want(ax.size());
  for (std::size_t i = 0; i < want.size(); i++) want[i] = a * ax[i] + b * ay[i];
  expect_close(action(z), want, tol, what, std::max(max_norm(ax), max_norm(ay)), where);
}

void expect_like_reference(Ceed ceed, const std::function<Values(Ceed)> &run, CeedScalar tol, std::string_view what,
                           SourceLocation where) {
  const CeedHandle reference(open(reference_resource));
  const Values want = run(reference), got = run(ceed);
  expect_close(got, want, tol, what, 0, where);
}

}  // namespace hg::test
