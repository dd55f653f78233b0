// Regions of several material models in one body.
#include <gtest/gtest.h>

#include <cmath>

#include "program_runs.hpp"

namespace hg::test {
namespace {

// A stiff linear cube in a soft neo-Hookean one under its weight; on unstressed points at Gauss locations the first step of
// the material point method is that of finite elements.
std::string body(const std::string &method, const std::string &foam) {
  return "-method " + method + " -order 2 -dm_plex_box_faces 5,5,5 -mpm_num_points_per_cell 27 " +
         "-mpm_point_location_type gauss -material core,foam -core_model elasticity-linear -core_E 10 -core_nu 0.3 " +
         "-core_rho 1 -core_region_box 0.4,0.4,0.4,0.6,0.6,0.6 -foam_model " + foam + " -foam_E 1 -foam_nu 0.3 " +
         "-foam_rho 1 -forcing body -forcing_body_vector 0,0,-1 -bc_clamp 1,2,3,4,5,6 -ts_dt 1 -ts_max_time 1 " +
         "-snes_rtol 1e-10 -mat_type aij -probe 0.5,0.5,0.5 -quiet -ts_monitor_quantities " + method + ".csv";
}

TEST(Regions, LinearInNeoHookean) {
  WorkingFolder folder;
  const ProgramResult fem = honeyguide(body("fem", "elasticity-neo-hookean-current"));
  const ProgramResult mpm = honeyguide(body("mpm", "elasticity-mpm-neo-hookean-current"), 2);
  ASSERT_EQ(fem.status, 0) << fem.output;
  ASSERT_EQ(mpm.status, 0) << mpm.output;
  const auto elements = read_csv("fem.csv"), points = read_csv("mpm.csv");
  for (const char *quantity : {"displacement_probe0_z", "mean_displacement_core_z", "mean_displacement_foam_z",
                               "strain_energy_core", "strain_energy_foam"}) {
    const double expected = elements.at(quantity).back();
    EXPECT_NE(expected, 0.) << quantity;
    EXPECT_NEAR(points.at(quantity).back(), expected, 1e-6 * std::abs(expected)) << quantity;
  }
}

}  // namespace
}  // namespace hg::test
