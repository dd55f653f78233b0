/// @file
/// What the printed text of an operator at points is made of: up to two packs of points of one element.
#pragma once

#include "in_blocks.hpp"

namespace hg::host::HG_HOST_ISA {

/// n points of an element, the first of which is the `first`-th of all that `side` lists; arrays have `stride` numbers
/// for each component, of which those beyond the n-th repeat it.
struct SomePoints {
  CeedInt first, n, stride;
};

/// Index of the first point of element e in the list of a restriction at points.
[[gnu::always_inline]] inline CeedInt first_point(const Side &side, CeedInt e) {
  return side.offsets[e];
}

/// values_(c,p) = component c at point p
template <int num_comp>
[[gnu::always_inline]] inline void read_points(const Side &side, const CeedScalar *l, const SomePoints &points,
                                               CeedScalar *values) {
  gather_points(points.n, num_comp, side.offsets + points.first, l, side.l_size, points.stride, values);
  for (CeedInt c = 0; c < num_comp && points.n < points.stride; c++) {
    CeedScalar *component = values + c * points.stride;
    for (CeedInt p = points.n; p < points.stride; p++) component[p] = component[points.n - 1];
  }
}

/// Component c at point p += values_(c,p)
template <int num_comp>
[[gnu::always_inline]] inline void add_points(const Side &side, const SomePoints &points, const CeedScalar *values,
                                              CeedScalar *l) {
  scatter_add_points(points.n, num_comp, side.offsets + points.first, values, points.stride, l);
}

template <int packs>
[[gnu::always_inline]] inline void tabulate(CeedInt dim, CeedInt K, const CeedScalar *x_ref, CeedInt stride,
                                            PointTable (&table)[packs]) {
#pragma GCC unroll 2
  for (int i = 0; i < packs; i++) table[i].fill(dim, K, x_ref + i * W, stride, stride - i * W);
}

/// What num_comp functions of K coefficients in each direction are at the points, and their derivatives; either may be
/// NULL. `coefficients`: of the first component; those of the element's lane lie W apart.
template <int dim, int K, int num_comp, bool with_derivatives, int packs>
[[gnu::always_inline]] inline void evaluate_at(const PointTable (&table)[packs], const CeedScalar *coefficients,
                                               const SomePoints &points, CeedScalar *values, CeedScalar *derivatives) {
  constexpr int K1 = dim > 1 ? K : 1, K2 = dim > 2 ? K : 1;
  for (int c = 0; c < num_comp; c++) {
#pragma GCC unroll 2
    for (int i = 0; i < packs; i++) {
      PointValues<with_derivatives> at;
      at.template evaluate<W>(table[i], K, K1, K2, coefficients + c * K * K1 * K2 * W);
      const CeedInt n = points.stride - i * W;
      if (values != nullptr) store_some(values + c * points.stride + i * W, at.v, n);
      if constexpr (with_derivatives) {
        CeedScalar *to = derivatives + c * points.stride + i * W;
        store_some(to, at.x, n);
        if (dim > 1) store_some(to + num_comp * points.stride, at.y, n);
        if (dim > 2) store_some(to + 2 * num_comp * points.stride, at.z, n);
      }
    }
  }
}

/// The transpose: adds to `sums`, W numbers for each coefficient.
template <int dim, int K, int num_comp, bool with_derivatives, int packs>
[[gnu::always_inline]] inline void integrate_at(const PointTable (&table)[packs], const SomePoints &points,
                                                const CeedScalar *values, const CeedScalar *derivatives,
                                                CeedScalar *sums) {
  const PointEvaluation e{dim, K, num_comp, points.n, nullptr, points.stride, nullptr};
  integrate_packs<K, with_derivatives, packs>(e, table, 0, values, derivatives, sums);
}

}  // namespace hg::host::HG_HOST_ISA
