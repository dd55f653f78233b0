#include "guarded_array.hpp"

#include <algorithm>
#include <cstring>

namespace hg::memcheck {

namespace {

constexpr std::uint64_t unset_bits = 0x7ff4dead00c0ffeeu;
static_assert(sizeof(CeedScalar) == sizeof unset_bits);

std::uint64_t bits_of(CeedScalar value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

void make_unset(CeedScalar *values, CeedSize length) {
  for (CeedSize i = 0; i < length; i++) std::memcpy(values + i, &unset_bits, sizeof unset_bits);
}

}  // namespace

CeedScalar unset_value() {
  CeedScalar value = 0;
  make_unset(&value, 1);
  return value;
}

bool is_unset(CeedScalar value) {
  return bits_of(value) == unset_bits;
}

GuardedArray::GuardedArray(const CeedScalar *values, CeedSize length)
    : values_(static_cast<std::size_t>(length + 2 * zone)) {
  make_unset(values_.data(), length + 2 * zone);
  if (values != nullptr && length > 0) std::memcpy(data(), values, static_cast<std::size_t>(length) * sizeof *values);
}

bool GuardedArray::is_sound() const {
  return std::all_of(values_.begin(), values_.begin() + zone, is_unset) &&
         std::all_of(values_.end() - zone, values_.end(), is_unset);
}

CeedSize GuardedArray::first_difference(const CeedScalar *values) const {
  for (CeedSize i = 0; i < length(); i++) {
    if (bits_of(data()[i]) != bits_of(values[i])) return i;
  }
  return -1;
}

CeedSize GuardedArray::first_unset() const {
  const auto found = std::find_if(data(), data() + length(), is_unset);
  return found == data() + length() ? -1 : found - data();
}

CeedSize GuardedArray::num_unset() const {
  return std::count_if(data(), data() + length(), is_unset);
}

void GuardedArray::copy_written(CeedScalar *values) const {
  for (CeedSize i = 0; i < length(); i++) {
    if (!is_unset(data()[i])) std::memcpy(values + i, data() + i, sizeof *values);
  }
}

void GuardedArray::retire() {
  make_unset(values_.data(), static_cast<CeedSize>(values_.size()));
}

CeedSize GuardedArray::first_set() const {
  const auto found = std::find_if_not(data(), data() + length(), is_unset);
  return found == data() + length() ? -1 : found - data();
}

}  // namespace hg::memcheck
