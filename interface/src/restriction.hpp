/// @file
/// The map between L-vectors and E-vectors. The core keeps the offsets on the host; backends may keep more.
#pragma once

#include <array>
#include <cstdlib>
#include <memory>
#include <vector>

#include "ceed.hpp"

struct CeedElemRestriction_private final : CeedObject_private {
  ~CeedElemRestriction_private() override;
  void check_destroyable() const override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }

  struct Free {
    void operator()(CeedInt *array) const noexcept { std::free(array); }
  };

  hg::Ref<Ceed_private> ceed;
  CeedRestrictionType type = CEED_RESTRICTION_STANDARD;
  CeedInt num_elem = 0;
  CeedInt elem_size = 0;   ///< at points: the largest number of points of an element
  CeedInt num_points = 0;  ///< at points: points in all
  CeedInt num_comp = 0;
  CeedInt comp_stride = 0;  ///< strided: 0; at points: 1
  CeedSize l_size = 0;
  CeedSize e_size = 0;
  bool has_backend_strides = false;
  std::array<CeedInt, 3> strides{};    ///< strided: (node, component, element), also where the backend chose them
  std::array<CeedInt, 3> e_layout{};   ///< (node, component, element); at points {1, 0, 0}: the rest varies
  std::vector<CeedInt> owned_offsets;  ///< CEED_COPY_VALUES
  std::unique_ptr<CeedInt[], Free> adopted_offsets;  ///< CEED_OWN_POINTER
  const CeedInt *offsets = nullptr;                  ///< one of the two above, or what the user lent
  std::uint64_t num_readers = 0;
  bool is_known_to_backend = false;
  void *data = nullptr;  ///< of the backend

  bool is_points() const { return type == CEED_RESTRICTION_POINTS; }
  bool is_strided() const { return type == CEED_RESTRICTION_STRIDED; }
  /// Number of entries of `offsets`.
  CeedSize num_offsets() const;
  const CeedElemRestrictionOps &ops() const { return ceed->ops.restriction; }
};

namespace hg {

/// Handle -> restriction; NULL and CEED_ELEMRESTRICTION_NONE are errors.
CeedElemRestriction_private &deref_restriction(CeedElemRestriction rstr, Where where = Where::current());
/// Whether two restrictions map the same nodes: the same handle, or the same kind, sizes and offsets.
bool equal(const CeedElemRestriction_private &a, const CeedElemRestriction_private &b);
/// Points of element `elem` of a restriction at points: their numbers.
struct PointRange {
  const CeedInt *points;
  CeedInt size;
};
PointRange points_in_element(const CeedElemRestriction_private &rstr, CeedInt elem);

}  // namespace hg
