// The access protocol of vectors, what they print, and what they refuse.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace {

using namespace hg::test;

class VectorAccess : public testing::Test {
 protected:
  std::uint64_t state(CeedVector vec) {
    std::uint64_t value = 0;
    ok(CeedVectorGetState(vec, &value));
    return value;
  }

  CeedHandle ceed{open(reference_resource)};
  CeedScalar *array = nullptr;
  const CeedScalar *read = nullptr;
};

TEST_F(VectorAccess, HasOneWriter) {
  Vector x = make_vector(ceed, 4, 1.0);
  ok(CeedVectorGetArray(x, CEED_MEM_HOST, &array));
  CeedScalar *second = nullptr;
  const char *in_use = "Cannot grant CeedVector array access, the access lock is already in use";
  expect_error(CeedVectorGetArray(x, CEED_MEM_HOST, &second), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &second), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &read), CEED_ERROR_ACCESS,
               {"Cannot grant CeedVector read-only array access, the access lock is already in use"});
  expect_error(CeedVectorSetValue(x, 2.0), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, array), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedVectorScale(x, 2.0), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedVectorSyncArray(x, CEED_MEM_HOST), CEED_ERROR_ACCESS,
               {"Cannot sync CeedVector, the access lock is already in use"});
  expect_error(CeedVectorTakeArray(x, CEED_MEM_HOST, &second), CEED_ERROR_ACCESS, {"Cannot take CeedVector array"});
  expect_error(CeedVectorDestroy(x.address()), CEED_ERROR_ACCESS,
               {"Cannot destroy CeedVector, the writable access lock is in use"});
  ASSERT_NE(x.get(), nullptr) << "a vector that may not be destroyed stays";
  EXPECT_EQ(second, nullptr);
  array[2] = 7;
  ok(CeedVectorRestoreArray(x, &array));
  EXPECT_EQ(array, nullptr);
  EXPECT_EQ(values_of(x), (Values{1, 1, 7, 1}));
}

TEST_F(VectorAccess, HasManyReaders) {
  Vector x = make_vector(ceed, 4, 1.0), y = make_vector(ceed, 4, 2.0);
  const CeedScalar *other = nullptr;
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &read));
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &other));
  EXPECT_EQ(read, other);
  const char *is_read = "Cannot grant CeedVector array access, a process has read access";
  expect_error(CeedVectorGetArray(x, CEED_MEM_HOST, &array), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &array), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorSetValue(x, 2.0), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorSetValueStrided(x, 0, -1, 1, 2.0), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorAXPY(x, 2.0, y), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorAXPBY(x, 2.0, 1.0, y), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorPointwiseMult(x, y, y), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorReciprocal(x), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorFilter(x, 0.5), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorCopy(y, x), CEED_ERROR_ACCESS, {is_read});
  expect_error(CeedVectorDestroy(x.address()), CEED_ERROR_ACCESS, {"Cannot destroy CeedVector, a process has read"});
  ok(CeedVectorSyncArray(x, CEED_MEM_HOST));
  ok(CeedVectorCopy(x, y));
  ok(CeedVectorRestoreArrayRead(x, &read));
  EXPECT_EQ(read, nullptr);
  expect_error(CeedVectorSetValue(x, 2.0), CEED_ERROR_ACCESS, {is_read});
  ok(CeedVectorRestoreArrayRead(x, &other));
  ok(CeedVectorSetValue(x, 2.0));
  EXPECT_EQ(values_of(x), Values(4, 2.0));
  EXPECT_EQ(values_of(y), Values(4, 1.0));
}

TEST_F(VectorAccess, IsRestoredOnce) {
  Vector x = make_vector(ceed, 4, 1.0);
  expect_error(CeedVectorRestoreArray(x, &array), CEED_ERROR_ACCESS,
               {"Cannot restore CeedVector array access, access was not granted"});
  expect_error(CeedVectorRestoreArrayRead(x, &read), CEED_ERROR_ACCESS, {"access was not granted"});
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &read));
  expect_error(CeedVectorRestoreArray(x, &array), CEED_ERROR_ACCESS, {"access was not granted"});
  ok(CeedVectorRestoreArrayRead(x, &read));
}

