// The backends that must be there: a suite that runs on whatever it finds would pass on nothing.
#include <algorithm>

#include "backends.hpp"

namespace {

using namespace hg::test;

/// Always built, and open on every machine.
const char *const required[] = {
    "/cpu/self/ref/serial",
    "/cpu/self/memcheck/serial",
    "/cpu/self/avx/blocked",
    "/cpu/self/avx/serial",
    "/cpu/self/gen",
    "/gpu/emu/gen",
    "/gpu/emu/ref",
};

TEST(ExpectedBackends, AreListedAndOpen) {
  if (are_chosen()) GTEST_SKIP() << "backends were chosen with --ceed";
  for (const char *resource : required) {
    const auto found = std::find_if(backends().begin(), backends().end(),
                                    [&](const Backend &backend) { return backend.resource == resource; });
    ASSERT_NE(found, backends().end()) << resource << " is not listed";
    EXPECT_TRUE(found->is_usable || found->reason == left_out) << resource << ": " << found->reason;
  }
}

}  // namespace
