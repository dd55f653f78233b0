// Vectors on every backend: memory that is lent, copied and given away, and arithmetic against its definition.
#include <ceed/backend.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "backends.hpp"

namespace {

using namespace hg::test;

class VectorConformance : public BackendTest {
 protected:
  /// Lengths around the widths of vector units, and longer than a block of threads.
  static constexpr CeedSize lengths[] = {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64, 100, 1023, 4099};

  Random random{20};
};

TEST_P(VectorConformance, CopiesValues) {
  for (const CeedSize length : lengths) {
    Values values = random.reals(length);
    Vector x;
    ok(CeedVectorCreate(ceed, length, x.out()));
    EXPECT_EQ(length_of(x), length);
    ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, values.data()));
    const Values before = values;
    values.assign(values.size(), -7.0);
    EXPECT_EQ(values_of(x), before);
  }
}

/// Where a backend works on a device, arrays that are there are used where they are, or copied there.
TEST_P(VectorConformance, UsesArraysOnItsDevice) {
  CeedMemType works_in = CEED_MEM_HOST;
  ok(CeedGetPreferredMemType(ceed, &works_in));
  const Values values = random.reals(100), others = random.reals(100);
  Vector owner = make_vector(ceed, values), x = make_vector(ceed, others), copy = make_vector(ceed, 100, 0.0);
  CeedScalar *array = nullptr, *taken = nullptr;
  if (works_in == CEED_MEM_HOST) {
    Values lent = values;
    EXPECT_NE(CeedVectorSetArray(x, CEED_MEM_DEVICE, CEED_USE_POINTER, lent.data()), CEED_ERROR_SUCCESS);
    return;
  }
  ok(CeedVectorGetArray(owner, CEED_MEM_DEVICE, &array));
  CeedTransfers before, after;
  ok(CeedGetTransfers(ceed, &before));
  ok(CeedVectorSetArray(copy, CEED_MEM_DEVICE, CEED_COPY_VALUES, array));
  ok(CeedVectorSetArray(x, CEED_MEM_DEVICE, CEED_USE_POINTER, array));
  ok(CeedVectorScale(x, 2.0));
  ok(CeedVectorTakeArray(x, CEED_MEM_DEVICE, &taken));
  ok(CeedGetTransfers(ceed, &after));
  EXPECT_EQ(after.num_to_device + after.num_to_host, before.num_to_device + before.num_to_host);
  EXPECT_EQ(taken, array);
  ok(CeedVectorRestoreArray(owner, &array));
  EXPECT_EQ(values_of(copy), values);
  Values twice = values;
  for (CeedScalar &value : twice) value *= 2;
  EXPECT_EQ(values_of(owner), twice);
}

TEST_P(VectorConformance, UsesALentArray) {
  Values lent{1, 2, 3, 4};
  Vector x;
  ok(CeedVectorCreate(ceed, 4, x.out()));
  bool is_borrowed = true;
  ok(CeedVectorHasBorrowedArrayOfType(x, CEED_MEM_HOST, &is_borrowed));
  EXPECT_FALSE(is_borrowed);
  CeedScalar *taken = nullptr;
  expect_error(CeedVectorTakeArray(x, CEED_MEM_HOST, &taken), CEED_ERROR_INCOMPLETE, {"no borrowed host array"});
  ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_USE_POINTER, lent.data()));
  ok(CeedVectorHasBorrowedArrayOfType(x, CEED_MEM_HOST, &is_borrowed));
  EXPECT_TRUE(is_borrowed);
  EXPECT_EQ(values_of(x), (Values{1, 2, 3, 4}));
  ok(CeedVectorScale(x, 2.0));
  ok(CeedVectorSyncArray(x, CEED_MEM_HOST));
  EXPECT_EQ(lent, (Values{2, 4, 6, 8})) << "synchronised, the lent array holds the values";
  Vector y = make_vector(ceed, 4, 5.0);
  ok(CeedVectorCopy(y, x));
  ok(CeedVectorTakeArray(x, CEED_MEM_HOST, &taken));
  EXPECT_EQ(taken, lent.data());
  EXPECT_EQ(lent, Values(4, 5.0)) << "taken back, the lent array holds the values";
  bool is_valid = true;
  ok(CeedVectorHasValidArray(x, &is_valid));
  EXPECT_FALSE(is_valid);
  // The vector makes an array of its own now.
  ok(CeedVectorSetValue(x, 3.0));
  EXPECT_EQ(values_of(x), Values(4, 3.0));
  EXPECT_EQ(lent, Values(4, 5.0));
}

