/// @file
/// What the printed text of an operator at points is made of: up to two packs of points, of one element or of W.
#pragma once

#include "in_blocks.hpp"

namespace hg::host::HG_HOST_ISA {

/// Index of the first point of element e in the list of a restriction at points.
[[gnu::always_inline]] inline CeedInt first_point(const Side &side, CeedInt e) {
  return side.offsets[e];
}

/// The element to which a point in that list belongs.
inline CeedInt element_of(const Side &side, CeedInt num_elem, CeedInt place) {
  CeedInt e = 0;
  while (e + 1 < num_elem && side.offsets[e + 1] <= place) e++;
  return e;
}

/// The points of a block of elements.
struct BlockPoints {
  Mask count{};        ///< of each lane
  CeedInt element[W];  ///< one that has points, for lanes that have none
  CeedInt last[W];     ///< point of that element
  CeedInt total, most = 0, least;
  bool is_across;  ///< whether they are taken across the elements

  [[gnu::always_inline]] BlockPoints(const Side &side, CeedInt first, CeedInt num_elem)
      : total(first_point(side, first + num_elem) - first_point(side, first)) {
    CeedInt counts[W], any = first;
    for (CeedInt lane = 0; lane < W; lane++) {
      const CeedInt e = first + lane;
      counts[lane] = lane < num_elem ? first_point(side, e + 1) - first_point(side, e) : 0;
      if (counts[lane] > 0) any = e;
      count[lane] = counts[lane];
    }
    is_across = pays_across(counts, W);
    least = counts[0];
    for (CeedInt lane = 0; lane < W; lane++) {
      const CeedInt n = counts[lane];
      if (n > most) most = n;
      if (n < least) least = n;
      element[lane] = n > 0 ? first + lane : any;
      last[lane] = n > 0 ? n - 1 : 0;
    }
  }
};

/// The points [first, first + n) of element e, of which arrays have `stride` numbers for each component; those beyond
/// the n-th repeat it. What belongs to the element is in one lane of a block.
struct Along {
  static constexpr bool is_across = false;
  CeedInt e, lane, first, n, stride;

  [[gnu::always_inline]] const CeedInt *places(const Side &side) const {
    return side.offsets + first_point(side, e) + first;
  }
};

/// The points k, and k + 1 where `stride` is 2 W, of the elements of a block, one in each lane. Where an element does
/// not have so many the last one is repeated.
struct Across {
  static constexpr bool is_across = true;
  const BlockPoints &block;
  CeedInt k, stride;

