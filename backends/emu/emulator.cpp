#include "emulator.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <list>
#include <new>
#include <numeric>
#include <sstream>

#include "../jit/cache.hpp"
#include "texts.hpp"

namespace hg::emu {

using gpu::DeviceError, gpu::Emulated, gpu::SharedWord;

namespace {

/// A function of a module.
struct Function {
  void (*call)(const void *job);
  std::string name;
};

/// What a thread gives to another one of its warp.
struct Offer {
  std::vector<double> values;
  unsigned meeting = 0;  ///< of its warp, in which it is taken
};

/// What is running, for the functions that a kernel calls.
struct Running {
  Emulated state;
  Fibers *fibers;  ///< NULL: there are none
  const Function *function;
  std::vector<gpu::Phase> phases;  ///< of each warp
  std::vector<Offer> offers[2];    ///< of each thread, in this exchange and in the one before it
  struct Meetings {
    unsigned count = 0;
    bool is_exchange = false;  ///< the next one, which is no barrier for what is in memory
  };
  std::vector<Meetings> meetings;  ///< of each warp

  void warp_has_met(int warp) {
    meetings[warp].count++;
    if (!meetings[warp].is_exchange) phases[warp].of_warp++;
    meetings[warp].is_exchange = false;
  }
  /// Which thread runs from now on.
  void is(int thread) {
    state.thread = thread;
    state.warp = thread / state.warp_size;
  }
};
thread_local Running *running = nullptr;

/// A library that stays open as long as the process, as jit::Cache has it.
class Library : public gpu::Module {
 public:
  Library(std::string name, void *library) : name_(std::move(name)), library_(library) {
    const auto bind = reinterpret_cast<void (*)(Emulated * (*)())>(symbol("hg_bind"));
    bind([] { return &running->state; });
  }
  gpu::Kernel kernel(const char *name) override {
    functions_.push_back(
        {.call = reinterpret_cast<void (*)(const void *)>(symbol(name)), .name = std::string(name) + "' of '" + name_});
    return {.handle = &functions_.back(), .name = name_.c_str()};
  }

 private:
  void *symbol(const char *name) const {
    void *address = ::dlsym(library_, name);
    if (address == nullptr) throw DeviceError("'" + name_ + "' has no kernel '" + name + "'");
    return address;
  }

  std::string name_;
  void *library_;
  std::list<Function> functions_;  // they are pointed to
};

std::string name_of(const Emulated *state) {
  return "thread " + std::to_string(state->thread) + " of block " + std::to_string(state->block) + " of the kernel '" +
         running->function->name + "'";
}

[[noreturn]] void fail(const Emulated *state, const char *what, std::ptrdiff_t word) {
  throw DeviceError(name_of(state) + " " + what + ": word " + std::to_string(word) + " of " +
                    std::to_string(state->num_shared));
}

/// Others run in between.
void wait_as(Emulated *state, void (Fibers::*wait)()) {
  if (running->fibers == nullptr) {
    throw DeviceError("the kernel '" + running->function->name + "' has a barrier, and was said to have none");
  }
  const int own = state->thread;
  (running->fibers->*wait)();
  running->is(own);
}
void wait(Emulated *state) {
  wait_as(state, &Fibers::wait);
}
void wait_for_warp(Emulated *state) {
  wait_as(state, &Fibers::wait_for_team);
}

/// No thread is two exchanges ahead of another one of its warp: offers alternate between two places.
void exchange(Emulated *state, double *values, int count, int distance) {
  const int own = state->thread, other = own ^ distance;
  if (other >= state->num_threads || other / state->warp_size != state->warp) {
    throw DeviceError(name_of(state) + " exchanges values with thread " + std::to_string(other) +
                      ", which is not of its warp");
  }
  Running::Meetings &meetings = running->meetings[state->warp];
  const unsigned meeting = meetings.count + 1;
  std::vector<Offer> &offers = running->offers[meeting % 2];
  offers[own].values.assign(values, values + count);
  offers[own].meeting = meeting;
  meetings.is_exchange = true;
  wait_for_warp(state);
  const Offer &offer = offers[other];
  if (offer.meeting != meeting || offer.values.size() != static_cast<std::size_t>(count)) {
    throw DeviceError(name_of(state) + " exchanges " + std::to_string(count) + " values with thread " +
                      std::to_string(other) + ", which exchanges " +
                      std::to_string(offer.meeting == meeting ? offer.values.size() : 0));
  }
  std::copy(offer.values.begin(), offer.values.end(), values);
}

}  // namespace

Options parse(const std::string &text) {
  Options options;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "order=forward") {
      options.order = Order::forward;
    } else if (word == "order=backward") {
      options.order = Order::backward;
    } else if (word == "order=shuffled") {
      options.order = Order::shuffled;
    } else if (word == "warp=32") {
      options.warp_size = 32;
    } else if (word == "warp=64") {
      options.warp_size = 64;
    } else if (word == "shared=64") {
      options.shared_kib = 64;
    } else if (word == "shared=163") {
      options.shared_kib = 163;
    } else if (word == "shared=227") {
      options.shared_kib = 227;
    } else if (!gpu::parse_option(word, options.device)) {
      throw DeviceError("the emulator has no option '" + word +
                        "'; expected order=forward, order=backward, order=shuffled, warp=32, warp=64, "
                        "shared=64, shared=163, shared=227, " +
                        gpu::expected_options);
    }
  }
  return options;
}

