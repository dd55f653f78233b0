// Options: defaults, checks with messages, lists, loads over time.
#include <gtest/gtest.h>

#include "mesh_fixture.hpp"
#include "options/options.hpp"

namespace hg::test {
namespace {

template <class Body>
std::string message_of(Body &&body) {
  try {
    body();
  } catch (const Error &error) {
    return error.what();
  }
  return "no error";
}

bool mentions(const std::string &text, std::initializer_list<const char *> parts) {
  for (const char *part : parts) {
    if (text.find(part) == std::string::npos) return false;
  }
  return true;
}

TEST(OptionGroup, GivesValuesAndDefaults) {
  ScopedOptions options{{"-a_x", "2.5"}, {"-a_n", "7"}, {"-a_list", "1,2,3"}, {"-a_names", "one,two"}, {"-a_on", ""}};
  OptionGroup group(PETSC_COMM_WORLD, "a_", "Test");
  EXPECT_EQ(group.real("x", "", 1), 2.5);
  EXPECT_EQ(group.real("y", "", 1), 1);
  EXPECT_EQ(group.integer("n", "", 1), 7);
  EXPECT_EQ(group.reals("list", "", {}, 3), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(group.integers("list", "", {}, 3), (std::vector<PetscInt>{1, 2, 3}));
  EXPECT_EQ(group.strings("names", "", {}), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(group.strings("others", "", {"x"}), (std::vector<std::string>{"x"}));
  EXPECT_TRUE(group.boolean("on", "", false));
  EXPECT_TRUE(group.given("on"));
  EXPECT_FALSE(group.given("off"));
  EXPECT_EQ(group.full("nu"), "-a_nu");
}

TEST(OptionGroup, MessagesNameOptionValueAndExpectation) {
  ScopedOptions options{{"-m_nu", "0.5"}, {"-m_E", "-3"}, {"-m_n", "many"}, {"-m_kind", "round"}, {"-m_v", "1,2"}};
  OptionGroup group(PETSC_COMM_WORLD, "m_", "Test");
  const Range poisson{.min = -1, .max = 0.5, .min_open = true, .max_open = true};
  EXPECT_TRUE(mentions(message_of([&] { group.real("nu", "", 0.3, poisson); }), {"-m_nu", "0.5", "> -1", "< 0.5"}));
  EXPECT_TRUE(mentions(message_of([&] { group.real("E", "", 1, Range::positive()); }), {"-m_E", "-3", "> 0"}));
  EXPECT_TRUE(mentions(message_of([&] { group.integer("n", "", 1); }), {"-m_n", "many", "integer"}));
  EXPECT_TRUE(mentions(message_of([&] { group.real("n", "", 1); }), {"-m_n", "many", "number"}));
  EXPECT_TRUE(mentions(message_of([&] {
                         group.choice("kind", "", {"flat", "steep"}, "flat");
                       }),
                       {"-m_kind", "round", "flat,steep"}));
  EXPECT_TRUE(mentions(message_of([&] { group.reals("v", "", {}, 3); }), {"-m_v", "2 numbers", "expected 3"}));
  EXPECT_TRUE(mentions(message_of([&] { group.required_real("G", "shear modulus"); }), {"-m_G", "missing"}));
}

TEST(RunOptions, ReadsRegions) {
  ScopedOptions options{{"-material", "sinker,foam"},
                        {"-sinker_region_box", "0.4,0.4,0.4,0.6,0.6,0.6"},
                        {"-method", "mpm"},
                        {"-order", "2"}};
  const RunOptions run = RunOptions::read(PETSC_COMM_WORLD);
  EXPECT_EQ(run.method, Method::mpm);
  EXPECT_EQ(run.order, 2);
  ASSERT_EQ(run.regions.size(), 2u);
  EXPECT_EQ(run.regions[0].prefix, "sinker_");
  EXPECT_TRUE(run.regions[0].box.has_value());
  EXPECT_TRUE(run.regions[1].takes_rest());
}

TEST(RunOptions, RejectsWhatItCannotMean) {
  const auto read = [] { RunOptions::read(PETSC_COMM_WORLD); };
  {
    ScopedOptions options{{"-material", "a,b"}};
    EXPECT_TRUE(mentions(message_of(read), {"-material", "2 regions", "at most one"}));
  }
  {
    ScopedOptions options{{"-material", "a,a"}};
    EXPECT_TRUE(mentions(message_of(read), {"'a'", "twice"}));
  }
  {
    ScopedOptions options{{"-order", "9"}};
    EXPECT_TRUE(mentions(message_of(read), {"-order", "9", "<= 8"}));
  }
  {
    ScopedOptions options{{"-forcing", "body"}, {"-forcing_body_vector", "0,1"}};
    EXPECT_TRUE(mentions(message_of(read), {"-forcing_body_vector", "2 numbers"}));
  }
  {
    ScopedOptions options{{"-forcing", "body"}, {"-forcing_body_vector", "0,1,0"}, {"-forcing_body_times", "1,2"}};
    EXPECT_TRUE(mentions(message_of(read), {"-forcing_body_times", "2 times for 1"}));
  }
}

TEST(VectorAt, GoesLinearlyOrInSteps) {
  const std::vector<double> times{1, 3};
  const std::vector<std::array<double, 3>> vectors{{2, 0, 0}, {4, 8, 0}};
  using V = std::array<double, 3>;
  EXPECT_EQ(vector_at(times, vectors, Ramp::linear, 0), (V{0, 0, 0}));
  EXPECT_EQ(vector_at(times, vectors, Ramp::linear, 0.5), (V{1, 0, 0}));
  EXPECT_EQ(vector_at(times, vectors, Ramp::linear, 1), (V{2, 0, 0}));
  EXPECT_EQ(vector_at(times, vectors, Ramp::linear, 2), (V{3, 4, 0}));
  EXPECT_EQ(vector_at(times, vectors, Ramp::linear, 9), (V{4, 8, 0}));
  EXPECT_EQ(vector_at(times, vectors, Ramp::step, 0.5), (V{2, 0, 0}));
  EXPECT_EQ(vector_at(times, vectors, Ramp::step, 1.5), (V{4, 8, 0}));
  EXPECT_EQ(vector_at({}, {}, Ramp::linear, 1), (V{0, 0, 0}));
}

TEST(Guard, CarriesMessagesThroughPetsc) {
  const auto inner = [] { return guard([] { fail("cell %d is %s", 3, "flat"); }); };
  EXPECT_EQ(message_of([&] { petsc_check(inner()); }), "cell 3 is flat");
  VecHandle vector;
  petsc_check(VecCreate(PETSC_COMM_SELF, vector.put()));
  EXPECT_TRUE(mentions(message_of([&] { petsc_check(VecSetType(vector, "nonsense")); }), {"nonsense"}));
}

}  // namespace
}  // namespace hg::test
