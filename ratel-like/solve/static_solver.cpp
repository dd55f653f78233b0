#include "solve/static_solver.hpp"

#include <ceed/backend.h>

#include <algorithm>
#include <cmath>

#include "mesh/lend.hpp"
#include "options/error.hpp"
#include "solve/slope_search.hpp"
#include "solve/stages.hpp"

namespace hg {

namespace {

StaticSolver &self(void *context) {
  return *static_cast<StaticSolver *>(context);
}

PetscErrorCode residual_callback(SNES, Vec u, Vec f, void *context) {
  return guard([&] { self(context).residual(u, f); });
}

PetscErrorCode jacobian_callback(SNES, Vec u, Mat, Mat, void *context) {
  return guard([&] { self(context).jacobian(u); });
}

// Undamped Newton on a step that goes well needs 4 to 10 iterations.
constexpr PetscInt quick_iterations = 25;
constexpr double first_damping = 1e-2;

bool finite_everywhere(Vec f) {
  PetscReal norm;
  petsc_check(VecNorm(f, NORM_2, &norm));
  return std::isfinite(norm);
}

}  // namespace

StaticSolver::StaticSolver(const Mesh &mesh, SolidOperators &operators, const BoundaryConditions &boundary,
                           const RunOptions &options)
    : mesh_(mesh), operators_(operators), boundary_(boundary), options_(options), tractions_(mesh) {
  OptionGroup group(mesh.comm, "", "Solver");
  final_time_ = group.real("ts_max_time", "time at which the run ends [s]", 1., Range::positive());
  keep_tolerance_ = group.given("snes_atol");
  if (!tractions_.empty() && options.method == Method::mpm) {
    fail("option -bc_traction: faces of the background mesh carry no load in -method mpm, expected -method fem");
  }
  jacobian_ = std::make_unique<JacobianMat>(mesh, read_mat_type(mesh.comm));

  petsc_check(DMCreateGlobalVector(mesh.dm, residual_.put()));
  petsc_check(VecDuplicate(residual_, trial_.put()));
  petsc_check(VecDuplicate(residual_, guess_.put()));
  petsc_check(DMCreateLocalVector(mesh.dm, local_u_.put()));
  petsc_check(VecDuplicate(local_u_, local_r_.put()));
  petsc_check(VecDuplicate(local_u_, local_load_.put()));
  petsc_check(VecDuplicate(local_u_, boundary_values_.put()));
  petsc_check(VecZeroEntries(boundary_values_));
  ceed_check(CeedVectorCreate(mesh.ceed, mesh.local_size, ceed_u_.put()));
  ceed_check(CeedVectorCreate(mesh.ceed, mesh.local_size, ceed_r_.put()));

  petsc_check(SNESCreate(mesh.comm, snes_.put()));
  petsc_check(SNESSetFunction(snes_, residual_, residual_callback, this));
  petsc_check(SNESSetJacobian(snes_, jacobian_->mat(), jacobian_->mat(), jacobian_callback, this));
  petsc_check(SNESSetTolerances(snes_, 1e-50, 1e-8, 1e-14, 50, 100000));
  KSP ksp;
  PC pc;
  petsc_check(SNESGetKSP(snes_, &ksp));
  petsc_check(KSPGetPC(ksp, &pc));
  if (jacobian_->type() == JacobianMat::Type::shell) {
    petsc_check(KSPSetType(ksp, KSPCG));
    petsc_check(PCSetType(pc, PCJACOBI));
    petsc_check(KSPSetTolerances(ksp, 1e-6, PETSC_DEFAULT, PETSC_DEFAULT, 10000));
  } else {
    petsc_check(KSPSetType(ksp, KSPPREONLY));
    // The Jacobian is symmetric: MUMPS factors L D Lᵀ, also of an indefinite one, for half the price.
    petsc_check(PCSetType(pc, PetscDefined(HAVE_MUMPS) ? PCCHOLESKY : PCLU));
    if (PetscDefined(HAVE_MUMPS)) petsc_check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  }
  petsc_check(SNESSetFromOptions(snes_));
  PetscInt max_iterations;
  petsc_check(SNESGetTolerances(snes_, nullptr, nullptr, nullptr, &max_iterations, nullptr));
  if (group.given("snes_linesearch_type") || group.given("snes_type")) {
    attempts_ = {{.slope_search = false, .damping = 0, .max_iterations = max_iterations}};
  } else {
    attempts_ = {{.slope_search = true, .damping = 0, .max_iterations = std::min(max_iterations, quick_iterations)},
                 {.slope_search = true, .damping = first_damping, .max_iterations = max_iterations}};
    use_slope_search(snes_);
  }
  SNESLineSearch search;
  petsc_check(SNESGetLineSearch(snes_, &search));
  petsc_check(SNESLineSearchSetPreCheck(
      search,
      [](SNESLineSearch, Vec u, Vec y, PetscBool *changed, void *context) -> PetscErrorCode {
        return guard([&] { self(context).shorten_step(u, y, changed); });
      },
      this));
}

void StaticSolver::operators_changed(const std::vector<char> &active_cells) {
  const auto nodes_of_cell = static_cast<std::size_t>((mesh_.order + 1) * (mesh_.order + 1) * (mesh_.order + 1));
  std::vector<double> active(static_cast<std::size_t>(mesh_.local_size) / 3, 0.);
  const auto &offsets = mesh_.node_offsets();
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (active_cells[i / nodes_of_cell]) active[offsets[i] / 3] = 1;
  }
  mesh_.sum_shared(mesh_.order, 1, active);
  PetscInt first, end;
  petsc_check(VecGetOwnershipRange(residual_, &first, &end));
  std::vector<PetscInt> inactive;
  for (PetscInt i = 0; i < mesh_.local_size; ++i) {
    const PetscInt row = jacobian_->global_index()[i];
    if (row >= first && row < end && active[i / 3] == 0) inactive.push_back(row - first);
  }
  inactive_.set(inactive, residual_);
  ceed_check(CeedOperatorPrepare(operators_.residual()));  // so that what solves take is not what compiling takes
  jacobian_->set_operator(operators_.jacobian(), inactive_);
}

