// The backends that must be there: a suite that runs on whatever it finds would pass on nothing.
#include <algorithm>

#include "backends.hpp"

namespace {

using namespace hg::test;

/// Always built, and open on every machine.
const char *const required[] = {
    "/cpu/self/ref/serial",
};

TEST(ExpectedBackends, AreListedAndOpen) {
  if (are_chosen()) GTEST_SKIP() << "backends were chosen with --ceed";
  for (const char *resource : required) {
    const auto found = std::find_if(backends().begin(), backends().end(),
                                    [&](const Backend &backend) { return backend.resource == resource; });
    ASSERT_NE(found, backends().end()) << resource << " is not listed";
    EXPECT_TRUE(found->is_usable) << resource << ": " << found->reason;
  }
}

class EveryBackend : public BackendTest {};

TEST_P(EveryBackend, GivesItsFullName) {
  const char *resource = nullptr;
  ok(CeedGetResource(ceed, &resource));
  EXPECT_EQ(resource, GetParam());
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
