// The calls of the vendors' drivers and compilers that the backends make, by their names and arguments. Built as a
// library that is loaded instead.
#include "fake_vendors.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

FakeVendors fake;

namespace {

constexpr int out_of_memory = 2, invalid_value = 1, invalid_context = 201, no_binary = 209;
constexpr int num_devices = 2;
constexpr char compiled[] = "code";

/// A node of a graph: what it was added or changed with, copied.
using Node = FakeVendors::Called;
using Graph = std::vector<Node *>;

bool takes_one_less(int &refused) {
  if (refused == 0) return false;
  refused--;
  return true;
}

/// CUDA_KERNEL_NODE_PARAMS up to its arguments, and hipKernelNodeParams.
struct CudaKernel {
  void *function;
  unsigned grid[3], block[3], shared_bytes;
  void **arguments, **extra;
};
struct HipKernel {
  unsigned block[3];
  void **extra, *function;
  unsigned grid[3];
  void **arguments;
  unsigned shared_bytes;
};
template <typename Kernel>
Node read(const Kernel &kernel) {
  return {.function = kernel.function,
          .job = *static_cast<const int *>(kernel.arguments[0]),
          .num_blocks = kernel.grid[0],
          .num_threads = kernel.block[0],
          .shared_bytes = kernel.shared_bytes};
}
template <typename Kernel>
int add(void **node, void *graph, std::size_t num_dependencies, const Kernel &kernel) {
  if (num_dependencies > 0 || kernel.extra != nullptr || takes_one_less(fake.refused_nodes)) return invalid_value;
  auto *added = new Node(read(kernel));
  static_cast<Graph *>(graph)->push_back(added);
  *node = added;
  return 0;
}
template <typename Kernel>
int change(void *node, const Kernel &kernel) {
  if (takes_one_less(fake.refused_changes)) return invalid_value;
  fake.num_changed++;
  *static_cast<Node *>(node) = read(kernel);
  return 0;
}

/// A number of a device's properties, by its number with CUDA and with HIP.
struct Attribute {
  int cuda, hip, value;
};
constexpr int no_number = -1;
constexpr Attribute attributes[] = {{1, 56, 1024},        // threads of a block
                                    {10, 87, 32},         // of a warp
                                    {16, 63, 4},          // processors
                                    {75, no_number, 9},   // architecture
                                    {76, no_number, 0},   // the same, minor
                                    {97, 74, 64 << 10}};  // shared memory of a block
int attribute_of(int *value, int Attribute::*number, int wanted) {
  for (const Attribute &attribute : attributes) {
    if (attribute.*number != wanted) continue;
    *value = attribute.value;
    return 0;
  }
  return invalid_value;
}

int copy_now(void *to, const void *from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
  return 0;
}
int copy_on(void *stream, void *to, const void *from, std::size_t bytes) {
  fake.worked_on.push_back(stream);
  return copy_now(to, from, bytes);
}

}  // namespace

