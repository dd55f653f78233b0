#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hg {

/// What points need to know of the hexahedra of one rank; plain data, no PETSc.
///
/// Corner order is the tensor order: corner b has reference coordinate ξ_d = -1 where bit d of b is 0 and +1 where it
/// is 1. Face order is -ξ0, +ξ0, -ξ1, +ξ1, -ξ2, +ξ2 (index 2 d + side).
struct CellGrid {
  /// The cell behind a face at a rank border, as that rank numbers it. Its corners decide ties without a message.
  struct RemoteFace {
    std::int32_t rank = -1;
    std::int32_t cell = -1;
    std::array<double, 24> corners{};
  };

  static constexpr std::int32_t kBoundary = -1;  ///< neighbour value: the face is on the domain's boundary
  /// Neighbour value of the face whose remote side is remote[k].
  static constexpr std::int32_t remote_link(std::int32_t k) { return -2 - k; }
  /// Inverse of remote_link; negative for a local neighbour or the boundary.
  static constexpr std::int32_t remote_index(std::int32_t neighbour) { return -2 - neighbour; }

  std::vector<double> corners;           ///< num_cells × 8 × 3, metres
  std::vector<std::int32_t> neighbours;  ///< num_cells × 6: local cell, kBoundary or remote_link(k)
  std::vector<RemoteFace> remote;        ///< cells behind faces at rank borders
  std::vector<std::int64_t> cell_ids;  ///< num_cells: number of the cell in the whole mesh, the same on every partition

  std::int32_t num_cells() const { return static_cast<std::int32_t>(corners.size() / 24); }
  std::span<const double, 24> cell_corners(std::int32_t c) const {
    return std::span<const double, 24>(corners.data() + 24 * static_cast<std::size_t>(c), 24);
  }
};

/// Structured box of nx × ny × nz cells on [lower, upper] on one rank (tests, benchmarks).
/// `map`, if given, moves each corner: void(double x[3]).
CellGrid make_box_grid(std::array<int, 3> cells, std::array<double, 3> lower, std::array<double, 3> upper,
                       void (*map)(double *x) = nullptr);

}  // namespace hg
