/// @file
/// The plot of bake-off records.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "program.hpp"

namespace hg::test {
namespace {

const std::string plot = "'" BPS_PYTHON "' '" BPS_PLOT "' ";

class Plot : public testing::Test {
 protected:
  void SetUp() override {
    if (run("'" BPS_PYTHON "' -c 'import matplotlib'").code != 0) GTEST_SKIP() << BPS_PYTHON " has no matplotlib";
  }

  std::string make_records(const std::string &name, const std::string &arguments) {
    const std::string file = quoted(folder_ / name);
    const Finished finished =
        run("'" BPS_KERNEL "' --ceed /cpu/self/ref/serial --reps 1 --quiet " + arguments + " --json " + file);
    EXPECT_EQ(finished.code, 0) << finished.err;
    return file + " ";
  }

  TemporaryFolder folder_;
};

TEST_F(Plot, DrawsThroughputOverDegreeAndSize) {
  const std::string first = make_records("a.json", "--problem bp1,bp3 --degree 1-2 --dofs 200,1000");
  const std::string second = make_records("b.json", "--problem bp3 --degree 1 --dofs 200 --points 8");
  for (const char *quantity : {"mdofs_per_s", "cg_mdofs_per_s"}) {
    const auto picture = folder_ / (std::string(quantity) + ".png");
    const Finished finished = run(plot + first + second + "-q " + quantity + " -o " + quoted(picture));
    ASSERT_EQ(finished.code, 0) << finished.err;
    EXPECT_NE(finished.out.find("9 records"), std::string::npos) << finished.out;
    const std::string bytes = read_text(picture);
    EXPECT_EQ(bytes.substr(0, 4), "\x89PNG");
    EXPECT_GT(bytes.size(), 10000u);
  }
}

TEST_F(Plot, DrawsRunsOfOneSizeOverDegreeAlone) {
  const std::string three = make_records("a.json", "--problem bp1,bp3,bp5 --degree 1-2 --dofs 200");
  const auto picture = folder_ / "degree.png";
  const Finished finished = run(plot + three + "-o " + quoted(picture));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.out.find("6 records"), std::string::npos) << finished.out;
  EXPECT_EQ(read_text(picture).substr(0, 4), "\x89PNG");
}

TEST_F(Plot, SaysWhatIsWrongWithAFile) {
  const auto broken = folder_ / "broken.json", other = folder_ / "other.json";
  std::ofstream(broken) << "{ not json";
  std::ofstream(other) << "[{\"problem\": \"bp1\"}]";
  const std::string good = make_records("a.json", "--problem bp1 --degree 1 --dofs 200");
  const auto expect_refusal = [&](const std::string &arguments, const std::string &fragment) {
    const Finished finished = run(plot + arguments);
    EXPECT_NE(finished.code, 0);
    EXPECT_NE(finished.err.find(fragment), std::string::npos) << finished.err;
    EXPECT_EQ(finished.err.find("Traceback"), std::string::npos) << finished.err;
  };
  expect_refusal("/no/such/file.json", "No such file");
  expect_refusal(quoted(broken), "not a JSON file");
  expect_refusal(quoted(other), "lacks ceed");
  expect_refusal(good + "-p bp6", "the files have bp1");
  expect_refusal(good + "-q joules", "invalid choice");
  expect_refusal(good + "-o /no/such/folder/x.png", "No such file");
}

}  // namespace
}  // namespace hg::test
