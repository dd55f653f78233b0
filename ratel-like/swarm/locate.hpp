#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "swarm/cell_grid.hpp"

namespace hg {

enum class PointPlace : std::uint8_t {
  kInside,   ///< in the local cell given
  kRemote,   ///< on another rank's side: remote[index] of the grid
  kOutside,  ///< the walk ended at the domain's boundary (or found no cell)
};

/// Answer for one point.
struct Location {
  PointPlace place = PointPlace::kOutside;
  std::int32_t index = -1;         ///< kInside: local cell; kRemote: index into CellGrid::remote; kOutside: last cell
  double xi[3] = {0.0, 0.0, 0.0};  ///< reference coordinate in the cell given (kInside), or in the last cell walked
};

/// Finds the trilinear hexahedron that holds a point, and the reference coordinate in it.
///
/// The cell map is x(ξ) = Σ_b x_b Π_d (1 + s_bd ξ_d)/2, s_bd = ±1 by bit d of b. Cells whose bilinear and trilinear
/// terms vanish (boxes, parallelepipeds) are inverted in closed form, the others by Newton.
///
/// A search walks from a first guess across the face that is violated most; without a guess it starts from a hash
/// grid of cell bounding boxes. A point within `kFaceTolerance` (in ξ) of a face belongs to every cell that it touches;
/// its owner is found by walking to the touching face neighbour that is smallest by `cell_less`, a rule of coordinates
/// alone, so that the owner depends neither on the partition nor on the numbering.
///
/// Holds a reference to the grid, which must outlive it and not change. Const calls are safe from several threads.
class HexLocator {
 public:
  static constexpr double kFaceTolerance = 1e-10;

  /// Throws std::invalid_argument, naming the cell and its smallest corner Jacobian, when a cell is inverted or flat.
  explicit HexLocator(const CellGrid &grid);
  ~HexLocator();
  HexLocator(HexLocator &&) noexcept;
  HexLocator(const HexLocator &) = delete;

  /// Walk from cell `guess` (0 <= guess < num_cells).
  Location walk(const double x[3], std::int32_t guess) const;

  /// Search without a guess, in this rank's cells only: kInside (smallest touching cell by cell_less) or kOutside.
  Location find(const double x[3]) const;

  /// Many points: walks from cells[i] where that is a cell, and calls find() where it is negative. A walk that ends
  /// outside is tried once more by find(), so that a concave boundary is no obstacle.
  /// x: n × 3; cells: n, in: guess or -1, out: Location::index; xi: n × 3 out; place: n out. Returns how many are
  /// inside.
  std::size_t locate(std::span<const double> x, std::span<std::int32_t> cells, std::span<double> xi,
                     std::span<PointPlace> place) const;

  /// The local cell nearest to x and the point of it that is nearest along the cell's own coordinates (ξ clamped to
  /// [-1, 1]³). Slow, for reports and the `project` policy. index = -1 on a rank without cells. Returns the distance.
  double nearest(const double x[3], Location &where) const;

  /// x(ξ) in cell c.
  void map(std::int32_t c, const double xi[3], double x[3]) const;
  /// dxdX[i*3+j] = ∂x_i/∂ξ_j in cell c at ξ; returns its determinant.
  double jacobian(std::int32_t c, const double xi[3], double dxdX[9]) const;
  /// ∫ det J over cell c (exact: 2-point Gauss).
  double cell_volume(std::int32_t c) const;

  /// Cells with a closed-form inverse.
  std::int32_t num_affine() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Strict order of cells by geometry alone: bounding box minimum x, y, z, then maximum, then the sorted corners.
/// The same whatever the order of the corners, the partition or the numbering; distinct cells never tie.
bool cell_less(std::span<const double, 24> a, std::span<const double, 24> b);

}  // namespace hg
