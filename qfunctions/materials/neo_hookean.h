/// @file
/// Compressible neo-Hookean solid: stress, energy and diagnostics, shared by its initial and current forms.
///
///   ψ = μ/2 (I₁ − 3) − μ ln J + λ/4 (J² − 1 − 2 ln J),   τ = μ (b − I) + λ/2 (J² − 1) I,   λ = K − 2μ/3.
///
/// With F = I + H: b − I = 2 (sym H + H Hᵀ/2), J² − 1 = (J − 1)(J + 1), and, with φ = (J − 1) − ln J,
/// ψ = μ (|H|²/2 − II(H) − det H + φ) + λ/4 ((J − 1)² + 2 φ): nothing of order 1 is subtracted, so stress keeps its
/// relative precision for any small H, and so does ψ.
#ifndef HG_MATERIALS_NEO_HOOKEAN_H
#define HG_MATERIALS_NEO_HOOKEAN_H

#include "../common/kinematics.h"

/// J² − 1
CEED_QFUNCTION_HELPER
CeedScalar hg_square_minus_one(CeedScalar J_minus_1) {
  return J_minus_1 * (J_minus_1 + 2.);
}

/// Kirchhoff stress τ (6); NaN where J <= 0
CEED_QFUNCTION_HELPER
void hg_neo_hookean_tau(const CeedScalar *H, CeedScalar J_minus_1, CeedScalar K, CeedScalar mu, CeedScalar *tau) {
  CeedScalar HHt[9], e[6], q[6];
  const CeedScalar spherical =
      0.5 * hg_lambda(K, mu) * hg_square_minus_one(J_minus_1) + hg_nan_if_inverted(1. + J_minus_1);
  hg_multiply_transpose(H, H, HHt);
  hg_symmetric_part(H, e);
  hg_symmetric_part(HHt, q);
  for (CeedInt c = 0; c < 6; c++) tau[c] = mu * (2. * e[c] + q[c]) + (c < 3 ? spherical : 0.);
}

/// ψ; NaN where J <= 0
CEED_QFUNCTION_HELPER
CeedScalar hg_neo_hookean_energy(const CeedScalar *H, CeedScalar J_minus_1, CeedScalar K, CeedScalar mu) {
  const CeedScalar phi = hg_x_minus_log1p(J_minus_1) + hg_nan_if_inverted(1. + J_minus_1);
  const CeedScalar shear = 0.5 * hg_contract(H, H) - hg_second_invariant(H) - hg_determinant(H) + phi;
  return mu * shear + 0.25 * hg_lambda(K, mu) * (J_minus_1 * J_minus_1 + 2. * phi);
}

/// in: q_data (10), F (9), moduli (2), ∇u (9); out: w ψ / J_n (1)
CEED_QFUNCTION(HgNeoHookeanEnergy)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *energy = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    hg_load_kinematics(Q, i, q_data, F, du, &k);
    energy[i] = k.w * hg_neo_hookean_energy(k.H, k.J_minus_1, moduli[i], moduli[Q + i]);
  }
  return 0;
}

/// in: q_data (10), F (9), moduli (2), ∇u (9); out: diagnostic values (10)
CEED_QFUNCTION(HgNeoHookeanDiagnostic)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *diagnostic = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    CeedScalar sigma[6];
    hg_load_kinematics(Q, i, q_data, F, du, &k);
    const CeedScalar J = 1. + k.J_minus_1;
    hg_neo_hookean_tau(k.H, k.J_minus_1, moduli[i], moduli[Q + i], sigma);
    for (CeedInt c = 0; c < 6; c++) sigma[c] /= J;
    hg_store_diagnostic(Q, i, sigma, J, hg_neo_hookean_energy(k.H, k.J_minus_1, moduli[i], moduli[Q + i]), diagnostic);
  }
  return 0;
}

#endif
