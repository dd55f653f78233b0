/// @file
/// Random input that is the same on every machine: a fixed seed, and no distribution of the standard library.
#pragma once

#include <ceed.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace hg::test {

/// How many of `all` random cases to run: a quarter where sanitizers make each ten times as long.
constexpr int num_cases(int all) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return (all + 3) / 4;
#else
  return all;
#endif
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// An integer in [low, high].
  CeedInt integer(CeedInt low, CeedInt high) {
    const auto range = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<CeedInt>(engine_() % range);
  }
  /// A number in [low, high).
  CeedScalar real(CeedScalar low = -1, CeedScalar high = 1) {
    const double unit = static_cast<double>(engine_() >> 11) * 0x1.0p-53;
    return static_cast<CeedScalar>(low + (high - low) * unit);
  }
  bool chance(double probability) { return real(0, 1) < probability; }
  std::vector<CeedScalar> reals(CeedSize count, CeedScalar low = -1, CeedScalar high = 1) {
    std::vector<CeedScalar> values(static_cast<std::size_t>(count));
    for (CeedScalar &value : values) value = real(low, high);
    return values;
  }
  /// `count` different integers of [0, below).
  std::vector<CeedInt> distinct(CeedInt count, CeedInt below) {
    std::vector<CeedInt> all(static_cast<std::size_t>(below));
    std::iota(all.begin(), all.end(), 0);
    for (CeedInt i = 0; i < count; i++) std::swap(all[i], all[integer(i, below - 1)]);
    all.resize(static_cast<std::size_t>(count));
    return all;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hg::test
