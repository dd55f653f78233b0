/// @file
/// What the Fortran stubs share: objects known by integers, texts with hidden lengths, arrays with offsets.
///
/// Every stub is a procedure with the name of the C function in lower case and an underscore, the same arguments by
/// reference, and an error code after them; lengths of texts follow all others, as gfortran passes them. Arrays that come
/// out are given as an offset: entry i is a(offset + i) for the array a that the caller has passed.
#pragma once

#include <ceed/backend.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "error.hpp"

namespace hg::fortran {

/// The values of ceed/fortran.h that stand for no object of the caller's.
enum Special : int {
  request_immediate = -1,
  request_ordered = -2,
  null = -3,
  strides_backend = -4,
  vector_active = -5,
  vector_none = -6,
  restriction_none = -7,
  basis_none = -8,
  qfunction_none = -9,
};

/// Length of a text, after all other arguments.
using Length = std::size_t;

/// The text without trailing blanks, or up to a null character.
inline std::string text_of(const char *characters, Length length) {
  std::string_view view(characters, length);
  view = view.substr(0, view.find('\0'));
  return std::string(view.substr(0, view.find_last_not_of(' ') + 1));
}

/// Objects of one kind that Fortran has made. Numbers are not used again.
template <typename T>
class Handles {
 public:
  explicit Handles(const char *kind) : kind_(kind) {}

  int add(T object) {
    const std::lock_guard lock(mutex_);
    objects_.emplace(next_, object);
    return next_++;
  }
  T at(int handle) const {
    const std::lock_guard lock(mutex_);
    const auto found = objects_.find(handle);
    require(found != objects_.end(), CEED_ERROR_MINOR,
            [&] { return text("%d is not the number of a %s; expected one that is not destroyed", handle, kind_); });
    return found->second;
  }
  void erase(int handle) {
    const std::lock_guard lock(mutex_);
    objects_.erase(handle);
  }

 private:
  const char *kind_;
  mutable std::mutex mutex_;
  std::map<int, T> objects_;
  int next_ = 0;
};

Handles<Ceed> &ceeds();
Handles<CeedVector> &vectors();
Handles<CeedElemRestriction> &restrictions();
Handles<CeedBasis> &bases();
Handles<CeedQFunction> &qfunctions();
Handles<CeedQFunctionContext> &contexts();
Handles<CeedOperator> &operators();

/// The objects of numbers, special ones too.
inline Ceed ceed_at(const int *handle) { return ceeds().at(*handle); }
CeedVector vector_at(const int *handle);
CeedElemRestriction restriction_at(const int *handle);
CeedBasis basis_at(const int *handle);
CeedQFunction qfunction_at(const int *handle);
inline CeedQFunctionContext context_at(const int *handle) { return contexts().at(*handle); }
inline CeedOperator operator_at(const int *handle) { return operators().at(*handle); }

/// Runs a stub: *err is what `f` returns; what it throws is reported.
template <typename F>
void run(int *err, F &&f, const char *function = __builtin_FUNCTION()) {
  int code = CEED_ERROR_SUCCESS;
  const int thrown = guard(nullptr, [&] { code = f(); }, function);
  *err = thrown != CEED_ERROR_SUCCESS ? thrown : code;
}

/// Runs a stub that makes an object: f(T *) does, and the number is stored.
template <typename T, typename F>
void make(Handles<T> &handles, int *handle, int *err, F &&f, const char *function = __builtin_FUNCTION()) {
  run(
      err,
      [&] {
        T object = nullptr;
        const int code = f(&object);
        if (code == CEED_ERROR_SUCCESS) *handle = handles.add(object);
        return code;
      },
      function);
}

/// Runs a stub that destroys an object; its number becomes ceed_null. As in C, destroying none is no error.
template <typename T>
void destroy(Handles<T> &handles, int *handle, int *err, int (*destroy_object)(T *),
             const char *function = __builtin_FUNCTION()) {
  run(
      err,
      [&] {
        if (*handle == null) return static_cast<int>(CEED_ERROR_SUCCESS);
        T object = handles.at(*handle);
        const int code = destroy_object(&object);
        if (code == CEED_ERROR_SUCCESS) {
          handles.erase(*handle);
          *handle = null;
        }
        return code;
      },
      function);
}

/// Entries from the caller's array to another one.
template <typename T>
std::int64_t offset_of(const T *array, const T *base) {
  return (reinterpret_cast<std::intptr_t>(array) - reinterpret_cast<std::intptr_t>(base)) /
         static_cast<std::intptr_t>(sizeof(T));
}

/// All work is complete when a function returns, so there is no request to keep.
CeedRequest *request_at(const int *request);

}  // namespace hg::fortran
