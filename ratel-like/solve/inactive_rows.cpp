#include "solve/inactive_rows.hpp"
#include "options/error.hpp"

namespace hg {

void InactiveRows::set(const std::vector<PetscInt> &rows, Vec like) {
  if (!inactive_) {
    for (VecHandle *vec : {&inactive_, &active_, &work_}) petsc_check(VecDuplicate(like, vec->put()));
  }
  PetscScalar *array;
  petsc_check(VecZeroEntries(inactive_));
  petsc_check(VecGetArray(inactive_, &array));
  for (const PetscInt row : rows) array[row] = 1;
  petsc_check(VecRestoreArray(inactive_, &array));
  petsc_check(VecSet(active_, 1.));
  petsc_check(VecAXPY(active_, -1., inactive_));
  const int mine = rows.empty() ? 0 : 1;
  int most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, PetscObjectComm(reinterpret_cast<PetscObject>(like)));
  has_any_ = most > 0;
}

void InactiveRows::copy(Vec from, Vec to) const {
  if (!has_any_) return;
  petsc_check(VecPointwiseMult(work_, inactive_, from));
  petsc_check(VecPointwiseMult(to, active_, to));
  petsc_check(VecAXPY(to, 1., work_));
}

void InactiveRows::set_to_one(Vec to) const {
  if (!has_any_) return;
  petsc_check(VecPointwiseMult(to, active_, to));
  petsc_check(VecAXPY(to, 1., inactive_));
}

}  // namespace hg
