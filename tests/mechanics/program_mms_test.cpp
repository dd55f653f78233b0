// The manufactured solution of linear elasticity through the program: rate p + 1, and MPM with points at the Gauss
// places equal to FEM with the same points.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include "program_runs.hpp"

namespace hg::test {
namespace {

double error_of(int order, int cells, const std::string &more, int ranks = 1) {
  const std::string n = std::to_string(cells);
  const ProgramResult result =
      honeyguide("-model elasticity-linear -E 1 -nu 0.3 -order " + std::to_string(order) + " -dm_plex_box_faces " + n +
                     "," + n + "," + n + " -bc_mms 1,2,3,4,5,6 -forcing mms -ts_dt 1 -ksp_rtol 1e-9 -quiet " + more,
                 ranks);
  EXPECT_EQ(result.status, 0) << result.output;
  constexpr std::string_view title = "manufactured solution: ";
  const std::size_t found = result.output.find(title);
  EXPECT_NE(found, std::string::npos) << result.output;
  return found == std::string::npos ? NAN : std::stod(result.output.substr(found + title.size()));
}

TEST(ManufacturedSolution, FemConvergesAtOrderPlusOne) {
  const int coarse[] = {0, 8, 4, 3};
  for (int p : {1, 2, 3}) {
    const double big = error_of(p, coarse[p], ""), small = error_of(p, 2 * coarse[p], "");
    EXPECT_GT(std::log2(big / small), p + 0.8) << "order " << p << ": " << big << " " << small;
    EXPECT_LT(big, 1.3229e-3);  // the norm of the solution itself
  }
}

TEST(ManufacturedSolution, MpmAtGaussPlacesIsFem) {
  const double fem = error_of(2, 4, "");
  const double mpm = error_of(2, 4, "-method mpm -mpm_num_points_per_cell 27 -mpm_point_location_type gauss");
  EXPECT_NEAR(mpm, fem, 1e-6 * fem);
}

TEST(ManufacturedSolution, RanksAgree) {
  const double one = error_of(2, 4, ""), three = error_of(2, 4, "", 3);
  EXPECT_NEAR(three, one, 1e-6 * one);
}

}  // namespace
}  // namespace hg::test
