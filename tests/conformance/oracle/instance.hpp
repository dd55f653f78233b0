/// @file
/// A case made of the library's objects.
#pragma once

#include <memory>
#include <vector>

#include "case.hpp"
#include "support/errors.hpp"

namespace hg::test {

/// The operator of a case on a backend, with what it stands on.
struct Instance {
  Instance(Ceed ceed, const Case &c);
  /// Another operator of the same case, on the same restrictions, bases, QFunction and passive inputs.
  Instance(const Instance &other, const Case &c);
  /// Tells the operator of moved points.
  void set_points(const Case &c);

  Ceed ceed;
  std::vector<Restriction> restrictions;  ///< of the spaces
  std::vector<Basis> bases;               ///< of the spaces; empty handles where there is none
  Basis weight_basis;
  std::vector<Vector> passive;
  Restriction points_restriction;
  Vector points;
  Context context;
  QFunction qf;
  Operator op;

 private:
  void make_qfunction(const Case &c);
  void make_operator(const Case &c);
};

/// Applies the operator; CEED_VECTOR_NONE stands in where it has no active input or output.
Values apply(const Instance &instance, const Case &c, const Values &in);
/// The L-vector of a restriction as (element, node, component): value at [e][n * num_comp + c].
std::vector<Values> by_element(CeedElemRestriction rstr, CeedVector l_vector);
/// The matrix of coordinate form, row-major.
Values dense_from_coordinates(CeedOperator op, Ceed ceed, CeedSize num_rows, CeedSize num_cols);

}  // namespace hg::test