void StaticSolver::external_force(const Step &step) {
  const BodyForce &force = options_.forcing;
  if (force.kind == BodyForce::Kind::none) {
    petsc_check(VecZeroEntries(local_load_));
  } else {
    Lend load(local_load_, ceed_r_, Access::write);
    if (force.kind == BodyForce::Kind::mms) {
      operators_.mms_force(mms_amplitude * mms_factor(step.t, final_time_), ceed_r_);
    } else {
      operators_.body_force(vector_at(force.times, force.vectors, force.ramp, step.t), ceed_r_);
    }
  }
  if (tractions_.empty()) return;
  PetscScalar *array;
  petsc_check(VecGetArray(local_load_, &array));
  tractions_.add(step.t, {array, static_cast<std::size_t>(mesh_.local_size)});
  petsc_check(VecRestoreArray(local_load_, &array));
}

void StaticSolver::to_local(Vec u, Vec local) const {
  petsc_check(VecCopy(boundary_values_, local));
  petsc_check(DMGlobalToLocal(mesh_.dm, u, INSERT_VALUES, local));
}

void StaticSolver::local_residual(Vec u) {
  to_local(u, local_u_);
  {
    Lend in(local_u_, ceed_u_, Access::read), out(local_r_, ceed_r_, Access::write);
    const OperatorScope scope(OperatorWork::residual);
    ceed_check(CeedOperatorApply(operators_.residual(), ceed_u_, ceed_r_, CEED_REQUEST_IMMEDIATE));
  }
  petsc_check(VecAXPY(local_r_, -1., local_load_));
}

bool StaticSolver::residual(Vec u, Vec f) {
  local_residual(u);
  petsc_check(VecZeroEntries(f));
  petsc_check(DMLocalToGlobal(mesh_.dm, local_r_, ADD_VALUES, f));
  inactive_.copy(u, f);  // no material: the row says that the increment is zero
  return finite_everywhere(f);
}

void StaticSolver::jacobian(Vec u) {
  to_local(u, local_u_);
  {
    Lend in(local_u_, ceed_u_, Access::read);
    operators_.linearize(ceed_u_);
  }
  PetscReal norm;
  petsc_check(SNESGetFunctionNorm(snes_, &norm));
  if (damping_ > 0 && !first_jacobian_) {
    damping_ = norm > last_norm_ ? std::min(4 * damping_, 1.) : damping_ / (norm < 0.5 * last_norm_ ? 5 : 2);
    if (damping_ < 1e-9) damping_ = 0;
  }
  last_norm_ = norm;
  first_jacobian_ = false;
  jacobian_->update(damping_);
}

