// Newton on real solids: homogeneous states against closed forms, quadratic convergence, the same answer from both
// kinds of matrix and on any number of ranks, empty cells, and states that cannot be solved.
#include <gtest/gtest.h>

#include "operators_fixture.hpp"
#include "solver_fixture.hpp"

namespace hg::test {
namespace {

// Stretch in x, free sides: slip on the three low faces and on the high x face.
const std::initializer_list<std::pair<std::string, std::string>> stretch{{"-bc_slip", "6,3,1,5"},
                                                                         {"-bc_slip_6_components", "0"},
                                                                         {"-bc_slip_3_components", "1"},
                                                                         {"-bc_slip_1_components", "2"},
                                                                         {"-bc_slip_5_components", "0"},
                                                                         {"-bc_slip_5_translate", "0.2"},
                                                                         {"-mat_type", "aij"}};

double rank_sum(double mine) {
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return mine;
}

TEST(StaticSolver, LinearUniaxialStretchContractsByPoisson) {
  ScopedOptions options(stretch);
  Problem problem("elasticity-linear", "2,3,2", 2, bend);
  const SolveResult result = problem.solve();
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_LE(result.newton_iterations, 2);
  const auto u = problem.local();
  const auto &x = problem.mesh->node_coordinates(2);
  for (std::size_t i = 0; i < u.size(); ++i) ASSERT_NEAR(u[i], (i % 3 == 0 ? 0.2 : -0.4 * 0.2) * x[i], 1e-9);
  // Force: E ε times the area.
  const auto forces = problem.solver->reactions(problem.u);
  EXPECT_NEAR(forces[0][0], -2.8 * 0.2, 1e-8);
  EXPECT_NEAR(forces[3][0], 2.8 * 0.2, 1e-8);
}

TEST(StaticSolver, NeoHookeanUniaxialStretchMeetsTheClosedForm) {
  for (const char *model : {"elasticity-neo-hookean-initial", "elasticity-neo-hookean-current"}) {
    ScopedOptions options(stretch);
    Problem problem(model, "2,2,2", 1, bend);
    const SolveResult result = problem.solve();
    ASSERT_TRUE(result.converged) << result.reason;
    // Lateral stretch b from τ_yy = μ (b² − 1) + λ/2 (a² b⁴ − 1) = 0 at a = 1.2.
    const double mu = 1, lambda = 2.8 * 0.4 / (1.4 * 0.2), a = 1.2;
    const double A = lambda / 2 * a * a, b2 = (-mu + std::sqrt(mu * mu + 4 * A * (mu + lambda / 2))) / (2 * A);
    const double force = (mu * (a * a - 1) + lambda / 2 * (a * a * b2 * b2 - 1)) / a;
    const auto u = problem.local();
    const auto &x = problem.mesh->node_coordinates(1);
    for (std::size_t i = 0; i < u.size(); ++i) {
      ASSERT_NEAR(u[i], (i % 3 == 0 ? a - 1 : std::sqrt(b2) - 1) * x[i], 1e-8);
    }
    EXPECT_NEAR(problem.solver->reactions(problem.u)[3][0], force, 1e-7);
  }
}

TEST(StaticSolver, TractionPullsAsAStretchDoes) {
  ScopedOptions options{{"-bc_slip", "6,3,1"},
                        {"-bc_slip_6_components", "0"},
                        {"-bc_slip_3_components", "1"},
                        {"-bc_slip_1_components", "2"},
                        {"-bc_traction", "5"},
                        {"-bc_traction_5", "0.28,0,0"},
                        {"-mat_type", "aij"}};
  Problem problem("elasticity-linear", "2,3,2", 2, bend);
  const SolveResult result = problem.solve(0.5);
  ASSERT_TRUE(result.converged) << result.reason;
  const auto u = problem.local();
  const auto &x = problem.mesh->node_coordinates(2);
  // ε = t/E at half the ramp.
  for (std::size_t i = 0; i < u.size(); ++i) ASSERT_NEAR(u[i], (i % 3 == 0 ? 0.05 : -0.4 * 0.05) * x[i], 1e-9);
  EXPECT_NEAR(problem.solver->reactions(problem.u)[0][0], -0.14, 1e-9);
}

TEST(StaticSolver, TractionsThatCannotBeMeantAreNamed) {
  const auto message = [](std::initializer_list<std::pair<std::string, std::string>> pairs) -> std::string {
    ScopedOptions options(pairs);
    try {
      Problem problem("elasticity-linear", "1,1,1", 1);
    } catch (const Error &error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message({{"-bc_traction", "5"}}).find("-bc_traction_5: 0 numbers"), std::string::npos);
  EXPECT_NE(message({{"-bc_traction", "8"}, {"-bc_traction_8", "1,0,0"}}).find("value 8"), std::string::npos);
  EXPECT_NE(message({{"-bc_traction", "5"}, {"-bc_traction_5", "1,0,0"}, {"-method", "mpm"}}).find("-method fem"),
            std::string::npos);
}

const std::initializer_list<std::pair<std::string, std::string>> twist{{"-bc_clamp", "1,2"},
                                                                       {"-bc_clamp_2_rotate", "0,0,1,0.6,0"},
                                                                       {"-bc_clamp_2_translate", "0.05,0,0.1"},
                                                                       {"-snes_rtol", "1e-11"}};

TEST(StaticSolver, NewtonIsQuadratic) {
  ScopedOptions options(twist);
  ScopedOptions direct{{"-mat_type", "aij"}};
  Problem problem("elasticity-neo-hookean-initial", "2,2,2");
  petsc_check(SNESSetConvergenceHistory(problem.solver->snes(), nullptr, nullptr, 50, PETSC_TRUE));
  ASSERT_TRUE(problem.solve().converged);
  PetscReal *history;
  PetscInt count;
  petsc_check(SNESGetConvergenceHistory(problem.solver->snes(), &history, nullptr, &count));
  ASSERT_GE(count, 4);
  // The last step of Newton above rounding: the exponent of one residual norm in the one before.
  PetscInt k = count - 1;
  while (k > 2 && history[k] < 1e-13 * history[0]) --k;
  const double order = std::log(history[k] / history[k - 1]) / std::log(history[k - 1] / history[k - 2]);
  EXPECT_GT(order, 1.7) << history[k - 2] << " " << history[k - 1] << " " << history[k];
}

TEST(StaticSolver, MatrixFreeAndAssembledAgreeOnAnyRanks) {
  ScopedOptions options(twist);
  std::vector<double> energies;
  for (const char *type : {"aij", "shell"}) {
    ScopedOptions matrix{{"-mat_type", type}, {"-ksp_rtol", "1e-10"}};
    Problem problem("elasticity-neo-hookean-current", "3,2,2");
    const SolveResult result = problem.solve();
    ASSERT_TRUE(result.converged) << type << ": " << result.reason;
    if (std::string(type) == "shell") {
      EXPECT_GT(result.linear_iterations, 10);
    }
    energies.push_back(rank_sum(problem.energy()));
  }
  EXPECT_NEAR(energies[0], energies[1], 1e-9 * energies[0]);
  // Each rank solves the whole problem alone.
  ScopedOptions direct{{"-mat_type", "aij"}};
  Problem alone("elasticity-neo-hookean-current", "3,2,2", 2, nullptr, PETSC_COMM_SELF);
  ASSERT_TRUE(alone.solve().converged);
  EXPECT_NEAR(energies[0], alone.energy(), 1e-9 * energies[0]);
}

TEST(StaticSolver, JacobianMatchesFiniteDifferencesOfItsResidual) {
  ScopedOptions options(twist);
  Problem problem("elasticity-neo-hookean-initial", "2,2,2", 1);
  ASSERT_TRUE(problem.solve(0.5).converged);
  VecHandle direction, f0, f1, Jd, moved;
  for (VecHandle *v : {&direction, &f0, &f1, &Jd, &moved}) petsc_check(VecDuplicate(problem.u, v->put()));
  PetscRandom random;
  petsc_check(PetscRandomCreate(PETSC_COMM_WORLD, &random));
  petsc_check(VecSetRandom(direction, random));
  petsc_check(PetscRandomDestroy(&random));
  ASSERT_TRUE(problem.solver->residual(problem.u, f0));
  problem.solver->jacobian(problem.u);
  petsc_check(MatMult(problem.solver->matrix().mat(), direction, Jd));
  // Taylor: |f(u + h d) − f(u) − h J d| falls with h².
  double remainder[2];
  for (int k = 0; k < 2; ++k) {
    const double h = k ? 1e-4 : 1e-3;
    petsc_check(VecWAXPY(moved, h, direction, problem.u));
    ASSERT_TRUE(problem.solver->residual(moved, f1));
    petsc_check(VecAXPY(f1, -1., f0));
    petsc_check(VecAXPY(f1, -h, Jd));
    petsc_check(VecNorm(f1, NORM_2, &remainder[k]));
  }
  EXPECT_NEAR(std::log10(remainder[0] / remainder[1]), 2, 0.05);
}

TEST(StaticSolver, DampingAddsItsShareOfTheMeanDiagonal) {
  ScopedOptions options(twist);
  for (const char *type : {"aij", "shell"}) {
    ScopedOptions matrix{{"-mat_type", type}};
    Problem problem("elasticity-neo-hookean-initial", "2,2,2", 1);
    ASSERT_TRUE(problem.solve(0.5).converged);
    JacobianMat &jacobian = problem.solver->matrix();
    VecHandle x, plain, damped, diagonal;
    for (VecHandle *v : {&x, &plain, &damped, &diagonal}) petsc_check(VecDuplicate(problem.u, v->put()));
    petsc_check(VecSet(x, 1.));
    jacobian.update();
    petsc_check(MatMult(jacobian.mat(), x, plain));
    petsc_check(MatGetDiagonal(jacobian.mat(), diagonal));
    jacobian.update(0.1);
    petsc_check(MatMult(jacobian.mat(), x, damped));
    PetscReal sum, largest;
    PetscInt size;
    petsc_check(VecNorm(diagonal, NORM_1, &sum));
    petsc_check(VecGetSize(x, &size));
    petsc_check(VecAXPY(damped, -1., plain));
    petsc_check(VecShift(damped, -0.1 * sum / static_cast<double>(size)));
    petsc_check(VecNorm(damped, NORM_INFINITY, &largest));
    EXPECT_LT(largest, 1e-12 * sum) << type;
  }
}

TEST(StaticSolver, EmptyCellsLeaveTheSystemSolvable) {
  for (const char *type : {"aij", "shell"}) {
    ScopedOptions options{{"-bc_clamp", "6"},
                          {"-forcing", "body"},
                          {"-forcing_body_vector", "0,0,-0.1"},
                          {"-mat_type", type},
                          {"-ksp_rtol", "1e-10"}};
    CeedHandle ceed = make_ceed();
    auto mesh = box_mesh(ceed, "4,2,2", {.order = 2});
    const RunOptions run = RunOptions::read(PETSC_COMM_WORLD);
    BoundaryConditions boundary(*mesh, PETSC_COMM_WORLD);
    const std::vector<RegionMaterial> materials{
        {&find_material("elasticity-neo-hookean-current"), {.E = 2.8, .nu = 0.3, .rho = 1.}}};
    Points points(*mesh, materials, PointPlacement::kUniform, 27, [](const double *x) { return x[0] < 0.5 ? 0 : -1; });
    MpmOperators operators(*mesh, materials);
    operators.attach(*points.epoch, points.swarm);
    StaticSolver solver(*mesh, operators, boundary, run);
    std::vector<char> active(mesh->num_cells);
    for (CeedInt c = 0; c < mesh->num_cells; ++c) active[c] = points.epoch->starts()[c + 1] > points.epoch->starts()[c];
    solver.operators_changed(active);
    VecHandle u, local;
    petsc_check(DMCreateGlobalVector(mesh->dm, u.put()));
    petsc_check(VecZeroEntries(u));
    const SolveResult result = solver.solve({.t = 1, .increment = true}, u);
    ASSERT_TRUE(result.converged) << result.reason;
    petsc_check(DMCreateLocalVector(mesh->dm, local.put()));
    solver.to_local(u, local);
    const auto &x = mesh->node_coordinates(2);
    const PetscScalar *array;
    double largest = 0;
    petsc_check(VecGetArrayRead(local, &array));
    for (PetscInt i = 0; i < mesh->local_size; ++i) {
      if (x[3 * (i / 3)] > 0.5 + 1e-9) {
        ASSERT_EQ(array[i], 0.) << "a node that no point supports moved";
      }
      largest = std::max(largest, std::abs(array[i]));
    }
    petsc_check(VecRestoreArrayRead(local, &array));
    EXPECT_GT(rank_sum(largest), 1e-3);
    // The clamp carries the weight of half the cube.
    EXPECT_NEAR(solver.reactions(u)[0][2], 0.05, 1e-7);
  }
}

TEST(StaticSolver, AnImpossibleStateIsReportedAsInverted) {
  ScopedOptions options{{"-bc_clamp", "5,6"}, {"-bc_clamp_5_translate", "-1.5,0,0"}};
  Problem problem("elasticity-neo-hookean-initial", "2,1,1", 1);
  const SolveResult result = problem.solve();
  EXPECT_FALSE(result.converged);
  EXPECT_TRUE(result.inverted);
  EXPECT_NE(result.reason.find("inverted element"), std::string::npos) << result.reason;
}

TEST(StaticSolver, NothingToDoIsDoneAtOnce) {
  ScopedOptions options(twist);
  ScopedOptions direct{{"-mat_type", "aij"}};
  Problem problem("elasticity-neo-hookean-initial", "2,2,2");
  ASSERT_TRUE(problem.solve().converged);
  // The same load again: the first residual is rounding, not something to reduce by 1e-8.
  const SolveResult again = problem.solve();
  EXPECT_TRUE(again.converged) << again.reason;
  EXPECT_LE(again.newton_iterations, 1);
}

TEST(StaticSolver, FailureNamesTheReason) {
  ScopedOptions options(twist);
  ScopedOptions limits{{"-snes_max_it", "1"}, {"-mat_type", "aij"}};
  Problem problem("elasticity-neo-hookean-initial", "2,2,2");
  const SolveResult result = problem.solve();
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.inverted);
  EXPECT_NE(result.reason.find("MAX_IT"), std::string::npos) << result.reason;
}

}  // namespace
}  // namespace hg::test
