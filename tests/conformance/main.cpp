// main of the conformance programs: chooses backends, runs, and says what ran where and what did not.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "backends.hpp"

namespace {

using hg::test::Backend;
using hg::test::backends;

/// Keeps the reasons of skipped tests for the summary.
class Skips : public testing::EmptyTestEventListener {
 public:
  void OnTestEnd(const testing::TestInfo &info) override {
    const testing::TestResult &result = *info.result();
    for (int i = 0; i < result.total_part_count(); i++) {
      const testing::TestPartResult &part = result.GetTestPartResult(i);
      if (part.skipped())
        list.push_back(std::string(info.test_suite_name()) + "." + info.name() + ": " + part.message());
    }
  }
  static inline std::vector<std::string> list;
};

/// Prints the summary.
class Summary : public testing::Environment {
 public:
  void TearDown() override {
    std::printf("\nBackends:\n");
    for (const Backend &backend : backends()) {
      if (backend.is_usable) {
        std::printf("  %-32s ran %d tests\n", backend.resource.c_str(), backend.num_tests);
      } else {
        std::printf("  %-32s not run: %s\n", backend.resource.c_str(), backend.reason.c_str());
      }
    }
    if (!Skips::list.empty()) std::printf("Skipped:\n");
    for (const std::string &skip : Skips::list) std::printf("  %s\n", skip.c_str());
    std::fflush(stdout);
  }
};

}  // namespace

int main(int argc, char **argv) {
  std::vector<std::string> chosen;
  std::vector<char *> rest;
  for (int i = 0; i < argc; i++) {
    const std::string argument = argv[i];
    if (argument == "--ceed" && i + 1 < argc) {
      chosen.emplace_back(argv[++i]);
    } else if (argument.rfind("--ceed=", 0) == 0) {
      chosen.push_back(argument.substr(7));
    } else {
      rest.push_back(argv[i]);
    }
  }
  hg::test::choose_backends(chosen);
  int num_rest = static_cast<int>(rest.size());
  rest.push_back(nullptr);
  testing::InitGoogleTest(&num_rest, rest.data());
  if (num_rest > 1) {
    std::fprintf(stderr, "Unknown option %s; expected --ceed RESOURCE or an option of GoogleTest\n", rest[1]);
    return 2;
  }
  testing::UnitTest::GetInstance()->listeners().Append(new Skips);
  testing::AddGlobalTestEnvironment(new Summary);
  const int failed = RUN_ALL_TESTS();
  if (testing::GTEST_FLAG(list_tests)) return failed;
  // A run on nothing is no success. A backend asked for by name must open.
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0) {
    std::fprintf(stderr, "No test ran\n");
    return 1;
  }
  for (const Backend &backend : backends()) {
    if (!chosen.empty() && !backend.is_usable) {
      std::fprintf(stderr, "%s was asked for and did not open\n", backend.resource.c_str());
      return 1;
    }
  }
  return failed;
}
