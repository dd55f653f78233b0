// Fields of points drawn on the mesh: a homogeneous state gives its values at every vertex, by both projections.
#include <gtest/gtest.h>

#include "output_files.hpp"
#include "solve/mpm_run.hpp"
#include "vtu.hpp"

namespace hg::test {
namespace {

class OutputPointsOnMesh : public testing::TestWithParam<const char *> {
 protected:
  Folder folder;
};
INSTANTIATE_TEST_SUITE_P(Projections, OutputPointsOnMesh, testing::Values("lumped", "consistent"),
                         [](const auto &info) { return std::string(info.param); });

// A cube between frictionless walls, pressed to nine tenths of its length in one step.
TEST_P(OutputPointsOnMesh, a_homogeneous_state_is_constant) {
  const ScopedOptions options{{"-method", "mpm"},
                              {"-model", "elasticity-mpm-neo-hookean-current"},
                              {"-order", "2"},
                              {"-E", "3"},
                              {"-nu", "0.3"},
                              {"-dm_plex_box_faces", "2,3,2"},
                              {"-mpm_num_points_per_cell", "27"},
                              {"-mpm_projection", GetParam()},
                              {"-bc_slip", "1,2,3,4,5,6"},
                              {"-bc_slip_1_components", "2"},
                              {"-bc_slip_2_components", "2"},
                              {"-bc_slip_3_components", "1"},
                              {"-bc_slip_4_components", "1"},
                              {"-bc_slip_5_components", "0"},
                              {"-bc_slip_6_components", "0"},
                              {"-bc_slip_5_translate", "-0.1"},
                              {"-snes_rtol", "1e-12"},
                              {"-ksp_rtol", "1e-10"},
                              {"-ts_dt", "1"},
                              {"-ts_max_time", "1"},
                              {"-quiet", "1"},
                              {"-ceed", "/cpu/self/ref/serial"},
                              {"-ts_monitor_diagnostic_quantities", folder / "series"},
                              {"-view_diagnostic_quantities", folder / "view"}};
  hg::Setup setup(PETSC_COMM_WORLD);
  MpmRun run(setup);
  run.run();
  MPI_Barrier(PETSC_COMM_WORLD);
  const double s = 0.9, mu = 3. / 2.6, lambda = 3. * 0.3 / (1.3 * 0.4);
  const double normal = (mu + 0.5 * lambda) * (s * s - 1.) / s, side = 0.5 * lambda * (s * s - 1.) / s;
  for (const std::string prefix : {"series", "view"}) {
    char own[32] = "-000001.vtu";
    if (ranks() > 1) std::snprintf(own, sizeof own, "-000001-%04d.vtu", my_rank());
    const Xml root = XmlReader::file(folder / (prefix + own));
    const Xml &piece = root.one("UnstructuredGrid").one("Piece");
    const auto x = values<double>(piece.one("Points").one("DataArray"));
    const auto stress = values<double>(piece.one("PointData").named("DataArray", "cauchy_stress"));
    const auto pressure = values<double>(piece.one("PointData").named("DataArray", "pressure"));
    const auto u = values<double>(piece.one("PointData").named("DataArray", "displacement"));
    const auto volume = values<double>(piece.one("PointData").named("DataArray", "volume"));
    ASSERT_EQ(stress.size(), 2 * x.size());
    ASSERT_EQ(u.size(), x.size());
    ASSERT_GT(x.size(), 0u);
    for (std::size_t n = 0; n < volume.size(); n++) {
      EXPECT_GT(volume[n], 0.);
      EXPECT_LT(x[3 * n], s + 1e-9) << "the mesh is drawn where the step carried it";
      const double expected[6] = {normal, side, side, 0., 0., 0.};
      for (int c = 0; c < 6; c++) EXPECT_NEAR(stress[6 * n + c], expected[c], 1e-8);
      EXPECT_NEAR(pressure[n], -(normal + 2. * side) / 3., 1e-8);
      EXPECT_NEAR(u[3 * n + 1], 0., 1e-8);
      if (std::string(GetParam()) == "consistent") {
        EXPECT_NEAR(u[3 * n], -0.1 * (x[3 * n] / s), 1e-8);
      } else {
        EXPECT_LE(u[3 * n], 1e-12);
        EXPECT_GE(u[3 * n], -0.1);
      }
    }
  }
}

}  // namespace
}  // namespace hg::test