void StaticSolver::shorten_step(Vec u, Vec y, PetscBool *changed) {
  // SNES goes to u − y. Its line searches give up at NaN, so they must not meet one.
  *changed = PETSC_FALSE;
  for (int halvings = 0; halvings < 30; ++halvings) {
    petsc_check(VecWAXPY(trial_, -1., y, u));
    local_residual(trial_);
    PetscReal norm;
    petsc_check(VecNorm(local_r_, NORM_2, &norm));
    int finite = std::isfinite(norm), all_finite = 0;
    MPI_Allreduce(&finite, &all_finite, 1, MPI_INT, MPI_MIN, mesh_.comm);
    if (all_finite) return;
    petsc_check(VecScale(y, 0.5));
    *changed = PETSC_TRUE;
  }
}

void StaticSolver::load(const Step &step) {
  PetscScalar *values;
  petsc_check(VecGetArray(boundary_values_, &values));
  boundary_.insert(step.t, step.t_from, step.increment ? 1. : 0.,
                   std::span<double>(values, static_cast<std::size_t>(mesh_.local_size)));
  petsc_check(VecRestoreArray(boundary_values_, &values));
  external_force(step);
}

void StaticSolver::set_time(double t) {
  load({.t_from = t, .t = t});
}

SolveResult StaticSolver::solve(const Step &step, Vec u) {
  load(step);
  SolveResult result;
  if (!residual(u, residual_)) {
    result.inverted = true;
    result.reason = "inverted element (det F <= 0) at the start of the step";
    return result;
  }
  if (!keep_tolerance_) {
    // A step whose first residual is rounding noise is in equilibrium already.
    PetscReal first;
    petsc_check(VecNorm(residual_, NORM_2, &first));
    scale_ = std::max(scale_, static_cast<double>(first));
    PetscReal rtol, stol;
    PetscInt max_it, max_f;
    petsc_check(SNESGetTolerances(snes_, nullptr, &rtol, &stol, &max_it, &max_f));
    petsc_check(SNESSetTolerances(snes_, std::max(1e-10 * scale_, 1e-50), rtol, stol, max_it, max_f));
  }
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  petsc_check(VecCopy(u, guess_));
  for (const Attempt &attempt : attempts_) {
    // Each attempt starts from the caller's guess.
    if (reason != SNES_CONVERGED_ITERATING) petsc_check(VecCopy(guess_, u));
    damping_ = attempt.damping;
    first_jacobian_ = true;
    PetscReal atol, rtol, stol;
    PetscInt max_f;
    petsc_check(SNESGetTolerances(snes_, &atol, &rtol, &stol, nullptr, &max_f));
    petsc_check(SNESSetTolerances(snes_, atol, rtol, stol, attempt.max_iterations, max_f));
    PetscInt newton, linear;
    petsc_check(SNESSolve(snes_, nullptr, u));
    petsc_check(SNESGetConvergedReason(snes_, &reason));
    petsc_check(SNESGetIterationNumber(snes_, &newton));
    petsc_check(SNESGetLinearSolveIterations(snes_, &linear));
    result.newton_iterations += newton;
    result.linear_iterations += linear;
    if (reason > 0) break;
  }
  result.converged = reason > 0;
  result.reason = SNESConvergedReasons[reason];
  if (reason == SNES_DIVERGED_LINEAR_SOLVE) {
    KSP ksp;
    KSPConvergedReason linear;
    petsc_check(SNESGetKSP(snes_, &ksp));
    petsc_check(KSPGetConvergedReason(ksp, &linear));
    result.reason += std::string(", the linear solver ended with ") + KSPConvergedReasons[linear];
    if (linear == KSP_DIVERGED_INDEFINITE_MAT) result.reason += " (-ksp_type minres solves with indefinite Jacobians)";
  }
  if (reason == SNES_DIVERGED_FUNCTION_DOMAIN || reason == SNES_DIVERGED_FNORM_NAN) {
    result.inverted = true;
    result.reason = "inverted element (det F <= 0) on every trial step of Newton";
  }
  return result;
}

std::vector<std::array<double, 3>> StaticSolver::reactions(Vec u) {
  local_residual(u);
  std::vector<std::array<double, 3>> forces(boundary_.faces().size());
  const PetscScalar *r;
  petsc_check(VecGetArrayRead(local_r_, &r));
  for (const auto &[index, face] : boundary_.entries()) forces[face][index % 3] += r[index];
  petsc_check(VecRestoreArrayRead(local_r_, &r));
  if (!forces.empty()) {
    MPI_Allreduce(MPI_IN_PLACE, forces.data(), static_cast<int>(3 * forces.size()), MPI_DOUBLE, MPI_SUM, mesh_.comm);
  }
  return forces;
}

}  // namespace hg
