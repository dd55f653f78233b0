// Oriented, curl-oriented and blocked restrictions and their copies: what they tell, what they print and what they
// refuse. What they do is the conformance suite's.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace {

using namespace hg::test;

template <typename T>
T ask(CeedElemRestriction rstr, int (*getter)(CeedElemRestriction, T *)) {
  T value{};
  ok(getter(rstr, &value));
  return value;
}

/// The first `count` entries of a table, or none where there is no table.
template <typename T>
std::vector<int> table(CeedElemRestriction rstr, int (*get)(CeedElemRestriction, CeedMemType, const T **),
                       int (*restore)(CeedElemRestriction, const T **), std::size_t count) {
  const T *array = nullptr;
  ok(get(rstr, CEED_MEM_HOST, &array));
  std::vector<int> values;
  if (array != nullptr) values.assign(array, array + count);
  ok(restore(rstr, &array));
  EXPECT_EQ(array, nullptr);
  return values;
}
std::vector<int> offsets_of(CeedElemRestriction rstr, std::size_t count) {
  return table(rstr, CeedElemRestrictionGetOffsets, CeedElemRestrictionRestoreOffsets, count);
}
std::vector<int> orients_of(CeedElemRestriction rstr, std::size_t count) {
  return table(rstr, CeedElemRestrictionGetOrientations, CeedElemRestrictionRestoreOrientations, count);
}
std::vector<int> curl_orients_of(CeedElemRestriction rstr, std::size_t count) {
  return table(rstr, CeedElemRestrictionGetCurlOrientations, CeedElemRestrictionRestoreCurlOrientations, count);
}

std::string view(CeedElemRestriction rstr) {
  return printed([&](FILE *stream) { ok(CeedElemRestrictionView(rstr, stream)); });
}

/// Three elements of two nodes on a line of four, with two components far apart.
class RestrictionForms : public testing::Test {
 protected:
  int oriented(const CeedInt *its_offsets, const bool *its_orients, CeedCopyMode mode = CEED_COPY_VALUES) {
    return CeedElemRestrictionCreateOriented(ceed, 3, 2, 2, 4, 8, CEED_MEM_HOST, mode, its_offsets, its_orients,
                                             rstr.out());
  }
  int curl_oriented(const CeedInt *its_offsets, const CeedInt8 *its_orients, CeedCopyMode mode = CEED_COPY_VALUES) {
    return CeedElemRestrictionCreateCurlOriented(ceed, 3, 2, 2, 4, 8, CEED_MEM_HOST, mode, its_offsets, its_orients,
                                                 rstr.out());
  }
  CeedSize flops(CeedTransposeMode mode) {
    CeedSize count = -1;
    ok(CeedElemRestrictionGetFlopsEstimate(rstr, mode, &count));
    return count;
  }
  void expect_sizes(CeedRestrictionType type) {
    EXPECT_EQ(ask(rstr, CeedElemRestrictionGetType), type);
    EXPECT_EQ(ask(rstr, CeedElemRestrictionGetNumElements), 3);
    EXPECT_EQ(ask(rstr, CeedElemRestrictionGetElementSize), 2);
    EXPECT_EQ(ask(rstr, CeedElemRestrictionGetNumComponents), 2);
    EXPECT_EQ(ask(rstr, CeedElemRestrictionGetCompStride), 4);
    EXPECT_EQ(ask(rstr, CeedElemRestrictionGetLVectorSize), 8);
    EXPECT_FALSE(ask(rstr, CeedElemRestrictionIsStrided));
    EXPECT_FALSE(ask(rstr, CeedElemRestrictionIsAtPoints));
  }

  CeedHandle ceed{open(reference_resource)};
  Restriction rstr;
  const std::vector<CeedInt> offsets{0, 1, 1, 2, 2, 3};
  const bool orients[6] = {false, true, true, false, false, true};
  const std::vector<CeedInt8> curl_orients{9, 1, 0, 0, 1, 9, 9, 0, -1, -1, 0, 9, 9, 2, -1, 3, -1, 9};
};

