// What element restrictions tell about themselves, what they print, and what they refuse.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace {

using namespace hg::test;

constexpr CeedInt largest = std::numeric_limits<CeedInt>::max();

class RestrictionFacts : public testing::Test {
 protected:
  int create(CeedInt num_elem, CeedInt elem_size, CeedInt num_comp, CeedInt comp_stride, CeedSize l_size,
             const std::vector<CeedInt> &offsets) {
    return CeedElemRestrictionCreate(ceed, num_elem, elem_size, num_comp, comp_stride, l_size, CEED_MEM_HOST,
                                     CEED_COPY_VALUES, offsets.data(), rstr.out());
  }
  int create_at_points(CeedInt num_elem, CeedInt num_points, CeedInt num_comp, CeedSize l_size,
                       const std::vector<CeedInt> &offsets) {
    return CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, num_comp, l_size, CEED_MEM_HOST,
                                             CEED_COPY_VALUES, offsets.data(), rstr.out());
  }
  int create_strided(CeedInt num_elem, CeedInt elem_size, CeedInt num_comp, CeedSize l_size,
                     const std::vector<CeedInt> &strides) {
    return CeedElemRestrictionCreateStrided(ceed, num_elem, elem_size, num_comp, l_size, strides.data(), rstr.out());
  }
  template <typename T>
  T ask(int (*getter)(CeedElemRestriction, T *)) {
    T value{};
    ok(getter(rstr, &value));
    return value;
  }
  std::vector<CeedInt> ask3(int (*getter)(CeedElemRestriction, CeedInt *)) {
    std::vector<CeedInt> values(3, -1);
    ok(getter(rstr, values.data()));
    return values;
  }
  std::string view() {
    return printed([&](FILE *stream) { ok(CeedElemRestrictionView(rstr, stream)); });
  }

  CeedHandle ceed{open(reference_resource)};
  Restriction rstr;
};

TEST_F(RestrictionFacts, WithOffsets) {
  ok(create(3, 2, 2, 4, 8, {0, 1, 1, 2, 2, 3}));
  EXPECT_EQ(ask(CeedElemRestrictionGetNumElements), 3);
  EXPECT_EQ(ask(CeedElemRestrictionGetElementSize), 2);
  EXPECT_EQ(ask(CeedElemRestrictionGetNumComponents), 2);
  EXPECT_EQ(ask(CeedElemRestrictionGetCompStride), 4);
  EXPECT_EQ(ask(CeedElemRestrictionGetLVectorSize), 8);
  EXPECT_EQ(ask(CeedElemRestrictionGetEVectorSize), 12);
  EXPECT_EQ(ask(CeedElemRestrictionGetNumBlocks), 3);
  EXPECT_EQ(ask(CeedElemRestrictionGetBlockSize), 1);
  EXPECT_EQ(ask(CeedElemRestrictionGetType), CEED_RESTRICTION_STANDARD);
  EXPECT_FALSE(ask(CeedElemRestrictionIsStrided));
  EXPECT_FALSE(ask(CeedElemRestrictionIsAtPoints));
  EXPECT_EQ(ask3(CeedElemRestrictionGetELayout), (std::vector<CeedInt>{1, 2, 4}));
  CeedInt values[3];
  bool flag = false;
  CeedSize offset = 0;
  expect_error(CeedElemRestrictionGetStrides(rstr, values), CEED_ERROR_MINOR, {"no strides"});
  expect_error(CeedElemRestrictionHasBackendStrides(rstr, &flag), CEED_ERROR_MINOR, {"no strides"});
  expect_error(CeedElemRestrictionGetLLayout(rstr, values), CEED_ERROR_MINOR, {"no strides"});
  expect_error(CeedElemRestrictionGetNumPoints(rstr, values), CEED_ERROR_INCOMPATIBLE, {"no points"});
  expect_error(CeedElemRestrictionGetMaxPointsInElement(rstr, values), CEED_ERROR_INCOMPATIBLE, {"no points"});
  expect_error(CeedElemRestrictionGetAtPointsElementOffset(rstr, 0, &offset), CEED_ERROR_INCOMPATIBLE, {"no points"});
  EXPECT_EQ(view(), "CeedElemRestriction from (8, 2) to 3 elements with 2 nodes each and component stride 4\n");
  ok(CeedElemRestrictionSetNumViewTabs(rstr, 1));
  EXPECT_EQ(view().substr(0, 21), "  CeedElemRestriction");
}

