/// @file
/// Newton's method for the equilibrium of one step: internal force(u) = external force(t).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boundary/boundary.hpp"
#include "boundary/traction.hpp"
#include "mesh/mesh.hpp"
#include "operators/solid_operators.hpp"
#include "options/options.hpp"
#include "solve/jacobian_mat.hpp"

namespace hg {

/// How a solve ended. A step is to be taken again with a smaller Δt when it did not converge.
struct SolveResult {
  bool converged = false;
  bool inverted = false;  ///< det F <= 0 somewhere in the state that the solver was given or could not leave
  PetscInt newton_iterations = 0;
  PetscInt linear_iterations = 0;
  std::string reason;  ///< in words, for messages
};

/// From where to where a step goes. FEM solves for the total displacement at t, MPM for the increment from t_from to t.
struct Step {
  double t_from = 0;
  double t = 0;
  bool increment = false;
};

/// One SNES for the whole run (options -snes_*, -ksp_*, -pc_*, -mat_type). Defaults: relative tolerance 1e-8; shell
/// matrix with CG and Jacobi to 1e-6; aij with a direct solver.
///
/// A step is first solved by Newton with the line search of slope_search.hpp. If that fails, it starts again from the
/// same guess with a damped Jacobian, J + α d I with d its mean diagonal: α grows when the residual grew, else
/// it falls. The damping holds nodes that hardly any material supports, where J is nearly singular;
/// it changes the way, not the solution. An option -snes_linesearch_type or -snes_type takes the place of both.
class StaticSolver {
 public:
  /// Mesh with its constraints, operators and boundary conditions outlive the solver. Collective.
  StaticSolver(const Mesh &mesh, SolidOperators &operators, const BoundaryConditions &boundary,
               const RunOptions &options);

  /// To be called once before the first solve and again whenever the operators were built anew. `active_cells` says for
  /// each local cell whether it holds material; nodes of empty cells only are taken out of the system. Collective.
  void operators_changed(const std::vector<char> &active_cells);

  /// Solves into u, a global vector of mesh.dm that holds the first guess. Does not throw when Newton fails.
  /// Collective.
  SolveResult solve(const Step &step, Vec u);

  /// Takes the boundary values and loads of time t, as if a solve had ended there (after a restart).
  void set_time(double t);

  /// The local vector of u with the boundary values of the last solve's step, for integrals and output. Collective.
  void to_local(Vec u, Vec local) const;

  /// Force on the body through each boundary face (in the order of BoundaryConditions::faces()): the sum of internal
  /// minus external force over its constrained entries, at u and the last solve's step. Collective.
  std::vector<std::array<double, 3>> reactions(Vec u);

  /// Largest norm of a first residual so far: what rounding is measured with. Part of a checkpoint.
  double residual_scale() const { return scale_; }
  void set_residual_scale(double scale) { scale_ = scale; }

  /// For SNES: f = internal − external force at u. Returns false, with f set to NaN, at an inverted element.
  bool residual(Vec u, Vec f);
  /// For SNES: linearises at u and updates the matrix.
  void jacobian(Vec u);

  SNES snes() const { return snes_; }
  JacobianMat &matrix() { return *jacobian_; }

 private:
  void local_residual(Vec u);
  void load(const Step &step);
  void external_force(const Step &step);
  void shorten_step(Vec u, Vec y, PetscBool *changed);

  const Mesh &mesh_;
  SolidOperators &operators_;
  const BoundaryConditions &boundary_;
  const RunOptions &options_;
  Tractions tractions_;
  double final_time_ = 1;
  double scale_ = 0;
  double damping_ = 0;           ///< of the next Jacobian
  bool first_jacobian_ = true;   ///< of a solve
  double last_norm_ = 0;         ///< of the residual at the Jacobian before
  bool keep_tolerance_ = false;  ///< the user gave -snes_atol
  std::unique_ptr<JacobianMat> jacobian_;
  InactiveRows inactive_;
  /// Ways to solve a step, tried in turn from the same guess.
  struct Attempt {
    bool slope_search;  ///< else the line search of the options
    double damping;     ///< of the first Jacobian, in units of its mean diagonal
    PetscInt max_iterations;
  };
  std::vector<Attempt> attempts_;
  VecHandle residual_, trial_, guess_, boundary_values_, local_u_, local_r_, local_load_;
  CeedVectorHandle ceed_u_, ceed_r_;
  SnesHandle snes_;
};

}  // namespace hg