TEST_F(VectorAccess, OfFailedOperationsLeavesNoLock) {
  Vector x = make_vector(ceed, 4, 1.0), empty;
  ok(CeedVectorCreate(ceed, 4, empty.out()));
  const char *no_values = "holds no values";
  expect_error(CeedVectorCopy(empty, x), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorAXPY(x, 1.0, empty), CEED_ERROR_INCOMPLETE, {no_values, "x of length 4"});
  expect_error(CeedVectorAXPY(empty, 1.0, x), CEED_ERROR_INCOMPLETE, {no_values, "y of length 4"});
  expect_error(CeedVectorPointwiseMult(empty, x, empty), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorCopyStrided(x, 0, -1, 1, empty), CEED_ERROR_INCOMPLETE, {no_values});
  ok(CeedVectorSetValue(x, 3.0));
  ok(CeedVectorSetValue(empty, 4.0));
  EXPECT_EQ(values_of(x), Values(4, 3.0));
}

TEST_F(VectorAccess, NeedsValuesToRead) {
  Vector x;
  ok(CeedVectorCreate(ceed, 3, x.out()));
  bool is_valid = true;
  ok(CeedVectorHasValidArray(x, &is_valid));
  EXPECT_FALSE(is_valid);
  CeedScalar norm = -1;
  const char *no_values = "length 3 holds no values";
  expect_error(CeedVectorGetArray(x, CEED_MEM_HOST, &array), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &read), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorNorm(x, CEED_NORM_2, &norm), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorScale(x, 2.0), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorReciprocal(x), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorFilter(x, 2.0), CEED_ERROR_INCOMPLETE, {no_values});
  expect_error(CeedVectorSetValueStrided(x, 0, -1, 2, 2.0), CEED_ERROR_INCOMPLETE, {no_values});
  ok(CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &array));
  array[0] = array[1] = array[2] = 6;
  ok(CeedVectorRestoreArray(x, &array));
  ok(CeedVectorHasValidArray(x, &is_valid));
  EXPECT_TRUE(is_valid);
  EXPECT_EQ(values_of(x), Values(3, 6.0));
}

TEST_F(VectorAccess, StateTellsOfChanges) {
  Vector x;
  ok(CeedVectorCreate(ceed, 3, x.out()));
  EXPECT_EQ(state(x), 0u);
  std::uint64_t before = 0;
  const auto expect_change = [&](const char *what) {
    EXPECT_GT(state(x), before) << what;
    EXPECT_EQ(state(x) % 2, 0u) << what;
    before = state(x);
  };
  Values values{1, 2, 3};
  ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, values.data()));
  expect_change("set array");
  ok(CeedVectorGetArray(x, CEED_MEM_HOST, &array));
  EXPECT_EQ(state(x), before + 1) << "odd while there is a writer";
  ok(CeedVectorRestoreArray(x, &array));
  expect_change("restore");
  ok(CeedVectorSetValue(x, 2.0));
  expect_change("set value");
  ok(CeedVectorScale(x, 2.0));
  expect_change("scale");
  ok(CeedVectorReciprocal(x));
  expect_change("reciprocal");
  ok(CeedVectorSetValueStrided(x, 1, 2, 1, 5.0));
  expect_change("set value strided");
  // Readers change nothing.
  CeedScalar norm = 0;
  ok(CeedVectorNorm(x, CEED_NORM_2, &norm));
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &read));
  EXPECT_EQ(state(x), before);
  ok(CeedVectorRestoreArrayRead(x, &read));
  EXPECT_EQ(state(x), before);
  // What is refused changes nothing.
  expect_error(CeedVectorAXPY(x, 1.0, x), CEED_ERROR_UNSUPPORTED, {"same vector"});
  EXPECT_EQ(state(x), before);
}

TEST_F(VectorAccess, OfOwnedArraysIsAligned) {
  for (const CeedSize length : {1, 2, 7, 100}) {
    Vector x = make_vector(ceed, length, 1.0);
    ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &read));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(read) % CEED_ALIGN, 0u) << "length " << length;
    ok(CeedVectorRestoreArrayRead(x, &read));
  }
}