TEST_F(RestrictionFacts, WithStrides) {
  ok(create_strided(3, 2, 2, 12, {1, 6, 2}));
  EXPECT_EQ(ask(CeedElemRestrictionGetType), CEED_RESTRICTION_STRIDED);
  EXPECT_TRUE(ask(CeedElemRestrictionIsStrided));
  EXPECT_FALSE(ask(CeedElemRestrictionHasBackendStrides));
  EXPECT_EQ(ask3(CeedElemRestrictionGetStrides), (std::vector<CeedInt>{1, 6, 2}));
  EXPECT_EQ(ask3(CeedElemRestrictionGetLLayout), (std::vector<CeedInt>{1, 6, 2}));
  EXPECT_EQ(ask3(CeedElemRestrictionGetELayout), (std::vector<CeedInt>{1, 2, 4}));
  EXPECT_EQ(view(), "CeedElemRestriction from (12, 2) to 3 elements with 2 nodes each and strides [1, 6, 2]\n");
}

TEST_F(RestrictionFacts, WithStridesOfTheBackend) {
  // Compared by value: programs hold copies of the constant.
  ok(create_strided(3, 2, 2, 12, {0, 0, 0}));
  EXPECT_TRUE(ask(CeedElemRestrictionHasBackendStrides));
  EXPECT_EQ(ask3(CeedElemRestrictionGetStrides), (std::vector<CeedInt>{0, 0, 0}));
  const auto layout = ask3(CeedElemRestrictionGetLLayout);
  EXPECT_EQ(layout, ask3(CeedElemRestrictionGetELayout));
  EXPECT_EQ(view(), "CeedElemRestriction from (12, 2) to 3 elements with 2 nodes each and strides [0, 0, 0]\n");
}

TEST_F(RestrictionFacts, AtPoints) {
  // Elements with 2, none, 3 and 1 points.
  ok(create_at_points(4, 6, 2, 12, {5, 7, 7, 10, 11, 3, 4, 5, 0, 1, 2}));
  EXPECT_EQ(ask(CeedElemRestrictionGetType), CEED_RESTRICTION_POINTS);
  EXPECT_TRUE(ask(CeedElemRestrictionIsAtPoints));
  EXPECT_EQ(ask(CeedElemRestrictionGetNumPoints), 6);
  EXPECT_EQ(ask(CeedElemRestrictionGetElementSize), 3);
  EXPECT_EQ(ask(CeedElemRestrictionGetMaxPointsInElement), 3);
  EXPECT_EQ(ask(CeedElemRestrictionGetMinPointsInElement), 0);
  EXPECT_EQ(ask(CeedElemRestrictionGetEVectorSize), 12);
  EXPECT_EQ(ask(CeedElemRestrictionGetCompStride), 1);
  const CeedInt counts[] = {2, 0, 3, 1};
  const CeedSize starts[] = {0, 4, 4, 10};
  for (CeedInt e = 0; e < 4; e++) {
    CeedInt count = -1;
    CeedSize start = -1;
    ok(CeedElemRestrictionGetNumPointsInElement(rstr, e, &count));
    ok(CeedElemRestrictionGetAtPointsElementOffset(rstr, e, &start));
    EXPECT_EQ(count, counts[e]);
    EXPECT_EQ(start, starts[e]);
  }
  CeedInt least = -1, most = -1;
  ok(CeedElemRestrictionGetMinMaxPointsInElement(rstr, &least, &most));
  EXPECT_EQ(least, 0);
  EXPECT_EQ(most, 3);
  for (const CeedInt elem : {-1, 4}) {
    expect_error(CeedElemRestrictionGetNumPointsInElement(rstr, elem, &least), CEED_ERROR_DIMENSION,
                 {std::to_string(elem), "[0, 4)"});
  }
  EXPECT_EQ(view(),
            "CeedElemRestriction at points from (12, 2) to 4 elements with a maximum of 3 points on an element\n");
}

TEST_F(RestrictionFacts, CompareTheirPoints) {
  const std::vector<CeedInt> points{3, 5, 6, 0, 1, 2};
  ok(create_at_points(2, 3, 1, 3, points));
  const auto compatible = [&](const std::vector<CeedInt> &other_points, CeedInt num_comp) {
    Restriction other;
    ok(CeedElemRestrictionCreateAtPoints(ceed, 2, 3, num_comp, CeedSize{3} * num_comp, CEED_MEM_HOST, CEED_COPY_VALUES,
                                         other_points.data(), other.out()));
    bool answer = false;
    ok(CeedElemRestrictionAtPointsAreCompatible(rstr, other, &answer));
    return answer;
  };
  EXPECT_TRUE(compatible(points, 1));
  EXPECT_TRUE(compatible(points, 3)) << "the number of components does not matter";
  EXPECT_FALSE(compatible({3, 4, 6, 0, 1, 2}, 1)) << "another number of points in the elements";
  EXPECT_FALSE(compatible({3, 5, 6, 0, 2, 1}, 1)) << "other points";
}

