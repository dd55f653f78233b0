/// @file
/// Solid operators integrated at material points (implicit MPM).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "operators/solid_operators.hpp"
#include "swarm/epoch.hpp"
#include "swarm/swarm.hpp"

namespace hg {

/// Bases, mesh restrictions and QFunctions live for the run; attach() makes new operators for a new point epoch.
///
/// In a step: attach(epoch, swarm) after location, then any number of residual, Jacobian, body force and integrals (all
/// with u = Δu), then, once the step is accepted, update_points().
class MpmOperators : public SolidOperators {
 public:
  /// The mesh must outlive this object. Not collective.
  MpmOperators(const Mesh &mesh, std::span<const RegionMaterial> regions);

  /// Builds everything that depends on where the points are. Copies F, V, material, rho0 and x of the swarm, so the
  /// swarm's fields stay untouched until update_points(). The epoch must live until the next attach(). A rank without
  /// points is fine: its operators give zero.
  void attach(const PointEpoch &epoch, const Swarm &swarm);

  /// x += Δu, u += Δu, F = (I + ∇Δu) F, V = det(I + ∇Δu) V, v = Δu/Δt, written to the swarm. The epoch is stale then.
  /// Throws hg::Error and writes nothing if det(I + ∇Δu) <= 0 at some point (its id and position are named).
  void update_points(CeedVector delta_u, double delta_t, Swarm &swarm);

  /// Values of Material::diagnostic at the points after Δu, num_points × num_diagnostic, storage order.
  std::vector<double> point_diagnostics(CeedVector delta_u);

  /// Sum over this rank's points of Nᵢ V: zero at nodes that no point supports. L-vector of mesh.space(order, 1).
  void node_volume(CeedVector volume);
};

}  // namespace hg