TEST_P(VectorConformance, CopiesIntoALentArray) {
  Values lent{1, 2, 3}, values{7, 8, 9};
  Vector x;
  ok(CeedVectorCreate(ceed, 3, x.out()));
  ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_USE_POINTER, lent.data()));
  ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, values.data()));
  ok(CeedVectorSyncArray(x, CEED_MEM_HOST));
  EXPECT_EQ(lent, values);
  ok(CeedVectorTakeArray(x, CEED_MEM_HOST, nullptr));
}

TEST_P(VectorConformance, IsLentAnotherArray) {
  Values first{1, 2, 3}, second{4, 5, 6};
  Vector x;
  ok(CeedVectorCreate(ceed, 3, x.out()));
  ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_USE_POINTER, first.data()));
  ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_USE_POINTER, second.data()));
  EXPECT_EQ(values_of(x), second);
  ok(CeedVectorSetValue(x, 0.5));
  CeedScalar *taken = nullptr;
  ok(CeedVectorTakeArray(x, CEED_MEM_HOST, &taken));
  EXPECT_EQ(taken, second.data());
  EXPECT_EQ(second, Values(3, 0.5));
  EXPECT_EQ(first, (Values{1, 2, 3}));
}

TEST_P(VectorConformance, OwnsWhatItIsGiven) {
  Vector x;
  ok(CeedVectorCreate(ceed, 3, x.out()));
  for (int round = 0; round < 2; round++) {
    auto *given = static_cast<CeedScalar *>(std::malloc(3 * sizeof(CeedScalar)));
    for (int i = 0; i < 3; i++) given[i] = i + round;
    ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_OWN_POINTER, given));
    EXPECT_EQ(values_of(x), (Values{round + 0.0, round + 1.0, round + 2.0}));
    bool is_borrowed = true;
    ok(CeedVectorHasBorrowedArrayOfType(x, CEED_MEM_HOST, &is_borrowed));
    EXPECT_FALSE(is_borrowed);
  }
}

TEST_P(VectorConformance, IsWrittenThroughItsArrays) {
  for (const CeedSize length : lengths) {
    const Values values = random.reals(length);
    Vector x;
    ok(CeedVectorCreate(ceed, length, x.out()));
    CeedScalar *array = nullptr;
    ok(CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &array));
    for (CeedSize i = 0; i < length; i++) array[i] = values[i];
    ok(CeedVectorRestoreArray(x, &array));
    ok(CeedVectorScale(x, 2.0));
    ok(CeedVectorGetArray(x, CEED_MEM_HOST, &array));
    for (CeedSize i = 0; i < length; i++) {
      EXPECT_EQ(array[i], 2 * values[i]);
      array[i] += 1;
    }
    ok(CeedVectorRestoreArray(x, &array));
    const Values got = values_of(x);
    for (CeedSize i = 0; i < length; i++) EXPECT_EQ(got[i], 2 * values[i] + 1);
  }
}

TEST_P(VectorConformance, Norms) {
  for (const CeedSize length : lengths) {
    const Values values = random.reals(length);
    Vector x = make_vector(ceed, values);
    long double sum = 0, squares = 0, largest = 0;
    for (const CeedScalar value : values) {
      sum += std::abs(value);
      squares += static_cast<long double>(value) * value;
      largest = std::max<long double>(largest, std::abs(value));
    }
    CeedScalar norm = -1;
    ok(CeedVectorNorm(x, CEED_NORM_1, &norm));
    EXPECT_NEAR(norm, sum, tolerance(length) * sum);
    ok(CeedVectorNorm(x, CEED_NORM_2, &norm));
    EXPECT_NEAR(norm, std::sqrt(squares), tolerance(length) * std::sqrt(squares));
    ok(CeedVectorNorm(x, CEED_NORM_MAX, &norm));
    EXPECT_EQ(norm, static_cast<CeedScalar>(largest));
  }
}

