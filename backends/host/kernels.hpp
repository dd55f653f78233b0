/// @file
/// The kernels of host backends as functions: one table for each instruction set, all from the same text. Work is done
/// on blocks of W elements side by side: entry k of a block's array holds the W numbers [k*W, k*W + W), one for each
/// element. Arrays of blocks are aligned to CEED_ALIGN.
#pragma once

#include <ceed/types.h>

#include <stdint.h>

namespace hg::host {

inline constexpr CeedInt max_width = 8;

/// How a matrix of one direction reads from both ends: B(M-1-m, N-1-n) = s B(m, n).
enum class Symmetry {
  none,
  even,  ///< s = 1: values at points that lie symmetrically
  odd,   ///< s = -1: first derivatives
};

/// What kernels ask the memory for while they compute: `lines` cache lines at each step of their innermost loop, from
/// the address `next` on, which moves along. Nothing is read, so that the address may lie anywhere. Data that stream by
/// once (geometry at the points) are otherwise waited for when a block begins, and the memory waits while it is worked
/// on.
struct Ahead {
  static constexpr CeedInt line = 64;  ///< bytes
  uintptr_t next = 0;
  CeedInt lines = 0;
};

/// Applies a matrix B, M by N, along one direction of an array in_(a,n,c), a < pre, c < post:
///   out_(a,m,c) = Σ_n B_(m,n) in_(a,n,c), or +=.
/// Coefficients, for Symmetry::none: B, row after row; else for each of the first (M+1)/2 rows m the even ones
/// (B_(m,n) + B_(m,N-1-n))/2, n < (N+1)/2, but B_(m,n) itself in the middle of an odd N, then the odd ones
/// (B_(m,n) - B_(m,N-1-n))/2, n < N/2.
/// Floor: (N + M) post*pre loads and stores of W numbers; M N post*pre fused multiplications and additions, half of
/// them where B is symmetric (even-odd decomposition; Solomonoff, J. Comput. Phys. 98 (1992), 174-177).
using Contraction = void (*)(const CeedScalar *coefficients, CeedInt M, CeedInt N, CeedInt pre, CeedInt post,
                             const CeedScalar *in, CeedScalar *out, Ahead &ahead);

/// Where the elements of a block find their nodes in an L-vector. Lanes beyond the last element repeat it.
struct BlockNodes {
  CeedInt num_nodes, num_comp;
  CeedInt comp_stride;
  CeedInt step;                       ///< between offsets of one element
  const CeedInt *offsets[max_width];  ///< of each lane
};

/// Where the numbers of a block go that are entries of element matrices: entry (row, column) is at
/// places[row*num_columns + column] of the block, and goes to elem*elem_stride + row*row_stride + column.
struct EntryPlaces {
  const CeedInt *places;
  CeedInt num_rows, num_columns;
  CeedInt num_elem;  ///< lanes that are wanted
  CeedSize row_stride, elem_stride;
};

/// The points of one element, or of W side by side, and what is evaluated there: num_comp functions, given by K^dim
/// Chebyshev coefficients c each, (component, k_(dim-1), ..., k_0). Along an element entry k is at coefficients[k*W]
/// (those of an element in a block); across W elements, to which the points belong in turn, at coefficients[k*W +
/// lane]. Arrays at points have `stride` numbers between components, and dim*num_comp components for derivatives, the
/// direction slower than the component; max_width numbers more, after the last one, can be read, and are written back.
struct PointEvaluation {
  CeedInt dim, K, num_comp, num_points;
  const CeedScalar *x_ref;  ///< (direction, point)
  CeedSize stride;          ///< between components, and between directions of x_ref
  Ahead *ahead;             ///< a step for each W points
};
/// values, or NULL; derivatives where the kernel is one with derivatives
using EvaluatePoints = void (*)(const PointEvaluation &evaluation, const CeedScalar *coefficients, CeedScalar *values,
                                CeedScalar *derivatives);
/// The transpose: coefficients are overwritten; `sums`: max_width num_comp K^dim numbers to work with along an element.
using IntegratePoints = void (*)(const PointEvaluation &evaluation, const CeedScalar *values,
                                 const CeedScalar *derivatives, CeedScalar *sums, CeedScalar *coefficients);

/// Moments of num_comp sets of values at the points of one element, num_comp next to each other for each point: K^dim
/// of them, sums_((k_(dim-1), ..., k_0), c) = Σ_p T_k(x_p) values_(p,c). Rows of `values` and `sums` are `row` numbers
/// apart, a multiple of max_width, and aligned as blocks are. table: K^dim moment_points numbers to work with.
inline constexpr CeedInt moment_points = 128;
using PointMoments = void (*)(const PointEvaluation &evaluation, const CeedScalar *values, CeedSize row,
                              CeedScalar *table, CeedScalar *sums);

/// What functions of one space give with themselves at the points of one element: P functions in each direction, K
/// Chebyshev coefficients each, coefficients[k*P + n]. A term is a set of values at the points that multiplies in each
/// direction the functions squared (kind 0), with their derivatives (1) or their derivatives squared (2).
inline constexpr CeedInt num_square_kinds = 3, most_square_terms = 10;
struct PointSquares {
  PointEvaluation points;  ///< num_comp: sets of all terms
  CeedInt P;
  const CeedScalar *coefficients;
  CeedInt num_terms;
  CeedInt kinds[most_square_terms][3];  ///< of a term in each direction; sorted by that in the first one
  CeedInt ends[num_square_kinds];       ///< of the terms of each kind in the first direction
};
/// entries_(c, (n_(dim-1), ..., n_0)) = Σ_p Σ_t values_(c,t,p) f_n, f the product over the directions of what the kinds
/// of t say; values are `stride` numbers apart for each (c,t). sums: max_width num_comp P^dim numbers to work with.
using IntegrateSquares = void (*)(const PointSquares &squares, const CeedScalar *values, CeedScalar *sums,
                                  CeedScalar *entries);

struct Kernels {
  const char *isa;  ///< for people: "avx512"
  CeedInt width;    ///< W; 1: one element at a time, with SIMD within it
  CeedInt columns;  ///< 0, or coefficients for Symmetry::none go on with B column after column, each filled up with
                    ///< zeros to a multiple of this

