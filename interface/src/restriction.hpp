/// @file
/// The map between L-vectors and E-vectors. The core keeps the offsets on the host; backends may keep more.
#pragma once

#include <array>
#include <vector>

#include "ceed.hpp"

struct CeedElemRestriction_private final : CeedObject_private {
  ~CeedElemRestriction_private() override;
  void check_destroyable() const override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }

  hg::Ref<Ceed_private> ceed;
  CeedRestrictionType type = CEED_RESTRICTION_STANDARD;
  CeedInt num_elem = 0;
  CeedInt elem_size = 0;   ///< at points: the largest number of points of an element
  CeedInt num_points = 0;  ///< at points: points in all
  CeedInt num_comp = 0;
  CeedInt comp_stride = 0;
  CeedSize l_size = 0;
  CeedSize e_size = 0;
  bool has_backend_strides = false;
  std::array<CeedInt, 3> strides{};   ///< strided: (node, component, element)
  std::array<CeedInt, 3> e_layout{};  ///< (node, component, element)
  std::vector<CeedInt> owned_offsets;
  const CeedInt *offsets = nullptr;  ///< owned_offsets, or what the user lent
  CeedInt *adopted_offsets = nullptr;  ///< CEED_OWN_POINTER: freed with free()
  std::uint64_t num_readers = 0;
  void *data = nullptr;  ///< of the backend

  bool is_points() const { return type == CEED_RESTRICTION_POINTS; }
  /// Number of entries of `offsets`.
  CeedSize num_offsets() const;
};

namespace hg {

/// Whether two restrictions map the same nodes: the same handle, or the same kind, sizes and offsets.
bool equal(const CeedElemRestriction_private &a, const CeedElemRestriction_private &b);
/// Points of element `elem` of a restriction at points: their numbers.
struct PointRange {
  const CeedInt *points;
  CeedInt size;
};
PointRange points_in_element(const CeedElemRestriction_private &rstr, CeedInt elem);

}  // namespace hg
