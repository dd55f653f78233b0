/// @file
/// Element restrictions of the reference backend.
#pragma once

#include <ceed/plugin.h>

namespace hg::ref {

/// The map of a restriction, for loops over elements without C calls: sizes and the address of the offsets. Valid while
/// the restriction lives.
/// An element array holds component c of node n at [c*num_nodes(e) + n]; at points the nodes are the element's points.
class ElementMap {
 public:
  ElementMap() = default;
  static int create(CeedElemRestriction rstr, ElementMap *map);

  CeedInt num_elem() const { return num_elem_; }
  CeedInt num_comp() const { return num_comp_; }
  /// Nodes of element e; at points the number of its points.
  CeedInt num_nodes(CeedInt e) const { return is_points_ ? offsets_[e + 1] - offsets_[e] : elem_size_; }
  /// Entries of the E-vector before those of element e.
  CeedSize first_entry(CeedInt e) const {
    const CeedSize nodes =
        is_points_ ? static_cast<CeedSize>(offsets_[e]) - offsets_[0] : static_cast<CeedSize>(e) * elem_size_;
    return nodes * num_comp_;
  }
  /// Place in the L-vector of component c of node n of element e.
  CeedSize entry(CeedInt e, CeedInt n, CeedInt c) const {
    if (is_points_) return static_cast<CeedSize>(offsets_[offsets_[e] + n]) * num_comp_ + c;
    const CeedSize node = offsets_ != nullptr
                              ? offsets_[static_cast<CeedSize>(e) * elem_size_ + n]
                              : static_cast<CeedSize>(n) * node_stride_ + static_cast<CeedSize>(e) * elem_stride_;
    return node + static_cast<CeedSize>(c) * comp_stride_;
  }
  /// values = R_e l
  void gather(CeedInt e, const CeedScalar *l, CeedScalar *values) const;
  /// l += R_e^T values
  void scatter_add(CeedInt e, const CeedScalar *values, CeedScalar *l) const;

 private:
  CeedInt num_elem_ = 0, elem_size_ = 0, num_comp_ = 0;
  CeedInt node_stride_ = 0, comp_stride_ = 0, elem_stride_ = 0;
  bool is_points_ = false;
  const CeedInt *offsets_ = nullptr;  ///< NULL: strided
};

void fill_restriction_ops(CeedElemRestrictionOps &ops);

}  // namespace hg::ref
