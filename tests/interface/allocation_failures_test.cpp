// Every allocation of every scenario fails once, alone and with all that follow: there is an error and a message,
// nothing leaks (which the address sanitizer tells), and the library works afterwards.
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "allocation_failures.hpp"
#include "failing_calls.hpp"
#include "support/handles.hpp"
#include "support/program.hpp"

namespace {

using namespace hg::test;

struct Setting {
  const char *resource;
  const Scenario *scenario;
};

class AllocationFailures : public testing::TestWithParam<Setting> {};

/// Runs the scenario with its n-th allocation failing, for n = 1, 2, ... up to their number.
void fail_each(Ceed ceed, const Scenario &scenario, bool all) {
  long num_errors = 0;
  for (long n = 1;; n++) {
    Ended ended;
    long num_failed = 0;
    {
      const FailingAllocations failing(n, all);
      ended = run_to_end(scenario, ceed);
      num_failed = failing.num_failed();
    }
    const std::string place = "allocation " + std::to_string(n) + (all ? " and all after it" : "");
    ASSERT_EQ(ended.wrong, nullptr) << place << ": " << ended.wrong;
    if (ended.code != CEED_ERROR_SUCCESS) {
      num_errors++;
      ASSERT_GT(num_failed, 0) << place << ": error " << ended.code << ", " << told.message;
      ASSERT_TRUE(ended.code == CEED_ERROR_MAJOR || ended.code == CEED_ERROR_BACKEND)
          << place << ": error " << ended.code << ", " << told.message;
      ASSERT_GE(told.count, 1) << place << ": error " << ended.code << " told to nobody";
      ASSERT_NE(std::string(told.message).find("memory"), std::string::npos) << place << ": " << told.message;
    }
    // After some failures the same calls succeed.
    if (n % 16 == 1) {
      const Ended again = run_to_end(scenario, ceed);
      ASSERT_EQ(again.code, CEED_ERROR_SUCCESS) << "after " << place << ": " << told.message;
      ASSERT_EQ(again.wrong, nullptr) << "after " << place << ": " << again.wrong;
    }
    if (num_failed == 0) break;
  }
  EXPECT_GT(num_errors, 0);
}

TEST_P(AllocationFailures, AreErrorsThatLeakNothing) {
  CeedHandle ceed;
  ASSERT_EQ(CeedInit(GetParam().resource, ceed.out()), CEED_ERROR_SUCCESS);
  ASSERT_EQ(CeedSetErrorHandler(ceed, keep_told), CEED_ERROR_SUCCESS);
  const Ended first = run_to_end(*GetParam().scenario, ceed);
  ASSERT_EQ(first.code, CEED_ERROR_SUCCESS) << told.message;
  ASSERT_EQ(first.wrong, nullptr) << first.wrong;
  for (const bool all : {false, true}) fail_each(ceed, *GetParam().scenario, all);
}

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const char *resource : {"/cpu/self/ref/serial", "/cpu/self/memcheck/serial", "/cpu/self/avx/blocked"}) {
    for (const Scenario &scenario : failure_scenarios()) all.push_back({resource, &scenario});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, AllocationFailures, testing::ValuesIn(settings()), [](const auto &info) {
  std::string name = std::string(info.param.resource) + "_" + info.param.scenario->name;
  for (char &c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name.substr(10);
});

/// Whether memcheck, a plugin of this build, is there, or was refused with a message.
bool names_every_plugin() {
  std::size_t num = 0;
  CeedPluginInfo *plugins = nullptr;
  if (CeedPluginGetList(&num, &plugins) != CEED_ERROR_SUCCESS) return false;
  bool is_named = false;
  for (std::size_t i = 0; i < num; i++) {
    is_named = is_named || std::string(plugins[i].path).find("memcheck") != std::string::npos;
  }
  std::free(plugins);
  return is_named;
}

/// Opening and closing a Ceed, the lists of the registry: there is no Ceed yet whose handler could be told.
void open_and_list(Ceed) {
  const auto must = [](int code) {
    if (code != CEED_ERROR_SUCCESS) throw Refused{code};
  };
  CeedHandle ceed;
  must(CeedInit("/cpu/self/ref/serial:an_option_that_is_long_enough_for_the_heap", ceed.out()));
  std::size_t num = 0;
  char **names = nullptr;
  CeedInt *priorities = nullptr;
  must(CeedRegistryGetList(&num, &names, &priorities));
  const bool has_backends = num >= 1;
  std::free(names);
  std::free(priorities);
  if (!has_backends) throw Wrong{"the registry has lost backends"};
}

TEST(AllocationFailuresOfNoCeed, AreErrorsThatLeakNothing) {
  constexpr Scenario scenario{"open", open_and_list};
  ASSERT_EQ(run_to_end(scenario, nullptr).code, CEED_ERROR_SUCCESS);  // now the registry is loaded
  for (const bool all : {false, true}) {
    for (long n = 1;; n++) {
      Ended ended;
      long num_failed = 0;
      {
        const FailingAllocations failing(n, all);
        ended = run_to_end(scenario, nullptr);
        num_failed = failing.num_failed();
      }
      ASSERT_EQ(ended.wrong, nullptr) << "allocation " << n << ": " << ended.wrong;
      ASSERT_TRUE(ended.code == CEED_ERROR_SUCCESS || num_failed > 0) << "allocation " << n << ": " << ended.code;
      if (num_failed == 0) break;
      EXPECT_NE(ended.code, CEED_ERROR_SUCCESS) << "allocation " << n;
      if (!all && ended.code != CEED_ERROR_SUCCESS) {
        const char *message = nullptr;
        ASSERT_EQ(CeedGetErrorMessage(nullptr, &message), CEED_ERROR_SUCCESS);
        EXPECT_NE(std::string(message).find("Out of memory"), std::string::npos)
            << "allocation " << n << ": " << message;
      }
    }
    EXPECT_EQ(run_to_end(scenario, nullptr).code, CEED_ERROR_SUCCESS);
  }
}

/// The registry of a process is loaded once: each allocation on the way fails in a process of its own.
TEST(AllocationFailuresOfNoCeed, LeaveARegistryThatCanBeLoaded) {
  const std::string self = std::filesystem::canonical("/proc/self/exe").string();
  for (long n = 1;; n += n < 40 ? 1 : 11) {
    const Finished finished = run(hg::test::quoted(self) + " --first-use " + std::to_string(n));
    if (finished.code == 3) break;
    ASSERT_EQ(finished.code, 0) << "allocation " << n << ": " << finished.out << finished.err;
    ASSERT_LT(n, 100000);
  }
}

}  // namespace

