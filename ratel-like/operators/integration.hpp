/// @file
/// Where integrals are taken: at the Gauss points of some cells, or at the material points of an epoch.
///
/// An Integration holds everything that an operator of one material needs apart from its QFunction. make() looks up the
/// supplier of each of the QFunction's fields by name (materials/material.hpp, field_names), so that one builder serves
/// every material and both methods.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "materials/material.hpp"
#include "options/handle.hpp"

namespace hg {

struct Integration {
  /// A field that is data at the integration points.
  struct Field {
    CeedElemRestrictionHandle rstr;
    CeedVectorHandle values;
  };
  /// A field on the mesh.
  struct Space {
    CeedElemRestrictionHandle rstr;
    CeedBasisHandle basis;
  };

  Ceed ceed = nullptr;
  const Material *material = nullptr;
  CeedInt num_cells = 0;
  CeedSize num_points = 0;              ///< entries for each component of a vector at the integration points
  std::map<std::string, Field> fields;  ///< passive data by field name
  Space displacement;                   ///< for the active fields "u" and "v"
  /// Points only: reference coordinates; without them the operator integrates at the basis' quadrature points.
  CeedElemRestrictionHandle points;
  CeedVectorHandle x_ref;
  /// Restriction for num_comp values at each integration point, L-vector of num_points × num_comp, the components of a
  /// point next to each other.
  std::function<CeedElemRestrictionHandle(CeedInt num_comp)> at_points;

  /// A vector of num_comp values for each integration point and its restriction, under a name. Replaces an older one.
  Field &add(const std::string &name, CeedInt num_comp);

  /// The operator of a QFunction whose fields are all known here. `outputs at points` (mode NONE) go to the passive
  /// vector of that name, or, if `active_output` names one, to the active output vector.
  CeedOperatorHandle make(const QFunctionSpec &spec, CeedQFunctionContext context = nullptr,
                          const char *active_output = nullptr) const;
};

}  // namespace hg
