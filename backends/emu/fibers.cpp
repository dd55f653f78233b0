#include "fibers.hpp"

#include <ucontext.h>

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

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
  ucontext_t context;
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
  ::swapcontext(&from.context, &to.context);
}

/// To be called where a stack begins or goes on; `from`: it was left for this one.
void arrived([[maybe_unused]] Place &at, [[maybe_unused]] Place &from) {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_finish_switch_fiber(at.frames, &from.bottom, &from.size);
#endif
}

struct Fiber {
  Place place;
  std::unique_ptr<std::byte[]> stack;
  bool has_ended = true;
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

  /// What runs on a fiber's stack, from its beginning.
  static void run_current();
  void begin(Fiber &fiber) {
    ::getcontext(&fiber.place.context);
    fiber.place.context.uc_stack.ss_sp = fiber.stack.get();
    fiber.place.context.uc_stack.ss_size = stack_size;
    fiber.place.context.uc_link = nullptr;
    fiber.place.frames = nullptr;
    ::makecontext(&fiber.place.context, run_current, 0);
    fiber.has_ended = false;
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
  fiber.has_ended = true;
  leave(fiber.place, turns.scheduler, true);
}

Fibers::Fibers() : turns_(std::make_unique<Turns>()) {}
Fibers::~Fibers() = default;

void Fibers::run(int count, const std::function<void(int)> &body, const std::function<std::vector<int>()> &order) {
  Turns &turns = *turns_;
  turns.make(count);
  turns.body = &body;
  turns.thrown = nullptr;
  running = &turns;
  for (int t = 0; t < count; t++) turns.begin(turns.fibers[t]);
  for (int num_waiting = count; num_waiting > 0;) {
    num_waiting = 0;
    int has_ended = -1, waits = -1;
    for (const int t : order()) {
      turns.current = t;
      leave(turns.scheduler, turns.fibers[t].place, false);
      Place nowhere;
      arrived(turns.scheduler, nowhere);
      if (turns.thrown) std::rethrow_exception(turns.thrown);
      (turns.fibers[t].has_ended ? has_ended : waits) = t;
      if (!turns.fibers[t].has_ended) num_waiting++;
    }
    if (num_waiting > 0 && num_waiting < count) {
      throw std::logic_error("thread " + std::to_string(waits) + " waits at a barrier that thread " +
                             std::to_string(has_ended) + " does not come to");
    }
  }
}

void Fibers::wait() {
  Turns &turns = *turns_;
  Fiber &fiber = turns.fibers[turns.current];
  leave(fiber.place, turns.scheduler, false);
  arrived(fiber.place, turns.scheduler);
}

}  // namespace hg::emu
