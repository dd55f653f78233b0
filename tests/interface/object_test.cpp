// What all handles share: counting, views, the Ceed they belong to; the sentinels; the tables of names.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace {

using namespace hg::test;

class Object : public testing::Test {
 protected:
  CeedObject as_object(CeedVector vec) { return reinterpret_cast<CeedObject>(vec); }

  CeedHandle ceed{open(reference_resource)};
};

TEST_F(Object, IsDestroyedWithItsLastReference) {
  Vector x = make_vector(ceed, 3, 2.0);
  CeedVector copy = nullptr;
  ok(CeedVectorReferenceCopy(x, &copy));
  EXPECT_EQ(copy, x.get());
  x.reset();
  EXPECT_EQ(values_of(copy), Values(3, 2.0)) << "one reference is left";
  auto object = as_object(copy);
  ok(CeedObjectDestroy(&object));
  EXPECT_EQ(object, nullptr);
  EXPECT_EQ(CeedObjectDestroy(&object), CEED_ERROR_SUCCESS) << "a NULL handle is fine";
}

TEST_F(Object, KeepsItsCeedAlive) {
  Vector x = make_vector(ceed, 2, 1.0);
  ceed.reset();
  CeedHandle again;
  ok(CeedVectorGetCeed(x, again.out()));
  EXPECT_EQ(again.get(), CeedVectorReturnCeed(x));
  EXPECT_EQ(values_of(x), Values(2, 1.0));
  const char *resource = nullptr;
  ok(CeedGetResource(again, &resource));
  EXPECT_STREQ(resource, reference_resource);
}

TEST_F(Object, ReferenceCopyDropsWhatTheHandleHeld) {
  Vector x = make_vector(ceed, 2, 1.0), y = make_vector(ceed, 2, 5.0);
  CeedVector copy = nullptr;
  ok(CeedVectorReferenceCopy(x, &copy));
  ok(CeedVectorReferenceCopy(y, &copy));
  ok(CeedVectorReferenceCopy(copy, &copy));
  EXPECT_EQ(copy, y.get());
  EXPECT_EQ(values_of(x), Values(2, 1.0));
  y.reset();
  EXPECT_EQ(values_of(copy), Values(2, 5.0));
  ok(CeedVectorDestroy(&copy));
}

TEST_F(Object, CountsReferencesOfSeveralThreads) {
  Vector x = make_vector(ceed, 4, 3.0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; t++) {
    threads.emplace_back([&] {
      for (int i = 0; i < 2000; i++) {
        CeedVector copy = nullptr;
        if (CeedVectorReferenceCopy(x, &copy) != 0 || CeedVectorDestroy(&copy) != 0) std::abort();
      }
    });
  }
  for (auto &thread : threads) thread.join();
  EXPECT_EQ(values_of(x), Values(4, 3.0));
}

TEST_F(Object, BelongsToACeed) {
  Vector x = make_vector(ceed, 1, 0.0);
  CeedHandle of_vector, of_itself;
  ok(CeedObjectGetCeed(as_object(x), of_vector.out()));
  ok(CeedObjectGetCeed(reinterpret_cast<CeedObject>(ceed.get()), of_itself.out()));
  EXPECT_EQ(of_vector.get(), ceed.get());
  EXPECT_EQ(of_itself.get(), ceed.get());
  EXPECT_EQ(CeedObjectReturnCeed(as_object(x)), ceed.get());
  EXPECT_EQ(CeedObjectReturnCeed(nullptr), nullptr);
}

TEST_F(Object, PrintsWithTabs) {
  Vector x = make_vector(ceed, 2, 1.5);
  CeedInt tabs = -1;
  ok(CeedObjectGetNumViewTabs(as_object(x), &tabs));
  EXPECT_EQ(tabs, 0);
  const auto print = [&](FILE *stream) { ok(CeedObjectView(as_object(x), stream)); };
  EXPECT_EQ(printed(print), "CeedVector length 2\n    1.50000000\n    1.50000000\n");
  ok(CeedObjectSetNumViewTabs(as_object(x), 2));
  EXPECT_EQ(printed(print), "    CeedVector length 2\n        1.50000000\n        1.50000000\n");
  ok(CeedVectorGetNumViewTabs(x, &tabs));
  EXPECT_EQ(tabs, 2);
  expect_error(CeedObjectSetNumViewTabs(as_object(x), -1), CEED_ERROR_MINOR, {"-1", "non-negative"});
}