TEST_F(RestrictionForms, Oriented) {
  ok(oriented(offsets.data(), orients));
  expect_sizes(CEED_RESTRICTION_ORIENTED);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 12);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetNumBlocks), 3);
  EXPECT_EQ(offsets_of(rstr, 6), std::vector<int>(offsets.begin(), offsets.end()));
  EXPECT_EQ(orients_of(rstr, 6), (std::vector<int>{0, 1, 1, 0, 0, 1}));
  EXPECT_EQ(curl_orients_of(rstr, 18), std::vector<int>());
  // A sign for each value, and an addition for each that is scattered.
  EXPECT_EQ(flops(CEED_NOTRANSPOSE), 12);
  EXPECT_EQ(flops(CEED_TRANSPOSE), 24);
  EXPECT_EQ(view(rstr), "CeedElemRestriction from (8, 2) to 3 elements with 2 nodes each and component stride 4\n");
}

TEST_F(RestrictionForms, CurlOriented) {
  ok(curl_oriented(offsets.data(), curl_orients.data()));
  expect_sizes(CEED_RESTRICTION_CURL_ORIENTED);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 12);
  EXPECT_EQ(offsets_of(rstr, 6), std::vector<int>(offsets.begin(), offsets.end()));
  EXPECT_EQ(orients_of(rstr, 6), std::vector<int>());
  EXPECT_EQ(curl_orients_of(rstr, 18), std::vector<int>(curl_orients.begin(), curl_orients.end()));
  // Three products and two sums; or three products, each added.
  EXPECT_EQ(flops(CEED_NOTRANSPOSE), 60);
  EXPECT_EQ(flops(CEED_TRANSPOSE), 72);
  EXPECT_EQ(view(rstr), "CeedElemRestriction from (8, 2) to 3 elements with 2 nodes each and component stride 4\n");
}

TEST_F(RestrictionForms, WithoutOrientationHaveNone) {
  ok(CeedElemRestrictionCreate(ceed, 3, 2, 2, 4, 8, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), rstr.out()));
  EXPECT_EQ(orients_of(rstr, 6), std::vector<int>());
  EXPECT_EQ(curl_orients_of(rstr, 18), std::vector<int>());
}

TEST_F(RestrictionForms, KeepTheirTablesAsAsked) {
  const bool *signs = nullptr;
  const CeedInt8 *matrices = nullptr;
  ok(oriented(offsets.data(), orients, CEED_USE_POINTER));
  ok(CeedElemRestrictionGetOrientations(rstr, CEED_MEM_HOST, &signs));
  EXPECT_EQ(signs, orients);
  ok(CeedElemRestrictionRestoreOrientations(rstr, &signs));
  ok(curl_oriented(offsets.data(), curl_orients.data(), CEED_USE_POINTER));
  ok(CeedElemRestrictionGetCurlOrientations(rstr, CEED_MEM_HOST, &matrices));
  EXPECT_EQ(matrices, curl_orients.data());
  ok(CeedElemRestrictionRestoreCurlOrientations(rstr, &matrices));
  ok(curl_oriented(offsets.data(), curl_orients.data(), CEED_COPY_VALUES));
  ok(CeedElemRestrictionGetCurlOrientations(rstr, CEED_MEM_HOST, &matrices));
  EXPECT_NE(matrices, curl_orients.data());
  ok(CeedElemRestrictionRestoreCurlOrientations(rstr, &matrices));

  // What is refused is not adopted: these arrays stay ours.
  auto *own_offsets = static_cast<CeedInt *>(std::calloc(6, sizeof(CeedInt)));
  auto *own_orients = static_cast<bool *>(std::calloc(6, sizeof(bool)));
  own_offsets[5] = 9;
  Restriction refused;
  expect_error(CeedElemRestrictionCreateOriented(ceed, 3, 2, 2, 4, 8, CEED_MEM_HOST, CEED_OWN_POINTER, own_offsets,
                                                 own_orients, refused.out()),
               CEED_ERROR_DIMENSION, {"element 2, node 1 is 9"});
  std::free(own_offsets);
  std::free(own_orients);
}

