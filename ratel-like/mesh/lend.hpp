/// @file
/// Lending the array of a PETSc vector to a CEED vector, without a copy.
#pragma once

#include <ceed.h>
#include <petscvec.h>

namespace hg {

enum class Access { read, write, read_write };

/// Where PETSc has the values of vectors like this one. What they are may be lost.
CeedMemType memory_of(Vec vec);

/// For its lifetime, `to` uses the array of `from` (host or device memory, wherever PETSc has it).
/// Both must have the same length; `from` must not be touched meanwhile. Access::write leaves old values undefined.
class Lend {
 public:
  Lend(Vec from, CeedVector to, Access access);
  ~Lend();
  Lend(const Lend &) = delete;
  Lend &operator=(const Lend &) = delete;

 private:
  Vec vec_;
  CeedVector ceed_vec_;
  Access access_;
  PetscMemType petsc_type_;
  CeedMemType ceed_type_;
};

}  // namespace hg
