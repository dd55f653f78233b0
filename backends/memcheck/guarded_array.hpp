/// @file
/// Copies of arrays between two red zones, in which what was never written can be told from what was.
#pragma once

#include <ceed/backend.h>

#include <cstdint>
#include <vector>

namespace hg::memcheck {

/// A copy of an array that is handed out in its place.
class GuardedArray {
 public:
  /// A copy of `length` values; of unset ones where `values` is NULL.
  GuardedArray(const CeedScalar *values, CeedSize length);

  CeedScalar *data() { return values_.data() + zone; }
  const CeedScalar *data() const { return values_.data() + zone; }
  CeedSize length() const { return static_cast<CeedSize>(values_.size()) - 2 * zone; }
  /// Whether nobody wrote beside the array.
  bool is_sound() const;
  /// The first entry that differs, bit by bit, from that of `values`, or -1.
  CeedSize first_difference(const CeedScalar *values) const;
  /// The first entry that was never written, or -1.
  CeedSize first_unset() const;
  CeedSize num_unset() const;
  /// Copies the entries that were written to `values`.
  void copy_written(CeedScalar *values) const;
  /// Makes all entries unset, as after the end of an access.
  void retire();
  /// The first entry that is not unset, or -1.
  CeedSize first_set() const;

 private:
  static constexpr CeedSize zone = 8;
  std::vector<CeedScalar> values_;
};

/// A signalling NaN: arithmetic makes another value of it, copies keep it.
CeedScalar unset_value();
bool is_unset(CeedScalar value);

}  // namespace hg::memcheck
