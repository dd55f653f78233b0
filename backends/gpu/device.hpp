/// @file
/// The device of a Ceed: memory, and the kernels of the library.
#pragma once

#include <ceed/plugin.h>

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "driver.hpp"

namespace hg::gpu {

/// Memory on the device, without values.
class Buffer {
 public:
  Buffer() = default;
  Buffer(std::shared_ptr<Driver> driver, std::size_t bytes)
      : driver_(std::move(driver)), memory_(driver_->allocate(bytes)), bytes_(bytes) {}
  /// What somebody else has allocated, and gives away.
  Buffer(std::shared_ptr<Driver> driver, void *memory, std::size_t bytes)
      : driver_(std::move(driver)), memory_(memory), bytes_(bytes) {}
  Buffer(Buffer &&other) noexcept { swap(other); }
  Buffer &operator=(Buffer &&other) noexcept {
    Buffer(std::move(other)).swap(*this);
    return *this;
  }
  ~Buffer() {
    if (memory_ != nullptr) driver_->free(memory_);
  }
  explicit operator bool() const { return memory_ != nullptr; }
  template <typename T>
  T *as() const {
    return static_cast<T *>(memory_);
  }
  std::size_t num_bytes() const { return bytes_; }
  /// Somebody else frees it from now on.
  void release() { memory_ = nullptr; }

 private:
  void swap(Buffer &other) noexcept {
    std::swap(driver_, other.driver_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
  }

  std::shared_ptr<Driver> driver_;
  void *memory_ = nullptr;
  std::size_t bytes_ = 0;
};

/// How whole operators are laid out on the device.
struct Tuning {
  int threads = 256;         ///< most threads of a block
  int lanes = 0, slots = 0;  ///< at points: threads of a cell, points of a thread at a time; 0: as the operator wants
};

/// Any thread may use it.
class Device {
 public:
  explicit Device(std::shared_ptr<Driver> driver, const Tuning &tuning = {})
      : driver_(std::move(driver)), tuning_(tuning) {}

  /// That of an object's Ceed.
  static Device &of(Ceed ceed);

  Driver &driver() const { return *driver_; }
  /// For what is made when it is first used, by whichever thread.
  std::unique_lock<std::recursive_mutex> lock() { return std::unique_lock(mutex_); }
  Buffer allocate(std::size_t bytes) const { return {driver_, bytes}; }
  Buffer adopt(void *memory, std::size_t bytes) const { return {driver_, memory, bytes}; }
  /// A copy of values on the host.
  template <typename Values>
  Buffer upload(const Values &values) const {
    const std::span all(values);
    Buffer buffer = allocate(all.size_bytes());
    driver_->copy_to_device(buffer.as<void>(), all.data(), all.size_bytes());
    return buffer;
  }

  /// Runs a kernel of the library (text/) in `count` threads or a few more, none where it is 0.
  template <typename Job>
  void run(const char *kernel, CeedSize count, const Job &job) {
    run(library_kernel(kernel), count, job);
  }
  template <typename Job>
  void run(Kernel kernel, CeedSize count, const Job &job) {
    static_assert(std::is_trivially_copyable_v<Job>);
    if (count == 0) return;
    const auto one_thread = lock();
    const Launch launch{.num_blocks = static_cast<std::uint64_t>((count + usual_threads - 1) / usual_threads),
                        .num_threads = usual_threads};
    driver_->launch(kernel, launch, &job, sizeof job);
  }
  /// The same with blocks that share memory and wait for their threads.
  template <typename Job>
  void run(const char *kernel, const Launch &launch, const Job &job) {
    const auto one_thread = lock();
    driver_->launch(library_kernel(kernel), launch, &job, sizeof job);
  }

  /// Compiles the library, or loads it, where that was not done yet.
  void prepare() { library(); }

  const Tuning &tuning() const { return tuning_; }
  /// The layout that operators at points of one kind have had so far, by a hash of the kind; zeros where there was
  /// none.
  struct Layout {
    int lanes = 0, slots = 0;
  };
  /// For who holds lock().
  Layout &layout_of(std::size_t kind) { return layouts_[kind]; }

 private:
  Module &library();
  Kernel library_kernel(const char *name);

  std::recursive_mutex mutex_;
  std::shared_ptr<Driver> driver_;
  Tuning tuning_;
  std::map<std::size_t, Layout> layouts_;
  std::unique_ptr<Module> library_;
  std::map<std::string, Kernel, std::less<>> kernels_;
};

}  // namespace hg::gpu
