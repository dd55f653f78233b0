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

#include "../gpu/options.hpp"
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

/// What is running, for the functions that a kernel calls.
struct Running {
  Emulated state;
  Fibers *fibers;  ///< NULL: there are none
  const Function *function;
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
    functions_.push_back({.call = reinterpret_cast<void (*)(const void *)>(symbol(name)), .name = name});
    return {&functions_.back()};
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

[[noreturn]] void fail(const Emulated *state, const char *what, std::ptrdiff_t word) {
  throw DeviceError("thread " + std::to_string(state->thread) + " of block " + std::to_string(state->block) +
                    " of the kernel '" + running->function->name + "' " + what + ": word " + std::to_string(word) +
                    " of " + std::to_string(state->num_shared));
}

void wait(Emulated *state) {
  if (running->fibers == nullptr) {
    throw DeviceError("the kernel '" + running->function->name + "' has a barrier, and was said to have none");
  }
  const int own = state->thread;
  running->fibers->wait();
  state->thread = own;
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
    } else if (word.starts_with(gpu::device_option)) {
      options.device_id = gpu::parse_device(word);
    } else {
      throw DeviceError("the emulator has no option '" + word +
                        "'; expected order=forward, order=backward, order=shuffled, warp=32, warp=64 or device_id=N");
    }
  }
  return options;
}

Emulator::Emulator(const Options &options)
    : options_(options),
      properties_{.name = "emulator",
                  .number = options.device_id,
                  .warp_size = options.warp_size,
                  .max_threads = 1024,
                  .shared_per_block = 64 << 10,
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

void Emulator::launch(gpu::Kernel kernel, const gpu::Launch &launch, const void *job, std::size_t) {
  const auto &function = *static_cast<const Function *>(kernel.handle);
  if (launch.num_threads < 1 || launch.num_threads > properties_.max_threads ||
      launch.shared_bytes > properties_.shared_per_block) {
    throw DeviceError("'" + function.name + "' cannot be launched with " + std::to_string(launch.num_threads) +
                      " threads and " + std::to_string(launch.shared_bytes) + " bytes of shared memory in a block");
  }
  shared_.resize(launch.shared_bytes / sizeof(double));
  Running run{.state = {.thread = 0,
                        .num_threads = launch.num_threads,
                        .block = 0,
                        .num_blocks = launch.num_blocks,
                        .shared = shared_.data(),
                        .num_shared = static_cast<std::ptrdiff_t>(shared_.size()),
                        .phase = 0,
                        .wait = wait,
                        .fail = fail},
              .fibers = launch.has_barriers ? &fibers_ : nullptr,
              .function = &function};
  running = &run;
  const std::function<void(int)> body = [&](int thread) {
    run.state.thread = thread;
    function.call(job);
  };
  for (const std::uint64_t block : order_of(launch.num_blocks)) {
    run.state.block = block;
    std::fill(shared_.begin(), shared_.end(),
              SharedWord{.value = std::numeric_limits<double>::quiet_NaN(),
                         .writer = -1,
                         .reader = -1,
                         .write_phase = 0,
                         .read_phase = 0});
    run.state.phase = 0;
    if (launch.has_barriers) {
      try {
        fibers_.run(launch.num_threads, body, [&] {
          run.state.phase++;
          return order_of(launch.num_threads);
        });
      } catch (const std::logic_error &error) {
        throw DeviceError("block " + std::to_string(run.state.block) + " of the kernel '" + function.name +
                          "': " + error.what());
      }
    } else {
      run.state.phase++;
      for (const int thread : order_of(launch.num_threads)) body(thread);
    }
  }
}

}  // namespace hg::emu
