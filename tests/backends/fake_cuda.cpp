// The calls of CUDA's driver and compiler that the backends make, by their names and arguments. Built as a library that
// is loaded instead.
#include "fake_cuda.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

FakeCuda fake_cuda;

namespace {

constexpr int out_of_memory = 2, invalid_value = 1, invalid_context = 201, no_binary = 209;
constexpr int num_devices = 2;
constexpr char compiled[] = "code";

/// A node of a graph: what it was added or changed with, copied.
using Node = FakeCuda::Called;
using Graph = std::vector<Node *>;

/// CUDA_KERNEL_NODE_PARAMS up to its arguments.
struct KernelNode {
  void *function;
  unsigned grid[3], block[3], shared_bytes;
  void **arguments, **extra;
};
Node read(const KernelNode &kernel) {
  return {.function = kernel.function,
          .job = *static_cast<const int *>(kernel.arguments[0]),
          .num_blocks = kernel.grid[0],
          .num_threads = kernel.block[0],
          .shared_bytes = kernel.shared_bytes};
}

int copy_now(void *to, const void *from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
  return 0;
}
int copy_on(void *stream, void *to, const void *from, std::size_t bytes) {
  fake_cuda.worked_on.push_back(stream);
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
  constexpr int max_threads = 1, warp_size = 10, num_processors = 16, major = 75, minor = 76, shared_per_block = 97;
  switch (attribute) {
    case max_threads:
      *value = 1024;
      return 0;
    case warp_size:
      *value = 32;
      return 0;
    case num_processors:
      *value = 4;
      return 0;
    case major:
      *value = 9;
      return 0;
    case minor:
      *value = 0;
      return 0;
    case shared_per_block:
      *value = 64 << 10;
      return 0;
    default:
      return invalid_value;
  }
}
int cuCtxGetDevice(int *device) {
  if (fake_cuda.current == FakeCuda::none) return invalid_context;
  *device = fake_cuda.current;
  return 0;
}
int cuDevicePrimaryCtxRetain(void **context, int device) {
  fake_cuda.num_retained++;
  *context = reinterpret_cast<void *>(static_cast<std::intptr_t>(device) + 1);
  return 0;
}
int cuCtxSetCurrent(void *context) {
  fake_cuda.current = static_cast<int>(reinterpret_cast<std::intptr_t>(context)) - 1;
  return 0;
}
int cuMemAlloc_v2(void **memory, std::size_t bytes) {
  if (fake_cuda.is_full) return out_of_memory;
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
  fake_cuda.worked_on.push_back(stream);
  std::memset(memory, value, bytes);
  return 0;
}
int cuEventCreate(void **event, unsigned) {
  fake_cuda.num_events++;
  *event = &fake_cuda.recorded;
  return 0;
}
int cuEventDestroy_v2(void *) {
  fake_cuda.num_events--;
  return 0;
}
int cuEventRecord(void *event, void *stream) {
  *static_cast<void **>(event) = stream;
  return 0;
}
int cuStreamWaitEvent(void *stream, void *event, unsigned) {
  fake_cuda.waits.emplace_back(stream, *static_cast<void **>(event));
  return 0;
}
int cuStreamSynchronize(void *stream) {
  fake_cuda.waited_for.push_back(stream);
  return 0;
}
int cuModuleLoadData(void **module, const void *code) {
  if (fake_cuda.refused_loads > 0) {
    fake_cuda.refused_loads--;
    return no_binary;
  }
  *module = std::strcmp(static_cast<const char *>(code), compiled) == 0 ? &fake_cuda : nullptr;
  return *module != nullptr ? 0 : invalid_value;
}
int cuModuleUnload(void *) {
  return 0;
}
int cuModuleGetFunction(void **function, void *, const char *) {
  if (!fake_cuda.reuses_functions || fake_cuda.num_functions == 0) fake_cuda.num_functions++;
  *function = reinterpret_cast<void *>(static_cast<std::intptr_t>(fake_cuda.num_functions));
  return 0;
}
int cuLaunchKernel(void *function, unsigned num_blocks, unsigned, unsigned, unsigned num_threads, unsigned, unsigned,
                   unsigned, void *stream, void **arguments, void **) {
  fake_cuda.num_launched++;
  fake_cuda.worked_on.push_back(stream);
  if (function != &fake_cuda.user_kernel) return 0;
  const auto *fields = static_cast<const void *const *>(arguments[2]);  // 16 inputs, then outputs
  fake_cuda.user_call = {.context = *static_cast<void **>(arguments[0]),
                         .Q = *static_cast<const int *>(arguments[1]),
                         .first_input = fields[0],
                         .first_output = fields[16],
                         .num_blocks = num_blocks,
                         .num_threads = num_threads,
                         .stream = stream};
  return 0;
}
int cuGraphCreate(void **graph, unsigned) {
  fake_cuda.num_graphs++;
  *graph = new Graph;
  return 0;
}
int cuGraphAddKernelNode(void **node, void *graph, void *const *, std::size_t num_dependencies,
                         const KernelNode *kernel) {
  if (num_dependencies > 0) return invalid_value;
  auto *added = new Node(read(*kernel));
  static_cast<Graph *>(graph)->push_back(added);
  *node = added;
  return 0;
}
int cuGraphInstantiateWithFlags(void **executable, void *graph, unsigned long long) {
  if (fake_cuda.refused_graphs > 0) {
    fake_cuda.refused_graphs--;
    return invalid_value;
  }
  fake_cuda.num_executables++;
  fake_cuda.num_made++;
  *executable = graph;
  return 0;
}
int cuGraphExecKernelNodeSetParams(void *, void *node, const KernelNode *kernel) {
  if (fake_cuda.refused_changes > 0) {
    fake_cuda.refused_changes--;
    return invalid_value;
  }
  fake_cuda.num_changed++;
  *static_cast<Node *>(node) = read(*kernel);
  return 0;
}
int cuGraphLaunch(void *executable, void *stream) {
  for (const Node *node : *static_cast<Graph *>(executable)) {
    fake_cuda.called.push_back(*node);
    fake_cuda.called.back().stream = stream;
  }
  return 0;
}
int cuGraphExecDestroy(void *) {
  fake_cuda.num_executables--;
  return 0;
}
int cuGraphDestroy(void *graph) {
  fake_cuda.num_graphs--;
  for (const Node *node : *static_cast<Graph *>(graph)) delete node;
  delete static_cast<Graph *>(graph);
  return 0;
}
int cuFuncSetAttribute(void *, int, int bytes) {
  fake_cuda.allowed.push_back(bytes);
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
  *program = &fake_cuda;
  return 0;
}
int nvrtcCompileProgram(void *, int, const char *const *) {
  fake_cuda.num_compiled++;
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

}  // extern "C"
