/// @file
/// What a basis is made of, for those who evaluate it.
#pragma once

#include <ceed/backend.h>

#include <vector>

namespace hg::host {

/// The matrices of a basis, row by row. Tensor products go direction by direction; where Q >= P their derivatives are
/// taken of the values at the quadrature points (the collocated derivative), else of the nodes.
struct BasisFactors {
  /// How values come about.
  enum class Route {
    identity,    ///< tensor product whose points are the nodes
    collocated,  ///< tensor product, derivatives at the points
    chains,      ///< tensor product, a chain for each derivative
    full,        ///< a matrix for each value
  };
  explicit BasisFactors(CeedBasis basis);

  Route route = Route::full;
  CeedInt num_directions = 1, num_comp = 0;            ///< one direction where the matrices are full
  CeedInt P = 0, Q = 0;                                ///< nodes and points in a direction
  std::vector<CeedScalar> interp_1d;                   ///< tensor: Q by P
  std::vector<CeedScalar> grad_1d;                     ///< tensor: Q by P; Q by Q where collocated
  std::vector<const CeedScalar *> interp, derivative;  ///< full: one for each value, Q by P; they are the basis's
  std::vector<CeedScalar> weights;                     ///< one for each quadrature point

 private:
  void read_tensor(CeedBasis basis);
  void read_full(CeedBasis basis);
};

}  // namespace hg::host