TEST_F(RestrictionFacts, KeepTheOffsetsAsAsked) {
  std::vector<CeedInt> offsets{0, 1, 1, 2};
  const CeedInt *got = nullptr;
  ok(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_USE_POINTER, offsets.data(), rstr.out()));
  ok(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &got));
  EXPECT_EQ(got, offsets.data());
  ok(CeedElemRestrictionRestoreOffsets(rstr, &got));
  EXPECT_EQ(got, nullptr);

  ok(create(2, 2, 1, 1, 3, offsets));
  offsets[0] = 77;
  ok(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &got));
  EXPECT_NE(got, offsets.data());
  EXPECT_EQ(got[0], 0);
  ok(CeedElemRestrictionRestoreOffsets(rstr, &got));

  auto *own = static_cast<CeedInt *>(std::calloc(4, sizeof(CeedInt)));
  ok(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_OWN_POINTER, own, rstr.out()));
  ok(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &got));
  EXPECT_EQ(got, own);
  ok(CeedElemRestrictionRestoreOffsets(rstr, &got));

  // What is refused is not adopted.
  own = static_cast<CeedInt *>(std::calloc(4, sizeof(CeedInt)));
  own[3] = 9;
  Restriction refused;
  expect_error(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_OWN_POINTER, own, refused.out()),
               CEED_ERROR_DIMENSION, {"9"});
  std::free(own);
}

TEST_F(RestrictionFacts, LockTheirOffsets) {
  ok(create(2, 2, 1, 1, 3, {0, 1, 1, 2}));
  const CeedInt *first = nullptr, *second = nullptr;
  ok(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &first));
  ok(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &second));
  ok(CeedElemRestrictionRestoreOffsets(rstr, &first));
  expect_error(CeedElemRestrictionDestroy(rstr.address()), CEED_ERROR_ACCESS,
               {"Cannot destroy CeedElemRestriction, a process has read access to the offset data"});
  ASSERT_NE(rstr.get(), nullptr);
  ok(CeedElemRestrictionRestoreOffsets(rstr, &second));
  expect_error(CeedElemRestrictionRestoreOffsets(rstr, &second), CEED_ERROR_ACCESS, {"access was not granted"});
}

TEST_F(RestrictionFacts, RefuseBadSizes) {
  const std::vector<CeedInt> offsets{0, 1, 2, 3};
  expect_error(create(-1, 2, 1, 1, 4, offsets), CEED_ERROR_DIMENSION, {"elements is -1"});
  expect_error(create(2, 0, 1, 1, 4, offsets), CEED_ERROR_DIMENSION, {"element size is 0"});
  expect_error(create(2, 2, 0, 1, 4, offsets), CEED_ERROR_DIMENSION, {"components is 0"});
  expect_error(create(2, 2, 2, 0, 4, offsets), CEED_ERROR_DIMENSION, {"component stride is 0"});
  expect_error(create(2, 2, 1, 1, -4, offsets), CEED_ERROR_DIMENSION, {"L-vector size is -4"});
  expect_error(create(0, 1 << 20, 1 << 20, 1, 4, offsets), CEED_ERROR_DIMENSION,
               {"element size times components", "1099511627776"});
  expect_error(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 4, CEED_MEM_HOST, CEED_COPY_VALUES, nullptr, rstr.out()),
               CEED_ERROR_MINOR, {"offsets are NULL"});
  expect_error(
      CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 4, CEED_MEM_DEVICE, CEED_COPY_VALUES, offsets.data(), rstr.out()),
      CEED_ERROR_BACKEND, {"HOST"});
  EXPECT_EQ(rstr.get(), nullptr);
  ok(create(2, 2, 1, 0, 4, offsets));
  ok(create(0, 2, 1, 1, 0, {}));
  EXPECT_EQ(ask(CeedElemRestrictionGetEVectorSize), 0);
}