  [[gnu::always_inline]] bool are_there() const { return k * W + stride <= block.least * W; }
  [[gnu::always_inline]] CeedInt place(const Side &side, CeedInt i, CeedInt lane) const {
    const CeedInt last = block.last[lane], p = k + i < last ? k + i : last;
    return side.offsets[first_point(side, block.element[lane]) + p];
  }
};

/// What num_comp numbers at each point from those of element e on will be read from, as much for each pack as a pack
/// holds. It is taken to lie together, as it does where points are sorted by element; elsewhere the lines that are
/// asked for are not the right ones.
template <int num_comp>
[[gnu::always_inline]] inline Ahead points_ahead(const Side &side, const CeedScalar *l, CeedInt e, CeedInt end) {
  constexpr CeedInt bytes = num_comp * W * sizeof(CeedScalar);
  if (e >= end || first_point(side, e) == first_point(side, end)) return {};
  return {reinterpret_cast<uintptr_t>(l + static_cast<CeedSize>(side.offsets[first_point(side, e)]) * num_comp),
          (bytes + Ahead::line - 1) / Ahead::line};
}
template <int packs>
[[gnu::always_inline]] inline void ask(Ahead &ahead) {
  for (int i = 0; i < packs; i++) ask(ahead);
}

/// Lists with more components are read, and added to, by functions of their own: copies of them at each place would
/// take compilers longer than all the rest.
inline constexpr int most_inlined = 6;

/// values_(c,p) = component c at the p-th of n listed points, and up to the stride the last of them again.
template <int num_comp>
[[gnu::always_inline]] inline void read_here(const CeedInt *list, CeedInt n, const CeedScalar *l, CeedSize l_size,
                                             CeedInt stride, CeedScalar *values) {
  gather_points(n, num_comp, list, l, l_size, stride, values);
  for (CeedInt c = 0; c < num_comp && n < stride; c++) {
    CeedScalar *component = values + c * stride;
    for (CeedInt p = n; p < stride; p++) component[p] = component[n - 1];
  }
}
template <int num_comp>
[[gnu::noinline]] void read_apart(const CeedInt *list, CeedInt n, const CeedScalar *l, CeedSize l_size, CeedInt stride,
                                  CeedScalar *values) {
  read_here<num_comp>(list, n, l, l_size, stride, values);
}
template <int num_comp>
[[gnu::always_inline]] inline void read_list(const CeedInt *list, CeedInt n, const Side &side, const CeedScalar *l,
                                             CeedInt stride, CeedScalar *values) {
  if constexpr (num_comp > most_inlined) {
    read_apart<num_comp>(list, n, l, side.l_size, stride, values);
  } else {
    read_here<num_comp>(list, n, l, side.l_size, stride, values);
  }
}

/// Component c at the p-th of n listed points += values_(c,p), or = where `set`.
template <int num_comp>
[[gnu::always_inline]] inline void write_here(const CeedInt *list, CeedInt n, const CeedScalar *values, CeedInt stride,
                                              bool set, CeedScalar *l) {
  if (set) {
    scatter_points<false>(n, num_comp, list, values, stride, l);
  } else {
    scatter_points<true>(n, num_comp, list, values, stride, l);
  }
}
template <int num_comp>
[[gnu::noinline]] void write_apart(const CeedInt *list, CeedInt n, const CeedScalar *values, CeedInt stride, bool set,
                                   CeedScalar *l) {
  write_here<num_comp>(list, n, values, stride, set, l);
}
template <int num_comp>
[[gnu::always_inline]] inline void write_list(const CeedInt *list, CeedInt n, const CeedScalar *values, CeedInt stride,
                                              bool set, CeedScalar *l) {
  if constexpr (num_comp > most_inlined) {
    write_apart<num_comp>(list, n, values, stride, set, l);
  } else {
    write_here<num_comp>(list, n, values, stride, set, l);
  }
}

/// values_(c,p) = component c at point p
template <int num_comp>
[[gnu::always_inline]] inline void read_points(const Side &side, const CeedScalar *l, const Along &points,
                                               CeedScalar *values) {
  read_list<num_comp>(points.places(side), points.n, side, l, points.stride, values);
}
template <int num_comp>
[[gnu::always_inline]] inline void read_points(const Side &side, const CeedScalar *l, const Across &points,
                                               CeedScalar *values) {
  CeedInt places[2 * W];
  for (CeedInt i = 0; i * W < points.stride; i++) {
    for (CeedInt lane = 0; lane < W; lane++) places[i * W + lane] = points.place(side, i, lane);
  }
  read_list<num_comp>(places, points.stride, side, l, points.stride, values);
}

/// Component c at point p += values_(c,p), or = where `set`
template <int num_comp>
[[gnu::always_inline]] inline void write_points(const Side &side, const Along &points, const CeedScalar *values,
                                                bool set, CeedScalar *l) {
  write_list<num_comp>(points.places(side), points.n, values, points.stride, set, l);
}
template <int num_comp>
[[gnu::always_inline]] inline void write_points(const Side &side, const Across &points, const CeedScalar *values,
                                                bool set, CeedScalar *l) {
  const bool are_there = points.are_there();
  for (CeedInt i = 0; i * W < points.stride; i++) {
    CeedInt places[W], first = 0, n = 0;
    for (CeedInt lane = 0; lane < W; lane++) places[lane] = points.place(side, i, lane);
    const auto is_there = [&](CeedInt lane) { return are_there || points.k + i < points.block.count[lane]; };
    for (CeedInt lane = 0; lane <= W; lane++) {  // runs of points that are there
      if (lane < W && is_there(lane)) {
        n++;
        continue;
      }
      if (n > 0) write_list<num_comp>(places + first, n, values + i * W + first, points.stride, set, l);
      first = lane + 1;
      n = 0;
    }
  }
}

/// What is to be integrated counts at points that are there, and is 0 at others. (Kernels see to the end of Along.)
template <int num_comp>
[[gnu::always_inline]] inline void drop_repeated(const Along &, CeedScalar *) {}
template <int num_comp>
[[gnu::always_inline]] inline void drop_repeated(const Across &points, CeedScalar *values) {
  if (points.are_there()) return;
  for (CeedInt i = 0; i * W < points.stride; i++) {
    const Mask is_there = points.block.count > static_cast<int64_t>(points.k + i);
    for (CeedInt c = 0; c < num_comp; c++) {
      CeedScalar *at = values + c * points.stride + i * W;
      store_anywhere(at, is_there ? load_anywhere(at) : Pack{});
    }
  }
}

template <int packs>
[[gnu::always_inline]] inline void tabulate(CeedInt dim, CeedInt K, const CeedScalar *x_ref, CeedInt stride,
                                            PointTable (&table)[packs]) {
#pragma GCC unroll 2
  for (int i = 0; i < packs; i++) table[i].fill(dim, K, x_ref + i * W, stride, stride - i * W);
}

/// What num_comp functions of K coefficients in each direction are at the points, and their derivatives; either may be
/// NULL. `coefficients`: those of a block of elements.
template <int dim, int K, int num_comp, bool with_derivatives, int packs, typename Points>
[[gnu::always_inline]] inline void evaluate_at(const PointTable (&table)[packs], const CeedScalar *coefficients,
                                               const Points &points, CeedScalar *values, CeedScalar *derivatives) {
  constexpr int K1 = dim > 1 ? K : 1, K2 = dim > 2 ? K : 1;
  if constexpr (!Points::is_across) coefficients += points.lane;
  for (int c = 0; c < num_comp; c++) {
#pragma GCC unroll 2
    for (int i = 0; i < packs; i++) {
      PointValues<with_derivatives> at;
      at.template evaluate<Points::is_across ? each_its_own : W>(table[i], K, K1, K2,
                                                                 coefficients + c * K * K1 * K2 * W);
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

/// The transpose: adds to W numbers for each coefficient, those of the elements across them, or, along one element,
/// such as are to be reduced.
template <int dim, int K, int num_comp, bool with_derivatives, int packs, typename Points>
[[gnu::always_inline]] inline void integrate_at(const PointTable (&table)[packs], const Points &points,
                                                const CeedScalar *values, const CeedScalar *derivatives,
                                                CeedScalar *to_reduce, CeedScalar *coefficients) {
  CeedInt n = points.stride;
  if constexpr (!Points::is_across) n = points.n;
  const PointEvaluation e{dim, K, num_comp, n, nullptr, points.stride, nullptr};
  integrate_packs<K, with_derivatives, packs>(e, table, 0, values, derivatives,
                                              Points::is_across ? coefficients : to_reduce);
}

}  // namespace hg::host::HG_HOST_ISA
