#include "mesh/lend.hpp"

#include "options/error.hpp"

namespace hg {

namespace {

CeedMemType ceed_type_of(PetscMemType type) {
  return PetscMemTypeDevice(type) ? CEED_MEM_DEVICE : CEED_MEM_HOST;
}

}  // namespace

CeedMemType memory_of(Vec vec) {
  PetscScalar *array = nullptr;
  PetscMemType type;
  petsc_check(VecGetArrayWriteAndMemType(vec, &array, &type));
  petsc_check(VecRestoreArrayWriteAndMemType(vec, &array));
  return ceed_type_of(type);
}

Lend::Lend(Vec from, CeedVector to, Access access) : vec_(from), ceed_vec_(to), access_(access) {
  PetscScalar *array = nullptr;
  switch (access) {
    case Access::read: {
      const PetscScalar *read_only = nullptr;
      petsc_check(VecGetArrayReadAndMemType(from, &read_only, &petsc_type_));
      array = const_cast<PetscScalar *>(read_only);  // CEED has no read-only loan; the caller promises not to write
      break;
    }
    case Access::write:
      petsc_check(VecGetArrayWriteAndMemType(from, &array, &petsc_type_));
      break;
    case Access::read_write:
      petsc_check(VecGetArrayAndMemType(from, &array, &petsc_type_));
      break;
  }
  ceed_type_ = ceed_type_of(petsc_type_);
  ceed_check(CeedVectorSetArray(to, ceed_type_, CEED_USE_POINTER, array));
}

Lend::~Lend() {
  CeedScalar *array = nullptr;
  (void)CeedVectorTakeArray(ceed_vec_, ceed_type_, &array);
  switch (access_) {
    case Access::read: {
      const PetscScalar *read_only = array;
      (void)VecRestoreArrayReadAndMemType(vec_, &read_only);
      break;
    }
    case Access::write:
      (void)VecRestoreArrayWriteAndMemType(vec_, &array);
      break;
    case Access::read_write:
      (void)VecRestoreArrayAndMemType(vec_, &array);
      break;
  }
}

}  // namespace hg
