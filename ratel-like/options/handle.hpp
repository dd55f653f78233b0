/// @file
/// Ownership of PETSc and CEED objects: each handle destroys what it holds and converts to the plain C handle.
#pragma once

#include <ceed.h>
#include <petscdm.h>
#include <petscsection.h>
#include <petscsf.h>
#include <petscsnes.h>
#include <petscts.h>

#include <utility>

namespace hg {

/// Owns one counted reference of a C object of type T, given back with Destroy(&object).
template <class T, auto Destroy>
class Handle {
 public:
  Handle() = default;
  /// Takes over the caller's reference.
  explicit Handle(T object) : object_(object) {}
  ~Handle() { reset(); }
  Handle(Handle &&other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle &operator=(Handle &&other) noexcept {
    if (this != &other) {
      reset();
      object_ = std::exchange(other.object_, nullptr);
    }
    return *this;
  }
  operator T() const { return object_; }
  T get() const { return object_; }
  /// Gives up what is held and hands out the place where a Create function writes: `VecDuplicate(x, y.put())`.
  T *put() {
    reset();
    return &object_;
  }
  void reset() {
    if (object_) (void)Destroy(&object_);
    object_ = nullptr;
  }
  /// Gives the reference to the caller.
  T release() { return std::exchange(object_, nullptr); }

 private:
  T object_ = nullptr;
};

using DmHandle = Handle<DM, DMDestroy>;
using VecHandle = Handle<Vec, VecDestroy>;
using MatHandle = Handle<Mat, MatDestroy>;
using SnesHandle = Handle<SNES, SNESDestroy>;
using TsHandle = Handle<TS, TSDestroy>;
using SectionHandle = Handle<PetscSection, PetscSectionDestroy>;
using SfHandle = Handle<PetscSF, PetscSFDestroy>;
using ViewerHandle = Handle<PetscViewer, PetscViewerDestroy>;

using CeedHandle = Handle<Ceed, CeedDestroy>;
using CeedVectorHandle = Handle<CeedVector, CeedVectorDestroy>;
using CeedElemRestrictionHandle = Handle<CeedElemRestriction, CeedElemRestrictionDestroy>;
using CeedBasisHandle = Handle<CeedBasis, CeedBasisDestroy>;
using CeedQFunctionHandle = Handle<CeedQFunction, CeedQFunctionDestroy>;
using CeedQFunctionContextHandle = Handle<CeedQFunctionContext, CeedQFunctionContextDestroy>;
using CeedOperatorHandle = Handle<CeedOperator, CeedOperatorDestroy>;

}  // namespace hg
