/// @file
/// Where integrals are taken: at the Gauss points of some cells, or at the material points of an epoch.
///
/// An Integration holds all that an operator needs apart from its QFunction. make() finds the supplier of each of the
/// QFunction's fields by name (materials/material.hpp, field_names), so one builder serves every material and method.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "materials/material.hpp"
#include "options/handle.hpp"

namespace hg {

/// Another counted reference to the same object.
CeedVectorHandle share(CeedVector vector);
CeedElemRestrictionHandle share(CeedElemRestriction rstr);
CeedBasisHandle share(CeedBasis basis);

/// A CEED vector with a copy of `values`.
CeedVectorHandle make_vector(Ceed ceed, std::span<const double> values);
/// Its values on the host.
std::vector<double> to_host(CeedVector vector);

/// The CEED QFunctions of a run, one for each QFunctionSpec: made when first asked for and kept, so that new operators
/// on moved points compile nothing again.
class QFunctionCache {
 public:
  explicit QFunctionCache(Ceed ceed) : ceed_(ceed) {}

  /// The QFunction of `spec`, with `context` at the first call (it takes its own reference) or none.
  CeedQFunction get(const QFunctionSpec &spec, CeedQFunctionContext context = nullptr);
  Ceed ceed() const { return ceed_; }

 private:
  Ceed ceed_;
  std::map<std::string, CeedQFunctionHandle> made_;
};

/// A context with a copy of `data`, a plain C struct.
template <class T>
CeedQFunctionContextHandle make_context(Ceed ceed, const T &data);
/// Overwrites the data of a context made from a T.
template <class T>
void set_context(CeedQFunctionContext context, const T &data);

struct Integration {
  /// Values at the integration points.
  struct AtPoints {
    CeedElemRestrictionHandle rstr;
    CeedVectorHandle values;
  };
  /// A field on the mesh; values are null where the operator's active vector takes their place.
  struct OnMesh {
    CeedElemRestrictionHandle rstr;
    CeedBasisHandle basis;
    CeedVectorHandle values;
  };

  Ceed ceed = nullptr;
  const Material *material = nullptr;
  CeedSize num_points = 0;  ///< length of a vector at the integration points, for each component
  std::map<std::string, AtPoints> at_points;
  std::map<std::string, OnMesh> on_mesh;
  /// Material points only: where they are in their cells. Without, the operator integrates at the bases' own points.
  CeedElemRestrictionHandle points;
  CeedVectorHandle x_ref;
  /// Restriction of num_comp values at each integration point, a point's components next to each other in the L-vector.
  std::function<CeedElemRestrictionHandle(CeedInt num_comp)> restriction;
  /// Region of the integration point with this number.
  std::function<int(CeedSize)> region;

  /// Makes (or replaces) an uninitialised field at the integration points.
  AtPoints &add(const std::string &name, CeedInt num_comp);

  /// The operator of a QFunction. Each field is looked up by its name: with mode NONE in at_points, with another mode
  /// in on_mesh (WEIGHT needs nothing). `active_output` names an output at points that goes to the operator's output
  /// vector instead of the vector in at_points. Throws hg::Error if a name is unknown.
  CeedOperatorHandle make(QFunctionCache &cache, const QFunctionSpec &spec, CeedQFunctionContext context = nullptr,
                          const char *active_output = nullptr) const;
};

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {
CeedQFunctionContextHandle make_context(Ceed ceed, std::size_t size, const void *data);
void set_context(CeedQFunctionContext context, std::size_t size, const void *data);
}  // namespace detail

template <class T>
CeedQFunctionContextHandle make_context(Ceed ceed, const T &data) {
  return detail::make_context(ceed, sizeof(T), &data);
}

template <class T>
void set_context(CeedQFunctionContext context, const T &data) {
  detail::set_context(context, sizeof(T), &data);
}

}  // namespace hg
