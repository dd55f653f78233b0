/// @file
/// Random input that is the same on every machine: a fixed seed, and no distribution of the standard library. Or input
/// that bytes decide, for fuzzing.
#pragma once

#include <ceed.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace hg::test {

/// How many of `all` random cases to run: HG_CASES in a hundred, all where it is not set; a quarter of them where
/// sanitizers make each ten times as long.
inline int num_cases(int all) {
  const char *wanted = std::getenv("HG_CASES");
  const long percent = wanted != nullptr ? std::strtol(wanted, nullptr, 10) : 100;
  if (percent < 1 || percent > 100) {
    throw std::runtime_error("HG_CASES is '" + std::string(wanted) + "'; expected 1 to 100, in a hundred");
  }
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr long part = 4;
#else
  constexpr long part = 1;
#endif
  return static_cast<int>((all * percent + 100 * part - 1) / (100 * part));
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Each integer, chance and choice takes a byte; when these are used up, integers are `low` and chances are not
  /// taken. Real numbers take none. The bytes must outlive this.
  explicit Random(std::span<const std::uint8_t> bytes) : engine_(0), bytes_(bytes), is_by_bytes_(true) {}
  /// An integer in [low, high].
  CeedInt integer(CeedInt low, CeedInt high) {
    const auto range = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<CeedInt>((is_by_bytes_ ? next_byte() : engine_()) % range);
  }
  /// The next byte, 0 when they are used up.
  std::uint8_t next_byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }
  bool has_bytes() const { return !bytes_.empty(); }
  /// A number in [low, high).
  CeedScalar real(CeedScalar low = -1, CeedScalar high = 1) {
    const double unit = static_cast<double>(engine_() >> 11) * 0x1.0p-53;
    return static_cast<CeedScalar>(low + (high - low) * unit);
  }
  bool chance(double probability) {
    return is_by_bytes_ ? next_byte() > 255 - 256 * probability : real(0, 1) < probability;
  }
  std::vector<CeedScalar> reals(CeedSize count, CeedScalar low = -1, CeedScalar high = 1) {
    std::vector<CeedScalar> values(static_cast<std::size_t>(count));
    for (CeedScalar &value : values) value = real(low, high);
    return values;
  }
  /// `count` different integers of [0, below).
  std::vector<CeedInt> distinct(CeedInt count, CeedInt below) {
    std::vector<CeedInt> all(static_cast<std::size_t>(below));
    std::iota(all.begin(), all.end(), 0);
    if (is_by_bytes_) {  // one byte for the whole choice
      for (std::uint64_t i = 0, state = next_byte(); i < static_cast<std::uint64_t>(count); i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        std::swap(all[i], all[i + (state >> 33) % (static_cast<std::uint64_t>(below) - i)]);
      }
      all.resize(static_cast<std::size_t>(count));
      return all;
    }
    for (CeedInt i = 0; i < count; i++) std::swap(all[i], all[integer(i, below - 1)]);
    all.resize(static_cast<std::size_t>(count));
    return all;
  }

 private:
  std::mt19937_64 engine_;
  std::span<const std::uint8_t> bytes_;
  bool is_by_bytes_ = false;
};

}  // namespace hg::test