TEST_P(VectorConformance, NormsShowNaN) {
  for (const CeedSize place : {0, 3, 6}) {
    Values values{1, 2, 3, 4, 5, 6, 7};
    values[place] = std::numeric_limits<CeedScalar>::quiet_NaN();
    Vector x = make_vector(ceed, values);
    for (const CeedNormType type : {CEED_NORM_1, CEED_NORM_2, CEED_NORM_MAX}) {
      CeedScalar norm = 0;
      ok(CeedVectorNorm(x, type, &norm));
      EXPECT_TRUE(std::isnan(norm)) << "norm " << type << ", NaN at " << place;
    }
  }
}

TEST_P(VectorConformance, Arithmetic) {
  for (const CeedSize length : lengths) {
    const Values x0 = random.reals(length), y0 = random.reals(length);
    const CeedScalar alpha = random.real(), beta = random.real();
    const auto expect_entries = [&](CeedVector vec, const char *what, auto &&entry) {
      Values want(x0.size());
      for (CeedSize i = 0; i < length; i++) want[i] = entry(x0[i], y0[i]);
      expect_close(values_of(vec), want, tolerance(2), what, 1);
    };
    Vector x = make_vector(ceed, x0), y = make_vector(ceed, y0), w;
    ok(CeedVectorScale(x, alpha));
    expect_entries(x, "scale", [&](auto a, auto) { return alpha * a; });
    set_values(x, x0);
    ok(CeedVectorAXPY(y, alpha, x));
    expect_entries(y, "axpy", [&](auto a, auto b) { return alpha * a + b; });
    set_values(y, y0);
    ok(CeedVectorAXPBY(y, alpha, beta, x));
    expect_entries(y, "axpby", [&](auto a, auto b) { return alpha * a + beta * b; });
    set_values(y, y0);
    ok(CeedVectorCreate(ceed, length, w.out()));
    ok(CeedVectorPointwiseMult(w, x, y));
    expect_entries(w, "w = x y", [](auto a, auto b) { return a * b; });
    ok(CeedVectorPointwiseMult(w, x, x));
    expect_entries(w, "w = x x", [](auto a, auto) { return a * a; });
    ok(CeedVectorCopy(x, w));
    ok(CeedVectorPointwiseMult(w, w, y));
    expect_entries(w, "w = w y", [](auto a, auto b) { return a * b; });
    ok(CeedVectorCopy(x, w));
    ok(CeedVectorPointwiseMult(w, y, w));
    expect_entries(w, "w = y w", [](auto a, auto b) { return a * b; });
    ok(CeedVectorCopy(x, w));
    ok(CeedVectorPointwiseMult(w, w, w));
    expect_entries(w, "w = w w", [](auto a, auto) { return a * a; });
    EXPECT_EQ(values_of(x), x0) << "inputs stay";
    EXPECT_EQ(values_of(y), y0) << "inputs stay";
  }
}

TEST_P(VectorConformance, Reciprocal) {
  const Values values{2, -4, 0, 1e-30, 0.5, -1e300};
  Vector x = make_vector(ceed, values);
  ok(CeedVectorReciprocal(x));
  const Values got = values_of(x);
  EXPECT_EQ(got[0], 0.5);
  EXPECT_EQ(got[1], -0.25);
  EXPECT_EQ(got[2], 0) << "zero stays";
  EXPECT_EQ(got[3], 1e-30) << "what counts as zero stays";
  EXPECT_EQ(got[4], 2);
  EXPECT_NEAR(got[5] * -1e300, 1, 1e-14);
}

TEST_P(VectorConformance, Filter) {
  const Values values{2, -0.5, 0.5, 0.25, -0.75, 0};
  Vector x = make_vector(ceed, values);
  ok(CeedVectorFilter(x, 0.5));
  EXPECT_EQ(values_of(x), (Values{2, 0, 0, 0, -0.75, 0}));
}

