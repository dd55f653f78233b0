/// @file
/// A restriction for a block of elements.
#pragma once

#include <ceed/plugin.h>

#include <cstddef>

#include "kernels.hpp"

namespace hg::host {

/// R_e = T_e G_e (see CeedElementMap) for W elements side by side. A block's array is (component, node), node fastest,
/// W numbers each. Valid while the restriction lives. Not for restrictions at points.
class BlockMap {
 public:
  BlockMap(const Kernels &kernels, CeedElemRestriction rstr);

  /// Numbers of a block's array.
  std::size_t block_size() const {
    return static_cast<std::size_t>(map_->elem_size) * map_->num_comp * kernels_->width;
  }
  /// Numbers of an element that fill the L-vector, element after element: those of a strided restriction; 0 for others.
  CeedSize stored_size() const {
    const CeedSize size = static_cast<CeedSize>(map_->elem_size) * map_->num_comp;
    return map_->type == CEED_RESTRICTION_STRIDED && map_->strides[2] == size ? size : 0;
  }
  std::size_t work_size() const { return map_->num_bands > 1 ? block_size() : 0; }
  /// block = R l for the elements [first, first + num_elem), num_elem <= W; lanes beyond repeat the last one.
  void gather(CeedInt first, CeedInt num_elem, const CeedScalar *l, CeedScalar *block, CeedScalar *work) const;
  /// Asks the memory for what gather() reads, or scatter_add() adds to.
  void ask(CeedInt first, CeedInt num_elem, const CeedScalar *l, bool to_write) const;
  /// rows = T^T block, one element after another, (component, node) each; the block is overwritten where the
  /// restriction is oriented.
  void to_rows(CeedInt first, CeedInt num_elem, CeedScalar *block, CeedScalar *rows, CeedScalar *work) const;
  /// l += G^T rows for the elements in the lanes [first_lane, end_lane).
  void scatter_add(CeedInt first, CeedInt num_elem, CeedInt first_lane, CeedInt end_lane, const CeedScalar *rows,
                   CeedScalar *l) const;

 private:
  BlockNodes nodes(CeedInt first, CeedInt num_elem) const;
  template <typename Visit>
  void for_each_run(Visit &&visit) const;
  void turn(CeedInt first, CeedInt num_elem, bool is_transpose, CeedScalar *block, CeedScalar *work) const;

  const Kernels *kernels_;
  const CeedElementMap *map_ = nullptr;
};

}  // namespace hg::host