int main(int argc, char **argv) {
  ::setenv("CEED_ERROR_HANDLER", "store", 1);
  if (argc == 3 && std::string(argv[1]) == "--first-use") {
    const long n = std::atol(argv[2]);
    int code = CEED_ERROR_SUCCESS;
    long num_failed = 0;
    {
      const FailingAllocations failing(n, false);
      code = CeedRegisterAll();
      if (code == CEED_ERROR_SUCCESS) code = CeedQFunctionRegisterAll();
      num_failed = failing.num_failed();
    }
    const Ended again = run_to_end({"open", open_and_list}, nullptr);
    CeedHandle ceed;
    CeedQFunction qf = nullptr;
    const bool works = again.code == CEED_ERROR_SUCCESS && again.wrong == nullptr && names_every_plugin() &&
                       CeedInit("/cpu/self/ref/serial", ceed.out()) == CEED_ERROR_SUCCESS &&
                       CeedQFunctionCreateInteriorByName(ceed, "Identity to scalar", &qf) == CEED_ERROR_SUCCESS;
    CeedQFunctionDestroy(&qf);
    if (!works) return std::printf("allocation %ld: the library does not work after error %d\n", n, code), 2;
    return num_failed > 0 ? 0 : 3;  // 3: there are fewer allocations
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
