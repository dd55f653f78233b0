/// @file
/// Memory for arrays on the host.
#pragma once

#include <ceed/backend.h>

#include <cstddef>
#include <cstdlib>
#include <memory>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace hg::host {

struct FreeArray {
  void operator()(CeedScalar *array) const noexcept { std::free(array); }
};
using Array = std::unique_ptr<CeedScalar[], FreeArray>;

/// An array without values; empty where there is no memory. Aligned to CEED_ALIGN; where it is large, to huge pages, of
/// which the system is asked for some: geometry at the points streams through memory, and finding small pages then
/// costs 10 to 15 % of an application.
inline Array allocate_array(std::size_t length) noexcept {
  constexpr std::size_t huge_page = std::size_t{1} << 21;
  if (length > (static_cast<std::size_t>(-1) - huge_page) / sizeof(CeedScalar)) return nullptr;
  const bool is_large = length >= 2 * huge_page / sizeof(CeedScalar);
  const std::size_t alignment = is_large ? huge_page : CEED_ALIGN;
  const std::size_t bytes = (length * sizeof(CeedScalar) / alignment + 1) * alignment;
  Array array(static_cast<CeedScalar *>(std::aligned_alloc(alignment, bytes)));
#if defined(__linux__)
  if (array && is_large) madvise(array.get(), bytes, MADV_HUGEPAGE);  // advice: it may be refused
#endif
  return array;
}

}  // namespace hg::host
