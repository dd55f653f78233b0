// The clock meets every nominal time, whatever was halved between, and stops at the smallest step.
#include <gtest/gtest.h>

#include "mesh_fixture.hpp"
#include "solve/clock.hpp"

namespace hg::test {
namespace {

TEST(Clock, StepsToTheEnd) {
  ScopedOptions options{{"-ts_dt", "0.3"}, {"-ts_max_time", "1"}};
  Clock clock(PETSC_COMM_WORLD);
  std::vector<double> times;
  while (!clock.done()) {
    clock.accept();
    times.push_back(clock.time());
  }
  ASSERT_EQ(times.size(), 4u);
  EXPECT_DOUBLE_EQ(times[0], 0.3);
  EXPECT_DOUBLE_EQ(times[2], 0.9);
  EXPECT_EQ(times[3], 1.);
}

TEST(Clock, HalvesGrowsAndMeetsNominalTimes) {
  ScopedOptions options{{"-ts_dt", "0.25"}, {"-ts_max_time", "1"}};
  Clock clock(PETSC_COMM_WORLD);
  clock.accept();
  clock.reject("test");
  clock.reject("test");
  EXPECT_DOUBLE_EQ(clock.dt(), 0.0625);
  std::vector<double> times;
  while (!clock.done()) {
    clock.accept();
    times.push_back(clock.time());
  }
  const std::vector<double> expected{0.3125, 0.4375, 0.5, 0.75, 1};
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_DOUBLE_EQ(times[i], expected[i]);
}

TEST(Clock, StopsAtTheSmallestStep) {
  ScopedOptions options{{"-ts_dt", "0.25"}, {"-ts_adapt_dt_min", "0.1"}};
  Clock clock(PETSC_COMM_WORLD);
  clock.reject("no reason");
  try {
    clock.reject("DIVERGED_TEST");
    FAIL() << "expected an error";
  } catch (const Error &error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("t = 0 s"), std::string::npos) << message;
    EXPECT_NE(message.find("0.125 s"), std::string::npos) << message;
    EXPECT_NE(message.find("DIVERGED_TEST"), std::string::npos) << message;
  }
}

TEST(Clock, RestoresItsState) {
  ScopedOptions options{{"-ts_dt", "0.1"}, {"-ts_max_time", "1"}};
  Clock clock(PETSC_COMM_WORLD), other(PETSC_COMM_WORLD);
  clock.accept();
  clock.reject("test");
  clock.accept();
  other.restore(clock.state());
  while (!clock.done()) {
    clock.accept();
    other.accept();
    EXPECT_EQ(clock.time(), other.time());
    EXPECT_EQ(clock.step(), other.step());
  }
  EXPECT_TRUE(other.done());
}

TEST(Clock, StopsAfterTheStepsAskedFor) {
  ScopedOptions options{{"-ts_dt", "0.1"}, {"-ts_max_steps", "3"}};
  Clock clock(PETSC_COMM_WORLD);
  int steps = 0;
  for (; !clock.done(); ++steps) clock.accept();
  EXPECT_EQ(steps, 3);
}

}  // namespace
}  // namespace hg::test
