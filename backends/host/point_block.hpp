/// @file
/// The points of a block of elements, and how they lie in its arrays.
#pragma once

#include <ceed/plugin.h>

#include <vector>

#include "kernels.hpp"

namespace hg::host {

/// The points of at most W elements: along one element after another; or across the elements, the k-th point of the
/// element in a lane at k*W + lane, where elements that do not have so many repeat their last one (and elements without
/// points that of another element).
class PointBlock {
 public:
  /// `may_lie_across`: points may be repeated. `points`: the restriction of their coordinates.
  PointBlock(const CeedElementMap &points, CeedInt W, CeedInt vec_length, bool may_lie_across, CeedInt first,
             CeedInt num_elem);

  CeedInt first() const { return first_; }
  CeedInt num_elem() const { return num_elem_; }
  CeedInt num_points() const { return num_points_; }  ///< of all elements
  CeedInt num_points_in(CeedInt lane) const { return counts_[lane]; }
  bool is_across() const { return is_across_; }
  /// Points in the arrays: along, one for each; across, repeated ones as well.
  CeedInt size() const { return is_across_ ? most_ * W_ : num_points_; }
  /// The same, up to a multiple of the QFunction's vector length: numbers between components.
  CeedInt stride() const { return stride_; }
  /// Packs of W points: along, each element has its own.
  CeedInt num_packs() const;

  /// Where size() points are listed in a restriction at points; `room` is for a list that is made.
  const CeedInt *places(const CeedElementMap &map, std::vector<CeedInt> &room) const;
  /// Sets values at points that are repeated to 0; NULL is left alone.
  void drop_repeated(CeedInt num_comp, CeedScalar *values) const;
  /// Calls visit(first, count) for runs of points in the arrays that are not repeated ones: each point once.
  template <typename Visit>
  void for_each_run(Visit &&visit) const {
    if (!is_across_) return visit(0, num_points_);
    if (least_ > 0) visit(0, least_ * W_);
    for (CeedInt k = least_; k < most_; k++) {
      for (CeedInt lane = 0; lane < num_elem_; lane++) {
        if (k < counts_[lane]) visit(k * W_ + lane, 1);
      }
    }
  }

 private:
  CeedInt W_, first_, num_elem_, num_points_, stride_;
  CeedInt counts_[max_width] = {};
  CeedInt most_ = 0, least_ = 0;
  bool is_across_ = false;
};

}  // namespace hg::host
