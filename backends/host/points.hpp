/// @file
/// Tensor-product polynomials at arbitrary points, W points side by side, in the basis of Chebyshev polynomials T_k,
/// whose values come by recurrence.
#pragma once

#include "across.hpp"
#include "ahead.hpp"
#include "kernels.hpp"
#include "pack.hpp"

namespace hg::host::HG_HOST_ISA {

/// T_k(x) and T'_k(x), k < K:
///   T_(k+1) = 2 x T_k - T_(k-1),   T'_(k+1) = 2 T_k + 2 x T'_k - T'_(k-1).
[[gnu::always_inline]] inline void chebyshev(CeedInt K, Pack x, Pack *T, Pack *dT) {
  T[0] = broadcast(1.0);
  dT[0] = Pack{};
  if (K == 1) return;
  T[1] = x;
  dT[1] = T[0];
  const Pack twice = x + x;
  for (CeedInt k = 1; k + 1 < K; k++) {
    T[k + 1] = fma(twice, T[k], -T[k - 1]);
    dT[k + 1] = fma(twice, dT[k], (T[k] + T[k]) - dT[k - 1]);
  }
}

/// Most coefficients of a direction that these kernels take.
inline constexpr CeedInt most_coefficients = 16;

/// T and T' of each direction at W points; directions beyond `dim` are constant.
struct PointTable {
  Pack T[3][most_coefficients], dT[3][most_coefficients];

  [[gnu::always_inline]] void fill(CeedInt dim, CeedInt K, const CeedScalar *x_ref, CeedSize stride, CeedInt n) {
    for (CeedInt d = 0; d < 3; d++) {
      if (d == 0 || d < dim) {
        chebyshev(K, load_some(x_ref + d * stride, n), T[d], dT[d]);
      } else {
        T[d][0] = broadcast(1.0);
        dT[d][0] = Pack{};
      }
    }
  }
};

/// Coefficients are those of one element, `lanes` numbers apart (elements side by side in a block: W, or 1), or each
/// point has its own, W of them next to each other.
inline constexpr int each_its_own = 0;
template <int lanes>
[[gnu::always_inline]] inline Pack coefficient(const CeedScalar *c) {
  if constexpr (lanes == each_its_own) {
    return load(c);
  } else {
    return broadcast(*c);
  }
}

/// A function, given by its coefficients c, and its derivatives at W points.
///   v = Σ c_(k2,k1,k0) T_k2(z) T_k1(y) T_k0(x),   x, y, z its derivatives
/// Floor, multiplications with additions: 2 K^3 + 3 K^2 + 4 K with derivatives, K^3 + K^2 + K without.
template <bool with_derivatives>
struct PointValues {
  Pack v{}, x{}, y{}, z{};

