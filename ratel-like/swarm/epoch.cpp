#include "swarm/epoch.hpp"

#include <algorithm>
#include <limits>

#include "options/error.hpp"

namespace hg {

PointEpoch::PointEpoch(Ceed ceed, std::int32_t num_cells, const Swarm &swarm) : ceed_(ceed), num_cells_(num_cells) {
  const PointField<std::int32_t> cell(swarm, field::cell);
  const PointField<double> xi(swarm, field::x_ref);
  // CEED counts with 32 bits: starts and indices share one array.
  constexpr std::size_t kMost = std::numeric_limits<CeedInt>::max();
  if (cell.size() + static_cast<std::size_t>(num_cells) + 1 > kMost) {
    fail("%zu points and %d cells on one rank: at most %zu together; use more ranks", cell.size(), num_cells,
         kMost - 1);
  }
  num_points_ = static_cast<std::int32_t>(cell.size());

  // Counting sort straight into the array that CEED wants: num_cells + 1 starts counted from num_cells + 1, then the
  // storage indices of the points cell by cell.
  const CeedInt head = num_cells + 1;
  offsets_.assign(static_cast<std::size_t>(head) + cell.size(), 0);
  for (std::int32_t p = 0; p < num_points_; p++) {
    if (cell[p] < 0 || cell[p] >= num_cells) {
      fail("point at storage index %d is in cell %d, expected 0 to %d: points must be located before an epoch begins",
           p, cell[p], num_cells - 1);
    }
    offsets_[cell[p] + 1]++;
  }
  for (std::int32_t c = 0; c < num_cells; c++) {
    max_points_ = std::max(max_points_, offsets_[c + 1]);
    num_empty_ += offsets_[c + 1] == 0;
  }
  offsets_[0] = head;
  for (std::int32_t c = 0; c < num_cells; c++) offsets_[c + 1] += offsets_[c];
  starts_.resize(head);
  for (CeedInt c = 0; c < head; c++) starts_[c] = offsets_[c] - head;
  std::vector<CeedInt> next(offsets_.begin(), offsets_.begin() + num_cells);
  for (std::int32_t p = 0; p < num_points_; p++) offsets_[next[cell[p]]++] = p;

  x_ref_ = vector(3, xi.span());
}

CeedElemRestriction PointEpoch::points(CeedInt num_comp) const {
  CeedElemRestrictionHandle &rstr = rstr_[num_comp];
  if (!rstr) {
    ceed_check(CeedElemRestrictionCreateAtPoints(ceed_, num_cells_, num_points_, num_comp,
                                                 static_cast<CeedSize>(num_points_) * num_comp, CEED_MEM_HOST,
                                                 CEED_COPY_VALUES, offsets_.data(), rstr.put()));
  }
  return rstr;
}

CeedVectorHandle PointEpoch::vector(CeedInt num_comp, std::span<const double> values) const {
  const std::size_t expected = static_cast<std::size_t>(num_points_) * num_comp;
  if (values.size() != expected) {
    fail("%zu values given for %d points with %d components, expected %zu", values.size(), num_points_, num_comp,
         expected);
  }
  CeedVectorHandle vec;
  ceed_check(CeedVectorCreate(ceed_, static_cast<CeedSize>(expected), vec.put()));
  // CEED takes a writable pointer even for a copy.
  ceed_check(CeedVectorSetArray(vec, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<double *>(values.data())));
  return vec;
}

}  // namespace hg
