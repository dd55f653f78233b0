/// Vectors: whoever asks for an array gets a copy of it, which is judged when it comes back.
#include <utility>

#include "state.hpp"

namespace hg::memcheck {

namespace {

using Access = VectorGuard::Access;

VectorGuard &guard_of(CeedVector vec) {
  return state_of(CeedVectorReturnCeed(vec)).guard_of(vec);
}

CeedSize length_of(CeedVector vec) {
  CeedSize length = 0;
  CeedVectorGetLength(vec, &length);
  return length;
}

/// Reports a write through the array of an access that is over.
int check_retired(CeedVector vec, VectorGuard &guard) {
  if (!guard.retired) return CEED_ERROR_SUCCESS;
  const CeedSize entry = guard.retired->first_set();
  const bool is_sound = guard.retired->is_sound();
  if (entry >= 0 || !is_sound) guard.retired.reset();  // told once
  CeedCheck(entry < 0, CeedVectorReturnCeed(vec), CEED_ERROR_BACKEND,
            "CeedVector array was written after it was restored: entry %" CeedSize_FMT " of %" CeedSize_FMT, entry,
            length_of(vec));
  CeedCheck(is_sound, CeedVectorReturnCeed(vec), CEED_ERROR_BACKEND,
            "CeedVector array of length %" CeedSize_FMT " was written outside of its bounds after it was restored",
            length_of(vec));
  return CEED_ERROR_SUCCESS;
}

/// Reports writes beside the array.
int check_bounds(CeedVector vec, const GuardedArray &array) {
  CeedCheck(array.is_sound(), CeedVectorReturnCeed(vec), CEED_ERROR_BACKEND,
            "CeedVector array was written outside of its bounds: before entry 0 or after entry %" CeedSize_FMT,
            array.length() - 1);
  return CEED_ERROR_SUCCESS;
}

/// Hands out a copy of `values`.
CeedScalar *begin(CeedVector vec, VectorGuard &guard, Access access, const CeedScalar *values) {
  guard.active = std::make_unique<GuardedArray>(values, length_of(vec));
  guard.access = access;
  guard.is_backends = InParent::is_now();
  guard.retired.reset();  // after the new one was made, so that its place is another
  return guard.active->data();
}

/// Takes the copy back: from now on it must stay as it is made here.
void end(VectorGuard &guard) {
  guard.active->retire();
  guard.retired = std::move(guard.active);
  guard.access = Access::none;
}

int create(CeedVector vec) {
  CeedCallBackend(parent().vector.create(vec));
  State &state = state_of(CeedVectorReturnCeed(vec));
  try {
    const std::lock_guard lock(state.mutex);
    state.vectors.try_emplace(vec);
  } catch (...) {
    parent().vector.destroy(vec);
    throw;
  }
  return CEED_ERROR_SUCCESS;
}

int get_array_read(CeedVector vec, CeedMemType mem_type, const CeedScalar **array) {
  VectorGuard &guard = guard_of(vec);
  if (guard.access != Access::read) {
    CeedCallBackend(check_retired(vec, guard));
    CeedCallBackend(parent().vector.get_array_read(vec, mem_type, &guard.read_from));
    begin(vec, guard, Access::read, guard.read_from);
  }
  *array = guard.active->data();
  return CEED_ERROR_SUCCESS;
}

/// The last reader is done.
int restore_array_read(CeedVector vec) {
  VectorGuard &guard = guard_of(vec);
  const GuardedArray &array = *guard.active;
  const CeedSize entry = array.first_difference(guard.read_from);
  const CeedScalar was = entry >= 0 ? guard.read_from[entry] : 0, is = entry >= 0 ? array.data()[entry] : 0;
  const int bounds = check_bounds(vec, array);
  end(guard);
  if (parent().vector.restore_array_read != nullptr) CeedCallBackend(parent().vector.restore_array_read(vec));
  CeedCallBackend(bounds);
  CeedCheck(entry < 0, CeedVectorReturnCeed(vec), CEED_ERROR_BACKEND,
            "CeedVector array data changed while accessed in read-only mode: entry %" CeedSize_FMT " of %" CeedSize_FMT
            " was %g and is %g",
            entry, length_of(vec), was, is);
  return CEED_ERROR_SUCCESS;
}

int get_array(CeedVector vec, CeedMemType mem_type, CeedScalar **array) {
  VectorGuard &guard = guard_of(vec);
  CeedCallBackend(check_retired(vec, guard));
  CeedCallBackend(parent().vector.get_array(vec, mem_type, &guard.write_to));
  *array = begin(vec, guard, Access::read_write, guard.write_to);
  return CEED_ERROR_SUCCESS;
}

int get_array_write(CeedVector vec, CeedMemType mem_type, CeedScalar **array) {
  VectorGuard &guard = guard_of(vec);
  CeedCallBackend(check_retired(vec, guard));
  bool has_values = false;
  CeedCallBackend(parent().vector.has_valid_array(vec, &has_values));
  CeedCallBackend(parent().vector.get_array_write(vec, mem_type, &guard.write_to));
  for (CeedSize i = 0; !has_values && i < length_of(vec); i++) guard.write_to[i] = unset_value();
  *array = begin(vec, guard, Access::write_only, nullptr);
  return CEED_ERROR_SUCCESS;
}

int restore_array(CeedVector vec) {
  VectorGuard &guard = guard_of(vec);
  const GuardedArray &array = *guard.active;
  // The parent may write a part of an array; what it does not write stays, and so it does where a caller forgot some.
  const bool must_be_whole = guard.access == Access::write_only && !guard.is_backends;
  const CeedSize first = must_be_whole ? array.first_unset() : -1, num_unset = must_be_whole ? array.num_unset() : 0;
  array.copy_written(guard.write_to);
  const int bounds = check_bounds(vec, array);
  end(guard);
  if (parent().vector.restore_array != nullptr) CeedCallBackend(parent().vector.restore_array(vec));
  CeedCallBackend(bounds);
  CeedCheck(first < 0, CeedVectorReturnCeed(vec), CEED_ERROR_BACKEND,
            "CeedVector array from CeedVectorGetArrayWrite() was restored with %" CeedSize_FMT " of %" CeedSize_FMT
            " entries unwritten, the first is entry %" CeedSize_FMT,
            num_unset, length_of(vec), first);
  return CEED_ERROR_SUCCESS;
}

int set_array(CeedVector vec, CeedMemType mem_type, CeedCopyMode copy_mode, CeedScalar *array) {
  CeedCallBackend(check_retired(vec, guard_of(vec)));
  return parent().vector.set_array(vec, mem_type, copy_mode, array);
}

int take_array(CeedVector vec, CeedMemType mem_type, CeedScalar **array) {
  CeedCallBackend(check_retired(vec, guard_of(vec)));
  return parent().vector.take_array(vec, mem_type, array);
}

int sync_array(CeedVector vec, CeedMemType mem_type) {
  CeedCallBackend(check_retired(vec, guard_of(vec)));
  return parent().vector.sync_array(vec, mem_type);
}

int destroy(CeedVector vec) {
  const int code = check_retired(vec, guard_of(vec));
  State &state = state_of(CeedVectorReturnCeed(vec));
  {
    const std::lock_guard lock(state.mutex);
    state.vectors.erase(vec);
  }
  CeedCallBackend(parent().vector.destroy(vec));
  return code;
}

}  // namespace

void fill_vector_ops(CeedVectorOps &ops) {
  ops.create = create;
  ops.destroy = destroy;
  ops.set_array = set_array;
  ops.take_array = take_array;
  ops.sync_array = sync_array;
  ops.get_array = get_array;
  ops.get_array_read = get_array_read;
  ops.get_array_write = get_array_write;
  ops.restore_array = restore_array;
  ops.restore_array_read = restore_array_read;
}

}  // namespace hg::memcheck
