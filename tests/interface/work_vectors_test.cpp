// Work vectors: what is given back is handed out again, and the Ceed still ends.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace hg::test {
namespace {

class WorkVectors : public testing::Test {
 protected:
  CeedVector get(CeedSize length) {
    CeedVector vec = nullptr;
    ok(CeedGetWorkVector(ceed, length, &vec));
    return vec;
  }
  void restore(CeedVector vec) {
    ok(CeedRestoreWorkVector(ceed, &vec));
    EXPECT_EQ(vec, nullptr);
  }
  /// Entries of all work vectors.
  CeedScalar usage() {
    CeedScalar usage_mb = -1;
    ok(CeedGetWorkVectorMemoryUsage(ceed, &usage_mb));
    return usage_mb * 1e6 / sizeof(CeedScalar);
  }
  CeedHandle ceed{open(reference_resource)};
};

TEST_F(WorkVectors, AreHandedOutAgain) {
  const CeedVector twenty = get(20);
  ok(CeedVectorSetValue(twenty, 3));
  EXPECT_EQ(length_of(twenty), 20);
  restore(twenty);
  EXPECT_EQ(get(20), twenty);
  const CeedVector other = get(20);
  EXPECT_NE(other, twenty) << "it is in use";
  restore(twenty);
  restore(other);
  const CeedVector thirty = get(30);
  EXPECT_EQ(length_of(thirty), 30);
  restore(thirty);
  // The shortest that is long enough, also for less.
  const CeedVector ten = get(10);
  EXPECT_TRUE(ten == twenty || ten == other);
  ok(CeedVectorSetValue(ten, 1));
  EXPECT_EQ(values_of(ten), Values(20, 1.0));
  EXPECT_EQ(get(25), thirty);
  restore(ten);
  restore(thirty);
  EXPECT_DOUBLE_EQ(usage(), 70);
}

TEST_F(WorkVectors, AreClearedByLength) {
  EXPECT_EQ(usage(), 0);
  const CeedVector x = get(10), y = get(20), z = get(30);
  EXPECT_DOUBLE_EQ(usage(), 60);
  restore(x);
  restore(z);
  ok(CeedClearWorkVectors(ceed, 30));
  EXPECT_DOUBLE_EQ(usage(), 50) << "y is in use, z is not shorter";
  ok(CeedVectorSetValue(y, 1));
  restore(y);
  ok(CeedClearWorkVectors(ceed, 31));
  EXPECT_EQ(usage(), 0);
  const CeedVector none = get(0);
  EXPECT_EQ(length_of(none), 0);
  restore(none);
}

TEST_F(WorkVectors, RefuseWhatIsNotTheirs) {
  CeedVector own = nullptr, null = nullptr;
  ok(CeedVectorCreate(ceed, 5, &own));
  Vector owner(own);
  expect_error(CeedRestoreWorkVector(ceed, &own), CEED_ERROR_MAJOR, {"not handed out"});
  expect_error(CeedRestoreWorkVector(ceed, &null), CEED_ERROR_INCOMPLETE, {"Work vector"});
  expect_error(CeedRestoreWorkVector(ceed, nullptr), CEED_ERROR_INCOMPLETE, {"vec"});
  expect_error(CeedGetWorkVector(ceed, -1, &null), CEED_ERROR_DIMENSION, {"len is -1"});
  expect_error(CeedGetWorkVector(ceed, 1, nullptr), CEED_ERROR_INCOMPLETE, {"vec"});
  expect_error(CeedGetWorkVectorMemoryUsage(ceed, nullptr), CEED_ERROR_INCOMPLETE, {"usage_mb"});
  CeedVector vec = get(5), twice = vec;
  CeedScalar *array = nullptr;
  ok(CeedVectorGetArrayWrite(vec, CEED_MEM_HOST, &array));
  EXPECT_EQ(CeedRestoreWorkVector(ceed, &vec), CEED_ERROR_ACCESS);
  ok(CeedVectorRestoreArray(vec, &array));
  CeedVector copy = nullptr;
  ok(CeedVectorReferenceCopy(vec, &copy));
  expect_error(CeedRestoreWorkVector(ceed, &vec), CEED_ERROR_ACCESS, {"1 other references"});
  ok(CeedVectorDestroy(&copy));
  restore(vec);
  expect_error(CeedRestoreWorkVector(ceed, &twice), CEED_ERROR_MAJOR, {"given back"});
}

// A vector in use keeps its Ceed; the last one that is given back ends it.
TEST_F(WorkVectors, OutliveTheHandleOfTheCeed) {
  CeedVector vec = get(5);
  const Ceed alive = ceed;
  ceed.reset();
  EXPECT_EQ(CeedVectorReturnCeed(vec), alive);
  ok(CeedVectorSetValue(vec, 2));
  ok(CeedRestoreWorkVector(alive, &vec));
}

TEST_F(WorkVectors, ServeSeveralThreads) {
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; t++) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 200; i++) {
        CeedVector vec = nullptr;
        ok(CeedGetWorkVector(ceed, 10 + i % 7, &vec));
        ok(CeedVectorSetValue(vec, t));
        EXPECT_EQ(values_of(vec).front(), t);
        ok(CeedRestoreWorkVector(ceed, &vec));
      }
    });
  }
  for (std::thread &thread : threads) thread.join();
  EXPECT_LE(usage(), 4 * 7 * 16);
}

}  // namespace
}  // namespace hg::test
