#include "vendor.hpp"

#include <cstdint>

namespace hg::hip {

namespace {

constexpr const char *driver_files[] = {"libamdhip64.so", "libamdhip64.so.7", "libamdhip64.so.6", "libamdhip64.so.5"};
/// The compiler is a library of its own in newer versions.
constexpr const char *compiler_files[] = {"libhiprtc.so",     "libhiprtc.so.7",   "libhiprtc.so.6",
                                          "libamdhip64.so.6", "libamdhip64.so.5", "libamdhip64.so"};
constexpr const char *driver_names[] = {"hipInit",
                                        "hipGetDeviceCount",
                                        "hipDeviceGetName",
                                        "hipDeviceGetAttribute",
                                        "hipMalloc",
                                        "hipFree",
                                        "hipMemcpyHtoDAsync",
                                        "hipMemcpyDtoHAsync",
                                        "hipMemcpyDtoDAsync",
                                        "hipMemsetD8Async",
                                        "hipStreamSynchronize",
                                        "hipEventCreateWithFlags",
                                        "hipEventDestroy",
                                        "hipEventRecord",
                                        "hipStreamWaitEvent",
                                        "hipModuleLoadData",
                                        "hipModuleUnload",
                                        "hipModuleGetFunction",
                                        "hipModuleLaunchKernel"};
constexpr const char *compiler_names[] = {"hiprtcVersion",           "hiprtcCreateProgram",  "hiprtcCompileProgram",
                                          "hiprtcGetProgramLogSize", "hiprtcGetProgramLog",  "hiprtcGetCodeSize",
                                          "hiprtcGetCode",           "hiprtcDestroyProgram", "hiprtcGetErrorString"};
constexpr const char *graph_names[] = {"hipGraphCreate",
                                       "hipGraphAddKernelNode",
                                       "hipGraphInstantiateWithFlags",
                                       "hipGraphExecKernelNodeSetParams",
                                       "hipGraphLaunch",
                                       "hipGraphExecDestroy",
                                       "hipGraphDestroy"};

std::string error(const gpu::VendorLibrary &driver, int code) {
  const auto text_of = reinterpret_cast<const char *(*)(int)>(driver.symbol("hipGetErrorString"));
  const char *text = text_of(code);
  return text != nullptr ? text : "error " + std::to_string(code);
}

int current(const gpu::VendorLibrary &driver, int *device) {
  return reinterpret_cast<int (*)(int *)>(driver.symbol("hipGetDevice"))(device);
}

/// A device is its number.
int open(const gpu::VendorLibrary &, int device, void **number) {
  *number = reinterpret_cast<void *>(static_cast<std::intptr_t>(device));
  return 0;
}

int make_current(const gpu::VendorLibrary &driver, void *number) {
  const auto device = static_cast<int>(reinterpret_cast<std::intptr_t>(number));
  static const auto set = reinterpret_cast<int (*)(int)>(driver.symbol("hipSetDevice"));  // it is in each call
  return set(device);
}

/// The compiler takes the current device's architecture.
std::vector<std::string> options(const gpu::DriverCalls &, int) {
  return {"-std=c++17", "-O3"};
}

/// hipKernelNodeParams. Graphs of ROCm 5.2 refuse functions of modules (ROCm/hip issue 2450), newer ones take them.
gpu::GraphNode graph_node(const gpu::GraphKernel &kernel) {
  struct {
    unsigned block[3];
    void **extra;
    void *function;
    unsigned grid[3];
    void **arguments;
    unsigned shared_bytes;
  } node{.block = {kernel.num_threads, 1, 1},
         .extra = nullptr,
         .function = kernel.function,
         .grid = {kernel.num_blocks, 1, 1},
         .arguments = kernel.arguments,
         .shared_bytes = kernel.shared_bytes};
  return gpu::GraphNode(node);
}

}  // namespace

const gpu::Vendor vendor{
    .name = "HIP",
    .driver_files = driver_files,
    .compiler_files = compiler_files,
    .driver_names = driver_names,
    .compiler_names = compiler_names,
    .graph_names = graph_names,
    .graph_node = graph_node,
    .user_kernels = gpu::UserKernels::hip,
    .attributes = {.max_threads = 56, .shared_per_block = 74, .warp_size = 87, .num_processors = 63},
    .error = error,
    .current = current,
    .open = open,
    .make_current = make_current,
    .allow_shared = [](const gpu::VendorLibrary &, void *, std::size_t) { return 0; },
    .options = options,
    .options_have_architecture = false};

}  // namespace hg::hip
