/// @file
/// Allocations that fail on demand. A program that links this has its own malloc() and operator new, which pass on to
/// those of the C library, or of the address sanitizer.
#pragma once

namespace hg::test {

/// From the `first`-th allocation of this thread on (1: the next), one fails or all do, until this goes.
class FailingAllocations {
 public:
  FailingAllocations(long first, bool all);
  FailingAllocations(const FailingAllocations &) = delete;
  FailingAllocations &operator=(const FailingAllocations &) = delete;
  ~FailingAllocations();
  /// How many have failed.
  long num_failed() const;
};

}  // namespace hg::test
