/// @file
/// What the printed text of an operator is made of: blocks of W elements. Counts of a block's arrays are packs.
#pragma once

namespace hg::host::HG_HOST_ISA {

using gen::Job, gen::Side;

/// Where a chain of contractions reads or writes: entry (a, n, c) at array[(a*pre + n*row + c)*W].
template <typename Scalar>
struct Rows {
  Scalar *array;
  CeedInt pre, row;
};

/// out_(a,m,c) (+)= Σ_n B_(m,n) in_(a,n,c) for a < pre, c < columns. s: 1 and -1 as in Contraction; 0: B as it is.
template <int M, int N, int s, bool add = false>
[[gnu::always_inline]] inline void contract(const CeedScalar *B, CeedInt pre, CeedInt columns,
                                            Rows<const CeedScalar> in, Rows<CeedScalar> out, Ahead &ahead) {
  const CeedSize in_step = static_cast<CeedSize>(in.row) * W, out_step = static_cast<CeedSize>(out.row) * W;
  for (CeedInt a = 0; a < pre; a++) {
    const CeedScalar *x = in.array + static_cast<CeedSize>(a) * in.pre * W;
    CeedScalar *y = out.array + static_cast<CeedSize>(a) * out.pre * W;
    if constexpr (s != 0) {
      contract_columns<M, N, s, add>(B, columns, x, in_step, y, out_step, ahead);
    } else {
      const auto rows = [&](auto count, CeedInt m) __attribute__((always_inline)) {
        for (CeedInt c = 0; c < columns; c++) {
          contract_rows<decltype(count)::value, add>(B + m * N, N, x + c * W, in_step, y + m * out_step + c * W,
                                                     out_step, ahead);
        }
      };
      constexpr int rest = M % 4;
      for (CeedInt m = 0; m + 4 <= M; m += 4) rows(Count<4>(), m);
      if constexpr (rest > 0) rows(Count<rest>(), M - rest);
    }
  }
}

/// to_k (+)= from_k, k < count
template <int count, bool add = false>
[[gnu::always_inline]] inline void copy(const CeedScalar *from, CeedScalar *to) {
  for (CeedInt k = 0; k < count; k++) put<add>(to + k * W, load(from + k * W));
}

/// The same for num_comp runs of `count` packs, which begin from_step and to_step packs after each other.
template <int num_comp, int count, bool add = false>
[[gnu::always_inline]] inline void copy_rows(const CeedScalar *from, CeedInt from_step, CeedScalar *to,
                                             CeedInt to_step) {
  for (CeedInt c = 0; c < num_comp; c++) copy<count, add>(from + c * from_step * W, to + c * to_step * W);
}

template <int count>
[[gnu::always_inline]] inline void fill(const CeedScalar *numbers, CeedScalar *to) {
  for (CeedInt k = 0; k < count; k++) store(to + k * W, broadcast(numbers[k]));
}

template <int count>
[[gnu::always_inline]] inline void clear(CeedScalar *to) {
  for (CeedInt k = 0; k < count; k++) store(to + k * W, Pack{});
}

/// The nodes [begin, begin + count) of num_elem elements of `size` nodes each; lanes beyond repeat the last element.
template <int size, int num_comp, int count>
[[gnu::always_inline]] inline BlockNodes nodes_of(const Side &side, CeedInt first, CeedInt num_elem, CeedInt begin) {
  BlockNodes nodes{count, num_comp, static_cast<CeedInt>(side.comp_stride), 1, {}};
  for (CeedInt lane = 0; lane < W; lane++) {
    const CeedInt e = first + (lane < num_elem ? lane : num_elem - 1);
    nodes.offsets[lane] = side.offsets + static_cast<CeedSize>(e) * size + begin;
  }
  return nodes;
}

/// block_(c,k) = node begin + k of component c, k < count, for W elements side by side.
template <int size, int num_comp, int count = size>
[[gnu::always_inline]] inline void read_nodes(const Side &side, const CeedScalar *l, CeedInt first, CeedInt num_elem,
                                              CeedInt begin, CeedScalar *block) {
  gather(nodes_of<size, num_comp, count>(side, first, num_elem, begin), l, block);
}

/// Asks for the nodes that are read, or written, next.
template <int size, int num_comp, bool to_write>
[[gnu::always_inline]] inline void ask_for(const Side &side, const CeedScalar *l, CeedInt first, CeedInt num_elem) {
  constexpr int few = 16;  // fewer are shared with the elements before, which are in the caches
  if constexpr (size >= few) {
    ask_for_nodes<W>(nodes_of<size, num_comp, size>(side, first, num_elem, 0), l, to_write);
  }
}

/// What the next block will read where there are no offsets, `lines` cache lines at each step of this block's
/// contractions.
[[gnu::always_inline]] inline Ahead ahead_of(const Side &side, const CeedScalar *l, CeedInt first, CeedInt lines) {
  return {reinterpret_cast<uintptr_t>(l) + (first + W) * side.elem_stride * sizeof(CeedScalar), lines};
}

/// The same where there are no offsets: rows of numbers, turned.
template <int size, int num_comp, int count = size>
[[gnu::always_inline]] inline void read_stored(const Side &side, const CeedScalar *l, CeedInt first, CeedInt num_elem,
                                               CeedInt begin, CeedScalar *block) {
  for (CeedInt c = 0; c < num_comp; c++, block += count * W) {
    const CeedScalar *rows[W];
    for (CeedInt lane = 0; lane < W; lane++) {
      const CeedInt e = first + (lane < num_elem ? lane : num_elem - 1);
      rows[lane] = l + e * side.elem_stride + c * side.comp_stride + begin;
    }
    CeedInt k = 0;
    for (; k + W <= count; k += W) {
      Pack square[W];
#pragma GCC unroll 8
      for (int lane = 0; lane < W; lane++) {
        square[lane] = load_anywhere(rows[lane] + k);
      }
      transpose(square);
#pragma GCC unroll 8
      for (int i = 0; i < W; i++) store(block + (k + i) * W, square[i]);
    }
    for (; k < count; k++) store(block + k * W, collect(rows, k));
  }
}

/// Node begin + k of component c += block_(c,k). `rows`: as many numbers as the block has.
template <int size, int num_comp, int count = size>
[[gnu::always_inline]] inline void add_nodes(const Side &side, CeedInt first, CeedInt num_elem, CeedInt begin,
                                             const CeedScalar *block, CeedScalar *rows, CeedScalar *l) {
  to_rows(count * num_comp, block, rows);
  const BlockNodes nodes = nodes_of<size, num_comp, count>(side, first, num_elem, begin);
  for (CeedInt lane = 0; lane < num_elem; lane++) scatter_add(nodes, lane, rows + lane * count * num_comp, l);
}

template <int size, int num_comp, int count = size>
[[gnu::always_inline]] inline void add_stored(const Side &side, CeedInt first, CeedInt num_elem, CeedInt begin,
                                              const CeedScalar *block, CeedScalar *rows, CeedScalar *l) {
  to_rows(count * num_comp, block, rows);
  for (CeedInt lane = 0; lane < num_elem; lane++) {
    for (CeedInt c = 0; c < num_comp; c++) {
      CeedScalar *to = l + (first + lane) * side.elem_stride + c * side.comp_stride + begin;
      const CeedScalar *from = rows + (lane * num_comp + c) * count;
      for (CeedInt k = 0; k < count; k++) to[k] += from[k];
    }
  }
}

}  // namespace hg::host::HG_HOST_ISA