  template <int lanes>
  [[gnu::always_inline]] void evaluate(const PointTable &table, CeedInt K, CeedInt K1, CeedInt K2,
                                       const CeedScalar *c) {
    for (CeedInt k2 = 0; k2 < K2; k2++) {
      Pack plane{}, plane_x{}, plane_y{};
      for (CeedInt k1 = 0; k1 < K1; k1++) {
        Pack row{}, row_x{};
#pragma GCC unroll 16
        for (CeedInt k0 = 0; k0 < K; k0++, c += lanes == each_its_own ? W : lanes) {
          row = fma(coefficient<lanes>(c), table.T[0][k0], row);
          if constexpr (with_derivatives) row_x = fma(coefficient<lanes>(c), table.dT[0][k0], row_x);
        }
        plane = fma(row, table.T[1][k1], plane);
        if constexpr (with_derivatives) {
          plane_x = fma(row_x, table.T[1][k1], plane_x);
          plane_y = fma(row, table.dT[1][k1], plane_y);
        }
      }
      v = fma(plane, table.T[2][k2], v);
      if constexpr (with_derivatives) {
        x = fma(plane_x, table.T[2][k2], x);
        y = fma(plane_y, table.T[2][k2], y);
        z = fma(plane, table.dT[2][k2], z);
      }
    }
  }
};

/// All components at all points.
template <int lanes, int fixed_K, bool with_derivatives>
void evaluate_points(const PointEvaluation &e, const CeedScalar *coefficients, CeedScalar *values,
                     CeedScalar *derivatives) {
  const CeedInt K = fixed_K > 0 ? fixed_K : e.K, K1 = e.dim > 1 ? K : 1, K2 = e.dim > 2 ? K : 1;
  const CeedSize of_component = static_cast<CeedSize>(K) * K1 * K2 * (lanes == each_its_own ? W : lanes);
  PointTable table;
  for (CeedInt first = 0; first < e.num_points; first += W) {
    const CeedInt n = e.num_points - first;
    ask(*e.ahead);
    table.fill(e.dim, K, e.x_ref + first, e.stride, n);
    for (CeedInt comp = 0; comp < e.num_comp; comp++) {
      PointValues<with_derivatives> at;
      at.template evaluate<lanes>(table, K, K1, K2, coefficients + comp * of_component);
      if (values != nullptr) store_some(values + comp * e.stride + first, at.v, n);
      if constexpr (with_derivatives) {
        const CeedSize of_direction = e.num_comp * e.stride;
        CeedScalar *to = derivatives + comp * e.stride + first;
        store_some(to, at.x, n);
        if (e.dim > 1) store_some(to + of_direction, at.y, n);
        if (e.dim > 2) store_some(to + 2 * of_direction, at.z, n);
      }
    }
  }
}

/// sums_k, W numbers -> their sums, at to[k*lanes].
template <int lanes>
[[gnu::always_inline]] inline void reduce(const CeedScalar *sums, CeedInt count, CeedScalar *to) {
  CeedInt k = 0;
  for (; k + W <= count; k += W) {
    Pack square[W];
#pragma GCC unroll 8
    for (int i = 0; i < W; i++) square[i] = load(sums + (k + i) * W);
    transpose(square);
#pragma GCC unroll 8
    for (int i = 1; i < W; i++) square[0] += square[i];
    for (int i = 0; i < W; i++) to[(k + i) * lanes] = square[0][i];
  }
  for (; k < count; k++) {
    CeedScalar sum = 0;
    for (int i = 0; i < W; i++) sum += sums[k * W + i];
    to[k * lanes] = sum;
  }
}

/// Adds what `packs` times W points from `first` on, with a table for each W, give to the sums of all components.
template <int fixed_K, bool with_derivatives, int packs>
[[gnu::always_inline]] inline void integrate_packs(const PointEvaluation &e, const PointTable *table, CeedInt first,
                                                   const CeedScalar *values, const CeedScalar *derivatives,
                                                   CeedScalar *sum) {
  const CeedInt K = fixed_K > 0 ? fixed_K : e.K, K1 = e.dim > 1 ? K : 1, K2 = e.dim > 2 ? K : 1;
  for (CeedInt comp = 0; comp < e.num_comp; comp++) {
    Pack v[packs]{}, x[packs]{}, y[packs]{}, z[packs]{};
#pragma GCC unroll 2
    for (int i = 0; i < packs; i++) {
      const CeedInt n = e.num_points - first - i * W;
      const CeedSize at = comp * e.stride + first + i * W, of_direction = e.num_comp * e.stride;
      if (values != nullptr) v[i] = load_some(values + at, n);
      if constexpr (with_derivatives) {
        x[i] = load_some(derivatives + at, n);
        if (e.dim > 1) y[i] = load_some(derivatives + of_direction + at, n);
        if (e.dim > 2) z[i] = load_some(derivatives + 2 * of_direction + at, n);
      }
    }
    for (CeedInt k2 = 0; k2 < K2; k2++) {
      Pack plane[packs], plane_x[packs]{}, plane_y[packs]{};
#pragma GCC unroll 2
      for (int i = 0; i < packs; i++) {
        plane[i] = v[i] * table[i].T[2][k2];
        if constexpr (with_derivatives) {
          plane[i] = fma(z[i], table[i].dT[2][k2], plane[i]);
          plane_x[i] = x[i] * table[i].T[2][k2];
          plane_y[i] = y[i] * table[i].T[2][k2];
        }
      }
      for (CeedInt k1 = 0; k1 < K1; k1++) {
        Pack row[packs], row_x[packs]{};
#pragma GCC unroll 2
        for (int i = 0; i < packs; i++) {
          row[i] = plane[i] * table[i].T[1][k1];
          if constexpr (with_derivatives) {
            row[i] = fma(plane_y[i], table[i].dT[1][k1], row[i]);
            row_x[i] = plane_x[i] * table[i].T[1][k1];
          }
        }
#pragma GCC unroll 16
        for (CeedInt k0 = 0; k0 < K; k0++, sum += W) {
          Pack s = load(sum);
#pragma GCC unroll 2
          for (int i = 0; i < packs; i++) {
            s = fma(row[i], table[i].T[0][k0], s);
            if constexpr (with_derivatives) s = fma(row_x[i], table[i].dT[0][k0], s);
          }
          store(sum, s);
        }
      }
    }
  }
}

/// The transpose: c_(k2,k1,k0) = Σ over the points of v T T T + x T T T' + ...; `sums` holds W numbers for each
/// coefficient. Two packs of points share the loads and stores of the sums, which are the limit.
template <int lanes, int fixed_K, bool with_derivatives>
void integrate_points(const PointEvaluation &e, const CeedScalar *values, const CeedScalar *derivatives,
                      CeedScalar *sums, CeedScalar *coefficients) {
  const CeedInt K = fixed_K > 0 ? fixed_K : e.K;
  const CeedInt num_coefficients = K * (e.dim > 1 ? K : 1) * (e.dim > 2 ? K : 1) * e.num_comp;
  if constexpr (lanes == each_its_own) sums = coefficients;
  for (CeedInt k = 0; k < num_coefficients; k++) store(sums + k * W, Pack{});
  PointTable table[2];
  const auto fill = [&](int i, CeedInt first) __attribute__((always_inline)) {
    ask(*e.ahead);
    table[i].fill(e.dim, K, e.x_ref + first, e.stride, e.num_points - first);
  };
  CeedInt first = 0;
  for (; first + W < e.num_points; first += 2 * W) {
    fill(0, first);
    fill(1, first + W);
    integrate_packs<fixed_K, with_derivatives, 2>(e, table, first, values, derivatives, sums);
  }
  if (first < e.num_points) {
    fill(0, first);
    integrate_packs<fixed_K, with_derivatives, 1>(e, table, first, values, derivatives, sums);
  }
  if constexpr (lanes != each_its_own) reduce<lanes>(sums, num_coefficients, coefficients);
}

/// Kernels for K = 2 ... 9, and at 0 for any K.
inline constexpr int largest_fixed_K = 9;
template <int lanes>
struct PointTables {
  template <int K>
  constexpr void fill() {
    evaluate[K][0] = evaluate_points<lanes, K, false>;
    evaluate[K][1] = evaluate_points<lanes, K, true>;
    integrate[K][0] = integrate_points<lanes, K, false>;
    integrate[K][1] = integrate_points<lanes, K, true>;
    if constexpr (K < largest_fixed_K) fill<K == 0 ? 2 : K + 1>();
  }
  constexpr PointTables() { fill<0>(); }

