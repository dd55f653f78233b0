/// @file
/// Products of tall panels, summed in registers: the inner loop of assembly.
#pragma once

#include <ceed/types.h>

#include <algorithm>

namespace hg {

/// Rows and columns that are summed at once; panels are padded to multiples of it.
inline constexpr CeedInt panel_tile = 4;

inline CeedInt pad_to_tile(CeedInt n) {
  return (n + panel_tile - 1) / panel_tile * panel_tile;
}

/// Rows of a panel, of `width` numbers each, that stay in the first cache beside those of another.
inline CeedInt panel_rows(CeedInt width) {
  return std::max<CeedInt>(2048 / std::max<CeedInt>(width, 1), 16);
}

/// C[m*c_stride + n] += Σ_i A[i*a_stride + m] B[i*b_stride + n] for i < count, m < num_rows, n < num_columns. A and B
/// are read up to the padded widths. Flops: 2 count num_rows num_columns.
inline void add_panel_product(CeedInt count, const CeedScalar *A, CeedSize a_stride, CeedInt num_rows,
                              const CeedScalar *B, CeedSize b_stride, CeedInt num_columns, CeedScalar *C,
                              CeedSize c_stride) {
  for (CeedInt m = 0; m < num_rows; m += panel_tile) {
    for (CeedInt n = 0; n < num_columns; n += panel_tile) {
      CeedScalar sum[panel_tile][panel_tile] = {};
      const CeedScalar *a = A + m, *b = B + n;
      for (CeedInt i = 0; i < count; i++, a += a_stride, b += b_stride) {
        for (CeedInt j = 0; j < panel_tile; j++) {
          for (CeedInt k = 0; k < panel_tile; k++) sum[j][k] += a[j] * b[k];
        }
      }
      for (CeedInt j = 0; j < std::min(panel_tile, num_rows - m); j++) {
        for (CeedInt k = 0; k < std::min(panel_tile, num_columns - n); k++) C[(m + j) * c_stride + n + k] += sum[j][k];
      }
    }
  }
}

}  // namespace hg
