/// @file
/// bps, the distributed bake-off, as its users run it: on one, two and three ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace hg::test {
namespace {

/// Runs bps on `ranks` ranks; the reference backend unless the arguments say otherwise.
Finished bps(int ranks, const std::string &arguments) {
  // More ranks than cores, and root in a container, are both fine for a test; one thread a rank.
  for (const char *name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                           "OMPI_MCA_rmaps_base_oversubscribe", "OMP_NUM_THREADS"})
    setenv(name, "1", 0);
  setenv("OMPI_MCA_btl_base_warn_component_unused", "0", 0);
  const std::string program = ranks == 1 ? std::string("'" BPS_PROGRAM "'")
                                         : "'" BPS_MPIEXEC "' -n " + std::to_string(ranks) + " '" BPS_PROGRAM "'";
  return run(program + " " + arguments);
}

/// What a program wrote to stderr without the notes of MPI and hwloc, which begin with a bracket: "[hwloc/linux] ...".
std::string own_errors(const Finished &finished) {
  std::istringstream all(finished.err);
  std::string line, own;
  while (std::getline(all, line)) {
    if (!line.empty() && line[0] != '[') own += line + "\n";
  }
  return own;
}

nlohmann::json records_of(int ranks, const std::string &arguments) {
  const TemporaryFolder folder;
  const auto file = folder / "records.json";
  const Finished finished =
      bps(ranks, arguments + " -ceed /cpu/self/ref/serial -reps 1 -ksp_max_it 3000 -json " + quoted(file));
  EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
  EXPECT_EQ(own_errors(finished), "");
  return finished.code == 0 ? read_json(file) : nlohmann::json::array();
}

struct MeshCase {
  const char *name, *arguments;
  friend void PrintTo(const MeshCase &which, std::ostream *stream) { *stream << which.arguments; }
};

class Ranks : public testing::TestWithParam<MeshCase> {};

