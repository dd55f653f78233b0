// Tables of quantities and probes: what is written, what is kept after a restart, values on any number of ranks.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "monitors/probes.hpp"
#include "monitors/record.hpp"
#include "operators_fixture.hpp"
#include "swarm/migrate.hpp"

namespace hg::test {
namespace {

std::string contents(const std::string &file) {
  MPI_Barrier(PETSC_COMM_WORLD);
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string own_name(const std::string &stem) {
  int size;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  return stem + "_np" + std::to_string(size) + ".csv";
}

Record sample(PetscInt step) {
  Record record;
  record.step = step;
  record.time = 0.25 * static_cast<double>(step);
  record.regions.resize(2);
  record.regions[0].strain_energy = 1.5;
  record.regions[1].strain_energy = 2;
  record.regions[0].mass = 3;
  record.probes = {{1, 2, 3}};
  return record;
}

TEST(Monitors, WriteWhatIsAskedFor) {
  const std::string energy = own_name("monitor_energy"), all = own_name("monitor_all");
  ScopedOptions options{{"-ts_monitor_strain_energy", "ascii:" + energy}, {"-ts_monitor_quantities", all}};
  Monitors monitors(PETSC_COMM_WORLD, {.regions = {"stiff", "soft"}, .probes = {"probe0"}, .reactions = {}});
  monitors.begin(-1);
  monitors.write(sample(1));
  monitors.write(sample(2));
  EXPECT_EQ(contents(energy),
            "step,time,strain_energy_stiff,strain_energy_soft,strain_energy\n"
            "1,0.25,1.5,2,3.5\n2,0.5,1.5,2,3.5\n");
  // Every line of the long table has as many values as the header has names.
  std::istringstream lines(contents(all));
  std::string line;
  std::vector<std::ptrdiff_t> commas;
  while (std::getline(lines, line)) commas.push_back(std::count(line.begin(), line.end(), ','));
  ASSERT_EQ(commas.size(), 3u);
  EXPECT_EQ(commas[1], commas[0]);
  EXPECT_EQ(commas[2], commas[0]);
}

TEST(Monitors, ARestartKeepsTheLinesBeforeIt) {
  const std::string energy = own_name("monitor_restart");
  ScopedOptions options{{"-ts_monitor_strain_energy", energy}};
  const RecordNames names{.regions = {"a", "b"}, .probes = {}, .reactions = {}};
  {
    Monitors monitors(PETSC_COMM_WORLD, names);
    monitors.begin(-1);
    for (PetscInt step = 1; step <= 4; ++step) monitors.write(sample(step));
  }
  Monitors monitors(PETSC_COMM_WORLD, names);
  monitors.begin(2);
  monitors.write(sample(3));
  EXPECT_EQ(contents(energy),
            "step,time,strain_energy_a,strain_energy_b,strain_energy\n"
            "1,0.25,1.5,2,3.5\n2,0.5,1.5,2,3.5\n3,0.75,1.5,2,3.5\n");
}

TEST(Monitors, AFileThatCannotBeWrittenIsNamed) {
  ScopedOptions options{{"-ts_monitor_quantities", "no_such_folder/table.csv"}};
  Monitors monitors(PETSC_COMM_WORLD, {});
  try {
    monitors.begin(-1);
    FAIL() << "expected an error";
  } catch (const Error &error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("-ts_monitor_quantities"), std::string::npos) << message;
    EXPECT_NE(message.find("no_such_folder/table.csv"), std::string::npos) << message;
  }
}

TEST(MeshProbes, EvaluateTheFieldAnywhere) {
  CeedHandle ceed = make_ceed();
  auto mesh = box_mesh(ceed, "3,2,4", {.order = 3});
  const CellGrid grid = build_cell_grid(*mesh);
  const HexLocator locator(grid);
  // Inside, on faces between cells, at a corner of the domain.
  const Places places{{0.123, 0.456, 0.789}, {1. / 3, 0.5, 0.25}, {0, 0, 0}, {1, 1, 0.3}};
  const MeshProbes probes(*mesh, locator, places);
  const auto cubic = [](const double *x, double *u) {
    u[0] = x[0] * x[1] * x[2];
    u[1] = x[0] * x[0] * x[0] - x[1];
    u[2] = 2 + x[2] * x[2];
  };
  const auto values = probes.evaluate(at_nodes(*mesh, cubic));
  for (std::size_t i = 0; i < places.size(); ++i) {
    double expected[3];
    cubic(places[i].data(), expected);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(values[i][c], expected[c], 1e-13);
  }
  EXPECT_THROW(MeshProbes(*mesh, locator, {{0.5, 0.5, 1.2}}), Error);
}

TEST(PointProbes, FollowTheNearestPointsAndShareTies) {
  CeedHandle ceed = make_ceed();
  auto mesh = box_mesh(ceed, "2,2,2", {});
  const CellGrid grid = build_cell_grid(*mesh);
  const HexLocator locator(grid);
  Swarm swarm(PETSC_COMM_WORLD);
  seed_swarm(
      {.points_per_cell = 8}, grid, locator, [](std::int32_t, const double *) { return PointMaterial{}; }, swarm);
  // The centre of the cube is equally near to eight points, the second place nearest to one.
  const PointProbes probes(*mesh, locator, swarm, {{0.5, 0.5, 0.5}, {0.13, 0.12, 0.12}});
  {
    const PointField<double> u(swarm, field::u), X0(swarm, field::X0);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 10 * X0[i];
  }
  const auto values = probes.evaluate(swarm);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(values[0][c], 5, 1e-13);
    EXPECT_NEAR(values[1][c], 1.25, 1e-13);
  }
  EXPECT_THROW(PointProbes(*mesh, locator, swarm, {{-0.1, 0.5, 0.5}}), Error);
}

TEST(Probes, OptionsComeInThrees) {
  ScopedOptions options{{"-probe", "1,2,3,4"}};
  EXPECT_THROW(read_probes(PETSC_COMM_WORLD), Error);
}

}  // namespace
}  // namespace hg::test
