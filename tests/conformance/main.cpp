// main of the conformance programs: chooses backends, runs, and says what ran where and what did not.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "backends.hpp"
#include "records.hpp"

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

constexpr const char *usage =
    "  --ceed RESOURCE  a backend to run on, instead of all that open here; repeat for several\n"
    "  --plugin FILE    load this plugin first; repeat for several\n"
    "  --record FILE    append a line for each case to this file; cases that it names already are left out\n"
    "and the options of GoogleTest\n";

struct Options {
  std::vector<std::string> resources, plugins;
  std::string record;
  std::vector<char *> rest;  ///< for GoogleTest
};

Options parse(int argc, char **argv) {
  Options options;
  for (int i = 0; i < argc; i++) {
    const std::string argument = argv[i];
    const auto take = [&](const std::string &name, auto &&store) {
      if (argument == name && i + 1 < argc) {
        store(argv[++i]);
      } else if (argument.rfind(name + "=", 0) == 0) {
        store(argument.substr(name.size() + 1));
      } else {
        return false;
      }
      return true;
    };
    if (take("--ceed", [&](std::string text) { options.resources.push_back(std::move(text)); })) continue;
    if (take("--plugin", [&](std::string text) { options.plugins.push_back(std::move(text)); })) continue;
    if (take("--record", [&](std::string text) { options.record = std::move(text); })) continue;
    options.rest.push_back(argv[i]);
  }
  return options;
}

/// The suite runs against any library with the interface; loading plugins is ours alone, so it is asked for by name.
bool load(const std::string &plugin) {
  const auto load = reinterpret_cast<int (*)(const char *)>(dlsym(RTLD_DEFAULT, "CeedPluginLoad"));
  const auto error = reinterpret_cast<const char *(*)()>(dlsym(RTLD_DEFAULT, "CeedPluginLoadError"));
  if (load != nullptr && load(plugin.c_str()) == 0) return true;
  std::fprintf(stderr, "--plugin %s: %s\n", plugin.c_str(), error != nullptr ? error() : "this library has no plugins");
  return false;
}

/// Leaves out the cases that the record names.
void resume_after(const std::string &record) {
  const std::string seen = hg::test::filter_of_cases_in(record);
  if (seen.empty()) return;
  std::string filter = testing::GTEST_FLAG(filter);
  filter += (filter.find('-') == std::string::npos ? "-" : ":") + seen;
  testing::GTEST_FLAG(filter) = filter;
}

}  // namespace

int main(int argc, char **argv) {
  Options options = parse(argc, argv);
  for (const std::string &plugin : options.plugins) {
    if (!load(plugin)) return 2;
  }
  hg::test::choose_backends(options.resources);
  int num_rest = static_cast<int>(options.rest.size());
  options.rest.push_back(nullptr);
  testing::InitGoogleTest(&num_rest, options.rest.data());
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  if (num_rest > 1) {
    std::fprintf(stderr, "Unknown option %s; expected\n%s", options.rest[1], usage);
    return 2;
  }
  testing::UnitTest::GetInstance()->listeners().Append(new Skips);
  if (!options.record.empty()) {
    resume_after(options.record);
    testing::UnitTest::GetInstance()->listeners().Append(new hg::test::Recorder(options.record));
  }
  testing::AddGlobalTestEnvironment(new Summary);
  const int failed = RUN_ALL_TESTS();
  // A run on nothing is no success, unless there was nothing left to do. A backend asked for by name must open.
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0 && options.record.empty()) {
    std::fprintf(stderr, "No test ran\n");
    return 1;
  }
  for (const Backend &backend : backends()) {
    if (!options.resources.empty() && !backend.is_usable) {
      std::fprintf(stderr, "%s was asked for and did not open\n", backend.resource.c_str());
      return 1;
    }
  }
  return failed;
}