TEST_P(Ranks, GiveTheSameAnswer) {
  std::vector<nlohmann::json> results;
  for (int ranks = 1; ranks <= 3; ranks++) {
    auto records = records_of(ranks, std::string("-ksp_rtol 1e-12 -cells 3,4,3 ") + GetParam().arguments);
    ASSERT_EQ(records.size(), 1u);
    expect_record(records[0]);
    EXPECT_EQ(records[0]["ranks"], ranks);
    EXPECT_EQ(records[0]["program"], "bps");
    ASSERT_TRUE(records[0]["cg_converged"].get<bool>());
    results.push_back(records[0]);
  }
  const double error = results[0]["error"], error_h1 = results[0]["error_h1"];
  EXPECT_LT(error, 0.2);
  for (const auto &other : results) {
    EXPECT_NEAR(other["error"].get<double>(), error, 1e-7 * error);
    EXPECT_NEAR(other["error_h1"].get<double>(), error_h1, 1e-7 * error_h1);
    for (const char *field : {"dofs", "elements", "points", "flops"})
      EXPECT_EQ(other[field], results[0][field]) << field;
    EXPECT_NEAR(other["cg_iterations"].get<int>(), results[0]["cg_iterations"].get<int>(), 2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bps, Ranks,
    testing::Values(MeshCase{"bp1", "-problem bp1 -degree 2"}, MeshCase{"bp2", "-problem bp2 -degree 3"},
                    MeshCase{"bp3", "-problem bp3 -degree 4"}, MeshCase{"bp4", "-problem bp4 -degree 3"},
                    MeshCase{"bp5", "-problem bp5 -degree 5"}, MeshCase{"bp6", "-problem bp6 -degree 2"},
                    MeshCase{"bp3_uniform", "-problem bp3 -degree 2 -swarm uniform -points_per_cell 64"},
                    MeshCase{"bp4_random", "-problem bp4 -degree 2 -swarm random -points_per_cell 50"},
                    MeshCase{"bp3_jacobi", "-problem bp3 -degree 3 -pc_type jacobi"}),
    [](const auto &info) { return std::string(info.param.name); });

class Rates : public testing::TestWithParam<const char *> {};

/// p + 1 in L2 on two ranks; the observed rate must be nearer to it than to p.
TEST_P(Rates, AreOptimal) {
  for (int degree = 1; degree <= 3; degree++) {
    const int coarse = degree == 1 ? 4 : 2;
    const auto error = [&](int n) {
      const std::string cells = std::to_string(n) + "," + std::to_string(n) + "," + std::to_string(n);
      return records_of(
                 2, std::string("-problem ") + GetParam() + " -degree " + std::to_string(degree) + " -cells " + cells)
          .at(0)
          .at("error")
          .get<double>();
    };
    EXPECT_GT(std::log2(error(2 * coarse) / error(4 * coarse)), degree + 0.5) << "p = " << degree;
  }
}

INSTANTIATE_TEST_SUITE_P(Bps, Rates, testing::Values("bp1", "bp3", "bp6"),
                         [](const auto &info) { return std::string(info.param); });

TEST(Bps, SeveralCasesGiveSeveralRecords) {
  const auto records = records_of(1, "-problem bp1,bp5 -degree 1-2 -local_nodes 5e2");
  ASSERT_EQ(records.size(), 4u);
  for (const auto &record : records) {
    expect_record(record);
    // Mass has no boundary condition: its DoFs are all nodes.
    if (record["problem"] == "bp1") {
      EXPECT_NEAR(record["dofs"].get<double>(), 500, 100);
    }
  }
}

TEST(Bps, ReportsDofsPerSecondInCg) {
  const Finished finished = bps(1, "-problem bp3 -degree 2 -local_nodes 1000 -ceed /cpu/self/ref/serial");
  EXPECT_EQ(finished.code, 0) << finished.err;
  for (const char *fragment : {"bp3 on 1 rank, /cpu/self/ref/serial", "DoFs/s in CG", "CG time", "global DoFs"})
    EXPECT_NE(finished.out.find(fragment), std::string::npos) << finished.out;
}

TEST(Bps, NamesOptionsThatItDidNotUse) {
  const Finished finished = bps(1, "-local_nodes 100 -dgree 2");
  EXPECT_EQ(finished.code, 0);
  EXPECT_NE(finished.err.find("-dgree was not used"), std::string::npos) << finished.err;
}

struct BadOptions {
  const char *arguments;
  int ranks;
  const char *fragments[2];
  friend void PrintTo(const BadOptions &which, std::ostream *stream) { *stream << which.arguments; }
};

class BadInput : public testing::TestWithParam<BadOptions> {};

TEST_P(BadInput, IsRefusedOnceWithAMessageThatHelps) {
  const auto &[arguments, ranks, fragments] = GetParam();
  const Finished finished = bps(ranks, arguments);
  EXPECT_EQ(finished.code, 2) << finished.err;
  for (const char *fragment : fragments) EXPECT_NE(finished.err.find(fragment), std::string::npos) << finished.err;
  const auto first = finished.err.find("bps: ");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(finished.err.find("bps: ", first + 1), std::string::npos) << finished.err;
}

INSTANTIATE_TEST_SUITE_P(
    Bps, BadInput,
    testing::Values(BadOptions{"-problem bp9", 1, {"-problem bp9", "bp6 and all"}},
                    BadOptions{"-degree 1-9", 2, {"-degree 1-9", "1 to 8"}},
                    BadOptions{"-local_nodes many", 1, {"-local_nodes many", "is not a number"}},
                    BadOptions{"-cells 3,3", 1, {"-cells 3,3", "three numbers"}},
                    BadOptions{"-swarm spiral", 1, {"-swarm spiral", "known are"}},
                    BadOptions{"-points_per_cell 8", 1, {"-points_per_cell 8", "-swarm"}},
                    BadOptions{"-swarm uniform -points_per_cell 9", 1, {"9 points a cell", "cube of a whole number"}},
                    BadOptions{"-ceed /no/such/backend", 2, {"/no/such/backend", "/cpu/self/ref/serial"}},
                    BadOptions{"-cells 1,1,1", 2, {"a rank has no cell", "fewer ranks"}},
                    BadOptions{"-json /no/such/folder/x.json", 2, {"/no/such/folder/x.json", "cannot write"}}),
    [](const auto &info) { return name_from(info.param.arguments); });

}  // namespace
}  // namespace hg::test
