/// @file
/// Element restrictions of the reference backend.
#pragma once

#include <ceed/plugin.h>

namespace hg::ref {

/// A restriction R_e = T_e G_e (see CeedElementMap) for loops over elements without C calls. Valid while the
/// restriction lives. An element array holds component c of node n at [(c*num_nodes(e) + n)*stride]; at points the
/// nodes are the element's points.
class ElementMap {
 public:
  ElementMap() = default;
  static int create(CeedElemRestriction rstr, ElementMap *map) {
    return CeedElemRestrictionGetElementMap(rstr, &map->map_);
  }

  const CeedElementMap &facts() const { return *map_; }
  /// Nodes of element e; at points the number of its points.
  CeedInt num_nodes(CeedInt e) const { return is_points() ? map_->offsets[e + 1] - map_->offsets[e] : map_->elem_size; }
  /// Entries of the E-vector before those of a block; at points, of an element.
  CeedSize first_entry(CeedInt block) const {
    const CeedSize nodes = is_points() ? static_cast<CeedSize>(map_->offsets[block]) - map_->offsets[0]
                                       : static_cast<CeedSize>(block) * map_->block_size * map_->elem_size;
    return nodes * map_->num_comp;
  }
  /// values = R_e l
  void gather(CeedInt e, const CeedScalar *l, CeedScalar *values, CeedInt stride = 1) const;
  /// l += R_e^T values
  void scatter_add(CeedInt e, const CeedScalar *values, CeedScalar *l, CeedInt stride = 1) const;

 private:
  bool is_points() const { return map_->type == CEED_RESTRICTION_POINTS; }

  const CeedElementMap *map_ = nullptr;
};

void fill_restriction_ops(CeedElemRestrictionOps &ops);

}  // namespace hg::ref
