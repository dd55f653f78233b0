/// @file
/// The six bake-off problems of the CEED project, and the work that one application of each must do.
///
/// BP1, BP2: mass, 1 and 3 components, q = p + 2 Gauss points a direction, no boundary condition (an L2 projection).
/// BP3, BP4: Poisson, 1 and 3 components, q = p + 2 Gauss points, zero on the boundary.
/// BP5, BP6: as BP3 and BP4 with q = p + 1 Gauss-Lobatto points, the nodes themselves.
#pragma once

#include <ceed.h>

#include <span>
#include <string_view>

namespace hg::bps {

struct Problem {
  std::string_view name;
  bool is_poisson;
  CeedInt num_comp;
  bool is_collocated;

  CeedInt q_1d(CeedInt degree) const { return is_collocated ? degree + 1 : degree + 2; }
  CeedQuadMode quad_mode() const { return is_collocated ? CEED_GAUSS_LOBATTO : CEED_GAUSS; }
  /// Stored values at each point.
  CeedInt num_stored() const { return is_poisson ? 6 : 1; }
};

/// BP1 to BP6 in order.
std::span<const Problem> all_problems();

/// The problem of this name (`bp1` … `bp6`), or null.
const Problem *find_problem(std::string_view name);

/// What one application must move and compute.
struct Work {
  double bytes;  ///< compulsory bytes
  double flops;
  double held_bytes;  ///< compulsory bytes that the operator must hold: without x and y
};

/// At quadrature points, compulsory bytes are x read and y written (16 a DoF), one 4-byte offset for each node of each
/// cell, and the stored data (8 bytes a value). Flops are those of sum-factorised contractions, 2 (P³Q + P²Q² + PQ³)
/// for each component and derivative set, once forward and once transposed, and the work at the points (1 a component
/// for mass, 15 for Poisson).
Work work_at_quadrature(const Problem &problem, CeedInt degree, CeedSize num_elem, CeedSize num_dofs);

/// At material points: the same bytes, and 24 for the reference coordinates of each point; held are 4 more for its
/// place. The contraction at a point costs 2 (P³ + P² + P) flops for each component and derivative set, forward and
/// transposed.
Work work_at_points(const Problem &problem, CeedInt degree, CeedSize num_elem, CeedSize num_dofs, CeedSize num_points);

}  // namespace hg::bps