TEST_P(VectorConformance, StridedRanges) {
  for (const CeedSize length : {7, 33, 100}) {
    for (const CeedSize step : {1, 2, 3, 10}) {
      for (const CeedSize start : {0, 1, 6}) {
        for (const CeedSize stop : {CeedSize{-1}, CeedSize{6}, length}) {
          const CeedSize end = stop < 0 ? length : stop;
          const Values from = random.reals(length), to = random.reals(length);
          Values copied = to, set = to;
          for (CeedSize i = start; i < end; i += step) {
            copied[i] = from[i];
            set[i] = 4.5;
          }
          Vector x = make_vector(ceed, from), y = make_vector(ceed, to);
          ok(CeedVectorCopyStrided(x, start, stop, step, y));
          EXPECT_EQ(values_of(y), copied) << start << " " << stop << " " << step;
          EXPECT_EQ(values_of(x), from);
          set_values(y, to);
          ok(CeedVectorSetValueStrided(y, start, stop, step, 4.5));
          EXPECT_EQ(values_of(y), set) << start << " " << stop << " " << step;
        }
      }
    }
  }
}

TEST_P(VectorConformance, StridedCopiesBetweenLengthsStopAtTheShorterOne) {
  Vector x = make_vector(ceed, Values{1, 2, 3, 4, 5}), y = make_vector(ceed, Values{0, 0, 0});
  ok(CeedVectorCopyStrided(x, 0, -1, 2, y));
  EXPECT_EQ(values_of(y), (Values{1, 0, 3}));
  ok(CeedVectorCopyStrided(y, 1, -1, 1, x));
  EXPECT_EQ(values_of(x), (Values{1, 0, 3, 4, 5}));
  expect_error(CeedVectorCopyStrided(x, 0, 4, 1, y), CEED_ERROR_DIMENSION, {"stop 4", "length 3"});
}

TEST_P(VectorConformance, RefusesWhatDoesNotFit) {
  Vector x = make_vector(ceed, 4, 1.0), y = make_vector(ceed, 3, 1.0);
  expect_error(CeedVectorCopy(x, y), CEED_ERROR_DIMENSION, {"4 entries", "has 3"});
  expect_error(CeedVectorAXPY(x, 1.0, y), CEED_ERROR_DIMENSION, {"x has 3", "y has 4"});
  expect_error(CeedVectorAXPBY(x, 1.0, 1.0, y), CEED_ERROR_DIMENSION, {"x has 3", "y has 4"});
  expect_error(CeedVectorPointwiseMult(x, x, y), CEED_ERROR_DIMENSION, {"y has 3", "w has 4"});
  expect_error(CeedVectorAXPY(x, 1.0, x), CEED_ERROR_UNSUPPORTED, {"same vector"});
  expect_error(CeedVectorAXPBY(x, 1.0, 1.0, x), CEED_ERROR_UNSUPPORTED, {"same vector"});
  expect_error(CeedVectorSetValueStrided(x, 0, 5, 1, 1.0), CEED_ERROR_DIMENSION, {"stop 5", "length 4"});
  expect_error(CeedVectorSetValueStrided(x, 3, 2, 1, 1.0), CEED_ERROR_DIMENSION, {"start 3", "[0, 2]"});
  expect_error(CeedVectorSetValueStrided(x, -1, 2, 1, 1.0), CEED_ERROR_DIMENSION, {"start -1"});
  expect_error(CeedVectorSetValueStrided(x, 0, 2, 0, 1.0), CEED_ERROR_DIMENSION, {"step 0"});
  EXPECT_EQ(values_of(x), Values(4, 1.0));
}

TEST_P(VectorConformance, CopiesBetweenBackends) {
  CeedHandle reference{open(reference_resource)};
  const Values values = random.reals(37);
  Vector there = make_vector(reference, values), here = make_vector(ceed, 37, 0.0);
  ok(CeedVectorCopy(there, here));
  EXPECT_EQ(values_of(here), values);
  ok(CeedVectorAXPY(here, 1.0, there));
  ok(CeedVectorCopy(here, there));
  Values twice = values;
  for (CeedScalar &value : twice) value *= 2;
  EXPECT_EQ(values_of(there), twice);
}

INSTANTIATE_TEST_SUITE_P(Backends, VectorConformance, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
