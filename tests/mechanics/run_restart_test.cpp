// Whole runs: the same answer on any number of ranks, and a run that stops and goes on from its checkpoint equals the
// run that did not, bitwise.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "output_files.hpp"
#include "solve/fem_run.hpp"
#include "solve/mpm_run.hpp"
#include "xml.hpp"

namespace hg::test {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

Options operator+(Options a, const Options &b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Options in force for the lifetime of this object.
class With {
 public:
  explicit With(Options options) : options_(std::move(options)) {
    for (const auto &[name, value] : options_) petsc_check(PetscOptionsSetValue(nullptr, name.c_str(), value.c_str()));
  }
  ~With() {
    for (const auto &option : options_) (void)PetscOptionsClearValue(nullptr, option.first.c_str());
  }
  With(const With &) = delete;
  With &operator=(const With &) = delete;

 private:
  Options options_;
};

/// A dense stiff block in a soft cube that is clamped all around, so soft and heavy that points cross cells.
Options block(const std::string &method) {
  Options o{{"-method", method}, {"-order", "1"}, {"-dm_plex_box_faces", "4,4,4"}, {"-bc_clamp", "1,2,3,4,5,6"}};
  const std::string model = method == "mpm" ? "elasticity-mpm-neo-hookean-current" : "elasticity-neo-hookean-current";
  const Options more{{"-material", "block,soft"},
                     {"-block_model", model},
                     {"-block_region_box", "0.25,0.25,0.5,0.5,0.75,0.75"},
                     {"-block_E", "200"},
                     {"-block_nu", "0.3"},
                     {"-block_rho", "8"},
                     {"-soft_model", model},
                     {"-soft_E", "5"},
                     {"-soft_nu", "0.3"},
                     {"-soft_rho", "0.1"},
                     {"-forcing", "body"},
                     {"-forcing_body_vector", "1,2,-9"},
                     {"-ts_dt", "0.2"},
                     {"-ts_max_time", "1"},
                     {"-probe", "0.4,0.6,0.6"},
                     {"-quiet", "true"},
                     {"-ceed", "/cpu/self/ref/serial"}};
  o.insert(o.end(), more.begin(), more.end());
  return o;
}

struct Outcome {
  Record record;
  std::map<std::int64_t, std::array<double, 22>> points;  ///< x, u, v, F, V, cell's number and ξ by id
  std::vector<double> displacement;
};

Outcome mpm(MPI_Comm comm, const Options &options) {
  const With with(options);
  Setup setup(comm);
  MpmRun run(setup);
  run.run();
  Outcome out;
  out.record = run.record();
  const Swarm &s = run.swarm();
  const PointField<double> x(s, field::x), u(s, field::u), v(s, field::v), F(s, field::F), V(s, field::V);
  const PointField<std::int32_t> cell(s, field::cell);
  const PointField<std::int64_t> id(s, field::id);
  for (std::size_t p = 0; p < V.size(); p++) {
    std::array<double, 22> &r = out.points[id[p]];
    for (int d = 0; d < 3; d++) r[d] = x[3 * p + d], r[3 + d] = u[3 * p + d], r[6 + d] = v[3 * p + d];
    for (int d = 0; d < 9; d++) r[9 + d] = F[9 * p + d];
    r[18] = V[p];
    r[19] = static_cast<double>(setup.grid->cell_ids[cell[p]]);
  }
  return out;
}

Outcome fem(MPI_Comm comm, const Options &options) {
  const With with(options);
  Setup setup(comm);
  FemRun run(setup);
  run.run();
  Outcome out;
  out.record = run.record();
  PetscInt n;
  const PetscScalar *a;
  petsc_check(VecGetLocalSize(run.displacement(), &n));
  petsc_check(VecGetArrayRead(run.displacement(), &a));
  out.displacement.assign(a, a + n);
  petsc_check(VecRestoreArrayRead(run.displacement(), &a));
  return out;
}

void expect_near(const Record &a, const Record &b, double tolerance) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t r = 0; r < a.regions.size(); r++) {
    EXPECT_NEAR(a.regions[r].mass, b.regions[r].mass, tolerance * b.regions[r].mass);
    EXPECT_NEAR(a.regions[r].volume, b.regions[r].volume, tolerance * b.regions[r].volume);
    EXPECT_NEAR(a.regions[r].strain_energy, b.regions[r].strain_energy, tolerance * b.regions[r].strain_energy);
    for (int d = 0; d < 3; d++) {
      EXPECT_NEAR(a.regions[r].mean_displacement[d], b.regions[r].mean_displacement[d], tolerance);
    }
  }
  ASSERT_EQ(a.probes.size(), 1u);
  ASSERT_EQ(b.probes.size(), 1u);
  for (int d = 0; d < 3; d++) EXPECT_NEAR(a.probes[0][d], b.probes[0][d], tolerance);
  double all[3] = {0, 0, 0}, force[3] = {0, 0, 0};
  ASSERT_EQ(a.reactions.size(), b.reactions.size());
  for (std::size_t f = 0; f < a.reactions.size(); f++) {
    for (int d = 0; d < 3; d++) {
      EXPECT_NEAR(a.reactions[f][d], b.reactions[f][d], 10 * tolerance);
      all[d] += a.reactions[f][d];
    }
  }
  // The clamps carry the body: the sum over shared edges counts twice, so only its sign is looked at.
  for (const Record::Region &region : a.regions) {
    for (int d = 0; d < 3; d++) force[d] += region.body_force[d];
  }
  for (int d = 0; d < 3; d++) EXPECT_LT(all[d] * force[d], 0);
}

