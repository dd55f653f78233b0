// All 20 steps of the sinker at 5³ cells.
#include <gtest/gtest.h>

#include <cmath>

#include "program_runs.hpp"

namespace hg::test {
namespace {

std::map<int, double> downward(const std::map<std::string, std::vector<double>> &table, const std::string &column) {
  std::map<int, double> values;
  const auto &times = table.at("time");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double step = 20 * times[i];
    if (std::abs(step - std::round(step)) < 1e-7) values[static_cast<int>(std::lround(step))] = -table.at(column)[i];
  }
  return values;
}

std::map<std::string, std::vector<double>> run_sinker(const std::string &method) {
  WorkingFolder folder;
  const ProgramResult result = honeyguide("-options_file " HONEYGUIDE_EXAMPLES "/sinker-" + method +
                                          ".yml -quiet -ts_monitor_quantities table.csv");
  EXPECT_EQ(result.status, 0) << result.output;
  return read_csv("table.csv");
}

TEST(SinkerAllSteps, FemWithinHalfAPercent) {
  auto centre = downward(run_sinker("fem"), "displacement_probe0_z");
  const std::map<int, double> expected{{4, 0.0881}, {8, 0.1707}, {12, 0.2414}, {16, 0.2889}, {20, 0.3201}};
  for (const auto &[step, value] : expected) EXPECT_NEAR(centre[step], value, 0.005 * value) << "step " << step;
}

TEST(SinkerAllSteps, MpmWithinTheIndependentSolutionsTolerance) {
  const auto table = run_sinker("mpm");
  auto centre = downward(table, "displacement_probe0_z"), mean = downward(table, "mean_displacement_sinker_z");
  const auto tolerance = [](int step) { return step <= 10 ? 0.002 : 0.01; };
  const std::map<int, double> centres{{1, 0.02486},  {2, 0.05045},  {4, 0.10349},  {6, 0.15392},
                                      {8, 0.21947},  {10, 0.26205}, {12, 0.29195}, {14, 0.31213},
                                      {16, 0.33381}, {18, 0.34688}, {20, 0.35718}};
  const std::map<int, double> means{{4, 0.09959}, {8, 0.21099}, {12, 0.28029}, {16, 0.32036}, {20, 0.34207}};
  for (const auto &[step, value] : centres) EXPECT_NEAR(centre[step], value, tolerance(step) * value) << step;
  for (const auto &[step, value] : means) EXPECT_NEAR(mean[step], value, tolerance(step) * value) << step;
  for (double mass : table.at("mass")) EXPECT_NEAR(mass, 79.28, 1e-9);
}

}  // namespace
}  // namespace hg::test
