/// @file
/// Contractions for one element at a time, see Contraction: W numbers of its own side by side.
#pragma once

#include "ahead.hpp"
#include "contract.hpp"
#include "kernels.hpp"
#include "pack.hpp"

namespace hg::host::HG_HOST_ISA {

template <bool add>
[[gnu::always_inline]] inline void put_some(CeedScalar *to, Pack v, CeedInt n) {
  if constexpr (add) v += load_anywhere(to);
  store_some(to, v, n);
}

/// `rows` rows of B at the places c, c + 1, ..., `n` of which are there.
template <int rows, bool add>
[[gnu::always_inline]] inline void contract_places(const CeedScalar *B, CeedInt N, CeedInt post, const CeedScalar *x,
                                                   CeedScalar *y, CeedInt n) {
  Pack sums[rows];
  const Pack first = load_anywhere(x);
#pragma GCC unroll 4
  for (int m = 0; m < rows; m++) sums[m] = B[m * N] * first;
  for (CeedInt k = 1; k < N; k++) {
    const Pack value = load_anywhere(x + static_cast<CeedSize>(k) * post);
#pragma GCC unroll 4
    for (int m = 0; m < rows; m++) sums[m] = fma(B[m * N + k], value, sums[m]);
  }
#pragma GCC unroll 4
  for (int m = 0; m < rows; m++) put_some<add>(y + static_cast<CeedSize>(m) * post, sums[m], n);
}

/// Along the direction whose numbers lie next to each other: the sums of W rows m grow side by side, by columns of B.
template <bool add>
[[gnu::always_inline]] inline void contract_first(const CeedScalar *columns, CeedInt M, CeedInt N, CeedInt pre,
                                                  const CeedScalar *in, CeedScalar *out, Ahead &ahead) {
  const CeedInt stride = (M + W - 1) / W * W;
  for (CeedInt a = 0; a < pre; a++, in += N, out += M) {
    ask(ahead);
    for (CeedInt m = 0; m < M; m += W) {
      Pack sum = in[0] * load_anywhere(columns + m);
      for (CeedInt k = 1; k < N; k++)
        sum = fma(in[k], load_anywhere(columns + static_cast<CeedSize>(k) * stride + m), sum);
      put_some<add>(out + m, sum, M - m);
    }
  }
}

/// Coefficients: B by rows, then by columns, each filled up with zeros to a multiple of W.
template <bool add>
void contract_element(const CeedScalar *B, CeedInt M, CeedInt N, CeedInt pre, CeedInt post, const CeedScalar *in,
                      CeedScalar *out, Ahead &ahead) {
  if (post == 1) return contract_first<add>(B + static_cast<CeedSize>(M) * N, M, N, pre, in, out, ahead);
  const auto rows = [&](auto count, CeedInt m, CeedInt c) __attribute__((always_inline)) {
    contract_places<decltype(count)::value, add>(B + static_cast<CeedSize>(m) * N, N, post, in + c,
                                                 out + static_cast<CeedSize>(m) * post + c, post - c);
  };
  for (CeedInt a = 0; a < pre; a++, in += static_cast<CeedSize>(N) * post, out += static_cast<CeedSize>(M) * post) {
    CeedInt m = 0;
    for (; m + 4 <= M; m += 4) {
      for (CeedInt c = 0; c < post; c += W) rows(Count<4>(), m, c);
      ask(ahead);
    }
    for (; m < M; m++) {
      for (CeedInt c = 0; c < post; c += W) rows(Count<1>(), m, c);
      ask(ahead);
    }
  }
}

inline Contraction element_contraction(CeedInt, CeedInt, Symmetry symmetry, bool add) {
  if (symmetry != Symmetry::none) return nullptr;
  return add ? contract_element<true> : contract_element<false>;
}

inline void gather_element(const BlockNodes &nodes, const CeedScalar *l, CeedScalar *block) {
  const CeedInt *offsets = nodes.offsets[0];
  for (CeedInt n = 0; n < nodes.num_nodes; n++) {
    const CeedScalar *first = l + offsets[static_cast<CeedSize>(n) * nodes.step];
    for (CeedInt c = 0; c < nodes.num_comp; c++) {
      block[static_cast<CeedSize>(c) * nodes.num_nodes + n] = first[static_cast<CeedSize>(c) * nodes.comp_stride];
    }
  }
}

inline void copy_row(CeedInt count, const CeedScalar *const *rows, CeedScalar *block) {
  for (CeedInt k = 0; k < count; k++) block[k] = rows[0][k];
}

inline void copy_element(CeedSize count, const CeedScalar *block, CeedScalar *rows) {
  for (CeedSize k = 0; k < count; k++) rows[k] = block[k];
}

inline void copy_entries(const EntryPlaces &to, const CeedScalar *block, CeedScalar *entries) {
  const CeedInt *place = to.places;
  for (CeedInt row = 0; row < to.num_rows; row++, place += to.num_columns, entries += to.row_stride) {
    for (CeedInt k = 0; k < to.num_columns; k++) entries[k] = block[place[k]];
  }
}

}  // namespace hg::host::HG_HOST_ISA
