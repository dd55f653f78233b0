#include "block_map.hpp"

#include <algorithm>

#include "access.hpp"

namespace hg::host {

BlockMap::BlockMap(const Kernels &kernels, CeedElemRestriction rstr) : kernels_(&kernels) {
  chk(CeedElemRestrictionGetElementMap(rstr, &map_));
}

BlockNodes BlockMap::nodes(CeedInt first, CeedInt num_elem) const {
  const CeedInt B = map_->block_size;
  BlockNodes nodes{map_->elem_size, map_->num_comp, map_->comp_stride, B, {}};
  for (CeedInt lane = 0; lane < kernels_->width; lane++) {
    const CeedInt e = first + std::min(lane, num_elem - 1);
    nodes.offsets[lane] = map_->offsets + static_cast<CeedSize>(e / B) * map_->elem_size * B + e % B;
  }
  return nodes;
}

/// Calls visit(count, place in the L-vector, entry) for each run of an element's numbers that lie next to each other:
/// in a strided restriction a whole element, or a component, or a single number.
template <typename Visit>
void BlockMap::for_each_run(Visit &&visit) const {
  const CeedInt N = map_->elem_size, num_comp = map_->num_comp;
  const CeedSize node = map_->strides[0], comp = map_->strides[1];
  if (node == 1 && (comp == N || num_comp == 1)) {
    visit(N * num_comp, CeedSize{0}, CeedSize{0});
    return;
  }
  for (CeedInt c = 0; c < num_comp; c++) {
    for (CeedInt n = 0; n < (node == 1 ? 1 : N); n++) {
      visit(node == 1 ? N : 1, c * comp + n * node, static_cast<CeedSize>(c) * N + n);
    }
  }
}

/// block = T block or T^T block, element by element.
void BlockMap::turn(CeedInt first, CeedInt num_elem, bool is_transpose, CeedScalar *block, CeedScalar *work) const {
  const CeedInt N = map_->elem_size, num_bands = map_->num_bands, B = map_->block_size, W = kernels_->width;
  const auto band = [&](CeedInt lane, CeedInt n, CeedInt k) -> CeedScalar {
    const CeedInt e = first + std::min(lane, num_elem - 1);
    return map_->bands[((static_cast<CeedSize>(e / B) * N + n) * num_bands + k) * B + e % B];
  };
  if (num_bands == 1) {
    for (CeedInt c = 0; c < map_->num_comp; c++) {
      for (CeedInt n = 0; n < N; n++, block += W) {
        for (CeedInt lane = 0; lane < W; lane++) block[lane] *= band(lane, n, 0);
      }
    }
    return;
  }
  std::fill_n(work, block_size(), 0.0);
  for (CeedInt c = 0; c < map_->num_comp; c++) {
    const std::size_t start = static_cast<std::size_t>(c) * N;
    for (CeedInt n = 0; n < N; n++) {
      for (CeedInt k = 0; k < num_bands; k++) {
        const CeedInt m = n + k - num_bands / 2;
        if (m < 0 || m >= N) continue;
        const CeedScalar *from = block + (start + (is_transpose ? n : m)) * W;
        CeedScalar *to = work + (start + (is_transpose ? m : n)) * W;
        for (CeedInt lane = 0; lane < W; lane++) to[lane] += band(lane, n, k) * from[lane];
      }
    }
  }
  std::copy_n(work, block_size(), block);
}

void BlockMap::gather(CeedInt first, CeedInt num_elem, const CeedScalar *l, CeedScalar *block, CeedScalar *work) const {
  if (map_->type == CEED_RESTRICTION_STRIDED) {
    for_each_run([&](CeedInt count, CeedSize place, CeedSize entry) {
      const CeedScalar *rows[max_width];
      for (CeedInt lane = 0; lane < kernels_->width; lane++) {
        rows[lane] = l + (first + std::min(lane, num_elem - 1)) * static_cast<CeedSize>(map_->strides[2]) + place;
      }
      kernels_->gather_rows(count, rows, block + entry * kernels_->width);
    });
  } else {
    kernels_->gather(nodes(first, num_elem), l, block);
  }
  if (map_->num_bands > 0) turn(first, num_elem, false, block, work);
}

void BlockMap::ask(CeedInt first, CeedInt num_elem, const CeedScalar *l, bool to_write) const {
  // Elements of few nodes share nearly all of them with those before, which are in the caches: asking costs more.
  constexpr CeedInt few = 16;
  if (map_->type == CEED_RESTRICTION_STRIDED || map_->elem_size < few) return;
  kernels_->ask_for_nodes(nodes(first, num_elem), l, to_write);
}

void BlockMap::to_rows(CeedInt first, CeedInt num_elem, CeedScalar *block, CeedScalar *rows, CeedScalar *work) const {
  if (map_->num_bands > 0) turn(first, num_elem, true, block, work);
  kernels_->to_rows(static_cast<CeedSize>(map_->elem_size) * map_->num_comp, block, rows);
}

void BlockMap::scatter_add(CeedInt first, CeedInt num_elem, CeedInt first_lane, CeedInt end_lane,
                           const CeedScalar *rows, CeedScalar *l) const {
  const CeedSize row_size = static_cast<CeedSize>(map_->elem_size) * map_->num_comp;
  if (map_->type != CEED_RESTRICTION_STRIDED) {
    const BlockNodes all = nodes(first, num_elem);
    for (CeedInt lane = first_lane; lane < end_lane; lane++) {
      kernels_->scatter_add(all, lane, rows + lane * row_size, l);
    }
    return;
  }
  for (CeedInt lane = first_lane; lane < end_lane; lane++) {
    for_each_run([&](CeedInt count, CeedSize place, CeedSize entry) {
      CeedScalar *to = l + (first + lane) * static_cast<CeedSize>(map_->strides[2]) + place;
      const CeedScalar *from = rows + lane * row_size + entry;
      for (CeedInt k = 0; k < count; k++) to[k] += from[k];
    });
  }
}

}  // namespace hg::host
