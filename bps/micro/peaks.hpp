/// @file
/// What a core can do at most with an instruction set, measured.
#pragma once

#include "cases.hpp"

namespace hg::micro {

/// Instructions a second: on packs, and on single numbers, in arrays that the first-level cache holds.
struct Peaks {
  double fmas, loads, stores, number_loads, number_stores;
};

/// Measured here and now, best of many: some 0.1 s.
Peaks measure_peaks(const InstructionSet &set);

/// Seconds that the floor of a call takes at these rates: arithmetic, loads and stores side by side.
double floor_seconds(const Work &work, const Peaks &peaks);

}  // namespace hg::micro
