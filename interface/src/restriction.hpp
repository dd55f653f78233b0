/// @file
/// The map between L-vectors and E-vectors. The core keeps the tables over the elements on the host; backends may keep
/// more.
#pragma once

#include <ceed/plugin.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "ceed.hpp"

namespace hg {

/// An array of a restriction: a copy, one that the user lent, or one that the user gave away, made by std::malloc().
template <typename T>
class HostArray {
 public:
  const T *data() const { return data_; }
  void copy(const T *array, CeedSize size) {
    copy_ = std::make_unique<T[]>(static_cast<std::size_t>(size));
    std::copy_n(array, size, copy_.get());
    data_ = copy_.get();
  }
  void keep(std::unique_ptr<T[]> array) {
    copy_ = std::move(array);
    data_ = copy_.get();
  }
  void lend(const T *array) { data_ = array; }
  /// Frees `array`: at once where there is a copy, else with this object.
  void adopt(const T *array) {
    adopted_.reset(array);
    if (copy_) adopted_.reset();
  }

 private:
  struct Free {
    void operator()(const T *array) const noexcept { std::free(const_cast<T *>(array)); }
  };
  const T *data_ = nullptr;
  std::unique_ptr<T[]> copy_;
  std::unique_ptr<const T, Free> adopted_;
};

}  // namespace hg

struct CeedElemRestriction_private final : CeedObject_private, CeedElementMap {
  CeedElemRestriction_private() : CeedElementMap{} { block_size = 1; }
  ~CeedElemRestriction_private() override;
  void check_destroyable() const override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }

  hg::Ref<Ceed_private> ceed;
  CeedInt num_points = 0;  ///< at points: points in all
  bool has_backend_strides = false;
  hg::HostArray<CeedInt> own_offsets;
  hg::HostArray<CeedInt8> own_bands;
  hg::HostArray<bool> orients;  ///< oriented ones, as the user gave them; the signs in `bands` say the same
  hg::Ref<CeedElemRestriction_private> base;  ///< the restriction whose tables a copy reads
  std::uint64_t num_readers = 0;              ///< of the offsets and orientations
  void *data = nullptr;  ///< of the backend

  bool is_points() const { return type == CEED_RESTRICTION_POINTS; }
  bool is_strided() const { return type == CEED_RESTRICTION_STRIDED; }
  CeedInt num_block() const { return num_elem / block_size + (num_elem % block_size > 0 ? 1 : 0); }
  /// Entries of a table with `per_elem` entries for each element, the repeated ones of the last block included.
  CeedSize table_size(CeedSize per_elem) const { return static_cast<CeedSize>(num_block()) * block_size * per_elem; }
  /// Entry k of the `per_elem` ones of element e in such a table.
  CeedSize table_index(CeedInt e, CeedSize k, CeedSize per_elem) const {
    return (e / block_size * per_elem + k) * block_size + e % block_size;
  }
  /// Number of entries of `offsets`.
  CeedSize num_offsets() const;
  /// Nodes of element e; at points, its points.
  CeedInt num_nodes(CeedInt e) const { return is_points() ? offsets[e + 1] - offsets[e] : elem_size; }
  /// Place in the L-vector of component c of node n of element e.
  CeedSize place(CeedInt e, CeedInt n, CeedInt c) const;
  /// Calls f(m, T_e(n,m)) for the nodes m that may take part in node n of element e.
  template <typename F>
  void for_each_turned(CeedInt e, CeedInt n, F &&f) const {
    if (num_bands == 0) return f(n, CeedInt8{1});
    for (CeedInt k = 0; k < num_bands; k++) {
      const CeedInt m = n + k - num_bands / 2;
      if (m < 0 || m >= elem_size) continue;
      const CeedSize per_elem = static_cast<CeedSize>(num_bands) * elem_size;
      f(m, bands[table_index(e, static_cast<CeedSize>(n) * num_bands + k, per_elem)]);
    }
  }
  const CeedElemRestrictionOps &ops() const { return ceed->ops.restriction; }
};

namespace hg {

/// Handle -> restriction; NULL and CEED_ELEMRESTRICTION_NONE are errors.
CeedElemRestriction_private &deref_restriction(CeedElemRestriction rstr, Where where = Where::current());
/// The last step of making a restriction: tells the backend. From then on nothing fails, and the arrays that the user
/// gave away may be adopted.
void show_to_backend(CeedElemRestriction_private &r);
/// Whether two restrictions map the same nodes in the same way: the same handle, or the same kind, sizes and tables.
bool equal(const CeedElemRestriction_private &a, const CeedElemRestriction_private &b);
/// Points of element `elem` of a restriction at points: their numbers.
struct PointRange {
  const CeedInt *points;
  CeedInt size;
};
PointRange points_in_element(const CeedElemRestriction_private &rstr, CeedInt elem);

}  // namespace hg
