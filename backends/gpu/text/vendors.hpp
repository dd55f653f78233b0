/// The language of kernels for CUDA and HIP, whose compilers have no standard library.
#define CEED_RUNNING_JIT_PASS
#define CEED_QFUNCTION_ATTR
#define CEED_QFUNCTION_HELPER_ATTR
#define CEED_QFUNCTION(name) static __device__ int name
#define CEED_QFUNCTION_HELPER static __device__ inline
#define HG_DEVICE __device__ inline
#define HG_KERNEL(name, Job) extern "C" __global__ void __launch_bounds__(256) name(const Job job)
/// The same for blocks of `most` threads, `blocks` of which a processor is to hold, and a job that is read as it is
/// needed.
#ifdef __CUDACC_RTC__
#define HG_KERNEL_OF(name, Job, most, blocks) \
  extern "C" __global__ void __launch_bounds__(most, blocks) name(const __grid_constant__ Job job)
#else
#define HG_KERNEL_OF(name, Job, most, blocks) extern "C" __global__ void __launch_bounds__(most) name(const Job job)
#endif
#define HG_UNROLL _Pragma("unroll")
#define HG_ROLLED _Pragma("unroll 1")
/// Unrolled by a number that the compiler knows.
#define HG_PRAGMA(text) _Pragma(#text)
#define HG_UNROLL_BY(count) HG_PRAGMA(unroll(count))
#define HG_SHARED(name) extern __shared__ __align__(16) double name[]

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
/// Waits for the threads of the warp, with what they have written to shared memory.
__device__ inline void warp_barrier() {
#ifdef __CUDACC_RTC__
  __syncwarp();
#else
  __builtin_amdgcn_fence(__ATOMIC_RELEASE, "wavefront");
  __builtin_amdgcn_wave_barrier();
  __builtin_amdgcn_fence(__ATOMIC_ACQUIRE, "wavefront");
#endif
}
/// Numbers for those of the thread whose number differs in the bit `distance`; all threads of a warp come here.
template <int count>
__device__ inline void exchange(double *values, int distance) {
  HG_UNROLL for (int i = 0; i < count; i++) {
#ifdef __CUDACC_RTC__
    values[i] = __shfl_xor_sync(0xffffffff, values[i], distance);
#else
    values[i] = __shfl_xor(values[i], distance);
#endif
  }
}
using SharedArray = double *;
/// Two numbers of shared memory from an even place on.
struct alignas(16) Pair {
  double first, second;
};
__device__ inline Pair read_pair(SharedArray array, int place) {
  return *reinterpret_cast<const Pair *>(array + place);
}
__device__ inline void write_pair(SharedArray array, int place, Pair pair) {
  *reinterpret_cast<Pair *>(array + place) = pair;
}
__device__ inline void atomic_add(double *to, double value) {
  atomicAdd(to, value);
}
/// Brings a line of memory nearer.
__device__ inline void prefetch([[maybe_unused]] const void *place) {
#ifdef __CUDACC_RTC__
  asm volatile("prefetch.global.L2 [%0];" ::"l"(place));
#endif
}

}  // namespace hg::gpu
