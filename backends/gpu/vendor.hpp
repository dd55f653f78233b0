/// @file
/// CUDA and HIP: two sets of names for the same calls. Their libraries are loaded when the program runs, so that what
/// uses them is built, and starts, where there are none.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "driver.hpp"
#include "options.hpp"

namespace hg::gpu {

/// A library that is loaded by one of several names, and stays loaded as long as the process.
class VendorLibrary {
 public:
  /// Throws DeviceError where none of these files can be loaded.
  explicit VendorLibrary(std::span<const char *const> files);
  /// Throws DeviceError where it is missing.
  void *symbol(const char *name) const;
  /// A struct of function pointers, by their names in the same order.
  template <typename Calls>
  Calls calls(std::span<const char *const> names) const {
    std::array<void *, sizeof(Calls) / sizeof(void *)> found;
    for (std::size_t i = 0; i < found.size(); i++) found[i] = symbol(names[i]);
    return std::bit_cast<Calls>(found);
  }

 private:
  void *library_ = nullptr;
  std::string file_;
};

/// Calls of the driver, which both vendors have with these arguments; 0 is success.
struct DriverCalls {
  int (*init)(unsigned flags);
  int (*count_devices)(int *count);
  int (*name)(char *name, int length, int device);
  int (*attribute)(int *value, int attribute, int device);
  int (*allocate)(void **memory, std::size_t bytes);
  int (*free)(void *memory);
  int (*to_device)(void *to, const void *from, std::size_t bytes, void *stream);
  int (*to_host)(void *to, const void *from, std::size_t bytes, void *stream);
  int (*copy)(void *to, const void *from, std::size_t bytes, void *stream);
  int (*clear)(void *memory, unsigned char value, std::size_t bytes, void *stream);
  int (*synchronize)(void *stream);
  int (*create_event)(void **event, unsigned flags);
  int (*destroy_event)(void *event);
  int (*record)(void *event, void *stream);  ///< the event is when what was given to the stream is done
  int (*wait)(void *stream, void *event, unsigned flags);
  int (*load)(void **module, const void *code);
  int (*unload)(void *module);
  int (*function)(void **function, void *module, const char *name);
  int (*launch)(void *function, unsigned grid_x, unsigned grid_y, unsigned grid_z, unsigned block_x, unsigned block_y,
                unsigned block_z, unsigned shared_bytes, void *stream, void **arguments, void **extra);
};
/// A kernel in a graph, in one direction.
struct GraphKernel {
  void *function;
  unsigned num_blocks, num_threads, shared_bytes;
  void **arguments;
};
/// The same as a vendor's calls read it: the bytes of its own struct, and 0.
class GraphNode {
 public:
  template <typename Struct>
  explicit GraphNode(const Struct &kernel) {
    static_assert(std::is_trivially_copyable_v<Struct> && sizeof(Struct) <= sizeof bytes_);
    std::memcpy(bytes_, &kernel, sizeof kernel);
  }

 private:
  alignas(void *) std::byte bytes_[96] = {};
};
/// Graphs, which run what does not depend on each other at once, and are launched as one. 0 is success.
struct GraphCalls {
  int (*create)(void **graph, unsigned flags);
  int (*add)(void **node, void *graph, void *const *dependencies, std::size_t num_dependencies,
             const GraphNode *kernel);
  int (*make)(void **executable, void *graph, unsigned long long flags);
  int (*change)(void *executable, void *node, const GraphNode *kernel);
  int (*launch)(void *executable, void *stream);
  int (*destroy_executable)(void *executable);
  int (*destroy)(void *graph);
};
/// The same of the compiler.
struct CompilerCalls {
  int (*version)(int *major, int *minor);
  int (*create)(void **program, const char *text, const char *name, int num_headers, const char *const *headers,
                const char *const *names);
  int (*compile)(void *program, int num_options, const char *const *options);
  int (*log_size)(void *program, std::size_t *bytes);
  int (*log)(void *program, char *log);
  int (*code_size)(void *program, std::size_t *bytes);
  int (*code)(void *program, char *code);
  int (*destroy)(void **program);
  const char *(*error)(int code);
};

/// What tells one vendor from the other.
struct Vendor {
  const char *name;
  std::span<const char *const> driver_files, compiler_files;  ///< of which the first that is there is taken
  std::span<const char *const> driver_names, compiler_names;  ///< of DriverCalls and CompilerCalls
  std::span<const char *const> graph_names;                   ///< of GraphCalls
  GraphNode (*graph_node)(const GraphKernel &kernel);
  UserKernels user_kernels;
  struct {
    int max_threads, shared_per_block, warp_size, num_processors;
  } attributes;  ///< numbers of a device's properties
  /// What an error of the driver means.
  std::string (*error)(const VendorLibrary &driver, int code);
  /// The device that this thread's calls are for.
  int (*current)(const VendorLibrary &driver, int *device);
  /// What makes a device the one that this thread's calls are for, in *handle; it is there as long as the process.
  int (*open)(const VendorLibrary &driver, int device, void **handle);
  int (*make_current)(const VendorLibrary &driver, void *handle);
  /// Lets blocks of a kernel have so much shared memory, more than usual.
  int (*allow_shared)(const VendorLibrary &driver, void *function, std::size_t bytes);
  /// The compiler's options for a device; whether they name its architecture.
  std::vector<std::string> (*options)(const DriverCalls &calls, int device);
  bool options_have_architecture;
};

/// A vendor's compiler, which needs no device.
class VendorCompiler {
 public:
  explicit VendorCompiler(const Vendor &vendor);
  /// The code of a text, from the cache on disk where it is there and `is_usable`; where there is no cache, that is
  /// told once. `log`: what the compiler said, empty where it was not asked; may be NULL. Throws DeviceError, with its
  /// messages.
  std::string compile(const std::string &name, const std::string &text, const std::vector<std::string> &options,
                      std::string *log = nullptr, bool is_usable = true) const;
  /// The same without the cache.
  std::string compile_now(const std::string &name, const std::string &text, const std::vector<std::string> &options,
                          std::string *log = nullptr) const;

 private:
  const Vendor &vendor_;
  CompilerCalls calls_;
  std::string version_;
};

/// A device of a vendor, from 0 on; current_device: the one that this thread's calls are for. From then on calls of the
/// vendor's library are for it, in each thread that uses it. Throws DeviceError where there is none.
std::shared_ptr<Driver> make_driver(const Vendor &vendor, int device);
/// For CeedBackend::score: 0 where there is no device or no compiler, and why. Opens none.
int score_of(const Vendor &vendor, const char **reason);

}  // namespace hg::gpu