TEST_F(RestrictionForms, LockTheirTables) {
  ok(oriented(offsets.data(), orients));
  const bool *signs = nullptr;
  ok(CeedElemRestrictionGetOrientations(rstr, CEED_MEM_HOST, &signs));
  expect_error(CeedElemRestrictionDestroy(rstr.address()), CEED_ERROR_ACCESS,
               {"Cannot destroy CeedElemRestriction, a process has read access to the offset data"});
  ok(CeedElemRestrictionRestoreOrientations(rstr, &signs));
  expect_error(CeedElemRestrictionRestoreOrientations(rstr, &signs), CEED_ERROR_ACCESS,
               {"orientations, access was not granted"});
  const CeedInt8 *matrices = nullptr;
  expect_error(CeedElemRestrictionRestoreCurlOrientations(rstr, &matrices), CEED_ERROR_ACCESS,
               {"curl-orientations, access was not granted"});
  expect_error(CeedElemRestrictionGetOrientations(rstr, CEED_MEM_DEVICE, &signs), CEED_ERROR_BACKEND, {"HOST"});
}

TEST_F(RestrictionForms, RefuseBadOrientations) {
  expect_error(oriented(offsets.data(), nullptr), CEED_ERROR_MINOR, {"the orientations are NULL"});
  expect_error(curl_oriented(offsets.data(), nullptr), CEED_ERROR_MINOR, {"the curl-orientations are NULL"});
  expect_error(oriented(nullptr, orients), CEED_ERROR_MINOR, {"the offsets are NULL"});
  expect_error(oriented(offsets.data(), orients, static_cast<CeedCopyMode>(3)), CEED_ERROR_MINOR, {"copy mode is 3"});
  std::vector<CeedInt8> wrong = curl_orients;
  wrong[8] = -128;
  expect_error(curl_oriented(offsets.data(), wrong.data()), CEED_ERROR_DIMENSION,
               {"curl-orientation 2 of element 1 is -128"});
  std::vector<CeedInt> beyond = offsets;
  beyond[4] = 4;
  expect_error(curl_oriented(beyond.data(), curl_orients.data()), CEED_ERROR_DIMENSION, {"element 2, node 0 is 4"});
  EXPECT_EQ(rstr.get(), nullptr);
}

TEST_F(RestrictionForms, Blocked) {
  ok(CeedElemRestrictionCreateBlocked(ceed, 3, 2, 2, 2, 4, 8, CEED_MEM_HOST, CEED_USE_POINTER, offsets.data(),
                                      rstr.out()));
  expect_sizes(CEED_RESTRICTION_STANDARD);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetNumBlocks), 2);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetBlockSize), 2);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 16);
  // Node, then element of the block; the last element twice.
  EXPECT_EQ(offsets_of(rstr, 8), (std::vector<int>{0, 1, 1, 2, 2, 2, 3, 3}));
  EXPECT_EQ(view(rstr),
            "Blocked CeedElemRestriction from (8, 2) to 3 elements with 2 nodes each and component stride 4\n");
  // Blocks of one element are no blocks.
  ok(CeedElemRestrictionCreateBlocked(ceed, 3, 2, 1, 2, 4, 8, CEED_MEM_HOST, CEED_USE_POINTER, offsets.data(),
                                      rstr.out()));
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetNumBlocks), 3);
  EXPECT_EQ(offsets_of(rstr, 6), std::vector<int>(offsets.begin(), offsets.end()));
  EXPECT_EQ(view(rstr), "CeedElemRestriction from (8, 2) to 3 elements with 2 nodes each and component stride 4\n");
}