TEST_F(VectorAccess, TakesHostMemoryOnlyWhereTheBackendDoes) {
  Vector x = make_vector(ceed, 2, 1.0);
  const char *host_only = "Can only provide HOST memory for this backend";
  EXPECT_NE(CeedVectorGetArray(x, CEED_MEM_DEVICE, &array), CEED_ERROR_SUCCESS);
  EXPECT_NE(last_report().message.find(host_only), std::string::npos) << last_report().message;
  EXPECT_NE(CeedVectorGetArrayRead(x, CEED_MEM_DEVICE, &read), CEED_ERROR_SUCCESS);
  Values values(2);
  EXPECT_NE(CeedVectorSetArray(x, CEED_MEM_DEVICE, CEED_USE_POINTER, values.data()), CEED_ERROR_SUCCESS);
  EXPECT_EQ(values_of(x), Values(2, 1.0));
}

TEST_F(VectorAccess, OfAnEmptyVectorIsFine) {
  Vector x;
  ok(CeedVectorCreate(ceed, 0, x.out()));
  CeedScalar norm = 5;
  ok(CeedVectorNorm(x, CEED_NORM_MAX, &norm));
  EXPECT_EQ(norm, 0);
  ok(CeedVectorSetValue(x, 1.0));
  ok(CeedVectorScale(x, 1.0));
  ok(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_USE_POINTER, nullptr));
  ok(CeedVectorGetArray(x, CEED_MEM_HOST, &array));
  ok(CeedVectorRestoreArray(x, &array));
  ok(CeedVectorTakeArray(x, CEED_MEM_HOST, nullptr));
  EXPECT_EQ(printed([&](FILE *stream) { ok(CeedVectorView(x, nullptr, stream)); }), "CeedVector length 0\n");
}

TEST_F(VectorAccess, RefusesBadArguments) {
  Vector x = make_vector(ceed, 2, 1.0), bad;
  expect_error(CeedVectorCreate(ceed, -1, bad.out()), CEED_ERROR_DIMENSION, {"-1"});
  EXPECT_EQ(bad.get(), nullptr);
  expect_error(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, nullptr), CEED_ERROR_MINOR, {"2 entries"});
  CeedScalar norm = 0;
  expect_error(CeedVectorNorm(x, static_cast<CeedNormType>(3), &norm), CEED_ERROR_MINOR, {"norm type is 3"});
  expect_error(CeedVectorSetArray(x, CEED_MEM_HOST, static_cast<CeedCopyMode>(3), &norm), CEED_ERROR_MINOR,
               {"copy mode is 3"});
  Vector huge;
  ok(CeedVectorCreate(ceed, std::numeric_limits<CeedSize>::max() / 2, huge.out()));
  expect_error(CeedVectorSetValue(huge, 1.0), CEED_ERROR_BACKEND, {"Out of memory"});
}

TEST_F(VectorAccess, PrintsRanges) {
  const Values values{1, -2.5, 3, 0.1234567};
  Vector x = make_vector(ceed, values);
  const auto range = [&](CeedSize start, CeedSize stop, CeedInt step, const char *format) {
    return printed([&](FILE *stream) { ok(CeedVectorViewRange(x, start, stop, step, format, stream)); });
  };
  EXPECT_EQ(range(0, 4, 1, nullptr), "CeedVector length 4\n  1\n  -2.5\n  3\n  0.123457\n");
  EXPECT_EQ(range(1, 3, 1, "%6.2f"),
            "CeedVector length 4\n  start: 1\n  stop:  3\n  step:  1\n   -2.50\n    3.00\n  ...\n");
  EXPECT_EQ(range(1, -1, 2, "%g"), "CeedVector length 4\n  start: 1\n  stop:  -1\n  step:  2\n  -2.5\n  0.123457\n");
  EXPECT_EQ(range(3, 0, -1, "%.1f"),
            "CeedVector length 4\n  start: 3\n  stop:  0\n  step:  -1\n  0.1\n  3.0\n  -2.5\n  ...\n");
  EXPECT_EQ(range(2, 9, 1, "%g"), "CeedVector length 4\n  start: 2\n  stop:  9\n  step:  1\n  3\n  0.123457\n");
  expect_error(CeedVectorViewRange(x, 0, 2, 0, "%g", stdout), CEED_ERROR_MINOR, {"'step' must be nonzero"});
  expect_error(CeedVectorViewRange(x, -1, 2, 1, "%g", stdout), CEED_ERROR_DIMENSION, {"-1", "[0, 4]"});
}

}  // namespace
