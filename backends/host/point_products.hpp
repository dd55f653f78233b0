/// @file
/// What assembly asks of points: moments, and sums of products of functions.
#pragma once

#include "contract.hpp"
#include "points.hpp"

namespace hg::host::HG_HOST_ISA {

/// C_(i,j) += Σ_q A_(i,q) B_(q,j) for `rows` rows i and W `packs` columns j, summed in registers.
template <int rows, int packs>
[[gnu::always_inline]] inline void add_tile(CeedInt count, const CeedScalar *A, CeedSize a_stride, const CeedScalar *B,
                                            CeedSize b_stride, CeedScalar *C) {
  Pack sum[rows][packs] = {};
  for (CeedInt q = 0; q < count; q++, B += b_stride) {
    Pack b[packs];
#pragma GCC unroll 4
    for (int j = 0; j < packs; j++) b[j] = load(B + j * W);
#pragma GCC unroll 8
    for (int i = 0; i < rows; i++) {
#pragma GCC unroll 4
      for (int j = 0; j < packs; j++) sum[i][j] = fma(A[i * a_stride + q], b[j], sum[i][j]);
    }
  }
#pragma GCC unroll 8
  for (int i = 0; i < rows; i++) {
#pragma GCC unroll 4
    for (int j = 0; j < packs; j++) put<true>(C + i * b_stride + j * W, sum[i][j]);
  }
}

/// The same for any number of rows; rows of C are b_stride apart.
template <int packs>
void add_columns(CeedInt count, CeedInt num_rows, const CeedScalar *A, CeedSize a_stride, const CeedScalar *B,
                 CeedSize b_stride, CeedScalar *C) {
  constexpr int rows = W == 8 ? 8 : 4;  // as many sums as there are registers for
  CeedInt i = 0;
  for (; i + rows <= num_rows; i += rows) {
    add_tile<rows, packs>(count, A + i * a_stride, a_stride, B, b_stride, C + i * b_stride);
  }
  for (; i < num_rows; i++) add_tile<1, packs>(count, A + i * a_stride, a_stride, B, b_stride, C + i * b_stride);
}

/// sums_((k2,k1,k0), c) = Σ_p T_k2(z_p) T_k1(y_p) T_k0(x_p) values_(p,c): a product of two matrices, for so many points
/// at once that a panel of their values stays in the first cache.
inline void point_moments(const PointEvaluation &e, const CeedScalar *values, CeedSize row, CeedScalar *table,
                          CeedScalar *sums) {
  const CeedInt K = e.K, K1 = e.dim > 1 ? K : 1, K2 = e.dim > 2 ? K : 1, num_moments = K * K1 * K2;
  for (CeedSize i = 0; i < num_moments * row; i += W) store(sums + i, Pack{});
  for (CeedInt first = 0; first < e.num_points; first += moment_points) {
    const CeedInt count = e.num_points - first < moment_points ? e.num_points - first : moment_points;
    for (CeedInt q = 0; q < count; q += W) {
      PointTable at;
      at.fill(e.dim, K, e.x_ref + first + q, e.stride, count - q);
      CeedScalar *to = table + q;
      for (CeedInt k2 = 0; k2 < K2; k2++) {
        for (CeedInt k1 = 0; k1 < K1; k1++) {
          const Pack factor = at.T[2][k2] * at.T[1][k1];
          for (CeedInt k0 = 0; k0 < K; k0++, to += moment_points) store(to, factor * at.T[0][k0]);
        }
      }
    }
    const CeedScalar *B = values + first * row;
    CeedInt c = 0;
    for (; c + 3 * W <= e.num_comp; c += 3 * W) {
      add_columns<3>(count, num_moments, table, moment_points, B + c, row, sums + c);
    }
    if (c + 2 * W < e.num_comp) {
      add_columns<3>(count, num_moments, table, moment_points, B + c, row, sums + c);
    } else if (c + W < e.num_comp) {
      add_columns<2>(count, num_moments, table, moment_points, B + c, row, sums + c);
    } else if (c < e.num_comp) {
      add_columns<1>(count, num_moments, table, moment_points, B + c, row, sums + c);
    }
  }
}

/// What the functions of each direction give at W points, each with itself; directions beyond `dim` are constant.
struct SquareTable {
  Pack f[3][num_square_kinds][most_coefficients];