TEST_F(RestrictionForms, BlockedWithOrientations) {
  ok(CeedElemRestrictionCreateBlockedOriented(ceed, 3, 2, 2, 2, 4, 8, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(),
                                              orients, rstr.out()));
  expect_sizes(CEED_RESTRICTION_ORIENTED);
  EXPECT_EQ(offsets_of(rstr, 8), (std::vector<int>{0, 1, 1, 2, 2, 2, 3, 3}));
  EXPECT_EQ(orients_of(rstr, 8), (std::vector<int>{0, 1, 1, 0, 0, 0, 1, 1}));
  EXPECT_EQ(flops(CEED_NOTRANSPOSE), 16);
  EXPECT_EQ(view(rstr).substr(0, 27), "Blocked CeedElemRestriction");
  ok(CeedElemRestrictionCreateBlockedCurlOriented(ceed, 3, 2, 2, 2, 4, 8, CEED_MEM_HOST, CEED_COPY_VALUES,
                                                  offsets.data(), curl_orients.data(), rstr.out()));
  expect_sizes(CEED_RESTRICTION_CURL_ORIENTED);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 16);
  EXPECT_EQ(curl_orients_of(rstr, 24),
            (std::vector<int>{9, 9, 1, 0, 0, -1, 0, -1, 1, 0, 9, 9, 9, 9, 2, 2, -1, -1, 3, 3, -1, -1, 9, 9}));
}

