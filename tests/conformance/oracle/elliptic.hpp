/// @file
/// Mass and Poisson operators of the gallery on a box, with their stored data.
#pragma once

#include <string>

#include "box.hpp"

namespace hg::test {

enum class Elliptic { mass, poisson };

/// Setup and application of a gallery operator of one or three components.
struct EllipticOperator {
  /// Coordinates use a basis of degree mesh.P_1d - 1, and so do the unknowns.
  EllipticOperator(Ceed ceed, const Box &mesh, Elliptic kind, CeedInt num_comp, CeedInt Q_1d,
                   CeedQuadMode quad_mode = CEED_GAUSS);
  Values apply(const Values &in) const;
  CeedSize size() const { return l_size; }

  Ceed ceed;
  CeedSize l_size;
  Restriction rstr_x, rstr_u, rstr_q;
  Basis basis_x, basis_u;
  Vector x, q_data;
  QFunction qf_build, qf_apply;
  Operator op_build, op;
};

}  // namespace hg::test
