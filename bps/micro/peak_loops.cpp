/// Loops of one instruction set, see HG_HOST_ISA in pack.hpp. The empty assembler statements make the compiler do what
/// has no effect.
#include "peak_loops.hpp"

#include "pack.hpp"

// Where vector registers are kept, as the compilers name them.
#if defined(__AVX512F__)
#define HG_REGISTER "v"
#elif defined(__x86_64__)
#define HG_REGISTER "x"
#else
#define HG_REGISTER "w"
#endif

namespace hg::micro::HG_HOST_ISA {

namespace {

using host::HG_HOST_ISA::fma;
using host::HG_HOST_ISA::load;
using host::HG_HOST_ISA::Pack;
using host::HG_HOST_ISA::store;
constexpr int W = host::HG_HOST_ISA::W;

constexpr int per_step = 16;
/// Sums that do not wait for one another; with two factors they fill the sixteen registers of SSE2.
constexpr int num_sums = 14;

void fmas(long steps, CeedScalar *numbers) {
  Pack sums[num_sums], factor = load(numbers), term = load(numbers + W);
#pragma GCC unroll 16
  for (int i = 0; i < num_sums; i++) sums[i] = load(numbers);
  for (long step = 0; step < steps; step++) {
#pragma GCC unroll 16
    for (int i = 0; i < num_sums; i++) {
      sums[i] = fma(sums[i], factor, term);
      asm volatile("" : "+" HG_REGISTER(sums[i]));
    }
  }
}

void loads(long steps, CeedScalar *numbers) {
  for (long step = 0; step < steps; step++) {
#pragma GCC unroll 16
    for (int i = 0; i < per_step; i++) asm volatile("" : : HG_REGISTER(load(numbers + i * W)) : "memory");
  }
}

void stores(long steps, CeedScalar *numbers) {
  const Pack value = load(numbers);
  for (long step = 0; step < steps; step++) {
#pragma GCC unroll 16
    for (int i = 0; i < per_step; i++) {
      store(numbers + i * W, value);
      asm volatile("" : : : "memory");
    }
  }
}

void number_loads(long steps, CeedScalar *numbers) {
  for (long step = 0; step < steps; step++) {
#pragma GCC unroll 16
    for (int i = 0; i < per_step; i++) asm volatile("" : : HG_REGISTER(numbers[i]) : "memory");
  }
}

void number_stores(long steps, CeedScalar *numbers) {
  const CeedScalar value = numbers[0];
  for (long step = 0; step < steps; step++) {
#pragma GCC unroll 16
    for (int i = 0; i < per_step; i++) {
      numbers[i] = value;
      asm volatile("" : : : "memory");
    }
  }
}

}  // namespace

const PeakLoops peak_loops{
    {fmas, num_sums}, {loads, per_step}, {stores, per_step}, {number_loads, per_step}, {number_stores, per_step}};

}  // namespace hg::micro::HG_HOST_ISA