TEST_F(RestrictionFacts, NameTheOffsetThatIsOutOfRange) {
  expect_error(create(2, 2, 1, 1, 4, {0, 1, 9, 3}), CEED_ERROR_DIMENSION, {"element 1, node 0 is 9", "[0, 4)"});
  expect_error(create(2, 2, 1, 1, 4, {0, -1, 2, 3}), CEED_ERROR_DIMENSION, {"element 0, node 1 is -1", "[0, 4)"});
  expect_error(create(2, 2, 2, 1, 4, {0, 1, 2, 3}), CEED_ERROR_DIMENSION, {"element 1, node 1 is 3", "3 to 4"});
  // Components far apart: their places do not fit in 32 bits.
  expect_error(create(1, 1, 3, largest, 4, {0}), CEED_ERROR_DIMENSION, {"0 to 4294967294"});
  ok(create(1, 1, 3, largest, CeedSize{2} * largest + 1, {0}));
  EXPECT_EQ(ask(CeedElemRestrictionGetLVectorSize), CeedSize{2} * largest + 1);
}

TEST_F(RestrictionFacts, HaveSizesBeyond32Bits) {
  // Strides need no offsets, so sizes are all there is.
  const CeedSize size = CeedSize{1 << 20} * 3 * 4096;
  ok(create_strided(1 << 20, 4096, 3, size, {0, 0, 0}));
  EXPECT_EQ(ask(CeedElemRestrictionGetEVectorSize), size);
  EXPECT_GT(size, CeedSize{largest});
  // 2^18 blocks of four elements, and the last one's copies.
  ok(CeedElemRestrictionCreateBlockedStrided(ceed, (1 << 20) - 3, 4096, 4, 3, size, CEED_STRIDES_BACKEND, rstr.out()));
  EXPECT_EQ(ask(CeedElemRestrictionGetEVectorSize), size);
}

TEST_F(RestrictionFacts, RefuseBadStrides) {
  expect_error(create_strided(3, 2, 2, 11, {0, 0, 0}), CEED_ERROR_DIMENSION, {"[1, 2, 4]", "entry 11", "size 11"});
  expect_error(create_strided(3, 2, 2, 11, {1, 6, 2}), CEED_ERROR_DIMENSION, {"[1, 6, 2]", "entry 11"});
  expect_error(create_strided(3, 2, 2, 12, {1, -6, 2}), CEED_ERROR_DIMENSION, {"[1, -6, 2]", "0 or more"});
  expect_error(create_strided(largest, 2, 1, 12, {largest, 1, largest}), CEED_ERROR_DIMENSION, {"size 12"});
  expect_error(CeedElemRestrictionCreateStrided(ceed, 3, 2, 2, 12, nullptr, rstr.out()), CEED_ERROR_MINOR, {"NULL"});
}

TEST_F(RestrictionFacts, RefuseBadPoints) {
  expect_error(create_at_points(2, 3, 1, 2, {3, 5, 6, 0, 1, 2}), CEED_ERROR_DIMENSION, {"size is 2", "at least 3"});
  expect_error(create_at_points(2, 4, 1, 4, {3, 5, 6, 0, 1, 2}), CEED_ERROR_DIMENSION, {"hold 3 points", "at least 4"});
  expect_error(create_at_points(2, 3, 1, 3, {0, 2, 3, 0, 1, 2}), CEED_ERROR_DIMENSION,
               {"element 0", "offsets[0]", "offsets[3]"});
  expect_error(create_at_points(2, 0, 1, 3, {3, 5, 4, 0, 1, 2}), CEED_ERROR_DIMENSION,
               {"element 1", "offsets[5]", "offsets[4]"});
  expect_error(create_at_points(2, 3, 2, 6, {3, 5, 6, 0, 1, 3}), CEED_ERROR_DIMENSION,
               {"point 0 of element 1", "number 3", "[0, 3)"});
  expect_error(create_at_points(2, 3, 1, 3, {3, 5, 6, 0, -1, 2}), CEED_ERROR_DIMENSION,
               {"point 1 of element 0", "number -1"});
  expect_error(create_at_points(2, -1, 1, 3, {3, 5, 6, 0, 1, 2}), CEED_ERROR_DIMENSION, {"points is -1"});
}

