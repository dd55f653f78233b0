#pragma once
#include <ceed.h>
#include <petscsystypes.h>

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "options/handle.hpp"
#include "swarm/swarm.hpp"

namespace hg {

/// Everything that depends on where the points are, with one lifetime: from the moment points are located to the moment
/// they move. Build a new one after every migration; what it hands out dies with it. Bases, mesh restrictions,
/// QFunctions and compiled kernels are not here: they live for the run.
class PointEpoch {
 public:
  /// Counting sort of the points by cell (stable: storage order within a cell), and the reference coordinates as a
  /// CeedVector. Not collective. Cells without points are fine, and so is a rank without points.
  /// Throws hg::Error if a point's cell is not in [0, num_cells): the swarm was not located.
  /// `ceed` is borrowed and must outlive the epoch. Movable.
  PointEpoch(Ceed ceed, std::int32_t num_cells, const Swarm &swarm);

  std::int32_t num_cells() const { return num_cells_; }
  std::int32_t num_points() const { return num_points_; }
  /// Points of cell c are order()[starts()[c] .. starts()[c+1]); order holds storage indices. starts: num_cells + 1.
  std::span<const std::int32_t> starts() const { return starts_; }
  std::span<const CeedInt> order() const { return std::span(offsets_).subspan(num_cells_ + 1); }
  /// Largest number of points in one cell; cells without points.
  std::int32_t max_points() const { return max_points_; }
  std::int32_t num_empty_cells() const { return num_empty_; }

  /// ξ of every point, 3 for each, in storage order (L-vector of points(3)). Owned by the epoch.
  CeedVector x_ref() const { return x_ref_; }

  /// Restriction at points for a field of num_comp components whose L-vector is in storage order, the components of a
  /// point next to each other: entry (point p, component c) at p num_comp + c. Made on first use, kept, owned by the
  /// epoch; CeedOperatorSetField takes its own reference.
  CeedElemRestriction points(CeedInt num_comp) const;

  /// A CeedVector with a copy of `values`: num_points × num_comp, storage order.
  CeedVectorHandle vector(CeedInt num_comp, std::span<const double> values) const;

 private:
  Ceed ceed_;
  std::int32_t num_cells_ = 0, num_points_ = 0, max_points_ = 0, num_empty_ = 0;
  std::vector<std::int32_t> starts_;
  std::vector<CeedInt> offsets_;  // as CeedElemRestrictionCreateAtPoints wants them
  CeedVectorHandle x_ref_;
  mutable std::map<CeedInt, CeedElemRestrictionHandle> rstr_;
};

}  // namespace hg