TEST_F(Object, ThatIsNullIsAnError) {
  CeedSetErrorHandler(nullptr, CeedErrorReturn);
  EXPECT_NE(CeedObjectView(nullptr, stdout), CEED_ERROR_SUCCESS);
  CeedVector copy = nullptr;
  EXPECT_NE(CeedVectorReferenceCopy(nullptr, &copy), CEED_ERROR_SUCCESS);
  EXPECT_EQ(copy, nullptr);
  Vector x = make_vector(ceed, 1, 0.0);
  expect_error(CeedObjectView(as_object(x), nullptr), CEED_ERROR_MINOR, {"stream is NULL"});
}

TEST_F(Object, SentinelsAreNeitherCountedNorDestroyed) {
  EXPECT_NE(CEED_VECTOR_ACTIVE, CEED_VECTOR_NONE);
  for (int i = 0; i < 3; i++) {
    CeedVector vec = CEED_VECTOR_ACTIVE;
    ok(CeedVectorDestroy(&vec));
    EXPECT_EQ(vec, nullptr);
    CeedElemRestriction rstr = CEED_ELEMRESTRICTION_NONE;
    ok(CeedElemRestrictionDestroy(&rstr));
    EXPECT_EQ(rstr, nullptr);
    CeedVector copy = nullptr;
    ok(CeedVectorReferenceCopy(CEED_VECTOR_NONE, &copy));
    EXPECT_EQ(copy, CEED_VECTOR_NONE);
    ok(CeedVectorDestroy(&copy));
  }
  EXPECT_EQ(CeedVectorReturnCeed(CEED_VECTOR_ACTIVE), nullptr);
}

TEST_F(Object, SentinelsHaveNoValues) {
  Vector x = make_vector(ceed, 2, 1.0);
  expect_error(CeedVectorAXPY(x, 1.0, CEED_VECTOR_NONE), CEED_ERROR_INCOMPATIBLE, {"CEED_VECTOR_NONE"});
  expect_error(CeedVectorCopy(x, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPATIBLE, {"CEED_VECTOR_ACTIVE"});
  EXPECT_EQ(values_of(x), Values(2, 1.0));
}

TEST(Request, IsCompleteAtOnce) {
  CeedRequest request = nullptr;
  EXPECT_EQ(CeedRequestWait(&request), CEED_ERROR_SUCCESS);
  EXPECT_EQ(CeedRequestWait(CEED_REQUEST_IMMEDIATE), CEED_ERROR_SUCCESS);
  EXPECT_EQ(CeedRequestWait(CEED_REQUEST_ORDERED), CEED_ERROR_SUCCESS);
  EXPECT_NE(CEED_REQUEST_IMMEDIATE, CEED_REQUEST_ORDERED);
}

TEST(Names, AreFoundByValue) {
  EXPECT_STREQ(CeedErrorTypes[CEED_ERROR_UNSUPPORTED], "operation unsupported by backend");
  EXPECT_STREQ(CeedErrorTypes[CEED_ERROR_SUCCESS], "success");
  EXPECT_STREQ(CeedErrorTypes[CEED_ERROR_ACCESS], "access lock in use");
  EXPECT_STREQ(CeedMemTypes[CEED_MEM_HOST], "host");
  EXPECT_STREQ(CeedMemTypes[CEED_MEM_DEVICE], "device");
  EXPECT_STREQ(CeedCopyModes[CEED_OWN_POINTER], "own pointer");
  EXPECT_STREQ(CeedTransposeModes[CEED_TRANSPOSE], "transpose");
  EXPECT_STREQ(CeedEvalModes[CEED_EVAL_NONE], "none");
  EXPECT_STREQ(CeedEvalModes[CEED_EVAL_GRAD], "gradient");
  EXPECT_STREQ(CeedEvalModes[CEED_EVAL_WEIGHT], "quadrature weights");
  EXPECT_EQ(CeedEvalModes[3], nullptr);
  EXPECT_STREQ(CeedQuadModes[CEED_GAUSS_LOBATTO], "Gauss Lobatto");
  EXPECT_STREQ(CeedElemTopologies[CEED_TOPOLOGY_LINE], "line");
  EXPECT_STREQ(CeedElemTopologies[CEED_TOPOLOGY_PRISM], "prism");
  EXPECT_STREQ(CeedElemTopologies[CEED_TOPOLOGY_HEX], "hexahedron");
  EXPECT_STREQ(CeedContextFieldTypes[CEED_CONTEXT_FIELD_INT32], "int32");
  EXPECT_STREQ(CeedFESpaces[CEED_FE_SPACE_HCURL], "H(curl) space");
}

}  // namespace
