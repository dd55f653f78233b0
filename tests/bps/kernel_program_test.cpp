/// @file
/// bps-kernel as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "program.hpp"

namespace hg::test {
namespace {

const std::string reference = " --ceed /cpu/self/ref/serial --quiet ";

Finished kernel(const std::string &arguments) {
  return run(std::string("'" BPS_KERNEL "'") + " " + arguments);
}

long count(const std::string &text, const std::string &fragment) {
  long found = 0;
  for (auto at = text.find(fragment); at != std::string::npos; at = text.find(fragment, at + 1)) found++;
  return found;
}

/// Expects that --check ran `lines` properties and that all held.
void expect_all_pass(const Finished &finished, long lines) {
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(count(finished.out, "PASS "), lines) << finished.out;
  EXPECT_EQ(count(finished.out, "FAIL "), 0) << finished.out;
}

class BakeOffProblem : public testing::TestWithParam<const char *> {
 protected:
  std::string problem() const { return std::string(" --problem ") + GetParam(); }
};

TEST_P(BakeOffProblem, ConvergesAtTheOptimalRate) {
  expect_all_pass(kernel("--check --placement none --degree 1-4" + reference + problem()), 8);
}

TEST_P(BakeOffProblem, ConvergesAtPointsForEveryPlacement) {
  expect_all_pass(kernel("--check --placement all --degree 1-2" + reference + problem()), 8);
}

INSTANTIATE_TEST_SUITE_P(Kernel, BakeOffProblem, testing::Values("bp1", "bp2", "bp3", "bp4", "bp5", "bp6"),
                         [](const auto &info) { return std::string(info.param); });

/// One point a cell cannot carry a quadratic: the check has to notice.
TEST(Kernel, CheckFailsWhereThePointsAreTooFew) {
  const Finished finished = kernel("--check --problem bp1 --degree 2 --points 1" + reference);
  EXPECT_EQ(finished.code, 1);
  EXPECT_EQ(count(finished.out, "FAIL bp1 p=2"), 1) << finished.out;
  EXPECT_EQ(count(finished.out, "1 passed, 1 failed"), 1) << finished.out;
}

TEST(Kernel, EveryBackendOfTheLibraryRuns) {
  const TemporaryFolder folder;
  const auto file = folder / "all.json";
  const Finished finished =
      kernel("--ceed all --problem all --degree 2 --dofs 1000 --reps 1 --quiet --json " + quoted(file));
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto records = read_json(file);
  ASSERT_GE(records.size(), 6u);
  EXPECT_EQ(records.size() % 6, 0u);
  EXPECT_TRUE(std::ranges::any_of(records, [](const auto &r) { return r["ceed"] == "/cpu/self/ref/serial"; }));
  EXPECT_TRUE(std::ranges::none_of(records, [](const auto &r) {
    return r["ceed"].template get<std::string>().find("memcheck") != std::string::npos;
  }));
  std::map<std::string, int> num_runs;
  for (const auto &record : records) {
    expect_record(record);
    num_runs[record["ceed"]]++;
  }
  for (const auto &[ceed, num] : num_runs) EXPECT_EQ(num, 6) << ceed << ": once for each problem, other names left out";
}

TEST(Kernel, RecordsHoldTheSchema) {
  const TemporaryFolder folder;
  const auto file = folder / "records.json";
  const Finished finished = kernel(
      "--problem bp2,bp5 --degree 1-2 --dofs 500,2000 --points 27 --placement none,uniform,random,quadrature --reps 2 "
      "--cg-iterations 1000 --json " +
      quoted(file) + reference);
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto records = read_json(file);
  ASSERT_EQ(records.size(), 2u * 2 * 2 * 4);
  for (const auto &record : records) {
    expect_record(record);
    EXPECT_EQ(record["program"], "bps-kernel");
    EXPECT_EQ(record["ranks"], 1);
    EXPECT_EQ(record["repetitions"], 2);
    EXPECT_TRUE(record["cg_converged"].get<bool>());
    EXPECT_LT(record["error"].get<double>(), 0.5);
    EXPECT_EQ(count(finished.out, record["problem"].get<std::string>() + " "), 16);
  }
}

TEST(Kernel, MarksTheFastestOfSeveralBackends) {
  const Finished finished =
      kernel("--problem bp1 --degree 1-2 --dofs 500 --reps 1 --ceed /cpu/self/ref/serial" + reference);
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(count(finished.out, "/cpu/self/ref/serial"), 4) << finished.out;
  EXPECT_EQ(count(finished.out, "* "), 2) << finished.out;
}

TEST(Kernel, ReportsItsProgressAwayFromItsResults) {
  const Finished finished = kernel("--problem bp1,bp3 --degree 1 --dofs 100 --reps 1 --ceed /cpu/self/ref/serial");
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(count(finished.err, "[2/2] bp3 p=1"), 1) << finished.err;
  EXPECT_EQ(count(finished.out, "[2/2]"), 0) << finished.out;
}

TEST(Kernel, SolvesTheSameProblemTwiceAlike) {
  const TemporaryFolder folder;
  const auto error = [&](const char *name) {
    const auto file = folder / name;
    const Finished finished = kernel(
        "--problem bp4 --degree 2 --dofs 1000 --points 40 --placement random --reps 1 "
        "--cg-iterations 500 --json " +
        quoted(file) + reference);
    EXPECT_EQ(finished.code, 0) << finished.err;
    return read_json(file).at(0).at("error").get<double>();
  };
  EXPECT_EQ(error("first"), error("second"));
}

/// The dot product made of norms, for vectors that live on a device, gives the iterations of the one on the host.
TEST(Kernel, SolvesWithoutHostAccessAlike) {
  const TemporaryFolder folder;
  const auto record = [&](const std::string &dot) {
    const auto file = folder / dot;
    const Finished finished =
        kernel("--problem bp1,bp3 --degree 5 --dofs 2000 --reps 1 --cg-iterations 2000 --cg-dot " + dot + " --json " +
               quoted(file) + reference);
    EXPECT_EQ(finished.code, 0) << finished.err;
    return read_json(file);
  };
  const auto host = record("host"), norms = record("norms");
  for (int i = 0; i < 2; i++) {
    ASSERT_TRUE(norms.at(i)["cg_converged"].get<bool>());
    const int iterations = host.at(i)["cg_iterations"];
    EXPECT_NEAR(norms[i]["cg_iterations"].get<int>(), iterations, 2 + iterations / 20);
    EXPECT_NEAR(norms[i]["error"].get<double>() / host[i]["error"].get<double>(), 1, 1e-4);
  }
}

struct BadOptions {
  const char *arguments, *fragments[2];
  friend void PrintTo(const BadOptions &which, std::ostream *stream) { *stream << which.arguments; }
};

class BadInput : public testing::TestWithParam<BadOptions> {};

TEST_P(BadInput, IsRefusedWithAMessageThatHelps) {
  const auto &[arguments, fragments] = GetParam();
  const Finished finished = kernel(arguments);
  EXPECT_EQ(finished.code, 2) << finished.err;
  EXPECT_EQ(finished.out, "");
  for (const char *fragment : fragments) EXPECT_NE(finished.err.find(fragment), std::string::npos) << finished.err;
}

INSTANTIATE_TEST_SUITE_P(
    Kernel, BadInput,
    testing::Values(BadOptions{"--problem bp7", {"--problem bp7", "bp6 and all"}},
                    BadOptions{"--degree 9", {"--degree 9", "1 to 8"}}, BadOptions{"--degree 3-1", {"'3-1'", "1 to 8"}},
                    BadOptions{"--dofs -5", {"--dofs -5", "is not a number within"}},
                    BadOptions{"--points 20", {"20 points a cell", "cube of a whole number"}},
                    BadOptions{"--points 0 --placement random", {"--points 0", "1 to"}},
                    BadOptions{"--placement gauss", {"--placement gauss", "--points N"}},
                    BadOptions{"--placement spiral", {"--placement spiral", "known are"}},
                    BadOptions{"--reps 0", {"--reps", "1000000"}}, BadOptions{"--sizes 3", {"--sizes", "--help"}},
                    BadOptions{"--ceed /no/such/backend --quiet", {"/no/such/backend", "/cpu/self/ref/serial"}},
                    BadOptions{"--json /no/such/folder/file.json", {"/no/such/folder/file.json", "cannot write"}}),
    [](const auto &info) { return name_from(info.param.arguments); });

TEST(Kernel, HelpNamesEveryOption) {
  const Finished finished = kernel("--help");
  EXPECT_EQ(finished.code, 0);
  for (const char *option : {"--ceed", "--problem", "--degree", "--dofs", "--points", "--placement", "--json", "--reps",
                             "--cg-iterations", "--cg-tolerance", "--cg-dot", "--check", "--quiet"})
    EXPECT_EQ(count(finished.out, std::string("  ") + option + " "), 1) << option << "\n" << finished.out;
}

}  // namespace
}  // namespace hg::test