  /// The kernel for a matrix of this shape. With a symmetry: one made for the shape, or NULL; without: for any shape.
  Contraction (*contraction)(CeedInt M, CeedInt N, Symmetry symmetry, bool add);

  /// The kernels for K coefficients of a direction; NULL where there are too many.
  EvaluatePoints (*point_evaluation)(CeedInt K, bool with_derivatives, bool is_across);
  IntegratePoints (*point_integration)(CeedInt K, bool with_derivatives, bool is_across);
  PointMoments (*point_moments)(CeedInt K);
  IntegrateSquares (*square_integration)(CeedInt K, CeedInt P);
  /// values_(c,p) = l[offsets[p]*num_comp + c], p < num_points; l has l_size numbers
  void (*gather_points)(CeedInt num_points, CeedInt num_comp, const CeedInt *offsets, const CeedScalar *l,
                        CeedSize l_size, CeedSize stride, CeedScalar *values);
  /// l[offsets[p]*num_comp + c] = values_(c,p); the second one: +=
  void (*scatter_points[2])(CeedInt num_points, CeedInt num_comp, const CeedInt *offsets, const CeedScalar *values,
                            CeedSize stride, CeedScalar *l);

  /// block_(c,n) = l[offsets[n*step] + c*comp_stride]
  void (*gather)(const BlockNodes &nodes, const CeedScalar *l, CeedScalar *block);
  /// Asks the memory for the entries of an L-vector that `nodes` lead to, to read them or to add to them.
  void (*ask_for_nodes)(const BlockNodes &nodes, const CeedScalar *l, bool to_write);
  /// l[...] += row_(c,n) for the element in one lane
  void (*scatter_add)(const BlockNodes &nodes, CeedInt lane, const CeedScalar *row, CeedScalar *l);
  /// block_k = rows[lane][k], k < count
  void (*gather_rows)(CeedInt count, const CeedScalar *const *rows, CeedScalar *block);
  /// rows[lane*count + k] = block_k
  void (*to_rows)(CeedSize count, const CeedScalar *block, CeedScalar *rows);
  void (*to_entries)(const EntryPlaces &to, const CeedScalar *block, CeedScalar *entries);
};

/// The kernels for this machine, for blocks of elements or for one at a time; the environment variable CEED_HOST_ISA
/// (portable, avx2, avx512) takes another set that the machine has. NULL, with the reason, where it names none such.
const Kernels *kernels(bool is_blocked, const char **reason);

}  // namespace hg::host
