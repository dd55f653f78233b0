/// @file
/// The operators of a solid on a mesh, the same set for FEM and MPM.
///
/// Every active vector is an L-vector of mesh.rstr_u: the PETSc local vector of mesh.dm, three components of a node
/// next to each other, Dirichlet values put in by the caller. What an operator writes at a shared node is the sum over
/// the local cells only; the caller adds ranks together (DMLocalToGlobal with ADD_VALUES). Nothing here is collective.
///
/// Unknown: FEM the total displacement u, MPM the increment Δu of the step. Units are the user's.
///
/// det F <= 0 at any point makes residual and integrals NaN: the solver sees an inverted element in the norm.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "materials/region_material.hpp"
#include "mesh/mesh.hpp"
#include "operators/integration.hpp"
#include "options/handle.hpp"

namespace hg {

/// Sums over the integration points of one region on this rank.
struct RegionIntegrals {
  double volume = 0.;                         ///< ∫ dv, deformed
  double mass = 0.;                           ///< ∫ ρ₀ dV
  double strain_energy = 0.;                  ///< ∫ ψ dV
  std::array<double, 3> mass_displacement{};  ///< ∫ ρ₀ u dV of the active field; divided by mass, its mean
};

class SolidOperators {
 public:
  virtual ~SolidOperators() = default;
  SolidOperators(const SolidOperators &) = delete;
  SolidOperators &operator=(const SolidOperators &) = delete;

  /// u → internal force ∫ ∇v : P̃(u). Applying it also stores the linearisation at u. Body forces are not in it:
  /// equilibrium is residual(u) − external force = 0.
  CeedOperator residual() const { return residual_; }

  /// δu → derivative of the internal force where it was linearised last, that is at the u of the last application of
  /// residual() (it may be the last trial of a line search) or of linearize(u).
  CeedOperator jacobian() const { return jacobian_; }

  /// Stores the linearisation at u, so that jacobian() is the exact derivative there.
  void linearize(CeedVector u);

  /// f = ∫ v · ρ g with ρ = ρ₀/J_n on the mesh of this step and acceleration g. f is overwritten.
  void body_force(const std::array<double, 3> &acceleration, CeedVector f);

  /// f = ∫ v · (−∇·σ(u_mms)), the body force of the manufactured solution of qfunctions/bc/mms_linear.h with this
  /// amplitude (A₀ times the load factor). f is overwritten.
  void mms_force(double amplitude, CeedVector f);

  /// ∫ |u − u_mms|² over this rank's integration points.
  double mms_error_squared(double amplitude, CeedVector u);

  /// The same integral over this rank's cells by Gauss quadrature with order + 1 points in each direction, whatever the
  /// method's own points are.
  double mms_error_squared_on_mesh(double amplitude, CeedVector u);

  /// Sums for each region on this rank, in the order of the regions.
  std::vector<RegionIntegrals> integrals(CeedVector u);

 protected:
  SolidOperators(const Mesh &mesh, std::span<const RegionMaterial> regions);

  /// Takes one Integration for each material in use, with the fields q_data, F, moduli, rho at points and u, v, nodes
  /// on the mesh, and makes residual and Jacobian. Operators made earlier are dropped. `support`, with the same fields,
  /// adds to residual and Jacobian alone: it has no mass, no load, and no place in any sum.
  void build(std::vector<Integration> parts, std::optional<Integration> support = {});
  /// q_data of a part, by its geometry QFunction; `V` must be there for material points.
  void add_geometry(Integration &part);
  /// What a QFunction's output `output` (num_comp values at each integration point) is for the active vector `active`;
  /// num_points × num_comp values, a point's next to each other.
  std::vector<double> evaluate(const Integration &part, const QFunctionSpec &spec, CeedQFunctionContext context,
                               const char *output, CeedVector active);

  const Mesh *mesh_;
  Ceed ceed_;
  std::vector<RegionMaterial> regions_;
  QFunctionCache cache_;
  std::vector<Integration> parts_;
  CeedOperatorHandle residual_, jacobian_;
  CeedVectorHandle scratch_;  ///< of the length of a local displacement vector

 private:
  void add_coordinates(Integration &part);
  CeedOperatorHandle compose(const QFunctionSpec &spec, CeedQFunctionContext context);

  CeedQFunctionContextHandle body_force_context_, mms_context_;
  CeedOperatorHandle body_force_, mms_force_;
};

}  // namespace hg
