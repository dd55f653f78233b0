#include "plex_solver.hpp"

#include <petsctime.h>

#include <exception>

namespace hg::bps {

namespace {

/// Lends the array of a PETSc vector, wherever it lies, to a vector of the C interface.
class Lent {
 public:
  Lent(Ceed ceed, Vec from, CeedVector to, bool write) : from_(from), to_(to), write_(write) {
    PetscMemType where = PETSC_MEMTYPE_HOST;
    ok(write ? VecGetArrayAndMemType(from, &array_, &where)
             : VecGetArrayReadAndMemType(from, const_cast<const PetscScalar **>(&array_), &where));
    where_ = PetscMemTypeHost(where) ? CEED_MEM_HOST : CEED_MEM_DEVICE;
    check(ceed, CeedVectorSetArray(to, where_, CEED_USE_POINTER, array_));
  }
  Lent(const Lent &) = delete;
  Lent &operator=(const Lent &) = delete;
  ~Lent() {
    CeedVectorTakeArray(to_, where_, nullptr);
    if (write_) {
      VecRestoreArrayAndMemType(from_, &array_);
    } else {
      VecRestoreArrayReadAndMemType(from_, const_cast<const PetscScalar **>(&array_));
    }
  }

 private:
  Vec from_;
  CeedVector to_;
  bool write_;
  PetscScalar *array_ = nullptr;
  CeedMemType where_ = CEED_MEM_HOST;
};

/// Runs f; no exception may pass through PETSc's C code.
template <class F>
PetscErrorCode shielded(Mat A, F f) {
  PetscFunctionBegin;
  try {
    PlexOperator *self = nullptr;
    PetscCall(MatShellGetContext(A, &self));
    f(*self);
  } catch (const std::exception &error) {
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_LIB, "%s", error.what());
  }
  PetscFunctionReturn(0);
}

PetscErrorCode multiply(Mat A, Vec x, Vec y) {
  return shielded(A, [&](PlexOperator &self) { self.apply(x, y); });
}

PetscErrorCode get_diagonal(Mat A, Vec d) {
  return shielded(A, [&](PlexOperator &self) { self.diagonal(d); });
}

}  // namespace

PlexOperator::PlexOperator(Ceed ceed, const PlexMesh &mesh, const Bakeoff &bakeoff)
    : ceed_(ceed), dm_(mesh.dm()), bakeoff_(bakeoff) {
  ok(DMCreateLocalVector(dm_, x_local_.out()));
  ok(VecDuplicate(x_local_, y_local_.out()));
  ok(VecZeroEntries(x_local_));  // the entries on the boundary are never written again
  check(ceed_, CeedVectorCreate(ceed_, bakeoff.num_dofs(), x_.out()));
  check(ceed_, CeedVectorCreate(ceed_, bakeoff.num_dofs(), y_.out()));
}

Matrix PlexOperator::matrix() {
  PetscVector layout;
  PetscInt local = 0, global = 0;
  ok(DMCreateGlobalVector(dm_, layout.out()));
  ok(VecGetLocalSize(layout, &local));
  ok(VecGetSize(layout, &global));
  Matrix A;
  ok(MatCreateShell(PetscObjectComm(reinterpret_cast<PetscObject>(dm_)), local, local, global, global, this, A.out()));
  ok(MatShellSetOperation(A, MATOP_MULT, reinterpret_cast<void (*)(void)>(multiply)));
  ok(MatShellSetOperation(A, MATOP_GET_DIAGONAL, reinterpret_cast<void (*)(void)>(get_diagonal)));
  ok(MatSetOption(A, MAT_SPD, PETSC_TRUE));
  return A;
}

void PlexOperator::apply(Vec x, Vec y) {
  ok(DMGlobalToLocal(dm_, x, INSERT_VALUES, x_local_));
  {
    const Lent in(ceed_, x_local_, x_, false), out(ceed_, y_local_, y_, true);
    bakeoff_.apply(x_, y_);
  }
  ok(VecZeroEntries(y));
  ok(DMLocalToGlobal(dm_, y_local_, ADD_VALUES, y));
}

void PlexOperator::diagonal(Vec d) {
  {
    const Lent out(ceed_, y_local_, y_, true);
    bakeoff_.diagonal(y_);
  }
  ok(VecZeroEntries(d));
  ok(DMLocalToGlobal(dm_, y_local_, ADD_VALUES, d));
}

void PlexOperator::assemble(CeedVector local, Vec global) {
  {
    const Lent out(ceed_, y_local_, y_, true);
    check(ceed_, CeedVectorCopy(local, y_));
  }
  ok(VecZeroEntries(global));
  ok(DMLocalToGlobal(dm_, y_local_, ADD_VALUES, global));
}

ErrorSums PlexOperator::error(Vec x) {
  ok(DMGlobalToLocal(dm_, x, INSERT_VALUES, x_local_));
  ErrorSums sums;
  {
    const Lent in(ceed_, x_local_, x_, false);
    sums = bakeoff_.error(x_);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.terms.data(), static_cast<int>(sums.terms.size()), MPI_DOUBLE, MPI_SUM,
                PetscObjectComm(reinterpret_cast<PetscObject>(dm_)));
  return sums;
}

KspResult solve(Mat A, Vec b, Vec x) {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(A));
  Solver ksp;
  PC pc = nullptr;
  ok(KSPCreate(comm, ksp.out()));
  ok(KSPSetOperators(ksp, A, A));
  ok(KSPSetType(ksp, KSPCG));
  ok(KSPSetNormType(ksp, KSP_NORM_NATURAL));
  ok(KSPSetTolerances(ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 20));
  ok(KSPGetPC(ksp, &pc));
  ok(PCSetType(pc, PCNONE));
  ok(KSPSetFromOptions(ksp));

  PetscReal rtol = 0, atol = 0, divtol = 0;
  PetscInt max_iterations = 0;
  ok(KSPGetTolerances(ksp, &rtol, &atol, &divtol, &max_iterations));
  ok(KSPSetTolerances(ksp, rtol, atol, divtol, 1));
  ok(KSPSolve(ksp, b, x));
  ok(KSPSetTolerances(ksp, rtol, atol, divtol, max_iterations));

  KspResult result;
  ok(VecZeroEntries(x));
  MPI_Barrier(comm);
  const double start = MPI_Wtime();
  ok(KSPSolve(ksp, b, x));
  result.seconds = MPI_Wtime() - start;
  MPI_Allreduce(MPI_IN_PLACE, &result.seconds, 1, MPI_DOUBLE, MPI_MAX, comm);
  ok(KSPGetIterationNumber(ksp, &result.iterations));
  ok(KSPGetConvergedReason(ksp, &result.reason));
  ok(KSPGetResidualNorm(ksp, &result.residual));
  return result;
}

}  // namespace hg::bps