  EvaluatePoints evaluate[largest_fixed_K + 1][2] = {};
  IntegratePoints integrate[largest_fixed_K + 1][2] = {};
};
template <int lanes>
inline constexpr PointTables<lanes> point_tables;

template <int lanes>
EvaluatePoints point_evaluation(CeedInt K, bool with_derivatives, bool is_across) {
  if (K > most_coefficients) return nullptr;
  if constexpr (lanes == W) {
    if (is_across) return point_evaluation<each_its_own>(K, with_derivatives, false);
  }
  return point_tables<lanes>.evaluate[K >= 2 && K <= largest_fixed_K ? K : 0][with_derivatives];
}
template <int lanes>
IntegratePoints point_integration(CeedInt K, bool with_derivatives, bool is_across) {
  if (K > most_coefficients) return nullptr;
  if constexpr (lanes == W) {
    if (is_across) return point_integration<each_its_own>(K, with_derivatives, false);
  }
  return point_tables<lanes>.integrate[K >= 2 && K <= largest_fixed_K ? K : 0][with_derivatives];
}

#if HG_HOST_WIDTH >= 4
/// Four components of W points: rows of four numbers, `count` of which are wanted, turned.
[[gnu::always_inline]] inline void gather_four(const CeedScalar *const *rows, CeedInt count, CeedSize stride,
                                               CeedScalar *values) {
#pragma GCC unroll 2
  for (int part = 0; part < W; part += 4) {
    Four square[4];
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) square[i] = load_four(rows[part + i]);
    transpose_fours(square);
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
      if (i < count) store_four(values + i * stride + part, square[i]);
    }
  }
}
#endif