  [[gnu::always_inline]] void fill(const PointSquares &s, CeedInt first) {
    const PointEvaluation &e = s.points;
    PointTable table;
    table.fill(e.dim, e.K, e.x_ref + first, e.stride, e.num_points - first);
    for (CeedInt d = 0; d < 3; d++) {
      f[d][0][0] = broadcast(1.0);
      for (CeedInt n = 0; d < e.dim && n < s.P; n++) {
        Pack value{}, derivative{};
        for (CeedInt k = 0; k < e.K; k++) {
          value = fma(s.coefficients[k * s.P + n], table.T[d][k], value);
          derivative = fma(s.coefficients[k * s.P + n], table.dT[d][k], derivative);
        }
        f[d][0][n] = value * value;
        f[d][1][n] = value * derivative;
        f[d][2][n] = derivative * derivative;
      }
    }
  }
};

/// entries_(c, (n2,n1,n0)) = Σ_p Σ_t values_(c,t,p) f_n2 f_n1 f_n0, f of the kinds of term t. Terms of one kind in the
/// first direction are added up before it.
/// Floor of a component and a pack of points, T terms of U kinds in the first direction, multiplications with
/// additions: T (P + P^2) + U P^3.
template <int fixed_P>
void integrate_squares(const PointSquares &s, const CeedScalar *values, CeedScalar *sums, CeedScalar *entries) {
  const PointEvaluation &e = s.points;
  const CeedInt P = fixed_P > 0 ? fixed_P : s.P, P1 = e.dim > 1 ? P : 1, P2 = e.dim > 2 ? P : 1;
  const CeedInt num_sums = P * P1 * P2 * e.num_comp;
  for (CeedInt k = 0; k < num_sums; k++) store(sums + k * W, Pack{});
  SquareTable table;
  for (CeedInt first = 0; first < e.num_points; first += W) {
    table.fill(s, first);
    CeedScalar *sum = sums;
    for (CeedInt c = 0; c < e.num_comp; c++) {
      Pack value[most_square_terms], plane[most_square_terms];
      for (CeedInt t = 0; t < s.num_terms; t++) {
        value[t] =
            load_some(values + (static_cast<CeedSize>(c) * s.num_terms + t) * e.stride + first, e.num_points - first);
      }
      for (CeedInt n2 = 0; n2 < P2; n2++) {
        for (CeedInt t = 0; t < s.num_terms; t++) plane[t] = value[t] * table.f[2][s.kinds[t][2]][n2];
        for (CeedInt n1 = 0; n1 < P1; n1++) {
          Pack row[num_square_kinds];
          CeedInt t = 0;
#pragma GCC unroll 3
          for (int kind = 0; kind < num_square_kinds; kind++) {
            row[kind] = Pack{};
            for (; t < s.ends[kind]; t++) row[kind] = fma(plane[t], table.f[1][s.kinds[t][1]][n1], row[kind]);
          }
#pragma GCC unroll 8
          for (CeedInt n0 = 0; n0 < P; n0++, sum += W) {
            Pack total = load(sum);
#pragma GCC unroll 3
            for (int kind = 0; kind < num_square_kinds; kind++) total = fma(row[kind], table.f[0][kind][n0], total);
            store(sum, total);
          }
        }
      }
    }
  }
  reduce<1>(sums, num_sums, entries);
}

inline IntegrateSquares square_integration(CeedInt K, CeedInt P) {
  if (K > most_coefficients || P > most_coefficients) return nullptr;
  switch (P) {
    case 2:
      return integrate_squares<2>;
    case 3:
      return integrate_squares<3>;
    case 4:
      return integrate_squares<4>;
    case 5:
      return integrate_squares<5>;
    default:
      return integrate_squares<0>;
  }
}

inline PointMoments moments(CeedInt K) {
  return K > most_coefficients ? nullptr : point_moments;
}

}  // namespace hg::host::HG_HOST_ISA
