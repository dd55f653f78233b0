#include "point_block.hpp"

#include <algorithm>

#include "across.hpp"

namespace hg::host {

PointBlock::PointBlock(const CeedElementMap &points, CeedInt W, CeedInt vec_length, bool may_lie_across, CeedInt first,
                       CeedInt num_elem)
    : W_(W), first_(first), num_elem_(num_elem) {
  num_points_ = points.offsets[first + num_elem] - points.offsets[first];
  for (CeedInt lane = 0; lane < num_elem; lane++) {
    counts_[lane] = points.offsets[first + lane + 1] - points.offsets[first + lane];
  }
  most_ = *std::max_element(counts_, counts_ + W);
  least_ = *std::min_element(counts_, counts_ + W);
  is_across_ = may_lie_across && W > 1 && W % vec_length == 0 && pays_across(counts_, W);
  stride_ = (size() + vec_length - 1) / vec_length * vec_length;
}

CeedInt PointBlock::num_packs() const {
  if (is_across_) return most_;
  CeedInt packs = 0;
  for (CeedInt lane = 0; lane < num_elem_; lane++) packs += (counts_[lane] + W_ - 1) / W_;
  return packs;
}

const CeedInt *PointBlock::places(const CeedElementMap &map, std::vector<CeedInt> &room) const {
  if (!is_across_) return map.offsets + map.offsets[first_];
  room.resize(size());
  CeedInt any = 0;
  while (counts_[any] == 0) any++;
  for (CeedInt lane = 0; lane < W_; lane++) {
    const bool has_points = counts_[lane] > 0;
    const CeedInt *list = map.offsets + map.offsets[first_ + (has_points ? lane : any)];
    const CeedInt last = has_points ? counts_[lane] - 1 : 0;
    for (CeedInt k = 0; k < most_; k++) room[k * W_ + lane] = list[std::min(k, last)];
  }
  return room.data();
}

void PointBlock::drop_repeated(CeedInt num_comp, CeedScalar *values) const {
  if (!is_across_ || values == nullptr) return;
  for (CeedInt lane = 0; lane < W_; lane++) {
    for (CeedInt k = counts_[lane]; k < most_; k++) {
      for (CeedInt c = 0; c < num_comp; c++) values[static_cast<std::size_t>(c) * stride_ + k * W_ + lane] = 0;
    }
  }
}

}  // namespace hg::host
