/// @file
/// bps-kernel's own check at the degrees that take longer.
#include <gtest/gtest.h>

#include <string>

#include "program.hpp"

namespace hg::test {
namespace {

class HighDegree : public testing::TestWithParam<const char *> {
 protected:
  Finished check(const std::string &arguments) const {
    return run(std::string("'" BPS_KERNEL "' --check --quiet --ceed /cpu/self/ref/serial --problem ") + GetParam() +
               " " + arguments);
  }
};

TEST_P(HighDegree, ConvergesAtTheOptimalRate) {
  const Finished finished = check("--degree 5-8 --placement none");
  EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
  EXPECT_NE(finished.out.find("8 passed, 0 failed"), std::string::npos) << finished.out;
}

TEST_P(HighDegree, ConvergesAtPointsForEveryPlacement) {
  const Finished finished = check("--degree 3-4 --placement all");
  EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
  EXPECT_NE(finished.out.find("8 passed, 0 failed"), std::string::npos) << finished.out;
}

INSTANTIATE_TEST_SUITE_P(KernelLong, HighDegree, testing::Values("bp1", "bp2", "bp3", "bp4", "bp5", "bp6"),
                         [](const auto &info) { return std::string(info.param); });

}  // namespace
}  // namespace hg::test
