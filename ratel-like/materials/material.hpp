/// @file
/// A material: one descriptor and one QFunction header.
///
/// A material's QFunctions never know which method called them. Every one of them integrates over "points with a
/// weight", works on the mesh as it lies at the start of the step, and takes the deformation F_n that the material
/// has already seen when the step starts:
///
///   F = ΔF F_n,  ΔF = I + ∇Δu,  J_n = det F_n,  P̃ = (1/J_n) P(F) F_nᵀ = (1/J_n) τ(F) ΔF⁻ᵀ,
///   residual(v) = Σ_q w_q ∇v(x_q) : P̃.
///
/// MPM passes what the points carry (weight V_p, F_p, K_p, μ_p). FEM passes w det J, F_n = I and the region's K and μ
/// through restrictions that read the same few numbers for every point, so Δu is the total displacement, P̃ is the
/// first Piola-Kirchhoff stress, and nothing is stored for it. docs/theory/impm.md derives the formulas.
///
/// Layout of a field at Q points: component c of point q at c*Q + q. Tensors are row-major: A[3*i + j].
#pragma once

#include <ceed.h>

#include <span>
#include <string_view>

namespace hg {

/// One input or output of a QFunction. The name says who supplies it; see field_names below.
struct QFunctionField {
  const char *name;
  CeedInt size;       ///< values for each point, as in CeedQFunctionAddInput()
  CeedEvalMode mode;  ///< CEED_EVAL_NONE for data at points, GRAD or INTERP for fields on the mesh
};

/// A user function together with the fields it reads and writes, in order.
struct QFunctionSpec {
  const char *name;
  CeedQFunctionUser function;
  const char *source;  ///< "file:function", for backends that compile at run time
  std::span<const QFunctionField> inputs, outputs;
};

/// The vocabulary of field names. The operators room looks up suppliers by these.
namespace field_names {
inline constexpr const char *q_data = "q_data";  ///< 10: weight (w det J, or V_p), then dXdx[3*k + j] = ∂X_k/∂x_j
inline constexpr const char *F = "F";            ///< 9: F_n at the start of the step (FEM: identity)
inline constexpr const char *moduli = "moduli";  ///< 2: bulk modulus K, shear modulus μ
inline constexpr const char *rho = "rho";        ///< 1: density ρ₀ for each unit of undeformed volume
inline constexpr const char *x = "x";            ///< 3: coordinates of the point at the start of the step
inline constexpr const char *u = "u";            ///< active, value or gradient of the displacement (increment)
inline constexpr const char *v = "v";            ///< active, dual of u
inline constexpr const char *linearization = "linearization";  ///< written by the residual, read by the Jacobian
inline constexpr const char *energy = "energy";                ///< 1: strain energy of the point, weight included
inline constexpr const char *diagnostic = "diagnostic";        ///< see Material::diagnostic
}  // namespace field_names

/// Elastic constants of one region, as the user gives them.
struct ElasticParameters {
  double E = 0.;    ///< Young's modulus, > 0
  double nu = 0.;   ///< Poisson's ratio, in (-1, 1/2)
  double rho = 1.;  ///< density of the undeformed body, >= 0

  double bulk_modulus() const { return E / (3. * (1. - 2. * nu)); }
  double shear_modulus() const { return E / (2. * (1. + nu)); }
  double lame_lambda() const { return bulk_modulus() - 2. / 3. * shear_modulus(); }
};

/// Descriptor of a material. All are constants with static lifetime.
struct Material {
  std::string_view name;                      ///< for -model
  std::span<const std::string_view> aliases;  ///< further names for -model
  std::string_view summary;                   ///< one line for -help
  CeedInt num_linearization;                  ///< values at each point from residual to Jacobian; 0: none

  QFunctionSpec residual;  ///< q_data, F, moduli, ∇u → ∇v [, linearization]
  QFunctionSpec jacobian;  ///< linearization or (q_data, F, moduli), ∇δu → ∇v: the exact derivative of residual
  QFunctionSpec energy;    ///< q_data, F, moduli, ∇u → w ψ(F)/J_n
  QFunctionSpec diagnostic;  ///< q_data, F, moduli, ∇u → diagnostic values, not weighted
};

/// Values of Material::diagnostic, in this order.
inline constexpr const char *diagnostic_names[] = {"cauchy_stress_xx",
                                                   "cauchy_stress_yy",
                                                   "cauchy_stress_zz",
                                                   "cauchy_stress_yz",
                                                   "cauchy_stress_xz",
                                                   "cauchy_stress_xy",
                                                   "pressure",
                                                   "von_mises_stress",
                                                   "J",
                                                   "strain_energy_density"};
inline constexpr CeedInt num_diagnostic = 10;  ///< strain_energy_density is per undeformed volume; pressure = -tr σ / 3

/// All materials, each under one descriptor.
std::span<const Material *const> materials();

/// The material called `name` (or one of its aliases). Throws hg::Error that lists the known names.
const Material &find_material(std::string_view name);

}  // namespace hg