extern "C" {

int cuInit(unsigned) {
  return 0;
}
int cuDeviceGetCount(int *count) {
  *count = num_devices;
  return 0;
}
int cuDeviceGetName(char *name, int length, int device) {
  std::snprintf(name, static_cast<std::size_t>(length), "fake %d", device);
  return 0;
}
int cuDeviceGetAttribute(int *value, int attribute, int) {
  return attribute_of(value, &Attribute::cuda, attribute);
}
int cuCtxGetDevice(int *device) {
  if (fake.current == FakeVendors::none) return invalid_context;
  *device = fake.current;
  return 0;
}
int cuDevicePrimaryCtxRetain(void **context, int device) {
  fake.num_retained++;
  *context = reinterpret_cast<void *>(static_cast<std::intptr_t>(device) + 1);
  return 0;
}
int cuCtxSetCurrent(void *context) {
  fake.current = static_cast<int>(reinterpret_cast<std::intptr_t>(context)) - 1;
  return 0;
}
int cuMemAlloc_v2(void **memory, std::size_t bytes) {
  if (fake.is_full) return out_of_memory;
  *memory = std::malloc(bytes);
  return 0;
}
int cuMemFree_v2(void *memory) {
  std::free(memory);
  return 0;
}
int cuMemcpyHtoDAsync_v2(void *to, const void *from, std::size_t bytes, void *stream) {
  return copy_on(stream, to, from, bytes);
}
int cuMemcpyDtoHAsync_v2(void *to, const void *from, std::size_t bytes, void *stream) {
  return copy_on(stream, to, from, bytes);
}
int cuMemcpyDtoDAsync_v2(void *to, const void *from, std::size_t bytes, void *stream) {
  return copy_on(stream, to, from, bytes);
}
int cuMemsetD8Async(void *memory, unsigned char value, std::size_t bytes, void *stream) {
  fake.worked_on.push_back(stream);
  std::memset(memory, value, bytes);
  return 0;
}
int cuEventCreate(void **event, unsigned) {
  fake.num_events++;
  *event = &fake.recorded;
  return 0;
}
int cuEventDestroy_v2(void *) {
  fake.num_events--;
  return 0;
}
int cuEventRecord(void *event, void *stream) {
  *static_cast<void **>(event) = stream;
  return 0;
}
int cuStreamWaitEvent(void *stream, void *event, unsigned) {
  fake.waits.emplace_back(stream, *static_cast<void **>(event));
  return 0;
}
int cuStreamSynchronize(void *stream) {
  fake.waited_for.push_back(stream);
  return 0;
}
int cuModuleLoadData(void **module, const void *code) {
  if (takes_one_less(fake.refused_loads)) return no_binary;
  *module = std::strcmp(static_cast<const char *>(code), compiled) == 0 ? &fake : nullptr;
  return *module != nullptr ? 0 : invalid_value;
}
int cuModuleUnload(void *) {
  return 0;
}
int cuModuleGetFunction(void **function, void *, const char *) {
  if (!fake.reuses_functions || fake.num_functions == 0) fake.num_functions++;
  *function = reinterpret_cast<void *>(static_cast<std::intptr_t>(fake.num_functions));
  return 0;
}
int cuLaunchKernel(void *function, unsigned num_blocks, unsigned, unsigned, unsigned num_threads, unsigned, unsigned,
                   unsigned, void *stream, void **arguments, void **) {
  fake.num_launched++;
  fake.worked_on.push_back(stream);
  if (function != &fake.user_kernel) return 0;
  const auto *fields = static_cast<const void *const *>(arguments[2]);  // 16 inputs, then outputs
  fake.user_call = {.context = *static_cast<void **>(arguments[0]),
                    .Q = *static_cast<const int *>(arguments[1]),
                    .first_input = fields[0],
                    .first_output = fields[16],
                    .num_blocks = num_blocks,
                    .num_threads = num_threads,
                    .stream = stream};
  return 0;
}
int cuGraphCreate(void **graph, unsigned) {
  fake.num_graphs++;
  *graph = new Graph;
  return 0;
}
int cuGraphAddKernelNode(void **node, void *graph, void *const *, std::size_t num_dependencies,
                         const CudaKernel *kernel) {
  return add(node, graph, num_dependencies, *kernel);
}
int cuGraphInstantiateWithFlags(void **executable, void *graph, unsigned long long) {
  if (takes_one_less(fake.refused_graphs)) return invalid_value;
  fake.num_executables++;
  fake.num_made++;
  *executable = graph;
  return 0;
}
int cuGraphExecKernelNodeSetParams(void *, void *node, const CudaKernel *kernel) {
  return change(node, *kernel);
}
int cuGraphLaunch(void *executable, void *stream) {
  for (const Node *node : *static_cast<Graph *>(executable)) {
    fake.called.push_back(*node);
    fake.called.back().stream = stream;
  }
  return 0;
}
int cuGraphExecDestroy(void *) {
  fake.num_executables--;
  return 0;
}
int cuGraphDestroy(void *graph) {
  fake.num_graphs--;
  for (const Node *node : *static_cast<Graph *>(graph)) delete node;
  delete static_cast<Graph *>(graph);
  return 0;
}
int cuFuncSetAttribute(void *, int, int bytes) {
  fake.allowed.push_back(bytes);
  return 0;
}
int cuGetErrorString(int, const char **text) {
  *text = "an error of the fake";
  return 0;
}

int nvrtcVersion(int *major, int *minor) {
  *major = 13;
  *minor = 0;
  return 0;
}
int nvrtcCreateProgram(void **program, const char *, const char *, int, const char *const *, const char *const *) {
  *program = &fake;
  return 0;
}
int nvrtcCompileProgram(void *, int, const char *const *) {
  fake.num_compiled++;
  return 0;
}
int nvrtcGetProgramLogSize(void *, std::size_t *bytes) {
  *bytes = 1;
  return 0;
}
int nvrtcGetProgramLog(void *, char *log) {
  *log = '\0';
  return 0;
}
int nvrtcGetCUBINSize(void *, std::size_t *bytes) {
  *bytes = sizeof compiled;
  return 0;
}
int nvrtcGetCUBIN(void *, char *code) {
  return copy_now(code, compiled, sizeof compiled);
}
int nvrtcDestroyProgram(void **program) {
  *program = nullptr;
  return 0;
}
const char *nvrtcGetErrorString(int) {
  return "an error of the fake";
}

// HIP's: what is like CUDA's, by its other name, and what is not.

int hipInit(unsigned) __attribute__((alias("cuInit")));
int hipGetDeviceCount(int *) __attribute__((alias("cuDeviceGetCount")));
int hipDeviceGetName(char *, int, int) __attribute__((alias("cuDeviceGetName")));
int hipMalloc(void **, std::size_t) __attribute__((alias("cuMemAlloc_v2")));
int hipFree(void *) __attribute__((alias("cuMemFree_v2")));
int hipMemcpyHtoDAsync(void *, const void *, std::size_t, void *) __attribute__((alias("cuMemcpyHtoDAsync_v2")));
int hipMemcpyDtoHAsync(void *, const void *, std::size_t, void *) __attribute__((alias("cuMemcpyDtoHAsync_v2")));
int hipMemcpyDtoDAsync(void *, const void *, std::size_t, void *) __attribute__((alias("cuMemcpyDtoDAsync_v2")));
int hipMemsetD8Async(void *, unsigned char, std::size_t, void *) __attribute__((alias("cuMemsetD8Async")));
int hipStreamSynchronize(void *) __attribute__((alias("cuStreamSynchronize")));
int hipEventCreateWithFlags(void **, unsigned) __attribute__((alias("cuEventCreate")));
int hipEventDestroy(void *) __attribute__((alias("cuEventDestroy_v2")));
int hipEventRecord(void *, void *) __attribute__((alias("cuEventRecord")));
int hipStreamWaitEvent(void *, void *, unsigned) __attribute__((alias("cuStreamWaitEvent")));
int hipModuleLoadData(void **, const void *) __attribute__((alias("cuModuleLoadData")));
int hipModuleUnload(void *) __attribute__((alias("cuModuleUnload")));
int hipModuleGetFunction(void **, void *, const char *) __attribute__((alias("cuModuleGetFunction")));
int hipModuleLaunchKernel(void *, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned, void *, void **,
                          void **) __attribute__((alias("cuLaunchKernel")));
int hipGraphCreate(void **, unsigned) __attribute__((alias("cuGraphCreate")));
int hipGraphInstantiateWithFlags(void **, void *, unsigned long long)
    __attribute__((alias("cuGraphInstantiateWithFlags")));
int hipGraphLaunch(void *, void *) __attribute__((alias("cuGraphLaunch")));
int hipGraphExecDestroy(void *) __attribute__((alias("cuGraphExecDestroy")));
int hipGraphDestroy(void *) __attribute__((alias("cuGraphDestroy")));
int hiprtcVersion(int *, int *) __attribute__((alias("nvrtcVersion")));
int hiprtcCreateProgram(void **, const char *, const char *, int, const char *const *, const char *const *)
    __attribute__((alias("nvrtcCreateProgram")));
int hiprtcCompileProgram(void *, int, const char *const *) __attribute__((alias("nvrtcCompileProgram")));
int hiprtcGetProgramLogSize(void *, std::size_t *) __attribute__((alias("nvrtcGetProgramLogSize")));
int hiprtcGetProgramLog(void *, char *) __attribute__((alias("nvrtcGetProgramLog")));
int hiprtcGetCodeSize(void *, std::size_t *) __attribute__((alias("nvrtcGetCUBINSize")));
int hiprtcGetCode(void *, char *) __attribute__((alias("nvrtcGetCUBIN")));
int hiprtcDestroyProgram(void **) __attribute__((alias("nvrtcDestroyProgram")));
const char *hiprtcGetErrorString(int) __attribute__((alias("nvrtcGetErrorString")));

int hipDeviceGetAttribute(int *value, int attribute, int) {
  return attribute_of(value, &Attribute::hip, attribute);
}
int hipGetDevice(int *device) {
  *device = fake.current == FakeVendors::none ? 0 : fake.current;
  return 0;
}
int hipSetDevice(int device) {
  fake.current = device;
  return 0;
}
int hipGraphAddKernelNode(void **node, void *graph, void *const *, std::size_t num_dependencies,
                          const HipKernel *kernel) {
  return add(node, graph, num_dependencies, *kernel);
}
int hipGraphExecKernelNodeSetParams(void *, void *node, const HipKernel *kernel) {
  return change(node, *kernel);
}
const char *hipGetErrorString(int) {
  return "an error of the fake";
}

}  // extern "C"
