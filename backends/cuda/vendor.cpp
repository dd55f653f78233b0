#include "vendor.hpp"

namespace hg::cuda {

namespace {

constexpr const char *driver_files[] = {"libcuda.so.1"};
constexpr const char *compiler_files[] = {"libnvrtc.so",
                                          "libnvrtc.so.13",
                                          "libnvrtc.so.12",
                                          "libnvrtc.so.11.2",
                                          "/usr/local/cuda/lib64/libnvrtc.so",
                                          "/usr/local/cuda/lib/libnvrtc.so",
                                          "/usr/local/cuda/lib/libnvrtc.so.13"};
constexpr const char *driver_names[] = {"cuInit",
                                        "cuDeviceGetCount",
                                        "cuDeviceGetName",
                                        "cuDeviceGetAttribute",
                                        "cuMemAlloc_v2",
                                        "cuMemFree_v2",
                                        "cuMemcpyHtoDAsync_v2",
                                        "cuMemcpyDtoHAsync_v2",
                                        "cuMemcpyDtoDAsync_v2",
                                        "cuMemsetD8Async",
                                        "cuStreamSynchronize",
                                        "cuEventCreate",
                                        "cuEventDestroy_v2",
                                        "cuEventRecord",
                                        "cuStreamWaitEvent",
                                        "cuModuleLoadData",
                                        "cuModuleUnload",
                                        "cuModuleGetFunction",
                                        "cuLaunchKernel"};
constexpr const char *compiler_names[] = {"nvrtcVersion",           "nvrtcCreateProgram",  "nvrtcCompileProgram",
                                          "nvrtcGetProgramLogSize", "nvrtcGetProgramLog",  "nvrtcGetCUBINSize",
                                          "nvrtcGetCUBIN",          "nvrtcDestroyProgram", "nvrtcGetErrorString"};
constexpr const char *graph_names[] = {"cuGraphCreate",
                                       "cuGraphAddKernelNode",
                                       "cuGraphInstantiateWithFlags",
                                       "cuGraphExecKernelNodeSetParams",
                                       "cuGraphLaunch",
                                       "cuGraphExecDestroy",
                                       "cuGraphDestroy"};

std::string error(const gpu::VendorLibrary &driver, int code) {
  const auto text_of = reinterpret_cast<int (*)(int, const char **)>(driver.symbol("cuGetErrorString"));
  const char *text = nullptr;
  return text_of(code, &text) == 0 && text != nullptr ? text : "error " + std::to_string(code);
}

/// That of the current context, or the first one where there is none, as with the CUDA runtime.
int current(const gpu::VendorLibrary &driver, int *device) {
  constexpr int invalid_context = 201;
  const int code = reinterpret_cast<int (*)(int *)>(driver.symbol("cuCtxGetDevice"))(device);
  if (code == invalid_context) *device = 0;
  return code == invalid_context ? 0 : code;
}

/// The device's own context, which the CUDA runtime uses, too.
int open(const gpu::VendorLibrary &driver, int device, void **context) {
  return reinterpret_cast<int (*)(void **, int)>(driver.symbol("cuDevicePrimaryCtxRetain"))(context, device);
}

int make_current(const gpu::VendorLibrary &driver, void *context) {
  static const auto set = reinterpret_cast<int (*)(void *)>(driver.symbol("cuCtxSetCurrent"));  // it is in each call
  return set(context);
}

int allow_shared(const gpu::VendorLibrary &driver, void *function, std::size_t bytes) {
  constexpr int max_dynamic_shared_size_bytes = 8;
  static const auto set = reinterpret_cast<int (*)(void *, int, int)>(driver.symbol("cuFuncSetAttribute"));
  return set(function, max_dynamic_shared_size_bytes, static_cast<int>(bytes));
}

std::vector<std::string> options(const gpu::DriverCalls &calls, int device) {
  constexpr int compute_capability_major = 75, compute_capability_minor = 76;
  int major = 0, minor = 0;
  calls.attribute(&major, compute_capability_major, device);
  calls.attribute(&minor, compute_capability_minor, device);
  return {"--gpu-architecture=sm_" + std::to_string(major) + std::to_string(minor), "--std=c++17", "-default-device"};
}

/// CUDA_KERNEL_NODE_PARAMS; newer drivers read two more handles, which are 0.
gpu::GraphNode graph_node(const gpu::GraphKernel &kernel) {
  struct {
    void *function;
    unsigned grid[3], block[3], shared_bytes;
    void **arguments, **extra;
  } node{.function = kernel.function,
         .grid = {kernel.num_blocks, 1, 1},
         .block = {kernel.num_threads, 1, 1},
         .shared_bytes = kernel.shared_bytes,
         .arguments = kernel.arguments,
         .extra = nullptr};
  return gpu::GraphNode(node);
}

}  // namespace

const gpu::Vendor vendor{
    .name = "CUDA",
    .driver_files = driver_files,
    .compiler_files = compiler_files,
    .driver_names = driver_names,
    .compiler_names = compiler_names,
    .graph_names = graph_names,
    .graph_node = graph_node,
    .user_kernels = gpu::UserKernels::cuda,
    .attributes = {.max_threads = 1, .shared_per_block = 97, .warp_size = 10, .num_processors = 16},
    .error = error,
    .current = current,
    .open = open,
    .make_current = make_current,
    .allow_shared = allow_shared,
    .options = options,
    .options_have_architecture = true};

}  // namespace hg::cuda
