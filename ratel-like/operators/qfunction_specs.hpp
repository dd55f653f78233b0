/// @file
/// QFunctions that belong to no material, with the names of their fields. A name "grad_f" is the gradient of field "f".
#pragma once

#include <string>
#include <vector>

#include "materials/material.hpp"

namespace hg::specs {

extern const QFunctionSpec geometry;         ///< ∂x/∂X, weight → q_data, quadrature points of cells
extern const QFunctionSpec geometry_points;  ///< ∂x/∂X, V → q_data, material points
extern const QFunctionSpec weight;           ///< q_data → "scalar": ∫ N
extern const QFunctionSpec integrals;  ///< q_data, F, rho, u, ∇u → "integrals" (5): see qfunctions/common/integrals.h
extern const QFunctionSpec body_force;    ///< q_data, F, rho → v; HgBodyForceContext
extern const QFunctionSpec mms_force;     ///< q_data, x, moduli → v; HgMmsLinearContext
extern const QFunctionSpec mms_error;     ///< q_data, x, u → "error" (1); HgMmsLinearContext
extern const QFunctionSpec point_update;  ///< see qfunctions/mpm/point_update.h; HgPointUpdateContext

/// A QFunctionSpec for a number of components known at run time, with the fields it points to.
class OwnedSpec {
 public:
  OwnedSpec(const char *function_name, CeedQFunctionUser function, const char *source,
            std::vector<QFunctionField> inputs, std::vector<QFunctionField> outputs);
  operator QFunctionSpec() const;

 private:
  std::string name_;  ///< with the sizes of the fields, so that a cache can tell variants apart
  CeedQFunctionUser function_;
  const char *source_;
  std::vector<QFunctionField> inputs_, outputs_;
};

/// q_data, `input` → `output`, num_comp values each: weight times value; HgMassContext{num_comp}.
OwnedSpec mass(const QFunctionField &input, const QFunctionField &output);
/// `input` → `output`: the value; HgMassContext{num_comp}.
OwnedSpec copy(const QFunctionField &input, const QFunctionField &output);

}  // namespace hg::specs
