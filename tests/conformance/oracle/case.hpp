/// @file
/// An operator described by plain numbers, and what it does by definition: dense matrices from Lagrange polynomials,
/// plain loops, nothing of the library but the positions of Gauss and Gauss-Lobatto points.
#pragma once

#include <ceed/backend.h>

#include <memory>
#include <string>
#include <vector>

#include "conformance/qfunctions/mix_context.h"
#include "tabulated.hpp"
#include "support/values.hpp"

namespace hg::test {

/// Nodes of elements in an L-vector, with the Lagrange polynomials on Gauss-Lobatto nodes, or tensor products of given
/// matrices, as basis; or, with P_1d = 0, with a basis given by its matrices; or, without these, one node for each
/// point and no basis.
struct Space {
  CeedInt num_comp = 1, P_1d = 0;
  CeedInt elem_size = 0, comp_stride = 1;
  CeedSize l_size = 0;
  std::vector<CeedInt> offsets;     ///< (node, element), node fastest: place of component 0 in the L-vector
  std::vector<CeedInt> point_list;  ///< at points without basis: offsets as CeedElemRestrictionCreateAtPoints has them
  bool is_strided = false;          ///< then `strides` says the same as `offsets`
  CeedInt strides[3] = {0, 0, 0};
  CeedRestrictionType type = CEED_RESTRICTION_STANDARD;  ///< of those with offsets
  std::vector<CeedInt8> orientation;  ///< (band, node, element): T(n,n-1), T(n,n), T(n,n+1); empty: the identity
  CeedInt block_size = 0;             ///< 0: made by a function without blocks
  CeedFESpace kind = CEED_FE_SPACE_H1;
  CeedElemTopology topology = CEED_TOPOLOGY_LINE;
  Values interp, derivative;  ///< q_comp by points by nodes, if the basis is given by matrices
  Values interp_1d, grad_1d;  ///< Q_1d by P_1d, if it is a tensor product of given matrices

  bool is_tabulated() const { return !interp.empty(); }
  bool has_basis() const { return P_1d > 0 || is_tabulated(); }
  CeedEvalMode derivative_mode() const { return hg::test::derivative_mode(kind); }
  /// Values at a point for one component.
  CeedInt q_comp(CeedInt dim, CeedEvalMode mode) const { return hg::test::q_comp(kind, dim, mode); }
};

/// One input or output.
struct Field {
  std::string name;
  CeedEvalMode mode = CEED_EVAL_NONE;
  int space = -1;   ///< index in Case::spaces; -1 for weights
  int vector = -1;  ///< index in Case::passive; -1: active; meaningless for weights
  bool is_active() const { return mode != CEED_EVAL_WEIGHT && vector < 0; }
};

/// x -> the operator's action, for the QFunction of qfunctions/mix.h.
struct Case {
  CeedInt dim = 1, num_elem = 1;
  bool at_points = false;
  CeedInt Q_1d = 1;
  CeedQuadMode quad_mode = CEED_GAUSS;
  std::vector<CeedInt> num_points;                  ///< points of each element
  std::vector<std::vector<Values>> x;               ///< reference coordinates of point q of element e
  std::vector<std::vector<CeedInt>> point_numbers;  ///< at points: number of point q of element e
  std::vector<Space> spaces;
  std::vector<Field> inputs, outputs;
  std::vector<Values> passive;  ///< L-vectors of passive fields, outputs included
  MixContext mix{};

  /// Values of a field at a point.
  CeedInt size(const Field &field) const;
  CeedSize input_size() const;   ///< length of the active input; 0 where there is none
  CeedSize output_size() const;  ///< length of the active output; 0 where there is none
  CeedInt total_points() const;
  CeedInt max_points() const;
  CeedScalar weight(CeedInt q) const;
};

/// The case in words, for the trace of a failed test.
std::string describe(const Case &c);

/// Value k of a field at a point is the sum of coefficient * L[index].
struct Term {
  CeedSize index;
  CeedScalar coefficient;
};
std::vector<std::vector<Term>> terms(const Case &c, const Field &field, CeedInt elem, CeedInt q);

/// The linearised QFunction at a point: row-major, outputs by active inputs.
Values qfunction_matrix(const Case &c, CeedInt elem, CeedInt q);

/// What an application gives: the active output and the passive vectors, from zero.
struct Outcome {
  Values active;
  std::vector<Values> passive;  ///< zero where no output writes
};
Outcome apply(const Case &c, const Values &in);
/// The matrix of the active output by the active input, row-major.
Values matrix(const Case &c);
/// Whether vector `i` of `passive` belongs to an output.
bool is_output(const Case &c, int i);

/// A bound for the number of rounded terms in an entry of an outcome: for tolerance().
CeedSize num_terms(const Case &c);

/// What a random case is to have.
struct CaseWishes {
  CeedInt dim = 0;  ///< 0: any
  bool at_points = false;
  bool is_square = false;    ///< one active space, the same in and out: for diagonals
  bool is_bilinear = false;  ///< with active inputs and an active output that have bases
  int max_comp = 9;
  bool is_oriented = false;  ///< elements have orientations, and come in blocks
  bool mixes_spaces = false;  ///< bases in H^1, H(div) and H(curl) by matrices beside tensor products; not at points
  bool has_matrices = false;  ///< tensor products of random matrices beside those of polynomials; not at points
  bool has_many_elements = false;  ///< 9 to 20 of them: more than a block of a backend takes, with a rest
  bool is_small = false;      ///< at most 3 elements and 3 points a direction (5 in one dimension)
};
Case random_case(Random &random, const CaseWishes &wishes);

/// 1D Lagrange polynomials on `nodes` and their derivatives at x.
void lagrange(const Values &nodes, CeedScalar x, Values &value, Values &derivative);
/// New places for the points of a case at points, with other counts; the numbers of passive point values must not
/// change, so only cases whose fields all have bases can take new counts.
void place_points(Case &c, Random &random, bool keep_counts);

}  // namespace hg::test
