// Bad input to the program: each mistake ends with a non-zero status and one message that names it.
#include <gtest/gtest.h>

#include "program_runs.hpp"

namespace hg::test {
namespace {

const std::string soft_cube = "-model elasticity-neo-hookean-initial -E 1 -nu 0.3 -bc_clamp 1 -quiet ";

void expect_error(const std::string &arguments, std::initializer_list<const char *> parts, int ranks = 1) {
  SCOPED_TRACE(arguments);
  const ProgramResult result = honeyguide(arguments, ranks);
  EXPECT_NE(result.status, 0);
  EXPECT_TRUE(result.mentions("honeyguide: error: ")) << result.output;
  EXPECT_FALSE(result.mentions("PETSC ERROR")) << result.output;
  for (const char *part : parts) EXPECT_TRUE(result.mentions(part)) << part << " in\n" << result.output;
}

TEST(BadInput, MissingOptionsFile) {
  expect_error("-options_file no_such_file.yml", {"-options_file", "no_such_file.yml", "No such file"});
  expect_error("-options_file", {"-options_file", "no file name"});
}

TEST(BadInput, OptionsFileThatIsNotYaml) {
  WorkingFolder folder;
  std::ofstream("broken.yml") << "method: [fem\nb: }\n";
  expect_error("-options_file broken.yml", {"YAML"});
}

TEST(BadInput, UnknownMaterial) {
  expect_error("-model elasticity-rubber -E 1 -nu 0.3", {"-model", "elasticity-rubber", "elasticity-linear"});
  expect_error("", {"-model", "missing"});
}

TEST(BadInput, IncompressiblePoissonRatio) {
  expect_error("-model elasticity-linear -E 1 -nu 0.5", {"-nu", "0.5", "< 0.5"});
  expect_error("-material a,b -a_region_box 0,0,0,1,1,0.5 -model elasticity-linear -a_E 1 -a_nu 0.5 -b_E 1 -b_nu 0.3",
               {"-a_nu", "0.5", "< 0.5"});
}

TEST(BadInput, NegativeModulus) {
  expect_error("-model elasticity-linear -E -1 -nu 0.3", {"-E", "-1", "> 0"});
}

TEST(BadInput, UnknownBackend) {
  expect_error(soft_cube + "-ceed /no/such", {"-ceed", "/no/such"});
}

TEST(BadInput, MeshFileThatIsNotOne) {
  WorkingFolder folder;
  expect_error(soft_cube + "-dm_plex_filename nowhere.msh", {"-dm_plex_filename", "nowhere.msh"});
  std::ofstream("text.msh") << "This is not a mesh.\n";
  expect_error(soft_cube + "-dm_plex_filename text.msh", {"text.msh", "could not be read as a mesh"});
  std::ofstream("table.csv") << "1,2,3\n";
  expect_error(soft_cube + "-dm_plex_filename table.csv", {"table.csv", "could not be read as a mesh"});
}

TEST(BadInput, BoundaryFaceThatTheMeshDoesNotHave) {
  expect_error("-model elasticity-linear -E 1 -nu 0.3 -bc_clamp 9", {"face 9", "Face Sets"});
}

TEST(BadInput, ProbeOutsideTheMesh) {
  expect_error(soft_cube + "-probe 0.5,0.5,1.5", {"-probe", "(0.5, 0.5, 1.5)", "outside the mesh"});
}

// Points pushed through the boundary of the mesh: the body is shoved past the end of the box.
TEST(BadInput, PointOutsideTheMesh) {
  const std::string shove =
      "-method mpm -model elasticity-linear -E 1 -nu 0.3 -bc_clamp 5,6 -bc_clamp_5_translate 0.3,0,0 "
      "-bc_clamp_6_translate 0.3,0,0 -dm_plex_box_faces 2,2,2 -mat_type aij -quiet";
  expect_error(shove, {"point", "outside"});
  expect_error(shove, {"point", "outside"}, 2);
}

TEST(BadInput, InvertedElement) {
  const std::string crush = soft_cube +
                            "-bc_clamp 5,6 -bc_clamp_5_translate -1.5,0,0 -bc_clamp_5_interpolation step "
                            "-dm_plex_box_faces 2,2,2 -mat_type aij -ts_dt 1 -ts_adapt_dt_min 0.2";
  expect_error(crush, {"inverted element", "smallest step", "t = 0"});
}

TEST(BadInput, SolverThatDivergesAtTheSmallestStep) {
  const std::string hopeless =
      soft_cube +
      "-bc_clamp 5,6 -bc_clamp_5_translate 0.5,0,0 -dm_plex_box_faces 2,2,2 -mat_type aij -snes_max_it 1 "
      "-snes_rtol 1e-14 -ts_dt 1 -ts_adapt_dt_min 0.2";
  expect_error(hopeless, {"smallest step", "MAX_IT", "-ts_adapt_dt_min"});
  expect_error(hopeless, {"smallest step", "MAX_IT", "-ts_adapt_dt_min"}, 2);
}

TEST(BadInput, EveryRankEndsWhenOneFails) {
  expect_error("-model elasticity-linear -E -1 -nu 0.3", {"-E", "> 0"}, 2);
}

TEST(Input, UnusedOptionsAreReportedAndHarmless) {
  const ProgramResult result = honeyguide(soft_cube + "-bc_clmp_1_translate 0,0,1 -ts_dt 1");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_TRUE(result.mentions("warning: option -bc_clmp_1_translate 0,0,1 was not used")) << result.output;
  const ProgramResult clean = honeyguide(soft_cube + "-ts_dt 1");
  EXPECT_FALSE(clean.mentions("warning")) << clean.output;
}

TEST(Input, HelpExplainsEveryOption) {
  for (const char *method : {"fem", "mpm"}) {
    const ProgramResult result = honeyguide(std::string("-help -method ") + method +
                                            " -bc_clamp 1 -bc_slip 2 -bc_slip_2_components 0 -forcing body");
    EXPECT_EQ(result.status, 0);
    for (const char *option : {"-method <",
                               "-order <",
                               "-ceed <",
                               "-material <",
                               "-model <",
                               "-E <",
                               "-nu <",
                               "-rho <",
                               "-bc_clamp <",
                               "-bc_clamp_1_translate <",
                               "-bc_clamp_1_rotate <",
                               "-bc_slip_2_translate <",
                               "-bc_traction <",
                               "-forcing <",
                               "-forcing_body_vector <",
                               "-dm_plex_box_faces <",
                               "-ts_dt <",
                               "-ts_max_time <",
                               "-ts_adapt_dt_min <",
                               "-mat_type <",
                               "-probe <",
                               "-ts_monitor_quantities <",
                               "-ts_monitor_strain_energy <",
                               "-checkpoint <",
                               "-restart <",
                               "-mpm_num_points_per_cell <",
                               "-ksp_type <",
                               "-pc_type <",
                               "-snes_rtol <"}) {
      EXPECT_TRUE(result.mentions(option)) << option;
    }
  }
}

}  // namespace
}  // namespace hg::test