/// values_(c,p) = l[offsets[p]*num_comp + c]. The numbers of a point lie together: points are rows, turned in registers
/// four by four. Rows are read four numbers wide, but not beyond the end of l.
inline void gather_points(CeedInt num_points, CeedInt num_comp, const CeedInt *offsets, const CeedScalar *l,
                          [[maybe_unused]] CeedSize l_size, CeedSize stride, CeedScalar *values) {
  CeedInt p = 0;
#if HG_HOST_WIDTH >= 4
  for (; p + W <= num_points; p += W) {
    const CeedScalar *rows[W];
    bool is_inside = true;
#pragma GCC unroll 8
    for (int i = 0; i < W; i++) {
      const CeedSize at = static_cast<CeedSize>(offsets[p + i]) * num_comp;
      rows[i] = l + at;
      is_inside = is_inside && at + num_comp + 3 <= l_size;
    }
    if (!is_inside) break;
    for (CeedInt c = 0; c < num_comp; c += 4) {
      gather_four(rows, num_comp - c, stride, values + c * stride + p);
#pragma GCC unroll 8
      for (int i = 0; i < W; i++) rows[i] += 4;
    }
  }
#endif
  for (; p < num_points; p++) {
    const CeedScalar *from = l + static_cast<CeedSize>(offsets[p]) * num_comp;
    for (CeedInt c = 0; c < num_comp; c++) values[c * stride + p] = from[c];
  }
}

/// l[offsets[p]*num_comp + c] += values_(c,p), or = without `add`. Columns are turned to rows four by four, as far as
/// components fill rows of four; points are added one after another, so that one may be listed twice.
template <bool add>
inline void scatter_points(CeedInt num_points, CeedInt num_comp, const CeedInt *offsets, const CeedScalar *values,
                           CeedSize stride, CeedScalar *l) {
  const CeedInt num_turned = HG_HOST_WIDTH >= 4 ? num_comp / 4 * 4 : 0;
  CeedInt p = 0;
#if HG_HOST_WIDTH >= 4
  for (; p + 4 <= num_points; p += 4) {
    for (CeedInt c = 0; c < num_turned; c += 4) {
      Four square[4];
#pragma GCC unroll 4
      for (int i = 0; i < 4; i++) square[i] = load_four(values + (c + i) * stride + p);
      transpose_fours(square);
#pragma GCC unroll 4
      for (int i = 0; i < 4; i++) {
        CeedScalar *to = l + static_cast<CeedSize>(offsets[p + i]) * num_comp + c;
        store_four(to, add ? load_four(to) + square[i] : square[i]);
      }
    }
  }
#endif
  const CeedInt done = p;
  for (p = 0; p < num_points; p++) {
    CeedScalar *to = l + static_cast<CeedSize>(offsets[p]) * num_comp;
    for (CeedInt c = p < done ? num_turned : 0; c < num_comp; c++) {
      to[c] = add ? to[c] + values[c * stride + p] : values[c * stride + p];
    }
  }
}

}  // namespace hg::host::HG_HOST_ISA