Emulator::Emulator(const Options &options)
    : options_(options),
      properties_{.name = "emulator",
                  .number = std::max(options.device.device_id, 0),
                  .warp_size = options.warp_size,
                  .max_threads = 1024,
                  .shared_per_block = static_cast<std::size_t>(options.shared_kib) << 10,
                  .num_processors = 2} {}

// What nobody has written is no number.
void *Emulator::allocate(std::size_t bytes) {
  constexpr std::size_t alignment = 256;
  if (bytes > std::numeric_limits<std::size_t>::max() - 2 * alignment) throw std::bad_alloc();
  const std::size_t rounded = (bytes / alignment + 1) * alignment;
  void *memory = std::aligned_alloc(alignment, rounded);
  if (memory == nullptr) throw std::bad_alloc();
  std::memset(memory, 0xff, rounded);
  return memory;
}

void Emulator::free(void *memory) noexcept {
  std::free(memory);
}

void Emulator::copy(void *to, const void *from, std::size_t bytes) {
  if (bytes > 0) std::memmove(to, from, bytes);
}

void Emulator::clear(void *memory, std::size_t bytes) {
  if (bytes > 0) std::memset(memory, 0, bytes);
}

std::unique_ptr<gpu::Module> Emulator::compile(const std::string &name, const std::string &text) {
  jit::Cache::Request request{
      .text =
          "// " + name + ", for the emulator\n#define HG_EMULATED_TEXT\n" + jit::text_of(texts, "emulator.hpp") + text,
      .options = {"-std=gnu++20", "-O1", "-w", "-fpermissive", "-ffp-contract=off", "-nostdinc++"},
      .depends_on = "emulator",
      .is_report_wanted = false};
  for (auto &flag : jit::flags_of_user()) request.options.push_back(std::move(flag));
  std::string said;
  try {
    return std::make_unique<Library>(name, jit::Cache().library(jit::Compiler::find(), request, &said));
  } catch (const jit::NotCompiled &reason) {
    throw DeviceError("'" + name + "' is not compiled: " + reason.what());
  }
}

template <typename Number>
std::vector<Number> Emulator::order_of(Number count) {
  std::vector<Number> order(count);
  std::iota(order.begin(), order.end(), Number{0});
  if (options_.order == Order::backward) std::reverse(order.begin(), order.end());
  if (options_.order == Order::shuffled) std::shuffle(order.begin(), order.end(), random_);
  return order;
}

