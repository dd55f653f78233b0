/// The language of kernels, for the host: what a thread asks the emulator. Read by both of them.
#ifndef HG_EMULATOR
#define HG_EMULATOR
#include <math.h>
#include <stddef.h>
#include <stdint.h>

namespace hg::gpu {

/// Between which barriers something was done: those of the block, and those of a warp, which the former are as well.
struct Phase {
  unsigned of_block, of_warp;
};

/// A word of shared memory, and who has used it since the last barrier.
struct SharedWord {
  double value;
  int writer, reader;  ///< a thread; -1: none, -2: several of one warp, -3: of several
  int writing_warp, reading_warp;
  Phase written, read;
};

/// What a thread sees of its block.
struct Emulated {
  int thread, num_threads, warp, warp_size;
  uint64_t block, num_blocks;
  SharedWord *shared;
  ptrdiff_t num_shared;
  const Phase *phases;  ///< of each warp
  void (*wait)(Emulated *);
  void (*wait_for_warp)(Emulated *);
  /// Numbers for the thread that differs in the bit `distance`, in exchange for its own.
  void (*exchange)(Emulated *, double *values, int count, int distance);
  void (*fail)(const Emulated *, const char *what, ptrdiff_t word);  ///< does not return
};

}  // namespace hg::gpu

#ifdef HG_EMULATED_TEXT  // a kernel, not the emulator

#define CEED_RUNNING_JIT_PASS
#define CEED_QFUNCTION_ATTR
#define CEED_QFUNCTION_HELPER_ATTR
#define HG_DEVICE inline
#define HG_KERNEL(name, Job)                          \
  static void name##_of_thread(const Job &job);       \
  extern "C" void name(const void *job) {             \
    name##_of_thread(*static_cast<const Job *>(job)); \
  }                                                   \
  static void name##_of_thread(const Job &job)
#define HG_KERNEL_OF(name, Job, most, blocks) HG_KERNEL(name, Job)
#define HG_UNROLL
#define HG_ROLLED
#define HG_UNROLL_BY(count)
#define HG_SHARED(name) const hg::gpu::Shared name(hg::gpu::emulated(), 0)

namespace hg::gpu {

static Emulated *(*of_this_thread)();
/// Says which function finds the block that a thread of the host runs.
extern "C" void hg_bind(Emulated *(*find)()) {
  __atomic_store_n(&of_this_thread, find, __ATOMIC_RELAXED);
}
inline Emulated *emulated() {
  return __atomic_load_n(&of_this_thread, __ATOMIC_RELAXED)();
}

inline int thread() {
  return emulated()->thread;
}
inline int num_threads() {
  return emulated()->num_threads;
}
inline ptrdiff_t block() {
  return static_cast<ptrdiff_t>(emulated()->block);
}
inline ptrdiff_t num_blocks() {
  return static_cast<ptrdiff_t>(emulated()->num_blocks);
}
inline ptrdiff_t index() {
  return block() * num_threads() + thread();
}
inline void barrier() {
  emulated()->wait(emulated());
}
inline void warp_barrier() {
  emulated()->wait_for_warp(emulated());
}
template <int count>
inline void exchange(double *values, int distance) {
  emulated()->exchange(emulated(), values, count, distance);
}

/// A word that is read and written as a number: what was not written is not read, and between two barriers of a block a
/// word that one thread writes is not used by another one, unless there is a barrier of the warp that both are of.
class SharedNumber {
 public:
  SharedNumber(Emulated *state, ptrdiff_t place) : state_(state), place_(place) {
    if (place < 0 || place >= state->num_shared) state->fail(state, "is outside of shared memory", place);
  }
  operator double() const {
    SharedWord &word = state_->shared[place_];
    const int own = state_->thread, warp = state_->warp;
    const Phase now = state_->phases[warp];
    if (word.writer == -1) fail("reads shared memory that was not written");
    if (word.writer != own && is_now(word.written, word.writing_warp)) {
      fail("reads what another thread has written since the last barrier");
    }
    if (word.reader == -1 || word.read.of_block != now.of_block) {
      word.reader = own;
    } else if (word.reader == -3 || word.reading_warp != warp) {
      word.reader = -3;
    } else if (word.reader != own && word.read.of_warp == now.of_warp) {
      word.reader = -2;
    } else {
      word.reader = own;
    }
    word.reading_warp = warp;
    word.read = now;
    return word.value;
  }
  const SharedNumber &operator=(double value) const {
    SharedWord &word = state_->shared[place_];
    const int own = state_->thread, warp = state_->warp;
    const Phase now = state_->phases[warp];
    if (word.writer >= 0 && word.writer != own && is_now(word.written, word.writing_warp)) {
      fail("writes what another thread has written since the last barrier");
    }
    const bool is_read_now =
        word.reader == -3 ? word.read.of_block == now.of_block : is_now(word.read, word.reading_warp);
    if (word.reader != -1 && word.reader != own && is_read_now) {
      fail("writes what another thread has read since the last barrier");
    }
    word.value = value;
    word.writer = own;
    word.writing_warp = warp;
    word.written = now;
    return *this;
  }
  const SharedNumber &operator=(const SharedNumber &other) const { return *this = static_cast<double>(other); }
  const SharedNumber &operator+=(double value) const { return *this = *this + value; }

 private:
  /// Whether no barrier lies between a thread of `warp` then and this thread now.
  bool is_now(const Phase &then, int warp) const {
    const Phase &now = state_->phases[state_->warp];
    return warp == state_->warp ? then.of_warp == now.of_warp : then.of_block == now.of_block;
  }
  void fail(const char *what) const { state_->fail(state_, what, place_); }

  Emulated *state_;
  ptrdiff_t place_;
};

/// Shared memory from a word on: a pointer, but for the checks.
class Shared {
 public:
  Shared(Emulated *state, ptrdiff_t first) : state_(state), first_(first) {}
  SharedNumber operator[](ptrdiff_t i) const { return SharedNumber(state_, first_ + i); }
  Shared operator+(ptrdiff_t i) const { return Shared(state_, first_ + i); }
  /// The first of two words that a device reads or writes at once.
  SharedNumber pair(ptrdiff_t i) const {
    if ((first_ + i) % 2 != 0) state_->fail(state_, "takes for a pair what begins at an odd word", first_ + i);
    return (*this)[i];
  }

 private:
  Emulated *state_;
  ptrdiff_t first_;
};
using SharedArray = Shared;
struct Pair {
  double first, second;
};
inline Pair read_pair(SharedArray array, int place) {
  return {array.pair(place), array[place + 1]};
}
inline void write_pair(SharedArray array, int place, Pair pair) {
  array.pair(place) = pair.first;
  array[place + 1] = pair.second;
}

inline void atomic_add(double *to, double value) {
  *to += value;
}
inline void prefetch(const void *) {}

}  // namespace hg::gpu

#endif
#endif
