/// @file
/// Loops that do nothing but one kind of instruction, compiled once for each instruction set.
#pragma once

#include <ceed/types.h>

namespace hg::micro {

/// Numbers that a loop may read and write.
inline constexpr int peak_array_size = 16 * 8;

struct PeakLoop {
  void (*run)(long steps, CeedScalar *numbers);  ///< `numbers`: peak_array_size, aligned to CEED_ALIGN
  int instructions;                              ///< of the kind, in each step
};

struct PeakLoops {
  PeakLoop fmas;           ///< multiplications with additions of packs
  PeakLoop loads, stores;  ///< of packs
  PeakLoop number_loads, number_stores;
};

namespace portable {
extern const PeakLoops peak_loops;
}
namespace avx2 {
extern const PeakLoops peak_loops;
}
namespace avx512 {
extern const PeakLoops peak_loops;
}

}  // namespace hg::micro
