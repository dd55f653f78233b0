// What each backend says of itself.
#include "backends.hpp"

namespace {

using namespace hg::test;

class EveryBackend : public BackendTest {};

TEST_P(EveryBackend, GivesItsFullName) {
  const char *resource = nullptr;
  ok(CeedGetResource(ceed, &resource));
  EXPECT_EQ(resource, GetParam().substr(0, GetParam().find(':')));  // options follow a colon
}

TEST_P(EveryBackend, SaysWhereItsMemoryIs) {
  CeedMemType type = CEED_MEM_DEVICE;
  ok(CeedGetPreferredMemType(ceed, &type));
  EXPECT_TRUE(type == CEED_MEM_HOST || type == CEED_MEM_DEVICE);
  if (GetParam().rfind("/cpu", 0) == 0) {
    EXPECT_EQ(type, CEED_MEM_HOST);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, EveryBackend, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
