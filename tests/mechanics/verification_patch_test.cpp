// Whole runs with known answers: rigid translation and rotation of points, confined stretch by both methods.
#include <gtest/gtest.h>

#include "mesh_fixture.hpp"
#include "qfunction_harness.hpp"
#include "solve/fem_run.hpp"
#include "solve/mpm_run.hpp"

namespace hg::test {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

/// Sets options, "-name" to value, until destroyed.
class RunOptionsScope {
 public:
  explicit RunOptionsScope(Options options) : options_(std::move(options)) {
    // tight, with a floor: a rigid motion has no force to be relative to
    options_.insert(options_.end(), {{"-ceed", "/cpu/self/ref/serial"},
                                     {"-quiet", "1"},
                                     {"-ksp_rtol", "1e-10"},
                                     {"-snes_rtol", "1e-12"},
                                     {"-snes_atol", "1e-13"}});
    for (const auto &[name, value] : options_) petsc_check(PetscOptionsSetValue(nullptr, name.c_str(), value.c_str()));
  }
  ~RunOptionsScope() {
    for (const auto &option : options_) (void)PetscOptionsClearValue(nullptr, option.first.c_str());
  }

 private:
  Options options_;
};

Options with(Options options, const Options &more) {
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

double all_ranks(double mine, MPI_Op op) {
  double result = 0.;
  MPI_Allreduce(&mine, &result, 1, MPI_DOUBLE, op, PETSC_COMM_WORLD);
  return result;
}

/// What must hold for points after a rigid motion x = R X0 + c: no stress, no change of volume, the same points.
void expect_rigid(MpmRun &run, const Tensor &R, const std::array<double, 3> &c, double tolerance) {
  Swarm &swarm = run.swarm();
  const PointField<double> x(swarm, field::x), X0(swarm, field::X0), u(swarm, field::u), F(swarm, field::F);
  const PointField<double> V(swarm, field::V), V0(swarm, field::V0);
  double place = 0., deformation = 0., volume = 0.;
  for (std::size_t p = 0; p < V.size(); p++) {
    for (int i = 0; i < 3; i++) {
      double expected = c[i];
      for (int j = 0; j < 3; j++) expected += R[3 * i + j] * X0[3 * p + j];
      place = std::max(place, std::abs(x[3 * p + i] - expected));
      place = std::max(place, std::abs(X0[3 * p + i] + u[3 * p + i] - expected));
    }
    for (int k = 0; k < 9; k++) deformation = std::max(deformation, std::abs(F[9 * p + k] - R[k]));
    volume = std::max(volume, std::abs(V[p] / V0[p] - 1.));
  }
  EXPECT_LT(all_ranks(place, MPI_MAX), tolerance);
  EXPECT_LT(all_ranks(deformation, MPI_MAX), tolerance);
  EXPECT_LT(all_ranks(volume, MPI_MAX), tolerance);
  for (const Record::Region &region : run.record().regions) EXPECT_LT(std::abs(region.strain_energy), tolerance);
}

const Options block{{"-material", "block"},
                    {"-block_model", "elasticity-mpm-neo-hookean-current"},
                    {"-block_E", "3"},
                    {"-block_nu", "0.3"},
                    {"-block_rho", "2"}};

// Ten cells along, dragged by the faces beside it; points cross cells and, in parallel, ranks.
TEST(RigidMotion, TranslationThroughTenCells) {
  for (const char *order : {"1", "2"}) {
    SCOPED_TRACE(order);
    Options options = with(block, {{"-method", "mpm"},
                                   {"-order", order},
                                   {"-dm_plex_box_faces", "12,2,2"},
                                   {"-dm_plex_box_upper", "12,2,2"},
                                   {"-mpm_num_points_per_cell", "27"},
                                   {"-block_region_box", "0.2,0.3,0.3,1.8,1.8,1.8"},
                                   {"-bc_clamp", "1,2,3,4"},
                                   {"-ts_dt", "0.04"},
                                   {"-ts_max_time", "1"}});
    for (const char *face : {"1", "2", "3", "4"}) {
      options.emplace_back(std::string("-bc_clamp_") + face + "_translate", "10,0,0");
    }
    const RunOptionsScope scope(options);
    hg::Setup setup(PETSC_COMM_WORLD);
    MpmRun run(setup);
    const double mass = run.swarm().total_mass();
    const PetscInt count = run.swarm().global_size();
    run.run();
    expect_rigid(run, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {10., 0., 0.}, 1e-10);
    EXPECT_EQ(run.swarm().global_size(), count);
    EXPECT_NEAR(run.swarm().total_mass(), mass, 1e-14 * mass);
    EXPECT_NEAR(run.record().momentum[0], mass * 10., 1e-10 * mass);
    EXPECT_NEAR(run.record().momentum[1], 0., 1e-10 * mass);
    EXPECT_NEAR(run.record().momentum[2], 0., 1e-10 * mass);
  }
}

// A quarter turn in 18 steps, given on the boundary of the mesh; F is the rotation and FᵀF stays I.
TEST(RigidMotion, QuarterTurnInSteps) {
  for (const char *order : {"1", "2"}) {
    SCOPED_TRACE(order);
    Options options = with(block, {{"-method", "mpm"},
                                   {"-order", order},
                                   {"-dm_plex_box_faces", "2,2,2"},
                                   {"-dm_plex_box_lower", "-0.5,-0.5,-0.5"},
                                   {"-dm_plex_box_upper", "0.5,0.5,0.5"},
                                   {"-mpm_num_points_per_cell", "64"},
                                   {"-block_region_box", "-0.3,-0.3,-0.3,0.3,0.3,0.3"},
                                   {"-bc_clamp", "1,2,3,4,5,6"},
                                   {"-ts_dt", "0.0555555555555555556"},
                                   {"-ts_max_time", "1"}});
    for (const char *face : {"1", "2", "3", "4", "5", "6"}) {
      options.emplace_back(std::string("-bc_clamp_") + face + "_rotate", "0,0,1,1.5707963267948966,0");
    }
    const RunOptionsScope scope(options);
    hg::Setup setup(PETSC_COMM_WORLD);
    MpmRun run(setup);
    run.run();
    expect_rigid(run, {0, -1, 0, 1, 0, 0, 0, 0, 1}, {0., 0., 0.}, 1e-9);
    const double mass = run.swarm().total_mass();
    for (double momentum : run.record().momentum) EXPECT_NEAR(momentum, 0., 1e-9 * mass);
    // angular momentum about z of a rigid turn, from the last step's velocities
    const PointField<double> x(run.swarm(), field::x), u(run.swarm(), field::v), V0(run.swarm(), field::V0);
    double angular = 0., expected = 0.;
    const double dt = run.record().dt, angle = 1.5707963267948966 * dt;
    for (std::size_t p = 0; p < V0.size(); p++) {
      angular += 2. * V0[p] * (x[3 * p] * u[3 * p + 1] - x[3 * p + 1] * u[3 * p]);
      expected += 2. * V0[p] * (x[3 * p] * x[3 * p] + x[3 * p + 1] * x[3 * p + 1]) * std::sin(angle) / dt;
    }
    EXPECT_NEAR(all_ranks(angular, MPI_SUM), all_ranks(expected, MPI_SUM), 1e-9);
  }
}

// A cube between frictionless walls, pressed or pulled to s times its length: σ_xx = (μ + λ/2)(s² − 1)/s over area 1
// and σ_yy = λ/2 (s² − 1)/s over area s, for every form and method; the linear material obeys Hooke.
TEST(ConfinedStretch, ReactionsAreTheClosedForm) {
  struct Way {
    const char *method, *model;
    double stretch;
  };
  for (const Way &way : {Way{"fem", "elasticity-neo-hookean-initial", 1.6},
                         {"fem", "elasticity-neo-hookean-current", 0.6},
                         {"fem", "elasticity-linear", 1.2},
                         {"mpm", "elasticity-mpm-neo-hookean-current", 0.9},
                         {"mpm", "elasticity-mpm-linear", 0.9}}) {
    for (const char *order : {"1", "2"}) {
      SCOPED_TRACE(std::string(way.method) + " " + way.model + " order " + order);
      Options options{{"-method", way.method},
                      {"-model", way.model},
                      {"-order", order},
                      {"-E", "3"},
                      {"-nu", "0.3"},
                      {"-dm_plex_box_faces", "2,3,2"},
                      {"-mpm_num_points_per_cell", order[0] == '1' ? "8" : "27"},
                      {"-mpm_point_location_type", "gauss"},
                      {"-bc_slip", "1,2,3,4,5,6"},
                      {"-bc_slip_1_components", "2"},
                      {"-bc_slip_2_components", "2"},
                      {"-bc_slip_3_components", "1"},
                      {"-bc_slip_4_components", "1"},
                      {"-bc_slip_5_components", "0"},
                      {"-bc_slip_6_components", "0"},
                      {"-bc_slip_5_translate", std::to_string(way.stretch - 1.)},
                      {"-ts_dt", way.method[0] == 'f' ? "0.1" : "1"},
                      {"-ts_max_time", "1"}};
      const RunOptionsScope scope(options);
      hg::Setup setup(PETSC_COMM_WORLD);
      Record record;
      if (way.method[0] == 'f') {
        FemRun run(setup);
        run.run();
        record = run.record();
      } else {
        MpmRun run(setup);
        run.run();
        record = run.record();
        const PointField<double> F(run.swarm(), field::F);
        for (std::size_t k = 0; k < F.size(); k++) {
          EXPECT_NEAR(F[k], k % 9 == 0 ? way.stretch : (k % 9 % 4 == 0 ? 1. : 0.), 1e-9);
        }
      }
      const double s = way.stretch, mu = 3. / 2.6, lambda = 3. * 0.3 / (1.3 * 0.4);
      const bool linear = std::string(way.model).find("linear") != std::string::npos;
      const double normal = linear ? (2. * mu + lambda) * (s - 1.) : (mu + 0.5 * lambda) * (s * s - 1.) / s;
      const double side = linear ? lambda * (s - 1.) : 0.5 * lambda * (s * s - 1.);
      ASSERT_EQ(record.reactions.size(), 6u);
      EXPECT_NEAR(record.reactions[4][0], normal, 1e-8);
      EXPECT_NEAR(record.reactions[5][0], -normal, 1e-8);
      EXPECT_NEAR(record.reactions[2][1], -side, 1e-8);
      EXPECT_NEAR(record.reactions[3][1], side, 1e-8);
      EXPECT_NEAR(record.reactions[0][2], -side, 1e-8);
      EXPECT_NEAR(record.reactions[1][2], side, 1e-8);
      const double energy =
          linear ? 0.5 * (2. * mu + lambda) * (s - 1.) * (s - 1.)
                 : 0.5 * mu * (s * s - 1.) - mu * std::log(s) + 0.25 * lambda * (s * s - 1. - 2. * std::log(s));
      EXPECT_NEAR(record.regions[0].strain_energy, energy, 1e-9);
    }
  }
}

}  // namespace
}  // namespace hg::test
