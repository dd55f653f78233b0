// The sinker of the example option files: a dense stiff cube in a soft clamped one, by FEM and by implicit MPM, against
// independent solutions of the same problem (see docs/verification).
#include <gtest/gtest.h>

#include <cmath>

#include "program_runs.hpp"

namespace hg::test {
namespace {

using Table = std::map<std::string, std::vector<double>>;

Table run_sinker(const std::string &method, const std::string &more, int ranks = 1) {
  WorkingFolder folder;
  const ProgramResult result = honeyguide(
      "-options_file " HONEYGUIDE_EXAMPLES "/sinker-" + method + ".yml -ts_monitor_quantities table.csv -quiet " + more,
      ranks);
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_FALSE(result.mentions("warning")) << result.output;
  return read_csv("table.csv");
}

// Downward value of a column at the end of nominal step `step` of 20.
double at_step(const Table &table, const std::string &column, int step) {
  const auto &times = table.at("time");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::abs(times[i] - step / 20.) < 1e-9) return -table.at(column)[i];
  }
  ADD_FAILURE() << "no line at step " << step;
  return NAN;
}

const std::string centre = "displacement_probe0_z", mean = "mean_displacement_sinker_z";

TEST(Sinker, FemFirstSteps) {
  const Table table = run_sinker("fem", "-ts_max_steps 4");
  EXPECT_NEAR(at_step(table, centre, 4), 0.0881, 0.005 * 0.0881);
  // 64.4 kg: 0.2³ m³ of 8050 kg/m³; the supports carry all of the body force.
  EXPECT_NEAR(table.at("mass_sinker")[3], 64.4, 1e-9);
  double support = 0, load = table.at("body_force_sinker_z")[3] + table.at("body_force_foam_z")[3];
  for (int face = 1; face <= 6; ++face) support += table.at("reaction_clamp" + std::to_string(face) + "_z")[3];
  EXPECT_NEAR(support, -load, 1e-6 * std::abs(load));
}

TEST(Sinker, MpmFirstSteps) {
  const Table table = run_sinker("mpm", "-ts_max_steps 4");
  const std::map<int, double> expected{{1, 0.02486}, {2, 0.05045}, {4, 0.10349}};
  for (const auto &[step, value] : expected) EXPECT_NEAR(at_step(table, centre, step), value, 0.002 * value) << step;
  EXPECT_NEAR(at_step(table, mean, 4), 0.09959, 0.002 * 0.09959);
  EXPECT_NEAR(table.at("mass")[3], 64.4 + 14.88, 1e-9);
}

TEST(Sinker, RanksAgree) {
  for (const char *method : {"fem", "mpm"}) {
    const Table one = run_sinker(method, "-ts_max_steps 2");
    for (int ranks : {2, 3}) {
      const Table many = run_sinker(method, "-ts_max_steps 2", ranks);
      for (const std::string &column : {centre, mean, std::string("strain_energy")}) {
        EXPECT_NEAR(many.at(column)[1], one.at(column)[1], 1e-7 * std::abs(one.at(column)[1])) << method << ranks;
      }
    }
  }
}

TEST(Sinker, TwiceTheSameRunIsBitwiseTheSame) {
  for (const char *method : {"fem", "mpm"}) {
    EXPECT_EQ(run_sinker(method, "-ts_max_steps 2"), run_sinker(method, "-ts_max_steps 2"));
  }
}

TEST(Sinker, ARestartContinuesBitwise) {
  for (const char *method : {"fem", "mpm"}) {
    WorkingFolder folder;
    const std::string base = "-options_file " HONEYGUIDE_EXAMPLES "/sinker-" + std::string(method) + ".yml -quiet ";
    ASSERT_EQ(honeyguide(base + "-ts_max_steps 4 -ts_monitor_quantities whole.csv").status, 0);
    ASSERT_EQ(honeyguide(base + "-ts_max_steps 2 -ts_monitor_quantities parts.csv -checkpoint state.h5").status, 0);
    const ProgramResult rest = honeyguide(base + "-ts_max_steps 4 -ts_monitor_quantities parts.csv -restart state.h5");
    ASSERT_EQ(rest.status, 0) << rest.output;
    const Table whole = read_csv("whole.csv"), parts = read_csv("parts.csv");
    ASSERT_EQ(whole.at("step").size(), 4u);
    EXPECT_EQ(whole, parts) << method;
  }
}

}  // namespace
}  // namespace hg::test
