/// @file
/// Solid operators integrated at material points (implicit MPM).
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "operators/solid_operators.hpp"
#include "swarm/epoch.hpp"
#include "swarm/swarm.hpp"

namespace hg {

/// Bases, mesh restrictions and QFunctions live for the run; attach() makes new operators for a new point epoch.
///
/// In a step: attach(epoch, swarm) after location, then any number of residual, Jacobian, body force and integrals (all
/// with u = Δu), then, once the step is accepted, update_points().
///
/// Points of all regions with the same material share one sub-operator: each reads its own K, μ and ρ₀.
class MpmOperators : public SolidOperators {
 public:
  /// The mesh must outlive this object; the points' region numbers index `regions`. Not collective.
  MpmOperators(const Mesh &mesh, std::span<const RegionMaterial> regions);

  /// Builds everything that depends on where the points are. Copies F, V, material, rho0, x and u of the swarm, so that
  /// the swarm stays untouched until update_points(). The epoch must live until the next attach(). A rank without
  /// points is fine: its operators give zero.
  void attach(const PointEpoch &epoch, const Swarm &swarm);

  /// x += Δu, u += Δu, F = (I + ∇Δu) F, V = det(I + ∇Δu) V, v = Δu/Δt, written to the swarm, whose points must be those
  /// of attach(). The epoch is stale then. Throws hg::Error and writes nothing if det(I + ∇Δu) <= 0 at a point of this
  /// rank; the message has its id and position.
  void update_points(CeedVector delta_u, double delta_t, Swarm &swarm);

  /// Values of Material::diagnostic at the points after Δu: num_points × num_diagnostic, storage order.
  std::vector<double> point_diagnostics(CeedVector delta_u);

  /// All points of the epoch as one part, without a material: q_data, F, V, rho, x and u_total at points, nodes, u and
  /// v on the mesh. For operators beside these, such as projections. Valid until the next attach().
  const Integration &points() const { return all_; }

 private:
  /// Data at points and fields on the mesh that parts share; the restriction may leave points out.
  Integration make_part(const std::function<CeedElemRestrictionHandle(CeedInt)> &restriction) const;

  CeedBasisHandle basis_u_, basis_x_;
  CeedQFunctionContextHandle update_context_;
  Integration all_;
  std::map<std::string, CeedVectorHandle> values_;  ///< at all points, by field name
};

}  // namespace hg