void Emulator::launch_user(void *kernel, void *context, CeedInt Q, const gpu::UserFields &fields) {
  if (Q > 0) reinterpret_cast<void (*)(void *, CeedInt, gpu::UserFields)>(kernel)(context, Q, fields);
}

std::unique_ptr<gpu::Calls> Emulator::make_calls() {
  struct InOrder : gpu::Calls {
    explicit InOrder(Emulator &device) : device(device) {}
    void launch(std::span<const gpu::Call> calls) override {
      for (const std::size_t i : device.order_of(calls.size())) device.make(calls[i]);
    }
    Emulator &device;
  };
  return std::make_unique<InOrder>(*this);
}

void Emulator::launch(gpu::Kernel kernel, const gpu::Launch &launch, const void *job, std::size_t job_bytes) {
  const auto &function = *static_cast<const Function *>(kernel.handle);
  if (launch.num_blocks < 1 || launch.num_blocks > gpu::most_blocks || job_bytes > gpu::most_job_bytes) {
    throw DeviceError("'" + function.name + "' cannot be launched with " + std::to_string(launch.num_blocks) +
                      " blocks and a job of " + std::to_string(job_bytes) + " bytes");
  }
  if (launch.num_threads < 1 || launch.num_threads > properties_.max_threads ||
      launch.shared_bytes > properties_.shared_per_block) {
    throw DeviceError("'" + function.name + "' cannot be launched with " + std::to_string(launch.num_threads) +
                      " threads and " + std::to_string(launch.shared_bytes) + " bytes of shared memory in a block");
  }
  shared_.resize(launch.shared_bytes / sizeof(double));
  const int warp_size = properties_.warp_size, num_warps = (launch.num_threads + warp_size - 1) / warp_size;
  Running run{.state = {.thread = 0,
                        .num_threads = launch.num_threads,
                        .warp = 0,
                        .warp_size = warp_size,
                        .block = 0,
                        .num_blocks = launch.num_blocks,
                        .shared = shared_.data(),
                        .num_shared = static_cast<std::ptrdiff_t>(shared_.size()),
                        .phases = nullptr,
                        .wait = wait,
                        .wait_for_warp = wait_for_warp,
                        .exchange = exchange,
                        .fail = fail},
              .fibers = launch.has_barriers ? &fibers_ : nullptr,
              .function = &function,
              .phases = std::vector<gpu::Phase>(num_warps),
              .offers = {},
              .meetings = std::vector<Running::Meetings>(num_warps)};
  run.state.phases = run.phases.data();
  for (auto &offers : run.offers) offers.resize(launch.num_threads);
  running = &run;
  const std::function<void(int)> body = [&](int thread) {
    run.is(thread);
    function.call(job);
  };
  const Fibers::Referee referee{.order = [&] { return order_of(launch.num_threads); },
                                .team_met = [&](int warp) { run.warp_has_met(warp); },
                                .all_met =
                                    [&] {
                                      for (gpu::Phase &phase : run.phases) {
                                        phase.of_block++;
                                        phase.of_warp++;
                                      }
                                    }};
  for (const std::uint64_t block : order_of(launch.num_blocks)) {
    run.state.block = block;
    std::fill(shared_.begin(), shared_.end(),
              SharedWord{.value = std::numeric_limits<double>::quiet_NaN(),
                         .writer = -1,
                         .reader = -1,
                         .writing_warp = 0,
                         .reading_warp = 0,
                         .written = {},
                         .read = {}});
    if (launch.has_barriers) {
      try {
        fibers_.run(launch.num_threads, warp_size, body, referee);
      } catch (const std::logic_error &error) {
        throw DeviceError("block " + std::to_string(run.state.block) + " of the kernel '" + function.name +
                          "': " + error.what());
      }
    } else {
      for (const int thread : order_of(launch.num_threads)) body(thread);
    }
  }
}

}  // namespace hg::emu
