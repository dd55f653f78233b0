/// @file
/// Solid operators integrated at material points (implicit MPM).
#pragma once

#include <functional>
#include <map>
#include <optional>
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
///
/// Cells that have lost most of their points leave functions of the mesh without a stiffness. Where asked for, a void
/// supports them: linear elasticity for Δu by Gauss quadrature, with the moduli of the softest region times
/// void_stiffness · max(0, 1 − 2 φ), where φ = Σ_p V_p / V_cell is the part of the cell that points fill. It forgets
/// its stress with each reset of the mesh, and a cell that is half full feels nothing of it. (The idea of a fictitious
/// material of small stiffness: the finite cell method, Parvizian, Düster and Rank 2007,
/// doi:10.1007/s00466-007-0173-y.)
class MpmOperators : public SolidOperators {
 public:
  /// The mesh must outlive this object; the points' region numbers index `regions`; void_stiffness >= 0, 0 for none.
  /// Not collective.
  MpmOperators(const Mesh &mesh, std::span<const RegionMaterial> regions, double void_stiffness = 0.);

  /// Builds everything that depends on where the points are. Copies F, V, material, rho0, x and u of the swarm, so that
  /// the swarm stays untouched until update_points(). The epoch must live until the next attach(). A rank without
  /// points is fine: its operators give zero.
  void attach(const PointEpoch &epoch, const Swarm &swarm);

  /// For each local cell whether anything in it resists Δu: points, or the void.
  const std::vector<char> &active_cells() const { return active_cells_; }

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
  /// The void of this epoch; none where every cell is half full or it is not asked for. Sets active_cells_.
  std::optional<Integration> make_void(const PointEpoch &epoch, const Swarm &swarm);

  double void_stiffness_;
  std::vector<char> active_cells_;
  std::vector<double> cell_volumes_;  ///< only with a void
  CeedBasisHandle basis_u_, basis_x_;
  CeedQFunctionContextHandle update_context_;
  Integration all_;
  std::map<std::string, CeedVectorHandle> values_;  ///< at all points, by field name
};

}  // namespace hg
