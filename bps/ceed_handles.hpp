/// @file
/// Owning handles of the C interface, and its error codes as exceptions.
#pragma once

#include <ceed.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace hg::bps {

/// Something that the person who runs the program can understand and mend.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An Error that every rank throws at the same place: one of them may speak for all, and the program may end in order.
class CollectiveError : public Error {
 public:
  using Error::Error;
};

/// Owns one object of a C interface that destroys it through its address; destroyed when it goes out of scope.
template <class Object, auto destroy>
class Handle {
 public:
  Handle() = default;
  Handle(const Handle &) = delete;
  Handle &operator=(const Handle &) = delete;
  Handle(Handle &&other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle &operator=(Handle &&other) noexcept {
    if (this != &other) {
      reset();
      object_ = std::exchange(other.object_, nullptr);
    }
    return *this;
  }
  ~Handle() { reset(); }

  /// Where a function of the interface writes a new object.
  Object *out() {
    reset();
    return &object_;
  }
  /// Where a function of the interface finds an object, or none, that it may replace.
  Object *address() { return &object_; }
  operator Object() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  void reset() {
    if (object_) destroy(&object_);
    object_ = nullptr;
  }

  Object object_ = nullptr;
};

using Vector = Handle<CeedVector, CeedVectorDestroy>;
using Restriction = Handle<CeedElemRestriction, CeedElemRestrictionDestroy>;
using Basis = Handle<CeedBasis, CeedBasisDestroy>;
using QFunction = Handle<CeedQFunction, CeedQFunctionDestroy>;
using QFunctionContext = Handle<CeedQFunctionContext, CeedQFunctionContextDestroy>;
using Operator = Handle<CeedOperator, CeedOperatorDestroy>;
using Context = Handle<Ceed, CeedDestroy>;

/// Throws Error with the library's message if code is not success.
void check(Ceed ceed, int code);

/// The backend for this resource. Errors of the library become exceptions from here on.
/// Throws Error, with the resources that the library lists, if none can be used.
Context open_ceed(const std::string &resource);

/// Full name of the backend's resource.
std::string resource_name(Ceed ceed);

/// A vector with these values.
template <class Values>
Vector make_vector(Ceed ceed, const Values &values) {
  Vector vector;
  check(ceed, CeedVectorCreate(ceed, static_cast<CeedSize>(values.size()), vector.out()));
  check(ceed, CeedVectorSetArray(vector, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<CeedScalar *>(values.data())));
  return vector;
}

/// A vector of this length, all zero.
Vector make_vector(Ceed ceed, CeedSize length);

}  // namespace hg::bps