void expect_moved(const Record &r) {
  EXPECT_LT(r.probes[0][2], -0.02) << "the load is too small to test anything";
}

/// Solved so well that only rounding is left between partitions.
const Options tight{{"-ksp_rtol", "1e-12"}, {"-snes_rtol", "1e-11"}};

TEST(RunRanks, mpm_gives_the_same_answer_as_on_one_rank) {
  const Outcome spread = mpm(PETSC_COMM_WORLD, block("mpm") + tight),
                alone = mpm(PETSC_COMM_SELF, block("mpm") + tight);
  expect_moved(alone.record);
  expect_near(spread.record, alone.record, 1e-8);
  ASSERT_EQ(alone.points.size(), 512u);
  std::size_t crossed = 0;
  for (const auto &[id, p] : spread.points) {
    const auto &q = alone.points.at(id);
    for (int i = 0; i < 20; i++) ASSERT_NEAR(p[i], q[i], 1e-8) << "point " << id << " entry " << i;
    crossed += static_cast<std::int64_t>(p[19]) != id / 8;
  }
  unsigned long counts[2] = {spread.points.size(), crossed}, all[2];
  MPI_Allreduce(counts, all, 2, MPI_UNSIGNED_LONG, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_EQ(all[0], 512u);
  EXPECT_GT(all[1], 10u) << "no point crossed a cell: the test tests nothing";
}

TEST(RunRanks, fem_gives_the_same_answer_as_on_one_rank) {
  const Outcome spread = fem(PETSC_COMM_WORLD, block("fem") + tight),
                alone = fem(PETSC_COMM_SELF, block("fem") + tight);
  expect_moved(alone.record);
  expect_near(spread.record, alone.record, 1e-8);
}

std::string text_of(const std::string &path) {
  std::ifstream in(path);
  EXPECT_TRUE(in) << path;
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

struct RestartCase {
  const char *name;
  const char *method;
  Options extra;
};

class Restart : public testing::TestWithParam<RestartCase> {
 protected:
  Folder folder;
  Outcome run(const Options &options) {
    const std::string method = GetParam().method;
    const Options all = block(method) + GetParam().extra + options;
    return method == "mpm" ? mpm(PETSC_COMM_WORLD, all) : fem(PETSC_COMM_WORLD, all);
  }
  Options files(const std::string &stem) {
    const std::string series =
        GetParam().method == std::string("mpm") ? "-ts_monitor_swarm" : "-ts_monitor_diagnostic_quantities";
    return {{"-ts_monitor_quantities", "ascii:" + (folder / stem) + ".csv"}, {series, folder / stem}};
  }
};

std::string restart_name(const testing::TestParamInfo<RestartCase> &info) {
  return info.param.name;
}
// A Newton iteration too few for the later, larger steps: some are halved, and the checkpoint falls between halves.
INSTANTIATE_TEST_SUITE_P(
    Runs, Restart,
    testing::Values(RestartCase{"mpm", "mpm", {}},
                    RestartCase{
                        "mpm_assembled", "mpm", {{"-mat_type", "aij"}, {"-pc_type", "jacobi"}, {"-ksp_type", "gmres"}}},
                    RestartCase{"mpm_halved_steps", "mpm", {{"-snes_max_it", "3"}, {"-ts_dt", "0.25"}}},
                    RestartCase{"fem", "fem", {}},
                    RestartCase{"fem_order_2", "fem", {{"-order", "2"}, {"-ts_dt", "0.25"}}}),
    restart_name);

TEST_P(Restart, equals_the_run_that_did_not_stop_bitwise) {
  const Outcome whole = run(files("whole"));
  expect_moved(whole.record);
  ASSERT_GE(whole.record.step, 4);
  const PetscInt half = whole.record.step / 2 + 1;
  const std::string checkpoint = folder / "state.h5";
  run(files("parts") + Options{{"-checkpoint", checkpoint}, {"-ts_max_steps", std::to_string(half)}});
  const Outcome second = run(files("parts") + Options{{"-restart", checkpoint}});
  EXPECT_EQ(second.record.step, whole.record.step);
  EXPECT_EQ(second.record.time, whole.record.time);
  EXPECT_EQ(second.points, whole.points);
  EXPECT_EQ(second.displacement, whole.displacement);
  for (std::size_t r = 0; r < whole.record.regions.size(); r++) {
    EXPECT_EQ(second.record.regions[r].strain_energy, whole.record.regions[r].strain_energy);
    EXPECT_EQ(second.record.regions[r].mean_displacement, whole.record.regions[r].mean_displacement);
  }
  EXPECT_EQ(second.record.probes, whole.record.probes);
  EXPECT_EQ(second.record.reactions, whole.record.reactions);
  if (my_rank() != 0) return;
  // The tables and the lists of outputs go on as if nothing had happened.
  EXPECT_EQ(text_of(folder / "parts.csv"), text_of(folder / "whole.csv"));
  const bool points = GetParam().method == std::string("mpm");
  std::string a = text_of(folder / (points ? "whole.xdmf" : "whole.pvd")),
              b = text_of(folder / (points ? "parts.xdmf" : "parts.pvd"));
  for (std::size_t at; (at = a.find("whole-")) != std::string::npos;) a.replace(at, 6, "parts-");
  EXPECT_EQ(a, b);
}

TEST_P(Restart, from_a_file_that_is_none_is_an_error) {
  try {
    run({{"-restart", folder / "missing.h5"}});
    FAIL() << "restarted from nothing";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("cannot restart from " + (folder / "missing.h5") + ": there is no such file"),
              std::string::npos)
        << e.what();
  }
}

TEST(RestartOther, of_the_other_method_is_an_error) {
  const Folder folder;
  const Options write{{"-checkpoint", folder / "state.h5"}, {"-ts_max_steps", "1"}},
      read{{"-restart", folder / "state.h5"}};
  fem(PETSC_COMM_WORLD, block("fem") + write);
  EXPECT_THROW(mpm(PETSC_COMM_WORLD, block("mpm") + read), Error);
  mpm(PETSC_COMM_WORLD, block("mpm") + write);
  EXPECT_THROW(fem(PETSC_COMM_WORLD, block("fem") + read), Error);
}

}  // namespace
}  // namespace hg::test