TEST_F(RestrictionForms, BlockedStrided) {
  const CeedInt strides[3] = {1, 6, 2};
  ok(CeedElemRestrictionCreateBlockedStrided(ceed, 3, 2, 2, 2, 12, strides, rstr.out()));
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetType), CEED_RESTRICTION_STRIDED);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetNumBlocks), 2);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 16);
  EXPECT_EQ(view(rstr),
            "Blocked CeedElemRestriction from (12, 2) to 3 elements with 2 nodes each and strides [1, 6, 2]\n");
  CeedInt layout[3] = {0, 0, 0};
  ok(CeedElemRestrictionCreateBlockedStrided(ceed, 3, 2, 2, 2, 12, CEED_STRIDES_BACKEND, rstr.out()));
  EXPECT_TRUE(ask(rstr, CeedElemRestrictionHasBackendStrides));
  ok(CeedElemRestrictionGetLLayout(rstr, layout));
  EXPECT_EQ((std::vector<int>(layout, layout + 3)), (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(view(rstr),
            "Blocked CeedElemRestriction from (12, 2) to 3 elements with 2 nodes each and strides [0, 0, 0]\n");
  // The L-vector has no room for the copies that fill the last block, and needs none.
  expect_error(CeedElemRestrictionCreateBlockedStrided(ceed, 3, 2, 2, 2, 11, CEED_STRIDES_BACKEND, rstr.out()),
               CEED_ERROR_DIMENSION, {"[1, 2, 4]", "entry 11"});
}

TEST_F(RestrictionForms, RefuseBadBlocks) {
  const auto create = [&](CeedInt block_size) {
    return CeedElemRestrictionCreateBlocked(ceed, 3, 2, block_size, 1, 1, 4, CEED_MEM_HOST, CEED_COPY_VALUES,
                                            offsets.data(), rstr.out());
  };
  expect_error(create(0), CEED_ERROR_DIMENSION, {"block size is 0", "1 element or more"});
  expect_error(create(-2), CEED_ERROR_DIMENSION, {"block size is -2"});
  expect_error(CeedElemRestrictionCreateBlocked(ceed, 3, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(),
                                                rstr.out()),
               CEED_ERROR_DIMENSION, {"element 2, node 1 is 3"});
  const CeedInt strides[3] = {0, 0, 0}, most = 2147483647;
  expect_error(CeedElemRestrictionCreateBlockedStrided(ceed, most, 1, 2, 1, most, strides, rstr.out()),
               CEED_ERROR_DIMENSION, {"whole blocks", "2147483648"});
  ok(create(2));
  Vector l = make_vector(ceed, 4, 1.0), block = make_vector(ceed, 4, 0.0), small = make_vector(ceed, 3, 0.0);
  const auto apply = [&](CeedInt number, CeedTransposeMode mode, CeedVector u, CeedVector v) {
    return CeedElemRestrictionApplyBlock(rstr, number, mode, u, v, CEED_REQUEST_IMMEDIATE);
  };
  expect_error(apply(2, CEED_NOTRANSPOSE, l, block), CEED_ERROR_DIMENSION, {"block is 2", "[0, 2)"});
  expect_error(apply(-1, CEED_NOTRANSPOSE, l, block), CEED_ERROR_DIMENSION, {"block is -1"});
  expect_error(apply(0, CEED_NOTRANSPOSE, l, small), CEED_ERROR_DIMENSION, {"Output CeedVector has 3", "at least 4"});
  expect_error(apply(0, CEED_TRANSPOSE, small, l), CEED_ERROR_DIMENSION, {"Input CeedVector has 3", "at least 4"});
  expect_error(apply(0, CEED_NOTRANSPOSE, l, l), CEED_ERROR_INCOMPATIBLE, {"same vector"});
  ok(apply(1, CEED_NOTRANSPOSE, l, block));
}

TEST_F(RestrictionForms, KeepTheLayoutsTheyWereMadeWith) {
  CeedInt layout[3] = {3, 6, 1};
  ok(CeedElemRestrictionCreate(ceed, 3, 2, 2, 4, 8, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), rstr.out()));
  expect_error(CeedElemRestrictionSetELayout(rstr, layout), CEED_ERROR_ACCESS, {"made already"});
  expect_error(CeedElemRestrictionSetLLayout(rstr, layout), CEED_ERROR_MINOR, {"no strides"});
  expect_error(CeedElemRestrictionSetAtPointsEVectorSize(rstr, 99), CEED_ERROR_INCOMPATIBLE, {"no points"});
  ok(CeedElemRestrictionGetELayout(rstr, layout));
  EXPECT_EQ((std::vector<int>(layout, layout + 3)), (std::vector<int>{1, 2, 4}));
  ok(CeedElemRestrictionCreateStrided(ceed, 3, 2, 2, 12, CEED_STRIDES_BACKEND, rstr.out()));
  expect_error(CeedElemRestrictionSetLLayout(rstr, layout), CEED_ERROR_ACCESS, {"made already"});
}

TEST_F(RestrictionForms, UnsignedCopy) {
  Restriction copy;
  ok(oriented(offsets.data(), orients));
  ok(CeedElemRestrictionCreateUnsignedCopy(rstr, copy.out()));
  EXPECT_EQ(ask(copy, CeedElemRestrictionGetType), CEED_RESTRICTION_STANDARD);
  EXPECT_EQ(orients_of(copy, 6), std::vector<int>());
  ok(curl_oriented(offsets.data(), curl_orients.data()));
  ok(CeedElemRestrictionCreateUnsignedCopy(rstr, copy.out()));
  EXPECT_EQ(ask(copy, CeedElemRestrictionGetType), CEED_RESTRICTION_CURL_ORIENTED);
  EXPECT_EQ(curl_orients_of(copy, 18), (std::vector<int>{9, 1, 0, 0, 1, 9, 9, 0, 1, 1, 0, 9, 9, 2, 1, 3, 1, 9}));
  EXPECT_EQ(curl_orients_of(rstr, 18), std::vector<int>(curl_orients.begin(), curl_orients.end()));
}

