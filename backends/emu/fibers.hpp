/// @file
/// The threads of a block, on one thread of the host.
#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace hg::emu {

/// Functions that run in turn, each on a stack of its own, and wait for each other, or for those of their team: teams
/// are so many that follow each other.
class Fibers {
 public:
  Fibers();
  Fibers(const Fibers &) = delete;
  Fibers &operator=(const Fibers &) = delete;
  ~Fibers();

  /// What is asked and told while they run.
  struct Referee {
    std::function<std::vector<int>()> order;  ///< in which those that can go on do so, each time that some can
    std::function<void(int team)> team_met;   ///< all of a team wait for each other, and are about to go on
    std::function<void()> all_met;            ///< all wait for all
  };
  /// Calls body(t) for t = 0 ... count - 1. Throws what a body throws, and std::logic_error where some wait for others
  /// that wait elsewhere or have ended; those that have not ended stay where they are, and are forgotten.
  void run(int count, int team_size, const std::function<void(int)> &body, const Referee &referee);
  /// From within a body: goes on when all have come here.
  void wait();
  /// The same for its team.
  void wait_for_team();

 private:
  struct Turns;
  std::unique_ptr<Turns> turns_;
};

}  // namespace hg::emu
