// What passes between the core and a backend as a restriction is made: layouts, refusals, memory.
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

/// A backend of this program: the reference, but for what a test wants of its create().
std::function<int(CeedElemRestriction)> on_create;
int num_destroyed = 0;

int create(CeedElemRestriction rstr) {
  return on_create ? on_create(rstr) : CEED_ERROR_SUCCESS;
}
int destroy(CeedElemRestriction) {
  num_destroyed++;
  return CEED_ERROR_SUCCESS;
}
int init(Ceed, const char *, CeedBackendOps *ops) {
  ops->restriction.create = create;
  ops->restriction.destroy = destroy;
  ops->host_memory_only = false;
  return CEED_ERROR_SUCCESS;
}

Ceed open_watched() {
  static const CeedBackend backends[] = {{.resource = "/test/watched",
                                          .parent = reference_resource,
                                          .priority = 1000,
                                          .aliases = nullptr,
                                          .score = nullptr,
                                          .init = init}};
  static const CeedPlugin plugin = {.size = sizeof(CeedPlugin),
                                    .api_version = CEED_PLUGIN_API_VERSION,
                                    .name = "watched",
                                    .num_backends = 1,
                                    .backends = backends};
  static const int registered = CeedPluginRegister(&plugin);
  ok(registered);
  return open("/test/watched");
}

class RestrictionBackend : public testing::Test {
 protected:
  void SetUp() override { num_destroyed = 0; }
  void TearDown() override { on_create = nullptr; }
  int create_strided(const CeedInt *strides) {
    return CeedElemRestrictionCreateStrided(ceed, 3, 2, 2, 12, strides, rstr.out());
  }

  CeedHandle ceed{open_watched()};
  Restriction rstr;
  const std::vector<CeedInt> offsets{0, 1, 1, 2, 2, 3};
};

TEST_F(RestrictionBackend, SeesTheWholeMap) {
  const CeedInt8 curl_orients[] = {9, 1, 0, 0, 1, 9, 9, 0, -1, -1, 0, 9, 9, 1, -1, 0, -1, 9};
  CeedElementMap seen{};
  on_create = [&](CeedElemRestriction made) -> int {
    const CeedElementMap *map = nullptr;
    CeedCallBackend(CeedElemRestrictionGetElementMap(made, &map));
    seen = *map;
    return CEED_ERROR_SUCCESS;
  };
  ok(CeedElemRestrictionCreateCurlOriented(ceed, 3, 2, 2, 4, 8, CEED_MEM_HOST, CEED_USE_POINTER, offsets.data(),
                                           curl_orients, rstr.out()));
  EXPECT_EQ(seen.type, CEED_RESTRICTION_CURL_ORIENTED);
  EXPECT_EQ((std::vector<CeedInt>{seen.num_elem, seen.elem_size, seen.num_comp, seen.block_size, seen.comp_stride}),
            (std::vector<CeedInt>{3, 2, 2, 1, 4}));
  EXPECT_EQ(seen.l_size, 8);
  EXPECT_EQ(seen.e_size, 12);
  EXPECT_EQ(seen.offsets, offsets.data());
  EXPECT_EQ(seen.num_bands, 3);
  EXPECT_EQ(seen.bands, curl_orients);
  // Copies are shown too: what a backend keeps of a restriction, it keeps of them.
  Restriction copy;
  ok(CeedElemRestrictionCreateUnorientedCopy(rstr, copy.out()));
  EXPECT_EQ(seen.type, CEED_RESTRICTION_STANDARD);
  EXPECT_EQ(seen.num_bands, 0);
  EXPECT_EQ(seen.offsets, offsets.data());
  copy.reset();
  EXPECT_EQ(num_destroyed, 1);
}