TEST_F(RestrictionForms, UnorientedCopy) {
  Restriction copy, second;
  ok(curl_oriented(offsets.data(), curl_orients.data()));
  ok(CeedElemRestrictionCreateUnorientedCopy(rstr, copy.out()));
  // A copy of a copy reads the same tables, and outlives both.
  ok(CeedElemRestrictionCreateUnsignedCopy(copy, second.out()));
  rstr.reset();
  copy.reset();
  std::swap(rstr, second);
  expect_sizes(CEED_RESTRICTION_STANDARD);
  EXPECT_EQ(curl_orients_of(rstr, 18), std::vector<int>());
  EXPECT_EQ(offsets_of(rstr, 6), std::vector<int>(offsets.begin(), offsets.end()));
}

TEST_F(RestrictionForms, CopiesKeepWhatIsNotOrientation) {
  const CeedInt points[] = {3, 5, 6, 0, 1, 2};
  const auto copies_look_alike = [&] {
    Restriction unsigned_copy, unoriented_copy;
    ok(CeedElemRestrictionCreateUnsignedCopy(rstr, unsigned_copy.out()));
    ok(CeedElemRestrictionCreateUnorientedCopy(rstr, unoriented_copy.out()));
    for (const auto *copy : {&unsigned_copy, &unoriented_copy}) {
      EXPECT_NE(copy->get(), rstr.get());
      EXPECT_EQ(view(*copy), view(rstr));
      EXPECT_EQ(ask(*copy, CeedElemRestrictionGetType), ask(rstr, CeedElemRestrictionGetType));
      EXPECT_EQ(ask(*copy, CeedElemRestrictionGetEVectorSize), ask(rstr, CeedElemRestrictionGetEVectorSize));
      EXPECT_EQ(ask(*copy, CeedElemRestrictionGetNumBlocks), ask(rstr, CeedElemRestrictionGetNumBlocks));
    }
    // Tabs are each one's own.
    ok(CeedElemRestrictionSetNumViewTabs(unsigned_copy, 1));
    EXPECT_EQ(view(unsigned_copy), "  " + view(rstr));
  };
  ok(CeedElemRestrictionCreateBlockedStrided(ceed, 3, 2, 2, 2, 12, CEED_STRIDES_BACKEND, rstr.out()));
  copies_look_alike();
  ok(CeedElemRestrictionCreateAtPoints(ceed, 2, 3, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, points, rstr.out()));
  copies_look_alike();
  CeedInt num_points = 0;
  Restriction copy;
  ok(CeedElemRestrictionCreateUnorientedCopy(rstr, copy.out()));
  ok(CeedElemRestrictionGetNumPoints(copy, &num_points));
  EXPECT_EQ(num_points, 3);
  EXPECT_EQ(CeedElemRestrictionCreateUnsignedCopy(nullptr, copy.out()), CEED_ERROR_INCOMPLETE);
  EXPECT_EQ(CeedElemRestrictionCreateUnorientedCopy(CEED_ELEMRESTRICTION_NONE, copy.out()), CEED_ERROR_INCOMPATIBLE);
}

TEST_F(RestrictionForms, AcceptARankWithoutElements) {
  ok(CeedElemRestrictionCreateOriented(ceed, 0, 2, 1, 1, 0, CEED_MEM_HOST, CEED_USE_POINTER, nullptr, nullptr,
                                       rstr.out()));
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 0);
  ok(CeedElemRestrictionCreateCurlOriented(ceed, 0, 2, 1, 1, 0, CEED_MEM_HOST, CEED_COPY_VALUES, nullptr, nullptr,
                                           rstr.out()));
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 0);
  ok(CeedElemRestrictionCreateBlockedCurlOriented(ceed, 0, 2, 4, 1, 1, 0, CEED_MEM_HOST, CEED_COPY_VALUES, nullptr,
                                                  nullptr, rstr.out()));
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetEVectorSize), 0);
  EXPECT_EQ(ask(rstr, CeedElemRestrictionGetNumBlocks), 0);
}

}  // namespace
