#include "peaks.hpp"

#include <ceed/backend.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "peak_loops.hpp"

namespace hg::micro {

namespace {

const PeakLoops &loops_of(const InstructionSet &set) {
#ifdef HG_HOST_X86
  if (set.name == "avx512") return avx512::peak_loops;
  if (set.name == "avx2") return avx2::peak_loops;
#else
  static_cast<void>(set);
#endif
  return portable::peak_loops;
}

}  // namespace

Peaks measure_peaks(const InstructionSet &set) {
  constexpr int rounds = 80;
  constexpr long steps = 1 << 16;
  alignas(CEED_ALIGN) std::array<CeedScalar, peak_array_size> numbers{};
  numbers.fill(0.5);
  const PeakLoops &loops = loops_of(set);
  Peaks peaks{};
  // In turn, so that what else runs on the machine for a while harms none of them alone.
  const auto measure = [&](const PeakLoop &loop, double &best) {
    const auto start = std::chrono::steady_clock::now();
    loop.run(steps, numbers.data());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    best = std::max(best, static_cast<double>(steps) * loop.instructions / seconds.count());
  };
  for (int round = 0; round < rounds; round++) {
    measure(loops.fmas, peaks.fmas);
    measure(loops.loads, peaks.loads);
    measure(loops.stores, peaks.stores);
    measure(loops.number_loads, peaks.number_loads);
    measure(loops.number_stores, peaks.number_stores);
  }
  return peaks;
}

double floor_seconds(const Work &work, const Peaks &peaks) {
  return std::max({work.fmas / peaks.fmas, work.loads / peaks.loads + work.number_loads / peaks.number_loads,
                   work.stores / peaks.stores + work.number_stores / peaks.number_stores});
}

}  // namespace hg::micro
