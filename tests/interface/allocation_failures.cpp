#include "allocation_failures.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

// The thread sanitizer, and clang's address sanitizer, which is a part of the program, allocate before a malloc() of the
// program's own could pass on to them: there operator new fails alone.
#if defined(__SANITIZE_THREAD__)
#define HG_TEST_KEEPS_MALLOC
#elif defined(__clang__) && defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HG_TEST_KEEPS_MALLOC
#endif
#endif

// Of the sanitizer's library where there is one, else of the C library.
extern "C" {
[[gnu::weak]] void *__interceptor_malloc(std::size_t size);
[[gnu::weak]] void *__interceptor_calloc(std::size_t count, std::size_t size);
[[gnu::weak]] void *__interceptor_realloc(void *block, std::size_t size);
[[gnu::weak]] void *__interceptor_aligned_alloc(std::size_t alignment, std::size_t size);
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t count, std::size_t size);
void *__libc_realloc(void *block, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

/// Plain numbers: a constructor could itself allocate.
thread_local long until_failure = 0;  ///< 0: none fails
thread_local bool all_fail = false;
thread_local long num_failed = 0;

/// Counts an allocation; whether it is to fail.
bool fails() {
  if (until_failure == 0) return false;
  if (until_failure > 1) {
    until_failure--;
    return false;
  }
  if (!all_fail) until_failure = 0;
  num_failed++;
  errno = ENOMEM;
  return true;
}

void *allocate(std::size_t size, std::size_t alignment) {
#ifdef HG_TEST_KEEPS_MALLOC
  if (fails()) return nullptr;
#endif
  if (alignment <= alignof(std::max_align_t)) return std::malloc(size);
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void *allocate_or_throw(std::size_t size, std::size_t alignment) {
  void *block = allocate(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

constexpr std::size_t usual = alignof(std::max_align_t);

}  // namespace

#ifndef HG_TEST_KEEPS_MALLOC
extern "C" {

void *malloc(std::size_t size) {
  if (fails()) return nullptr;
  return __interceptor_malloc != nullptr ? __interceptor_malloc(size) : __libc_malloc(size);
}

void *calloc(std::size_t count, std::size_t size) {
  if (fails()) return nullptr;
  return __interceptor_calloc != nullptr ? __interceptor_calloc(count, size) : __libc_calloc(count, size);
}

void *realloc(void *block, std::size_t size) {
  if (fails()) return nullptr;
  return __interceptor_realloc != nullptr ? __interceptor_realloc(block, size) : __libc_realloc(block, size);
}

void *aligned_alloc(std::size_t alignment, std::size_t size) {
  if (fails()) return nullptr;
  return __interceptor_aligned_alloc != nullptr ? __interceptor_aligned_alloc(alignment, size)
                                                : __libc_memalign(alignment, size);
}
}
#endif

void *operator new(std::size_t size) {
  return allocate_or_throw(size, usual);
}
void *operator new[](std::size_t size) {
  return allocate_or_throw(size, usual);
}
void *operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void *operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void *operator new(std::size_t size, const std::nothrow_t &) noexcept {
  return allocate(size, usual);
}
void *operator new[](std::size_t size, const std::nothrow_t &) noexcept {
  return allocate(size, usual);
}
void operator delete(void *block) noexcept {
  std::free(block);
}
void operator delete[](void *block) noexcept {
  std::free(block);
}
void operator delete(void *block, std::size_t) noexcept {
  std::free(block);
}
void operator delete[](void *block, std::size_t) noexcept {
  std::free(block);
}
void operator delete(void *block, std::align_val_t) noexcept {
  std::free(block);
}
void operator delete[](void *block, std::align_val_t) noexcept {
  std::free(block);
}
void operator delete(void *block, std::size_t, std::align_val_t) noexcept {
  std::free(block);
}
void operator delete[](void *block, std::size_t, std::align_val_t) noexcept {
  std::free(block);
}
void operator delete(void *block, const std::nothrow_t &) noexcept {
  std::free(block);
}
void operator delete[](void *block, const std::nothrow_t &) noexcept {
  std::free(block);
}

namespace hg::test {

FailingAllocations::FailingAllocations(long first, bool all) {
  ::num_failed = 0;
  all_fail = all;
  until_failure = first;
}

FailingAllocations::~FailingAllocations() {
  until_failure = 0;
}

long FailingAllocations::num_failed() const {
  return ::num_failed;
}

}  // namespace hg::test