TEST_F(RestrictionFacts, AcceptARankWithoutElements) {
  ok(CeedElemRestrictionCreateAtPoints(ceed, 0, 0, 3, 0, CEED_MEM_HOST, CEED_USE_POINTER, nullptr, rstr.out()));
  EXPECT_EQ(ask(CeedElemRestrictionGetEVectorSize), 0);
  EXPECT_EQ(ask(CeedElemRestrictionGetMaxPointsInElement), 0);
  ok(create_at_points(3, 0, 2, 0, {4, 4, 4, 4}));
  EXPECT_EQ(ask(CeedElemRestrictionGetEVectorSize), 0);
  EXPECT_EQ(ask(CeedElemRestrictionGetMaxPointsInElement), 0);
  Vector l, e;
  ok(CeedElemRestrictionCreateVector(rstr, l.out(), e.out()));
  ok(CeedVectorSetValue(l, 0.0));
  ok(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
}

TEST_F(RestrictionFacts, RefuseVectorsThatDoNotFit) {
  ok(create(3, 2, 1, 1, 4, {0, 1, 1, 2, 2, 3}));
  Vector l = make_vector(ceed, 4, 1.0), e = make_vector(ceed, 6, 1.0), shorter = make_vector(ceed, 3, 1.0), unset;
  ok(CeedVectorCreate(ceed, 6, unset.out()));
  const auto apply = [&](CeedTransposeMode mode, CeedVector u, CeedVector v) {
    return CeedElemRestrictionApply(rstr, mode, u, v, CEED_REQUEST_IMMEDIATE);
  };
  expect_error(apply(CEED_NOTRANSPOSE, shorter, e), CEED_ERROR_DIMENSION, {"Input CeedVector has 3", "at least 4"});
  expect_error(apply(CEED_NOTRANSPOSE, l, shorter), CEED_ERROR_DIMENSION, {"Output CeedVector has 3", "at least 6"});
  expect_error(apply(CEED_TRANSPOSE, l, l), CEED_ERROR_DIMENSION, {"Input CeedVector has 4", "at least 6"});
  expect_error(apply(CEED_NOTRANSPOSE, e, e), CEED_ERROR_INCOMPATIBLE, {"same vector"});
  expect_error(apply(CEED_TRANSPOSE, unset, l), CEED_ERROR_INCOMPLETE, {"holds no values"});
  expect_error(apply(CEED_TRANSPOSE, e, unset), CEED_ERROR_INCOMPLETE, {"holds no values"});
  expect_error(apply(CEED_NOTRANSPOSE, CEED_VECTOR_NONE, e), CEED_ERROR_INCOMPATIBLE, {"CEED_VECTOR_NONE"});
  expect_error(CeedElemRestrictionGetMultiplicity(rstr, shorter), CEED_ERROR_DIMENSION, {"3 entries", "size 4"});
  expect_error(CeedElemRestrictionApplyAtPointsInElement(rstr, 0, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE),
               CEED_ERROR_INCOMPATIBLE, {"not one at points"});
  ok(apply(CEED_NOTRANSPOSE, l, unset));
  EXPECT_EQ(values_of(unset), Values(6, 1.0));

  ok(create_at_points(2, 3, 1, 3, {3, 5, 6, 0, 1, 2}));
  Vector one = make_vector(ceed, 1, 0.0), points = make_vector(ceed, 3, 2.0);
  const auto in_element = [&](CeedInt elem) {
    return CeedElemRestrictionApplyAtPointsInElement(rstr, elem, CEED_NOTRANSPOSE, points, one, CEED_REQUEST_IMMEDIATE);
  };
  expect_error(in_element(0), CEED_ERROR_DIMENSION, {"has 1 entries", "at least 2"});
  expect_error(in_element(2), CEED_ERROR_DIMENSION, {"element is 2", "[0, 2)"});
  expect_error(in_element(-1), CEED_ERROR_DIMENSION, {"element is -1"});
  ok(in_element(1));
  EXPECT_EQ(values_of(one), Values(1, 2.0));
}

TEST_F(RestrictionFacts, EstimateTheirWork) {
  ok(create(3, 2, 2, 4, 8, {0, 1, 1, 2, 2, 3}));
  CeedSize flops = -1;
  ok(CeedElemRestrictionGetFlopsEstimate(rstr, CEED_NOTRANSPOSE, &flops));
  EXPECT_EQ(flops, 0);
  ok(CeedElemRestrictionGetFlopsEstimate(rstr, CEED_TRANSPOSE, &flops));
  EXPECT_EQ(flops, 12);
}

TEST(RestrictionSentinel, HasNoElements) {
  CeedHandle ceed{open(reference_resource)};
  CeedInt count = -1;
  ok(CeedElemRestrictionGetNumElements(CEED_ELEMRESTRICTION_NONE, &count));
  EXPECT_EQ(count, 0);
  EXPECT_EQ(printed([](FILE *stream) { ok(CeedElemRestrictionView(CEED_ELEMRESTRICTION_NONE, stream)); }),
            "CeedElemRestriction from (0, 0) to 0 elements with 0 nodes each and component stride 0\n");
}

}  // namespace
