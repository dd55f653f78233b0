/// @file
/// A device that is none: kernels are compiled for the host, and their threads run in turn. It finds what a device may
/// hide: barriers that are missing, shared memory that is read before it is written, or is not there.
#pragma once

#include <random>
#include <vector>

#include "../gpu/options.hpp"
#include "fibers.hpp"
#include "text/emulator.hpp"

namespace hg::emu {

enum class Order { forward, backward, shuffled };

struct Options {
  Order order = Order::forward;  ///< of calls that do not depend on each other, blocks, and threads between two barriers
  int warp_size = 32;
  int shared_kib = 64;  ///< KiB of a block: those of AMD's devices (64), of sm_80 (163) and of sm_90 (227)
  gpu::Options device;  ///< as devices have them
};
/// "order=shuffled,warp=64,device_id=1". Throws gpu::DeviceError, with what was expected.
Options parse(const std::string &text);

class Emulator : public gpu::Driver {
 public:
  explicit Emulator(const Options &options);

  const gpu::Properties &properties() const override { return properties_; }
  void *allocate(std::size_t bytes) override;
  void free(void *memory) noexcept override;
  void copy(void *to, const void *from, std::size_t bytes) override;
  void clear(void *memory, std::size_t bytes) override;
  void set_stream(void *) override {}
  std::unique_ptr<gpu::Module> compile(const std::string &name, const std::string &text) override;
  void launch(gpu::Kernel kernel, const gpu::Launch &launch, const void *job, std::size_t job_bytes) override;
  /// The kernel is a function of the host.
  void launch_user(void *kernel, void *context, CeedInt Q, const gpu::UserFields &fields) override;
  std::unique_ptr<gpu::Calls> make_calls() override;

 private:
  void to_device(void *to, const void *from, std::size_t bytes) override { copy(to, from, bytes); }
  void to_host(void *to, const void *from, std::size_t bytes) override { copy(to, from, bytes); }
  template <typename Number>
  std::vector<Number> order_of(Number count);

  Options options_;
  gpu::Properties properties_;
  Fibers fibers_;
  std::vector<gpu::SharedWord> shared_;
  std::mt19937 random_;
};

}  // namespace hg::emu
