/// @file
/// Numbers side by side. This file and those that include it are the kernels' text: it is compiled once for each
/// instruction set, in a namespace of its own, and includes no header with functions of C++, which the linker would
/// merge.
///
/// HG_HOST_ISA   the namespace: portable, avx2, avx512; compiled
/// HG_HOST_WIDTH W, the numbers of a pack
///
/// Text that is compiled at run time includes it, too: without the headers of C++ and of intrinsics, which would take
/// longer than all the rest, and with a compiler that may fuse a b + c by itself.
#pragma once

#include <ceed/types.h>

#include <stdint.h>
#if defined(__FMA__) && !defined(HG_HOST_FUSES)
#define HG_HOST_FMA
#include <immintrin.h>
#endif

namespace hg::host::HG_HOST_ISA {

inline constexpr int W = HG_HOST_WIDTH;

/// W numbers: elements or points, one in each lane. (GCC's and clang's vector types carry the arithmetic.)
typedef CeedScalar Pack __attribute__((vector_size(W * sizeof(CeedScalar))));
/// The same, anywhere in memory.
typedef CeedScalar UnalignedPack
    __attribute__((vector_size(W * sizeof(CeedScalar)), aligned(sizeof(CeedScalar)), may_alias));
typedef Pack AliasedPack __attribute__((may_alias));

[[gnu::always_inline]] inline Pack load(const CeedScalar *from) {
  return *reinterpret_cast<const AliasedPack *>(from);
}
[[gnu::always_inline]] inline void store(CeedScalar *to, Pack v) {
  *reinterpret_cast<AliasedPack *>(to) = v;
}
[[gnu::always_inline]] inline Pack load_anywhere(const CeedScalar *from) {
  return *reinterpret_cast<const UnalignedPack *>(from);
}
[[gnu::always_inline]] inline void store_anywhere(CeedScalar *to, Pack v) {
  *reinterpret_cast<UnalignedPack *>(to) = v;
}
[[gnu::always_inline]] inline Pack broadcast(CeedScalar v) {
  return v - Pack{};
}

/// Which of W lanes are among the first n: all bits of a lane set, or none.
typedef int64_t Mask __attribute__((vector_size(W * sizeof(int64_t))));
[[gnu::always_inline]] inline Mask first_lanes(CeedInt n) {
#if HG_HOST_WIDTH == 8
  constexpr Mask lane = {0, 1, 2, 3, 4, 5, 6, 7};
#elif HG_HOST_WIDTH == 4
  constexpr Mask lane = {0, 1, 2, 3};
#else
  constexpr Mask lane = {0, 1};
#endif
  return lane < static_cast<int64_t>(n);
}

/// The first n of W numbers, the others 0. W numbers can be read.
[[gnu::always_inline]] inline Pack load_some(const CeedScalar *from, CeedInt n) {
  const Pack v = load_anywhere(from);
  return n >= W ? v : first_lanes(n) ? v : Pack{};
}

/// Writes the first n of W numbers. W numbers can be read and written back.
[[gnu::always_inline]] inline void store_some(CeedScalar *to, Pack v, CeedInt n) {
  store_anywhere(to, n >= W ? v : first_lanes(n) ? v : load_anywhere(to));
}

/// a b + c, rounded once where the instruction set can. The compiler fuses nothing by itself (-ffp-contract=off), so
/// that all widths round alike.
[[gnu::always_inline]] inline Pack fma(Pack a, Pack b, Pack c) {
#if HG_HOST_WIDTH == 8 && defined(HG_HOST_FMA)
  return _mm512_fmadd_pd(a, b, c);
#elif HG_HOST_WIDTH == 4 && defined(HG_HOST_FMA)
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}
[[gnu::always_inline]] inline Pack fma(CeedScalar a, Pack b, Pack c) {
  return fma(broadcast(a), b, c);
}

/// {from[0][at], from[1][at], ...}. Pairs, joined: a scalar at a time GCC 12 fills a pack by a chain of masked moves.
[[gnu::always_inline]] inline Pack collect(const CeedScalar *const *from, CeedSize at) {
  typedef CeedScalar Pair __attribute__((vector_size(2 * sizeof(CeedScalar))));
  const auto pair = [&](int lane) __attribute__((always_inline)) {
    return Pair{from[lane][at], from[lane + 1][at]};
  };
#if HG_HOST_WIDTH == 2
  return pair(0);
#else
  const auto four = [&](int lane) __attribute__((always_inline)) {
    return __builtin_shufflevector(pair(lane), pair(lane + 2), 0, 1, 2, 3);
  };
#if HG_HOST_WIDTH == 4
  return four(0);
#else
  return __builtin_shufflevector(four(0), four(4), 0, 1, 2, 3, 4, 5, 6, 7);
#endif
#endif
}

/// One step of a transposition: in blocks of 2S by 2S, swaps what is off the diagonal.
template <int S, int... lanes>
[[gnu::always_inline]] inline void swap_blocks(Pack &a, Pack &b) {
  const Pack low = __builtin_shufflevector(a, b, ((lanes & S) == 0 ? lanes : W + lanes - S)...);
  const Pack high = __builtin_shufflevector(a, b, ((lanes & S) == 0 ? lanes + S : W + lanes)...);
  a = low;
  b = high;
}

template <int S, int... lanes>
[[gnu::always_inline]] inline void swap_all_blocks(Pack (&rows)[W]) {
#pragma GCC unroll 16
  for (int i = 0; i < W; i++) {
    if ((i & S) == 0) swap_blocks<S, lanes...>(rows[i], rows[i + S]);
  }
}

/// rows[i][j] <-> rows[j][i]
[[gnu::always_inline]] inline void transpose(Pack (&rows)[W]) {
#if HG_HOST_WIDTH == 2
  swap_all_blocks<1, 0, 1>(rows);
#elif HG_HOST_WIDTH == 4
  swap_all_blocks<1, 0, 1, 2, 3>(rows);
  swap_all_blocks<2, 0, 1, 2, 3>(rows);
#elif HG_HOST_WIDTH == 8
  swap_all_blocks<1, 0, 1, 2, 3, 4, 5, 6, 7>(rows);
  swap_all_blocks<2, 0, 1, 2, 3, 4, 5, 6, 7>(rows);
  swap_all_blocks<4, 0, 1, 2, 3, 4, 5, 6, 7>(rows);
#else
#error "HG_HOST_WIDTH is 2, 4 or 8"
#endif
}

#if HG_HOST_WIDTH >= 4
/// Four numbers: rows and columns are turned by fours, for which processors have more ports than for wider ones.
typedef CeedScalar Four __attribute__((vector_size(4 * sizeof(CeedScalar))));
typedef CeedScalar UnalignedFour
    __attribute__((vector_size(4 * sizeof(CeedScalar)), aligned(sizeof(CeedScalar)), may_alias));
[[gnu::always_inline]] inline Four load_four(const CeedScalar *from) {
  return *reinterpret_cast<const UnalignedFour *>(from);
}
[[gnu::always_inline]] inline void store_four(CeedScalar *to, Four v) {
  *reinterpret_cast<UnalignedFour *>(to) = v;
}
/// rows[i][j] <-> rows[j][i]
[[gnu::always_inline]] inline void transpose_fours(Four (&rows)[4]) {
  const Four a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
             b = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Four c = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
             d = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}
#endif

}  // namespace hg::host::HG_HOST_ISA
