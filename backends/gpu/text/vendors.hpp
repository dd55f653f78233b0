/// The language of kernels for CUDA and HIP, whose compilers have no standard library.
#define CEED_RUNNING_JIT_PASS
#define CEED_QFUNCTION_ATTR
#define CEED_QFUNCTION_HELPER_ATTR
#define CEED_QFUNCTION(name) static __device__ int name
#define CEED_QFUNCTION_HELPER static __device__ inline
#define HG_DEVICE __device__ inline
#define HG_KERNEL(name, Job) extern "C" __global__ void __launch_bounds__(256) name(const Job job)
#define HG_SHARED(name) extern __shared__ double name[]

typedef decltype(static_cast<char *>(nullptr) - static_cast<char *>(nullptr)) ptrdiff_t;
typedef int int32_t;
#ifdef __CUDACC_RTC__  // the other compiler has these
typedef signed char int8_t;
typedef short int16_t;
typedef long int64_t;
typedef unsigned char uint8_t;
typedef unsigned short uint16_t;
typedef unsigned int uint32_t;
typedef unsigned long uint64_t;
#endif

namespace hg::gpu {

__device__ inline int thread() {
  return static_cast<int>(threadIdx.x);
}
__device__ inline int num_threads() {
  return static_cast<int>(blockDim.x);
}
__device__ inline ptrdiff_t block() {
  return static_cast<ptrdiff_t>(blockIdx.x);
}
__device__ inline ptrdiff_t num_blocks() {
  return static_cast<ptrdiff_t>(gridDim.x);
}
__device__ inline ptrdiff_t index() {
  return block() * num_threads() + thread();
}
__device__ inline void barrier() {
  __syncthreads();
}

}  // namespace hg::gpu
