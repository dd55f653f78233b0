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

  /// f = ∫ v · (−∇·σ(u_mms)), the body force of the manufactured solution in qfunctions/bc/mms_linear.h times
  /// `factor`. f is overwritten.
  void mms_force(double factor, CeedVector f);

  /// ∫ |u − factor u_mms|² over this rank's integration points.
  double mms_error_squared(double factor, CeedVector u);

  /// Sums for each region on this rank, in the order of the regions.
  std::vector<RegionIntegrals> integrals(CeedVector u);

 protected:
  SolidOperators(const Mesh &mesh, std::span<const RegionMaterial> regions);

  /// Makes residual, Jacobian and the rest from one Integration for each material in use.
  void build(std::vector<Integration> parts);

  const Mesh *mesh_;
  std::vector<RegionMaterial> regions_;
  std::vector<Integration> parts_;
  CeedOperatorHandle residual_, jacobian_;
};

}  // namespace hg
