/// @file
/// What a vendor's library has to do for us. CUDA, HIP and the emulator differ by a driver, and by nothing else.
#pragma once

#include <ceed/backend.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace hg::gpu {

/// The device, or its compiler, did not do what it was asked for; what() is for people.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whose kernels of the user's a device takes; `any`: an emulator, whose kernels are functions of the host.
enum class UserKernels { cuda, hip, any };

struct Properties {
  std::string name;
  int number;                    ///< among the vendor's devices
  int warp_size;                 ///< threads that run in step
  int max_threads;               ///< of a block
  std::size_t shared_per_block;  ///< bytes
  int num_processors;
  UserKernels user_kernels = UserKernels::any;
};

/// A function on the device; valid as long as its module.
struct Kernel {
  void *handle = nullptr;
  std::uint64_t id = 0;   ///< no other one's in this process, as a handle may be
  const char *name = "";  ///< for messages: that of its text
};

/// A loaded text, unloaded in the end.
class Module {
 public:
  virtual ~Module() = default;
  /// Throws DeviceError where there is none.
  virtual Kernel kernel(const char *name) = 0;
};

constexpr std::uint64_t most_blocks = 2147483647;  ///< of a launch, everywhere
constexpr std::size_t most_job_bytes = 4096;       ///< that a launch takes, everywhere
constexpr int usual_threads = 256;                 ///< of a block, where nothing speaks for another number

/// How many threads run a kernel, in one direction.
struct Launch {
  std::uint64_t num_blocks;
  int num_threads;               ///< of a block
  std::size_t shared_bytes = 0;  ///< of a block
  bool has_barriers = false;     ///< whether threads wait for each other

  bool operator==(const Launch &) const = default;
};

/// A kernel to be called with its one argument, the bytes of a struct of text/jobs.hpp.
struct Call {
  Kernel kernel;
  Launch launch;
  std::vector<std::byte> job;
};

/// The fields that a kernel of the user's is called with, as libCEED has them: value c of point i is entry c*Q + i.
struct UserFields {
  static constexpr CeedInt most = 16;  ///< inputs, and outputs
  const CeedScalar *inputs[most] = {};
  CeedScalar *outputs[most] = {};
};

/// Calls that do not depend on each other, and are made again and again, with kernels and jobs that seldom change.
class Calls {
 public:
  virtual ~Calls() = default;
  virtual void launch(std::span<const Call> calls) = 0;
  virtual std::size_t num_bytes() const { return 0; }
};

/// One device. All work is done in one order, that of the calls (a stream); only copies to the host wait for it.
/// Functions throw DeviceError, with what the vendor's library says.
class Driver {
 public:
  virtual ~Driver() = default;
  virtual const Properties &properties() const = 0;

  /// Memory on the device, aligned to 256 bytes, without values; never NULL. Throws std::bad_alloc where it is the
  /// host's.
  virtual void *allocate(std::size_t bytes) = 0;
  virtual void free(void *memory) noexcept = 0;
  void copy_to_device(void *to, const void *from, std::size_t bytes) {
    if (bytes == 0) return;
    to_device(to, from, bytes);
    num_to_device_++;
    bytes_to_device_ += static_cast<CeedSize>(bytes);
  }
  /// The values are there when it returns.
  void copy_to_host(void *to, const void *from, std::size_t bytes) {
    if (bytes == 0) return;
    to_host(to, from, bytes);
    num_to_host_++;
    bytes_to_host_ += static_cast<CeedSize>(bytes);
  }
  CeedTransfers transfers() const {
    return {.num_to_device = num_to_device_,
            .bytes_to_device = bytes_to_device_,
            .num_to_host = num_to_host_,
            .bytes_to_host = bytes_to_host_};
  }
  virtual void copy(void *to, const void *from, std::size_t bytes) = 0;
  /// Bytes become 0.
  virtual void clear(void *memory, std::size_t bytes) = 0;

  /// The stream (CUstream, hipStream_t) that work is given to from now on, where it begins after what was given to the
  /// one before. Nobody waits here.
  virtual void set_stream(void *stream) = 0;

  /// A text in the language of text/: what the driver says of it comes first. `name` is for messages.
  virtual std::unique_ptr<Module> compile(const std::string &name, const std::string &text) = 0;
  /// Calls a kernel with its one argument, a struct of text/jobs.hpp, which is copied.
  virtual void launch(Kernel kernel, const Launch &launch, const void *job, std::size_t job_bytes) = 0;
  /// Calls a kernel that the user has loaded (CUfunction, hipFunction_t): f(void *context, CeedInt Q, UserFields
  /// fields), with at least Q threads, in blocks of 256.
  virtual void launch_user(void *kernel, void *context, CeedInt Q, const UserFields &fields) = 0;
  void make(const Call &call) { launch(call.kernel, call.launch, call.job.data(), call.job.size()); }
  /// The driver is there as long as these are. Here: one after another.
  virtual std::unique_ptr<Calls> make_calls();

 private:
  virtual void to_device(void *to, const void *from, std::size_t bytes) = 0;
  virtual void to_host(void *to, const void *from, std::size_t bytes) = 0;

  std::atomic<CeedSize> num_to_device_ = 0, bytes_to_device_ = 0, num_to_host_ = 0, bytes_to_host_ = 0;
};

inline std::unique_ptr<Calls> Driver::make_calls() {
  struct OneByOne : Calls {
    explicit OneByOne(Driver &driver) : driver(driver) {}
    void launch(std::span<const Call> calls) override {
      for (const Call &call : calls) driver.make(call);
    }
    Driver &driver;
  };
  return std::make_unique<OneByOne>(*this);
}

}  // namespace hg::gpu
