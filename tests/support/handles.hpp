/// @file
/// Handles that destroy themselves, so that a test that stops half way leaks nothing.
#pragma once

#include <ceed/backend.h>

#include <utility>

namespace hg::test {

/// Owns one reference. Converts to the C handle; out() is for the functions that create one.
template <typename T, int (*Destroy)(T *)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T object) : object_(object) {}
  Handle(const Handle &) = delete;
  Handle(Handle &&other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle &operator=(Handle other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() { reset(); }
  operator T() const noexcept { return object_; }
  T get() const noexcept { return object_; }
  T *out() {
    reset();
    return &object_;
  }
  /// The place of the handle, with what it holds: for Destroy and ReferenceCopy.
  T *address() { return &object_; }
  void reset() {
    if (object_ != nullptr) Destroy(&object_);
    object_ = nullptr;
  }

 private:
  T object_ = nullptr;
};

using CeedHandle = Handle<Ceed, CeedDestroy>;
using Vector = Handle<CeedVector, CeedVectorDestroy>;
using Restriction = Handle<CeedElemRestriction, CeedElemRestrictionDestroy>;
using Basis = Handle<CeedBasis, CeedBasisDestroy>;
using QFunction = Handle<CeedQFunction, CeedQFunctionDestroy>;
using Context = Handle<CeedQFunctionContext, CeedQFunctionContextDestroy>;
using Operator = Handle<CeedOperator, CeedOperatorDestroy>;

}  // namespace hg::test
