/// @file
/// The micro-benchmarks and the comparison of their records. Nothing here depends on how long something takes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "program.hpp"

namespace hg::test {
namespace {

const std::string compare = "'" BPS_PYTHON "' '" BPS_MICRO_FOLDER "/compare.py' ";

class Micro : public testing::Test {
 protected:
  std::string write(const std::string &name, const std::string &text) {
    std::ofstream(folder_ / name) << text;
    return quoted(folder_ / name) + " ";
  }

  TemporaryFolder folder_;
};

/// A file as Google Benchmark writes it, of entries such as `"name": "a", "cpu_time": 2.0`.
std::string record_of(std::initializer_list<const char *> entries) {
  std::string text;
  for (const char *entry : entries) text += (text.empty() ? "{" : ", {") + std::string(entry) + "}";
  return "{\"context\": {}, \"benchmarks\": [" + text + "]}";
}

#ifdef BPS_MICRO
TEST_F(Micro, TimesKernelsAndWritesJson) {
  const auto file = folder_ / "micro.json";
  const Finished finished = run("'" BPS_MICRO
                                "' --benchmark_min_time=0.001 '--benchmark_filter=/3x2/|gather/8x1|rows/8$' "
                                "--benchmark_out_format=json --benchmark_out=" +
                                quoted(file));
  ASSERT_EQ(finished.code, 0) << finished.err;
  const nlohmann::json record = read_json(file);
  EXPECT_TRUE(record["context"].contains("portable_fmas_per_second")) << record["context"];
  bool has_contraction = false;
  ASSERT_GE(record["benchmarks"].size(), 9u);
  for (const auto &entry : record["benchmarks"]) {
    SCOPED_TRACE(entry.dump());
    const auto name = entry["name"].get<std::string>();
    for (const char *counter : {"cpu_time", "bytes_per_second", "floor"}) EXPECT_GT(entry.at(counter).get<double>(), 0);
    const bool computes = name.find("contraction") != std::string::npos;
    EXPECT_EQ(entry.contains("flops_per_second"), computes);
    has_contraction = has_contraction || name == "portable/blocked/contraction/even/3x2/set";
  }
  EXPECT_TRUE(has_contraction);

  const Finished same = run(compare + quoted(file) + " " + quoted(file));
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_NE(same.out.find("geometric mean"), std::string::npos) << same.out;
  EXPECT_NE(same.out.find("1.000  (" + std::to_string(record["benchmarks"].size()) + " benchmarks)"), std::string::npos)
      << same.out;
}

TEST_F(Micro, OneInstructionSetIsChosenByTheEnvironment) {
  const Finished listed = run("CEED_HOST_ISA=portable '" BPS_MICRO "' --benchmark_list_tests");
  ASSERT_EQ(listed.code, 0) << listed.err;
  EXPECT_NE(listed.out.find("portable/blocked/points/evaluate/3/derivatives/27x1"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("avx"), std::string::npos) << listed.out;
  const Finished wrong = run("CEED_HOST_ISA=mmx '" BPS_MICRO "' --benchmark_list_tests");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("CEED_HOST_ISA is 'mmx', which is no instruction set of this machine"), std::string::npos)
      << wrong.err;
}
#endif

#ifdef BPS_MICRO_COUNT
TEST_F(Micro, CountsTheSameInstructionsInEveryRun) {
  const std::string count =
      "'" BPS_PYTHON "' '" BPS_MICRO_FOLDER "/count.py' '" BPS_MICRO_COUNT "' --valgrind '" BPS_VALGRIND "' --filter ";
  const auto first = folder_ / "first.json", second = folder_ / "second.json";
  for (const auto &file : {first, second}) {
    const Finished finished = run(count + "blocked/.*/3x2/ --out " + quoted(file));
    ASSERT_EQ(finished.code, 0) << finished.err;
  }
  EXPECT_EQ(read_text(first), read_text(second));

  const nlohmann::json record = read_json(first);
  const auto counted = record["context"]["instruction_sets"].get<std::vector<std::string>>();
  ASSERT_FALSE(counted.empty());
  EXPECT_EQ(counted.back(), "portable");
  ASSERT_EQ(record["benchmarks"].size(), 2 * counted.size());
  for (const auto &entry : record["benchmarks"]) {
    SCOPED_TRACE(entry.dump());
    // 3 x 2 at 2 x 3 places in packs of one number for each element: every pack is loaded or stored.
    EXPECT_GE(entry["instructions"].get<long long>(), (3 + 2) * 6);
    EXPECT_GT(entry["floor"].get<double>(), 0);
    EXPECT_LE(entry["floor"].get<double>(), 1);
  }

  const Finished same = run(compare + quoted(first) + " " + quoted(second));
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(same.out.substr(0, 12), "instructions") << same.out;

  const Finished none = run(count + "nosuchcase --out " + quoted(folder_ / "none.json"));
  EXPECT_NE(none.code, 0);
  EXPECT_NE(none.err.find("no case has 'nosuchcase' in its name"), std::string::npos) << none.err;
  const Finished wrong = run(count + "'(' --out " + quoted(folder_ / "none.json"));
  EXPECT_NE(wrong.code, 0);
  EXPECT_NE(wrong.err.find("'(' is not a regular expression"), std::string::npos) << wrong.err;
}
#endif

TEST_F(Micro, ComparesByRatiosOfWhatIsInBothFiles) {
  const std::string before = write(
      "before.json", record_of({R"("name": "a", "run_type": "iteration", "cpu_time": 4.0, "time_unit": "ns")",
                                R"("name": "b", "run_type": "iteration", "cpu_time": 2.0, "time_unit": "us")",
                                R"("name": "old", "run_type": "iteration", "cpu_time": 1.0, "time_unit": "ns")"}));
  // The least of repetitions counts, what Google Benchmark sums up from them does not.
  const std::string after = write(
      "after.json",
      record_of({R"("name": "b", "run_name": "b", "run_type": "iteration", "cpu_time": 9000.0, "time_unit": "ns")",
                 R"("name": "b", "run_name": "b", "run_type": "iteration", "cpu_time": 8000.0, "time_unit": "ns")",
                 R"("name": "b_mean", "run_name": "b", "run_type": "aggregate", "cpu_time": 1.0, "time_unit": "ns")",
                 R"("name": "a", "run_type": "iteration", "cpu_time": 1.0, "time_unit": "ns")",
                 R"("name": "new", "run_type": "iteration", "cpu_time": 1.0, "time_unit": "ns")",
                 R"("name": "lost", "run_type": "iteration", "error_occurred": true)"}));
  const Finished finished = run(compare + before + after);
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto line_with = [&](const std::string &start) {
    const auto at = ("\n" + finished.out).find("\n" + start);
    return at == std::string::npos ? "" : finished.out.substr(at, finished.out.find('\n', at) - at);
  };
  EXPECT_TRUE(line_with("a ").ends_with(" 0.250")) << finished.out;
  EXPECT_TRUE(line_with("b ").ends_with(" 2 us          8 us  4.000")) << finished.out;
  EXPECT_TRUE(line_with("geometric mean").ends_with(" 1.000  (2 benchmarks)")) << finished.out;
  EXPECT_TRUE(line_with("only in ").ends_with("before.json: old")) << finished.out;
  EXPECT_NE(finished.out.find("after.json: new\n"), std::string::npos) << finished.out;
  EXPECT_NE(finished.out.find("after.json: lost\n"), std::string::npos) << finished.out;
}

TEST_F(Micro, ComparesWithTheRunBefore) {
  const std::string in_folder = compare + "--folder " + quoted(folder_ / "bench");
  const std::string keep =
      "'" BPS_CMAKE "' -DFILE=" + quoted(folder_ / "bench/count") + " -P '" BPS_MICRO_FOLDER "/keep.cmake'";
  EXPECT_EQ(run(keep).code, 0);
  write("bench/count.json", record_of({R"("name": "a", "instructions": 100)"}));
  const Finished nothing = run(in_folder);
  EXPECT_EQ(nothing.code, 2);
  EXPECT_NE(nothing.err.find("build the target bench-micro or bench-count twice"), std::string::npos) << nothing.err;
  EXPECT_EQ(run(keep).code, 0);
  write("bench/count.json", record_of({R"("name": "a", "instructions": 150)"}));
  const Finished finished = run(in_folder);
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.out.find("1.500  (1 benchmarks)"), std::string::npos) << finished.out;
}

TEST_F(Micro, ComparisonSaysWhatIsWrongWithAFile) {
  const std::string good = write("good.json", record_of({R"("name": "a", "cpu_time": 4.0)"}));
  const auto expect_refusal = [&](const std::string &arguments, const std::string &fragment) {
    const Finished finished = run(compare + arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_NE(finished.err.find(fragment), std::string::npos) << finished.err;
    EXPECT_EQ(finished.err.find("Traceback"), std::string::npos) << finished.err;
  };
  const auto expect_refusal_of = [&](const std::string &text, const std::string &fragment) {
    expect_refusal(good + write("bad.json", text), fragment);
  };
  expect_refusal(good, "expected two files");
  expect_refusal(good + "/no/such/file.json", "/no/such/file.json: No such file");
  expect_refusal_of("{ not json", "bad.json: not a JSON file");
  expect_refusal_of("\xff\xfe", "bad.json: not a text file");
  expect_refusal_of("[1, 2]", "expected an object with a list 'benchmarks'");
  expect_refusal_of("{\"benchmarks\": [1]}", "expected an object with a list 'benchmarks'");
  expect_refusal_of(record_of({}), "has no benchmark that ran");
  expect_refusal_of(record_of({R"("cpu_time": 1.0)"}), "benchmark 0 has no name");
  expect_refusal_of(record_of({R"("name": "a")"}), "'a': expected a positive number 'cpu_time', found null");
  expect_refusal_of(record_of({R"("name": "a", "cpu_time": "fast")"}), "found \"fast\"");
  expect_refusal_of(record_of({R"("name": "a", "cpu_time": -1.0)"}), "found -1.0");
  expect_refusal_of(record_of({R"("name": "a", "cpu_time": 1.0, "time_unit": "fortnights")"}),
                    "time_unit is \"fortnights\"; expected one of ns, us, ms, s");
  expect_refusal_of(record_of({R"("name": "a", "instructions": 0)"}), "expected a positive number 'instructions'");
  expect_refusal_of(record_of({R"("name": "a", "instructions": 7)"}), "not comparable");
  expect_refusal_of(record_of({R"("name": "a", "instructions": 7)", R"("name": "b", "cpu_time": 1.0)"}),
                    "has both times and counts of instructions");
  expect_refusal_of(record_of({R"("name": "b", "cpu_time": 1.0)"}), "no benchmark in common");
}

}  // namespace
}  // namespace hg::test
