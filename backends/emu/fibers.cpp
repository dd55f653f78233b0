// Hardened libraries take a jump from one stack to another for an attack.
#undef _FORTIFY_SOURCE
#define _FORTIFY_SOURCE 0

#include "fibers.hpp"

#include <setjmp.h>
#include <ucontext.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HG_IS_SANITIZED
#endif
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace hg::emu {

namespace {

constexpr std::size_t stack_size = std::size_t{128} << 10;

/// Where a stack was left. The sanitizers are told of it, too: which stack it is, and what they keep of its frames.
struct Place {
  ucontext_t context;  ///< where it begins; with sanitizers, where it goes on, too
  jmp_buf left;        ///< where it goes on
  bool has_begun = false;
  const void *bottom = nullptr;
  std::size_t size = 0;
  void *frames = nullptr;
  void *sanitizer = nullptr;
};

/// Goes from one place to another, where arrived() comes next.
void leave(Place &from, Place &to, [[maybe_unused]] bool for_good) {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_start_switch_fiber(for_good ? nullptr : &from.frames, to.bottom, to.size);
#endif
#if defined(__SANITIZE_THREAD__)
  __tsan_switch_to_fiber(to.sanitizer, 0);
#endif
#if defined(HG_IS_SANITIZED)
  ::swapcontext(&from.context, &to.context);
#else
  // swapcontext() asks the system for the signals of each place, which takes longer than all else here.
  from.has_begun = true;
  if (::_setjmp(from.left) != 0) return;
  if (to.has_begun) ::_longjmp(to.left, 1);
  to.has_begun = true;
  ::setcontext(&to.context);
#endif
}

/// To be called where a stack begins or goes on; `from`: it was left for this one.
void arrived([[maybe_unused]] Place &at, [[maybe_unused]] Place &from) {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(at.frames, &from.bottom, &from.size);
#endif
}

enum class State { can_go_on, waits_for_team, waits_for_all, ended };

struct Fiber {
  Place place;
  std::unique_ptr<std::byte[]> stack;
  State state = State::ended;
};

}  // namespace

struct Fibers::Turns {
  std::vector<Fiber> fibers;
  Place scheduler;
  const std::function<void(int)> *body = nullptr;
  int current = 0;
  std::exception_ptr thrown;

  ~Turns() {
#if defined(__SANITIZE_THREAD__)
    for (Fiber &fiber : fibers) __tsan_destroy_fiber(fiber.place.sanitizer);
#endif
  }

  void make(int count) {
    while (fibers.size() < static_cast<std::size_t>(count)) {
      Fiber &fiber = fibers.emplace_back();
      fiber.stack = std::make_unique<std::byte[]>(stack_size);
      fiber.place.bottom = fiber.stack.get();
      fiber.place.size = stack_size;
#if defined(__SANITIZE_THREAD__)
      fiber.place.sanitizer = __tsan_create_fiber(0);
#endif
    }
#if defined(__SANITIZE_THREAD__)
    scheduler.sanitizer = __tsan_get_current_fiber();
#endif
  }

  /// Goes to a fiber that can go on, and comes back when it waits or ends.
  void go_on(int t);
  /// Goes back from there.
  void wait(State state);
  /// Lets those in [first, end) go on where all of them wait for this.
  bool release(int first, int end, State state) {
    for (int t = first; t < end; t++) {
      if (fibers[t].state != state) return false;
    }
    for (int t = first; t < end; t++) fibers[t].state = State::can_go_on;
    return true;
  }
  [[noreturn]] void refuse(int count, int team_size) const;
  /// What runs on a fiber's stack, from its beginning.
  static void run_current();
  void begin(Fiber &fiber) {
    ::getcontext(&fiber.place.context);
    fiber.place.context.uc_stack.ss_sp = fiber.stack.get();
    fiber.place.context.uc_stack.ss_size = stack_size;
    fiber.place.context.uc_link = nullptr;
    fiber.place.frames = nullptr;
    fiber.place.has_begun = false;
    ::makecontext(&fiber.place.context, run_current, 0);
    fiber.state = State::can_go_on;
  }
};

namespace {

/// A function that makecontext() begins gets no pointer.
thread_local void *running = nullptr;

}  // namespace

void Fibers::Turns::run_current() {
  auto &turns = *static_cast<Turns *>(running);
  Fiber &fiber = turns.fibers[turns.current];
  arrived(fiber.place, turns.scheduler);
  try {
    (*turns.body)(turns.current);
  } catch (...) {
    turns.thrown = std::current_exception();
  }
  fiber.state = State::ended;
  leave(fiber.place, turns.scheduler, true);
}

Fibers::Fibers() : turns_(std::make_unique<Turns>()) {}
Fibers::~Fibers() = default;

void Fibers::Turns::go_on(int t) {
  current = t;
  leave(scheduler, fibers[t].place, false);
  Place nowhere;
  arrived(scheduler, nowhere);
  if (thrown) std::rethrow_exception(thrown);
}

void Fibers::Turns::wait(State state) {
  Fiber &fiber = fibers[current];
  fiber.state = state;
  leave(fiber.place, scheduler, false);
  arrived(fiber.place, scheduler);
}

/// Nobody can go on, and not all have ended: somebody does not come to where somebody else waits.
void Fibers::Turns::refuse(int count, int team_size) const {
  for (int t = 0; t < count; t++) {
    if (fibers[t].state == State::ended) continue;
    const bool is_of_team = fibers[t].state == State::waits_for_team;
    const int first = is_of_team ? t / team_size * team_size : 0,
              end = is_of_team ? std::min(count, first + team_size) : count;
    for (int other = first; other < end; other++) {
      if (fibers[other].state == fibers[t].state) continue;
      throw std::logic_error("thread " + std::to_string(t) + " waits at a barrier" +
                             (is_of_team ? " of its warp" : "") + " that thread " + std::to_string(other) +
                             " does not come to");
    }
  }
  throw std::logic_error("no thread can go on");
}

void Fibers::run(int count, int team_size, const std::function<void(int)> &body, const Referee &referee) {
  Turns &turns = *turns_;
  turns.make(count);
  turns.body = &body;
  turns.thrown = nullptr;
  running = &turns;
  for (int t = 0; t < count; t++) turns.begin(turns.fibers[t]);
  for (bool can_go_on = true; can_go_on;) {
    for (const int t : referee.order()) {
      if (turns.fibers[t].state == State::can_go_on) turns.go_on(t);
    }
    can_go_on = false;
    for (int first = 0; first < count; first += team_size) {
      if (!turns.release(first, std::min(count, first + team_size), State::waits_for_team)) continue;
      referee.team_met(first / team_size);
      can_go_on = true;
    }
    if (!can_go_on && turns.release(0, count, State::waits_for_all)) {
      referee.all_met();
      can_go_on = true;
    }
  }
  for (int t = 0; t < count; t++) {
    if (turns.fibers[t].state != State::ended) turns.refuse(count, team_size);
  }
}

void Fibers::wait() {
  turns_->wait(State::waits_for_all);
}

void Fibers::wait_for_team() {
  turns_->wait(State::waits_for_team);
}

}  // namespace hg::emu
