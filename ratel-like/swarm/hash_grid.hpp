#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "swarm/cell_grid.hpp"

namespace hg {

/// Uniform bins over the bounding box of a grid, about one for each cell; a bin lists the cells whose bounding box,
/// widened by `slack` of its own size, meets it. A cell that holds x is among the candidates of x.
class HashGrid {
 public:
  HashGrid(const CellGrid &grid, double slack) {
    const std::int32_t n = grid.num_cells();
    std::vector<std::array<double, 6>> boxes(n);
    lower_.fill(std::numeric_limits<double>::infinity());
    upper_.fill(-std::numeric_limits<double>::infinity());
    for (std::int32_t c = 0; c < n; c++) {
      boxes[c] = widened_box(grid.cell_corners(c), slack);
      for (int d = 0; d < 3; d++) {
        lower_[d] = std::min(lower_[d], boxes[c][d]);
        upper_[d] = std::max(upper_[d], boxes[c][3 + d]);
      }
    }
    if (n == 0) return;
    // Bins as near to cubes as the box allows.
    double volume = 1.0;
    for (int d = 0; d < 3; d++) volume *= upper_[d] - lower_[d];
    const double h = std::cbrt(volume / n);
    for (int d = 0; d < 3; d++) {
      const double extent = upper_[d] - lower_[d];
      bins_[d] = static_cast<std::int32_t>(std::clamp(std::ceil(extent / h), 1.0, 4.0 * std::cbrt(1.0 * n) + 1.0));
      scale_[d] = bins_[d] / extent;
    }
    starts_.assign(static_cast<std::size_t>(bins_[0]) * bins_[1] * bins_[2] + 1, 0);
    for (int pass = 0; pass < 2; pass++) {
      for (std::int32_t c = 0; c < n; c++) {
        std::array<std::int32_t, 3> lo, hi;
        for (int d = 0; d < 3; d++) {
          lo[d] = bin(boxes[c][d], d);
          hi[d] = bin(boxes[c][3 + d], d);
        }
        for (std::int32_t k = lo[2]; k <= hi[2]; k++) {
          for (std::int32_t j = lo[1]; j <= hi[1]; j++) {
            for (std::int32_t i = lo[0]; i <= hi[0]; i++) {
              const std::size_t b = index(i, j, k);
              if (pass == 0) {
                starts_[b + 1]++;
              } else {
                cells_[starts_[b]++] = c;
              }
            }
          }
        }
      }
      if (pass == 0) {
        for (std::size_t b = 1; b < starts_.size(); b++) starts_[b] += starts_[b - 1];
        cells_.resize(starts_.back());
      } else {  // filling moved each start to its end
        for (std::size_t b = starts_.size() - 1; b > 0; b--) starts_[b] = starts_[b - 1];
        starts_[0] = 0;
      }
    }
  }

  /// Cells that may hold x; empty outside the bounding box.
  std::span<const std::int32_t> candidates(const double x[3]) const {
    for (int d = 0; d < 3; d++) {
      if (!(x[d] >= lower_[d] && x[d] <= upper_[d])) return {};
    }
    const std::size_t b = index(bin(x[0], 0), bin(x[1], 1), bin(x[2], 2));
    return {cells_.data() + starts_[b], starts_[b + 1] - starts_[b]};
  }

 private:
  static std::array<double, 6> widened_box(std::span<const double, 24> corners, double slack) {
    std::array<double, 6> box;
    double size = 0.0;
    for (int d = 0; d < 3; d++) {
      box[d] = box[3 + d] = corners[d];
      for (int b = 1; b < 8; b++) {
        box[d] = std::min(box[d], corners[3 * b + d]);
        box[3 + d] = std::max(box[3 + d], corners[3 * b + d]);
      }
      size = std::max(size, box[3 + d] - box[d]);
    }
    for (int d = 0; d < 3; d++) {
      box[d] -= slack * size;
      box[3 + d] += slack * size;
    }
    return box;
  }
  std::int32_t bin(double x, int d) const {
    return std::clamp(static_cast<std::int32_t>((x - lower_[d]) * scale_[d]), 0, bins_[d] - 1);
  }
  std::size_t index(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return i + static_cast<std::size_t>(bins_[0]) * (j + static_cast<std::size_t>(bins_[1]) * k);
  }

  std::array<double, 3> lower_{}, upper_{}, scale_{};
  std::array<std::int32_t, 3> bins_{1, 1, 1};
  std::vector<std::size_t> starts_;
  std::vector<std::int32_t> cells_;
};

}  // namespace hg
