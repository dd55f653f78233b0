/// @file
/// bps-assembly: its records, its bound, its errors.
#include <gtest/gtest.h>

#include <set>

#include "program.hpp"

namespace hg::test {
namespace {

const std::string assembly = "'" BPS_ASSEMBLY "' --ceed /cpu/self/ref/serial ";

TEST(AssemblyProgram, WritesARecordForEachDegree) {
  const TemporaryFolder folder;
  const auto file = folder / "assembly.json";
  const Finished finished = run(assembly + "--degree 1-2 --cells 2 --reps 2 --json " + quoted(file));
  ASSERT_EQ(finished.code, 0) << finished.err;
  const nlohmann::json records = read_json(file);
  ASSERT_EQ(records.size(), 2u);
  for (int degree = 1; degree <= 2; degree++) {
    const nlohmann::json &record = records[degree - 1];
    const int q_1d = degree + 2, line = 2 * degree + 1;
    EXPECT_EQ(record.at("program"), "bps-assembly");
    EXPECT_EQ(record.at("problem"), "bp4");
    EXPECT_EQ(record.at("ceed"), "/cpu/self/ref/serial");
    EXPECT_EQ(record.at("degree"), degree);
    EXPECT_EQ(record.at("elements"), 8);
    EXPECT_EQ(record.at("dofs"), 3 * line * line * line);
    EXPECT_EQ(record.at("points_per_cell"), q_1d * q_1d * q_1d);
    EXPECT_EQ(record.at("repetitions"), 2);
    std::set<std::string> kinds;
    for (const nlohmann::json &entry : record.at("assembly")) {
      kinds.insert(entry.at("kind").get<std::string>());
      const double quadrature = entry.at("seconds_per_element").at("quadrature"),
                   points = entry.at("seconds_per_element").at("points");
      EXPECT_GT(quadrature, 0);
      EXPECT_GT(points, 0);
      EXPECT_DOUBLE_EQ(entry.at("ratio"), points / quadrature);
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"qfunction", "diagonal", "point blocks", "matrix"}));
  }
}

/// The best of many short runs, so that a busy machine does not decide.
TEST(AssemblyProgram, PointsCostAtMostFiveTimesAsMuch) {
  const Finished finished = run(assembly + "--problem bp4 --degree 2 --cells 2 --reps 40 --at-most 5");
  EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
}

TEST(AssemblyProgram, SaysWhenABoundDoesNotHold) {
  EXPECT_EQ(run(assembly + "--degree 1 --cells 1 --reps 1 --at-most 1e-9").code, 1);
}

TEST(AssemblyProgram, RefusesWhatItDoesNotKnow) {
  const Finished unknown = run(assembly + "--problem bp7");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("bp7"), std::string::npos) << unknown.err;
  const Finished unwritable = run(assembly + "--degree 1 --cells 1 --reps 1 --json /nowhere/assembly.json");
  EXPECT_EQ(unwritable.code, 2);
  EXPECT_NE(unwritable.err.find("/nowhere/assembly.json"), std::string::npos) << unwritable.err;
}

}  // namespace
}  // namespace hg::test
