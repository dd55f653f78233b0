/// @file
/// What all counted objects share, and the smart pointer that counts.
#pragma once

#include <atomic>
#include <mutex>
#include <utility>

#include "error.hpp"

/// Base of every handle. Handles are cast to CeedObject, so this is the first base of each object.
struct CeedObject_private {
  CeedObject_private() = default;
  CeedObject_private(const CeedObject_private &) = delete;
  CeedObject_private &operator=(const CeedObject_private &) = delete;
  virtual ~CeedObject_private() = default;

  /// Throws (CEED_ERROR_ACCESS) if the object may not be destroyed now; asked before the last reference goes.
  virtual void check_destroyable() const {}
  virtual void view(FILE *stream) const = 0;
  /// The Ceed the object belongs to; a Ceed belongs to itself. NULL for the sentinels such as CEED_VECTOR_ACTIVE.
  virtual Ceed owner() const = 0;

  std::atomic<int> ref_count{1};
  bool is_sentinel = false;  ///< the constants such as CEED_VECTOR_ACTIVE: never counted, never destroyed
  bool is_known_to_backend = false;  ///< the backend's create has succeeded, so its destroy is due
  std::mutex access;  ///< of counts of readers and writers: threads may read one object at once
  CeedInt num_view_tabs = 0;
};

namespace hg {

inline void reference(CeedObject_private *object) noexcept {
  if (object != nullptr && !object->is_sentinel) object->ref_count.fetch_add(1, std::memory_order_relaxed);
}

/// Drops one reference; deletes the object with the last one. Throws as check_destroyable() does, then the reference
/// stays.
void dereference(CeedObject_private *object);

/// Handle -> object, with an error that names `what` where it is NULL.
template <typename T>
T &deref(T *object, const char *what, Where where = Where::current()) {
  require(object != nullptr, CEED_ERROR_INCOMPLETE, [&] { return text("%s is NULL; expected a live object", what); },
          where);
  return *object;
}

/// A counted reference held by another object.
template <typename T>
class Ref {
 public:
  Ref() = default;
  explicit Ref(T *object) : object_(object) { reference(object_); }
  Ref(const Ref &other) : object_(other.object_) { reference(object_); }
  Ref(Ref &&other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Ref &operator=(Ref other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Ref() {
    if (object_ == nullptr) return;
    // An object that may not be destroyed (an array still lent out) outlives its last holder: leaking it is the safe
    // end, and the handler is told.
    T *object = object_;
    guard(object->owner(), [&] { dereference(object); });
  }
  T *get() const noexcept { return object_; }
  T *operator->() const noexcept { return object_; }
  T &operator*() const noexcept { return *object_; }
  explicit operator bool() const noexcept { return object_ != nullptr; }
  /// Takes over a reference that the caller already holds.
  static Ref adopt(T *object) noexcept {
    Ref ref;
    ref.object_ = object;
    return ref;
  }
  /// Hands the reference out.
  T *release() noexcept { return std::exchange(object_, nullptr); }

 private:
  T *object_ = nullptr;
};

/// Bodies of what all handles can do, for the entry point `function`.
int view_object(const CeedObject_private *object, FILE *stream, const char *function = __builtin_FUNCTION());
int set_view_tabs(CeedObject_private *object, CeedInt num_tabs, const char *function = __builtin_FUNCTION());
int get_view_tabs(const CeedObject_private *object, CeedInt *num_tabs, const char *function = __builtin_FUNCTION());
int get_ceed(const CeedObject_private *object, Ceed *ceed, const char *function = __builtin_FUNCTION());

/// A counted reference of an object that may be NULL for the caller; throws if the argument `name` is NULL.
template <typename T>
void hand_out(T *object, T **handle, const char *name, Where where = Where::current()) {
  result(handle, name, where) = object;
  reference(object);
}

/// Body of every Ceed*ReferenceCopy: *copy becomes another counted reference to `object`; what it held is dropped.
/// *copy must be NULL or a live handle.
template <typename T>
void reference_copy(T *object, T **copy) {
  deref(object, "handle to copy");
  require_argument(copy, "a place for the copy of the handle");
  Ref<T> held(object);
  if (*copy != nullptr) dereference(*copy);  // refused where it is lent out: then *copy stays
  *copy = held.release();
}

/// Body of every Ceed*Destroy.
template <typename T>
void destroy(T **object) {
  if (object == nullptr || *object == nullptr) return;
  if (!(*object)->is_sentinel) dereference(*object);
  *object = nullptr;
}

/// The Ceed of an object for guard(), or NULL.
inline Ceed ceed_of(const CeedObject_private *object) noexcept { return object != nullptr ? object->owner() : nullptr; }

}  // namespace hg