TEST_F(RestrictionBackend, RefusalLeavesTheUsersArrays) {
  on_create = [](CeedElemRestriction made) -> int {
    return CeedError(CeedElemRestrictionReturnCeed(made), CEED_ERROR_BACKEND, "no room for %s", "this");
  };
  const auto own = [](std::size_t size) { return std::calloc(6, size); };
  auto *own_offsets = static_cast<CeedInt *>(own(sizeof(CeedInt)));
  auto *own_orients = static_cast<bool *>(own(sizeof(bool)));
  for (const CeedInt block_size : {1, 2}) {
    expect_error(CeedElemRestrictionCreateBlockedOriented(ceed, 3, 2, block_size, 1, 1, 1, CEED_MEM_HOST,
                                                          CEED_OWN_POINTER, own_offsets, own_orients, rstr.out()),
                 CEED_ERROR_BACKEND, {"no room for this"});
    EXPECT_EQ(rstr.get(), nullptr);
  }
  EXPECT_EQ(num_destroyed, 0) << "what was refused is not shown again";
  on_create = nullptr;
  // Given once more, they are taken; blocked ones are read no more and freed at once.
  ok(CeedElemRestrictionCreateBlockedOriented(ceed, 3, 2, 2, 1, 1, 1, CEED_MEM_HOST, CEED_OWN_POINTER, own_offsets,
                                              own_orients, rstr.out()));
}

TEST_F(RestrictionBackend, SetsOnlyWhatIsItsOwn) {
  CeedInt layout[3] = {3, 6, 1};
  const CeedInt strides[3] = {1, 6, 2};
  on_create = [&](CeedElemRestriction made) { return CeedElemRestrictionSetLLayout(made, layout); };
  expect_error(create_strided(strides), CEED_ERROR_MINOR, {"strides that the user gave"});
  ok(create_strided(CEED_STRIDES_BACKEND));
  CeedInt got[3] = {0, 0, 0};
  ok(CeedElemRestrictionGetLLayout(rstr, got));
  EXPECT_EQ((std::vector<CeedInt>(got, got + 3)), (std::vector<CeedInt>{3, 6, 1}));
  ok(CeedElemRestrictionGetStrides(rstr, got));
  EXPECT_EQ((std::vector<CeedInt>(got, got + 3)), (std::vector<CeedInt>{0, 0, 0}));

  const CeedInt points[] = {3, 5, 6, 0, 1, 2};
  CeedSize e_size = 7;
  on_create = [&](CeedElemRestriction made) -> int {
    CeedInt padded[3] = {1, 2, 4};
    CeedCallBackend(CeedElemRestrictionSetELayout(made, padded));
    return CeedElemRestrictionSetAtPointsEVectorSize(made, e_size);
  };
  const auto at_points = [&] {
    return CeedElemRestrictionCreateAtPoints(ceed, 2, 3, 2, 6, CEED_MEM_HOST, CEED_USE_POINTER, points, rstr.out());
  };
  e_size = 5;
  expect_error(at_points(), CEED_ERROR_DIMENSION, {"E-vector is 5", "at least 6"});
  e_size = 8;
  ok(at_points());
  CeedSize start = 0;
  ok(CeedElemRestrictionGetEVectorSize(rstr, &start));
  EXPECT_EQ(start, 8);
  ok(CeedElemRestrictionGetAtPointsElementOffset(rstr, 1, &start));
  EXPECT_EQ(start, 4);
}

TEST_F(RestrictionBackend, GetsItsTablesOnTheHost) {
  const bool orients[6] = {};
  // Of a backend with device memory; the tables are checked on the host, where they have to be.
  expect_error(CeedElemRestrictionCreateOriented(ceed, 3, 2, 1, 1, 4, CEED_MEM_DEVICE, CEED_USE_POINTER, offsets.data(),
                                                 orients, rstr.out()),
               CEED_ERROR_UNSUPPORTED, {"offsets: memory type is CEED_MEM_DEVICE", "CEED_MEM_HOST"});
  ok(CeedElemRestrictionCreateOriented(ceed, 3, 2, 1, 1, 4, CEED_MEM_HOST, CEED_USE_POINTER, offsets.data(), orients,
                                       rstr.out()));
  const bool *got = nullptr;
  expect_error(CeedElemRestrictionGetOrientations(rstr, CEED_MEM_DEVICE, &got), CEED_ERROR_UNSUPPORTED,
               {"expected CEED_MEM_HOST"});
}

}  // namespace
