/// @file
/// Finite elements of textbooks as matrices: Lagrange, Raviart-Thomas and Nédélec elements of lowest orders on
/// simplices, prisms and boxes, each from a list of polynomial fields and a list of functionals, with a quadrature
/// rule.
#pragma once

#include <ceed/backend.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "support/values.hpp"

namespace hg::test {

/// The one derivative that a space has.
CeedEvalMode derivative_mode(CeedFESpace space);
/// Values at a point for one component: of a space in dim dimensions, for that mode.
CeedInt q_comp(CeedFESpace space, CeedInt dim, CeedEvalMode mode);

/// A polynomial in up to three variables.
class Polynomial3 {
 public:
  struct Term {
    CeedScalar coefficient;
    std::array<int, 3> powers;
  };
  Polynomial3() = default;
  Polynomial3(CeedScalar coefficient, std::array<int, 3> powers) : terms_{{coefficient, powers}} {}
  CeedScalar at(const CeedScalar *x) const;
  Polynomial3 derivative(int direction) const;
  void add(CeedScalar factor, const Polynomial3 &other);

 private:
  std::vector<Term> terms_;
};

/// A field: one polynomial in H^1, dim of them in H(div) and H(curl).
using PolynomialField = std::vector<Polynomial3>;

/// A finite element and a quadrature rule on its reference shape: [-1,1]^dim for lines, quadrilaterals and hexahedra;
/// corners at the origin and the unit vectors for triangles and tetrahedra; a triangle times [-1,1] for prisms.
struct Tabulated {
  std::string name;
  CeedElemTopology topology = CEED_TOPOLOGY_LINE;
  CeedFESpace space = CEED_FE_SPACE_H1;
  CeedInt dim = 1, P = 0, Q = 0;
  Values q_ref, q_weights;                                     ///< (point, direction) with the point fastest; weights
  std::vector<PolynomialField> shapes;                         ///< the basis function of each degree of freedom
  Values interp, derivative;                                   ///< q_comp by Q by P
  std::function<Values(const PolynomialField &)> interpolate;  ///< degrees of freedom of a field

  CeedEvalMode derivative_mode() const { return hg::test::derivative_mode(space); }
  CeedInt q_comp(CeedEvalMode mode) const { return hg::test::q_comp(space, dim, mode); }
  const Values &matrix(CeedEvalMode mode) const { return mode == CEED_EVAL_INTERP ? interp : derivative; }
  /// Values (dim or one) or derivative of a field at a point, q_comp entries.
  Values evaluate(const PolynomialField &field, CeedEvalMode mode, const CeedScalar *x) const;
  /// Coordinates of quadrature point q.
  Values point(CeedInt q) const;
  Basis make(Ceed ceed, CeedInt num_comp) const;
};

/// Every element that the tests know, with `points` quadrature points a direction (polynomials of degree
/// 2 points - 1 are integrated exactly in each direction).
std::vector<Tabulated> tabulated_elements(CeedInt points);
/// The one with that name.
Tabulated tabulated(const std::string &name, CeedInt points);

/// `q_comp` by `rows` by `columns` applied to (node, component) of each element by the definition, or its transpose
/// to (point, component, value).
Values dense_apply(const Values &matrix, CeedInt q_comp, CeedInt Q, CeedInt P, CeedInt num_comp, CeedInt num_elem,
                   CeedTransposeMode t_mode, const Values &u);

}  // namespace hg::test
