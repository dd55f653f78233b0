/// @file
/// Contractions of one direction, see Contraction.
#pragma once

#include "ahead.hpp"
#include "kernels.hpp"
#include "pack.hpp"

namespace hg::host::HG_HOST_ISA {

template <bool add>
[[gnu::always_inline]] inline void put(CeedScalar *to, Pack v) {
  if constexpr (add) v += load(to);
  store(to, v);
}

/// With e_n = x_n + x_(N-1-n), o_n = x_n - x_(N-1-n), E = (B_(m,n) + B_(m,N-1-n))/2 and O = (B_(m,n) - B_(m,N-1-n))/2:
///   y_m = E e + O o,   y_(M-1-m) = s (E e - O o).
/// The middle of an odd N counts among the e_n. `in_step` and `out_step` numbers lie between rows, W between the
/// `columns` that are next to each other.
template <int M, int N, int s, bool add>
[[gnu::always_inline]] inline void contract_columns(const CeedScalar *coefficients, CeedInt columns,
                                                    const CeedScalar *in, CeedSize in_step, CeedScalar *out,
                                                    CeedSize out_step, Ahead &ahead) {
  constexpr int num_even = (N + 1) / 2, num_odd = N / 2;
  for (CeedInt c = 0; c < columns; c++) {
    const CeedScalar *x = in + c * W;
    CeedScalar *y = out + c * W;
    ask(ahead);
    Pack even[num_even], odd[num_odd > 0 ? num_odd : 1];
#pragma GCC unroll 16
    for (int n = 0; n < num_odd; n++) {
      const Pack first = load(x + n * in_step), last = load(x + (N - 1 - n) * in_step);
      even[n] = first + last;
      odd[n] = first - last;
    }
    if constexpr (N % 2 == 1) even[num_odd] = load(x + num_odd * in_step);
#pragma GCC unroll 16
    for (int m = 0; m < M / 2; m++) {
      const CeedScalar *row = coefficients + m * N;
      Pack p = row[0] * even[0], q{};
#pragma GCC unroll 16
      for (int n = 1; n < num_even; n++) p = fma(row[n], even[n], p);
      if constexpr (num_odd > 0) q = row[num_even] * odd[0];
#pragma GCC unroll 16
      for (int n = 1; n < num_odd; n++) q = fma(row[num_even + n], odd[n], q);
      put<add>(y + m * out_step, p + q);
      put<add>(y + (M - 1 - m) * out_step, s > 0 ? p - q : q - p);
    }
    if constexpr (M % 2 == 1) {
      // The middle row sees only one of the two.
      const CeedScalar *row = coefficients + M / 2 * N;
      Pack p{};
      if constexpr (s > 0) {
        p = row[0] * even[0];
#pragma GCC unroll 16
        for (int n = 1; n < num_even; n++) p = fma(row[n], even[n], p);
      } else if constexpr (num_odd > 0) {
        p = row[num_even] * odd[0];
#pragma GCC unroll 16
        for (int n = 1; n < num_odd; n++) p = fma(row[num_even + n], odd[n], p);
      }
      put<add>(y + M / 2 * out_step, p);
    }
  }
}

template <int M, int N, int s, bool add>
void contract_symmetric(const CeedScalar *coefficients, CeedInt, CeedInt, CeedInt pre, CeedInt post,
                        const CeedScalar *in, CeedScalar *out, Ahead &ahead) {
  const CeedSize step = static_cast<CeedSize>(post) * W;
  for (CeedInt a = 0; a < pre; a++, in += N * step, out += M * step) {
    contract_columns<M, N, s, add>(coefficients, post, in, step, out, step, ahead);
  }
}

/// `rows` rows from m on, at place c.
template <int rows, bool add>
[[gnu::always_inline]] inline void contract_rows(const CeedScalar *B, CeedInt N, const CeedScalar *x, CeedSize in_step,
                                                 CeedScalar *y, CeedSize out_step, Ahead &ahead) {
  ask(ahead);
  Pack sums[rows];
#pragma GCC unroll 16
  for (int m = 0; m < rows; m++) sums[m] = B[m * N] * load(x);
  for (CeedInt n = 1; n < N; n++) {
    const Pack value = load(x + n * in_step);
#pragma GCC unroll 16
    for (int m = 0; m < rows; m++) sums[m] = fma(B[m * N + n], value, sums[m]);
  }
#pragma GCC unroll 16
  for (int m = 0; m < rows; m++) put<add>(y + m * out_step, sums[m]);
}

template <int n>
struct Count {
  static constexpr int value = n;
};

/// Any shape.
template <bool add>
void contract_any(const CeedScalar *B, CeedInt M, CeedInt N, CeedInt pre, CeedInt post, const CeedScalar *in,
                  CeedScalar *out, Ahead &ahead) {
  const CeedSize step = static_cast<CeedSize>(post) * W;
  const auto rows = [&](auto count, CeedInt m) __attribute__((always_inline)) {
    for (CeedInt c = 0; c < post; c++) {
      contract_rows<decltype(count)::value, add>(B + static_cast<CeedSize>(m) * N, N, in + c * W, step,
                                                 out + m * step + c * W, step, ahead);
    }
  };
  for (CeedInt a = 0; a < pre; a++, in += N * step, out += M * step) {
    CeedInt m = 0;
    for (; m + 8 <= M; m += 4) rows(Count<4>(), m);
    // One or two rows alone would wait for their own sums.
    switch (M - m) {
      case 7: rows(Count<7>(), m); break;
      case 6: rows(Count<6>(), m); break;
      case 5: rows(Count<5>(), m); break;
      case 4: rows(Count<4>(), m); break;
      case 3: rows(Count<3>(), m); break;
      case 2: rows(Count<2>(), m); break;
      case 1: rows(Count<1>(), m); break;
    }
  }
}

/// Shapes with a kernel of their own: the bake-offs' p = 1 to 8 with q = p to p + 2 points, there and back, and
/// derivatives between the points.
inline constexpr int largest_shape = 10;
constexpr bool has_kernel(int M, int N) {
  const int difference = M > N ? M - N : N - M;
  return M >= 2 && N >= 2 && difference <= 1;
}

/// Entry (M, N): kernels for s = 1 and -1, each to set and to add; NULL where there is none.
struct ShapeTable {
  template <int M, int N>
  constexpr void fill() {
    if constexpr (has_kernel(M, N)) {
      auto &entry = kernels[M][N];
      entry[0] = contract_symmetric<M, N, 1, false>;
      entry[1] = contract_symmetric<M, N, 1, true>;
      entry[2] = contract_symmetric<M, N, -1, false>;
      entry[3] = contract_symmetric<M, N, -1, true>;
    }
    if constexpr (N < largest_shape) {
      fill<M, N + 1>();
    } else if constexpr (M < largest_shape) {
      fill<M + 1, 1>();
    }
  }
  constexpr ShapeTable() { fill<1, 1>(); }

  Contraction kernels[largest_shape + 1][largest_shape + 1][4] = {};
};

inline Contraction contraction(CeedInt M, CeedInt N, Symmetry symmetry, bool add) {
  static constexpr ShapeTable table;
  if (symmetry == Symmetry::none) return add ? contract_any<true> : contract_any<false>;
  if (M > largest_shape || N > largest_shape) return nullptr;
  return table.kernels[M][N][(symmetry == Symmetry::even ? 0 : 2) + (add ? 1 : 0)];
}

}  // namespace hg::host::HG_HOST_ISA
