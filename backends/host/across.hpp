/// @file
/// Which points lie side by side.
#pragma once

#include <ceed/types.h>

namespace hg::host {

/// Points of W elements are worked on W at a time, along one element after another, or across the elements, one point
/// of each. Across there are as many steps as the element with most points has points, an eighth dearer, for the points
/// come from W places. Along an element each W points are one step, the last ones too where they are fewer; and the
/// sums of all coefficients over the lanes are half a step more. (Measured; docs/performance/cpu.md.)
inline bool pays_across(const CeedInt *num_points, CeedInt W) {
  CeedInt most = 0;
  CeedSize along = 0;  // eighths of a step
  for (CeedInt lane = 0; lane < W; lane++) {
    const CeedInt n = num_points[lane];
    if (n > most) most = n;
    if (n > 0) along += 8 * ((static_cast<CeedSize>(n) + W - 1) / W) + 4;
  }
  return 9 * static_cast<CeedSize>(most) <= along;
}

}  // namespace hg::host
