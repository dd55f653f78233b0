/// @file
/// From L-vectors to blocks of elements and back. Floor: each number of the L-vector is loaded, and stored on the way
/// back, by itself (gather instructions were slower); rows are turned in registers, W by W.
#pragma once

#include "kernels.hpp"
#include "pack.hpp"

namespace hg::host::HG_HOST_ISA {

/// With `plain` the offsets of an element lie next to each other, and there is one component.
template <bool plain>
[[gnu::always_inline]] inline void gather_nodes(const BlockNodes &nodes, const CeedScalar *l, CeedScalar *block) {
  const CeedInt N = nodes.num_nodes;
  const CeedSize step = plain ? 1 : nodes.step;
  for (CeedInt n = 0; n < N; n++) {
    const CeedScalar *first[W];
#pragma GCC unroll 8
    for (int lane = 0; lane < W; lane++) first[lane] = l + nodes.offsets[lane][n * step];
    for (CeedInt c = 0; c < (plain ? 1 : nodes.num_comp); c++) {
      store(block + (static_cast<CeedSize>(c) * N + n) * W,
            collect(first, static_cast<CeedSize>(c) * nodes.comp_stride));
    }
  }
}

inline void gather(const BlockNodes &nodes, const CeedScalar *l, CeedScalar *block) {
  if (nodes.step == 1 && nodes.num_comp == 1) {
    gather_nodes<true>(nodes, l, block);
  } else {
    gather_nodes<false>(nodes, l, block);
  }
}

/// One component of each node. `to_write` is a constant of the builtin.
template <int lanes, bool to_write>
[[gnu::always_inline]] inline void ask_for_component(const BlockNodes &nodes, const CeedScalar *l) {
  for (CeedInt n = 0; n < nodes.num_nodes; n++) {
#pragma GCC unroll 8
    for (int lane = 0; lane < lanes; lane++) {
      __builtin_prefetch(l + nodes.offsets[lane][static_cast<CeedSize>(n) * nodes.step], to_write);
    }
  }
}

/// Components that lie next to each other share a line, mostly: one of them is asked for.
template <int lanes>
void ask_for_nodes(const BlockNodes &nodes, const CeedScalar *l, bool to_write) {
  constexpr CeedInt line = Ahead::line / static_cast<CeedInt>(sizeof(CeedScalar));
  const CeedInt num_lines = nodes.comp_stride < line ? 1 : nodes.num_comp;
  for (CeedInt c = 0; c < num_lines; c++) {
    const CeedScalar *component = l + static_cast<CeedSize>(c) * nodes.comp_stride;
    if (to_write) {
      ask_for_component<lanes, true>(nodes, component);
    } else {
      ask_for_component<lanes, false>(nodes, component);
    }
  }
}

inline void scatter_add(const BlockNodes &nodes, CeedInt lane, const CeedScalar *row, CeedScalar *l) {
  const CeedInt N = nodes.num_nodes;
  const CeedInt *offsets = nodes.offsets[lane];
  if (nodes.step == 1 && nodes.num_comp == 1) {
    for (CeedInt n = 0; n < N; n++) l[offsets[n]] += row[n];
    return;
  }
  for (CeedInt n = 0; n < N; n++) {
    CeedScalar *to = l + offsets[static_cast<CeedSize>(n) * nodes.step];
    for (CeedInt c = 0; c < nodes.num_comp; c++) {
      to[static_cast<CeedSize>(c) * nodes.comp_stride] += row[static_cast<CeedSize>(c) * N + n];
    }
  }
}

inline void gather_rows(CeedInt count, const CeedScalar *const *rows, CeedScalar *block) {
  CeedInt k = 0;
  for (; k + W <= count; k += W) {
    Pack square[W];
#pragma GCC unroll 8
    for (int lane = 0; lane < W; lane++) square[lane] = load_anywhere(rows[lane] + k);
    transpose(square);
#pragma GCC unroll 8
    for (int i = 0; i < W; i++) store(block + (static_cast<CeedSize>(k) + i) * W, square[i]);
  }
  for (; k < count; k++) {
    for (int lane = 0; lane < W; lane++) block[static_cast<CeedSize>(k) * W + lane] = rows[lane][k];
  }
}

inline void to_rows(CeedSize count, const CeedScalar *block, CeedScalar *rows) {
  CeedSize k = 0;
  for (; k + W <= count; k += W) {
    Pack square[W];
#pragma GCC unroll 8
    for (int i = 0; i < W; i++) square[i] = load(block + (k + i) * W);
    transpose(square);
#pragma GCC unroll 8
    for (int lane = 0; lane < W; lane++) store_anywhere(rows + lane * count + k, square[lane]);
  }
  for (; k < count; k++) {
    for (int lane = 0; lane < W; lane++) rows[lane * count + k] = block[k * W + lane];
  }
}

inline void to_entries(const EntryPlaces &to, const CeedScalar *block, CeedScalar *entries) {
  const CeedInt *place = to.places;
  for (CeedInt row = 0; row < to.num_rows; row++, place += to.num_columns, entries += to.row_stride) {
    CeedInt k = 0;
    for (; k + W <= to.num_columns; k += W) {
      Pack square[W];
#pragma GCC unroll 8
      for (int i = 0; i < W; i++) square[i] = load(block + static_cast<CeedSize>(place[k + i]) * W);
      transpose(square);
#pragma GCC unroll 8
      for (int lane = 0; lane < W; lane++) {
        if (lane < to.num_elem) store_anywhere(entries + lane * to.elem_stride + k, square[lane]);
      }
    }
    for (; k < to.num_columns; k++) {
      const CeedScalar *from = block + static_cast<CeedSize>(place[k]) * W;
      for (CeedInt lane = 0; lane < to.num_elem; lane++) entries[lane * to.elem_stride + k] = from[lane];
    }
  }
}

}  // namespace hg::host::HG_HOST_ISA
