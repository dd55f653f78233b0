#include "vector.hpp"

#include <algorithm>
#include <new>

#include "../host/memory.hpp"

namespace hg::ref {

namespace {

/// The array of a vector: lent by the user, or owned. A lent array stays in use until it is taken back or replaced by
/// another.
struct HostArray {
  host::Array owned;
  CeedScalar *borrowed = nullptr;

  CeedScalar *current() const { return borrowed != nullptr ? borrowed : owned.get(); }
};

HostArray &array_of(CeedVector vec) {
  HostArray *array = nullptr;
  CeedVectorGetData(vec, &array);
  return *array;
}

CeedSize length_of(CeedVector vec) {
  CeedSize length = 0;
  CeedVectorGetLength(vec, &length);
  return length;
}

/// Makes sure that there is an array to write to.
int allocate(CeedVector vec) {
  HostArray &array = array_of(vec);
  if (array.current() != nullptr) return CEED_ERROR_SUCCESS;
  const CeedSize length = length_of(vec);
  array.owned = host::allocate_array(static_cast<std::size_t>(length));
  CeedCheck(array.owned, CeedVectorReturnCeed(vec), CEED_ERROR_BACKEND,
            "Out of memory: no room for a CeedVector of length %" CeedSize_FMT, length);
  return CEED_ERROR_SUCCESS;
}

int create(CeedVector vec) {
  auto *array = new (std::nothrow) HostArray;
  CeedCheck(array != nullptr, CeedVectorReturnCeed(vec), CEED_ERROR_BACKEND, "Out of memory");
  return CeedVectorSetData(vec, array);
}

int destroy(CeedVector vec) {
  HostArray *array = nullptr;
  CeedVectorGetData(vec, &array);
  delete array;
  return CEED_ERROR_SUCCESS;
}

int set_array(CeedVector vec, CeedMemType, CeedCopyMode copy_mode, CeedScalar *values) {
  HostArray &array = array_of(vec);
  switch (copy_mode) {
    case CEED_COPY_VALUES:
      CeedCallBackend(allocate(vec));
      if (values != array.current()) std::copy_n(values, length_of(vec), array.current());
      break;
    case CEED_OWN_POINTER:
      array.borrowed = nullptr;
      if (values != array.owned.get()) array.owned.reset(values);
      break;
    case CEED_USE_POINTER:
      array.borrowed = values;
      if (values == array.owned.get()) {
        (void)array.owned.release();
      } else {
        array.owned.reset();
      }
      break;
  }
  return CEED_ERROR_SUCCESS;
}

int take_array(CeedVector vec, CeedMemType, CeedScalar **values) {
  HostArray &array = array_of(vec);
  *values = array.borrowed;
  array.borrowed = nullptr;
  return CEED_ERROR_SUCCESS;
}

// A lent array is the only one there is, so it always holds the current values.
int sync_array(CeedVector, CeedMemType) {
  return CEED_ERROR_SUCCESS;
}

int get_array(CeedVector vec, CeedMemType, CeedScalar **values) {
  *values = array_of(vec).current();
  return CEED_ERROR_SUCCESS;
}

int get_array_read(CeedVector vec, CeedMemType, const CeedScalar **values) {
  *values = array_of(vec).current();
  return CEED_ERROR_SUCCESS;
}

int get_array_write(CeedVector vec, CeedMemType, CeedScalar **values) {
  CeedCallBackend(allocate(vec));
  *values = array_of(vec).current();
  return CEED_ERROR_SUCCESS;
}

int has_valid_array(CeedVector vec, bool *has_valid_array) {
  *has_valid_array = array_of(vec).current() != nullptr;
  return CEED_ERROR_SUCCESS;
}

int has_borrowed_array(CeedVector vec, CeedMemType, bool *has_borrowed_array) {
  *has_borrowed_array = array_of(vec).borrowed != nullptr;
  return CEED_ERROR_SUCCESS;
}

}  // namespace

void fill_vector_ops(CeedVectorOps &ops) {
  ops = {};
  ops.create = create;
  ops.destroy = destroy;
  ops.set_array = set_array;
  ops.take_array = take_array;
  ops.sync_array = sync_array;
  ops.get_array = get_array;
  ops.get_array_read = get_array_read;
  ops.get_array_write = get_array_write;
  ops.has_valid_array = has_valid_array;
  ops.has_borrowed_array = has_borrowed_array;
}

}  // namespace hg::ref
