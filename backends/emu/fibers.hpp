/// @file
/// The threads of a block, on one thread of the host.
#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace hg::emu {

/// Functions that run in turn, each on a stack of its own, and wait for each other.
class Fibers {
 public:
  Fibers();
  Fibers(const Fibers &) = delete;
  Fibers &operator=(const Fibers &) = delete;
  ~Fibers();

  /// Calls body(t) for t = 0 ... count - 1. Up to wait(), or to their end, they run in the order that `order` says,
  /// which is asked anew after each wait. Throws what a body throws, and std::logic_error where some wait and others
  /// have ended; those that have not ended stay where they are, and are forgotten.
  void run(int count, const std::function<void(int)> &body, const std::function<std::vector<int>()> &order);
  /// From within a body: goes on when all have come here.
  void wait();

 private:
  struct Turns;
  std::unique_ptr<Turns> turns_;
};

}  // namespace hg::emu
