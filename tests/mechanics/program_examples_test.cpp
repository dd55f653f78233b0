// Every option file in ratel-like/examples runs as it stands, with every option used.
#include <gtest/gtest.h>

#include "program_runs.hpp"

namespace hg::test {
namespace {

std::vector<std::string> example_files() {
  std::vector<std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(HONEYGUIDE_EXAMPLES)) {
    if (entry.path().extension() == ".yml") files.push_back(entry.path().string());
  }
  return files;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, Run) {
  WorkingFolder folder;
  const ProgramResult result = honeyguide("-options_file " + GetParam() + " -ts_max_steps 1");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_FALSE(result.mentions("warning")) << result.output;
  EXPECT_TRUE(result.mentions("step 1 ")) << result.output;
}

INSTANTIATE_TEST_SUITE_P(Folder, Examples, testing::ValuesIn(example_files()), [](const auto &info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  for (char &c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
});

TEST(ExampleFiles, AreThere) {
  EXPECT_GE(example_files().size(), 5u);
}

// Tip deflection of a slender cantilever under an end force: F l³ / (3 E I), with I = 1/12, plus 1 % for shear.
TEST(ExampleFiles, CantileverBendsAsBeamTheorySays) {
  WorkingFolder folder;
  ASSERT_EQ(honeyguide("-options_file " HONEYGUIDE_EXAMPLES "/traction-fem.yml -quiet").status, 0);
  const auto table = read_csv("traction-fem.csv");
  const double beam = 1e6 * 1e3 / (3 * 210e9 / 12);
  EXPECT_NEAR(-table.at("displacement_probe0_z")[0], beam, 0.02 * beam);
  EXPECT_NEAR(table.at("reaction_clamp6_z")[0], 1e6, 1e-3);
}

}  // namespace
}  // namespace hg::test
