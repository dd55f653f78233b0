/// @file
/// Linear elasticity: ψ = μ ε:ε + (λ/2) tr²ε with ε = sym(F − I), so P = 2μ ε + λ tr(ε) I.
///
/// With F_n = I this is the small-strain theory. For a point with a history it is the same energy of the same F, and
/// the residual stays linear in Δu; it is not objective, so use it where displacements are small.
#ifndef HG_MATERIALS_LINEAR_H
#define HG_MATERIALS_LINEAR_H

#include "../common/kinematics.h"

/// σ = 2μ sym(H) + λ tr(H) I, symmetric
CEED_QFUNCTION_HELPER
void hg_linear_stress(const CeedScalar *H, CeedScalar K, CeedScalar mu, CeedScalar *sigma) {
  const CeedScalar pressure = hg_lambda(K, mu) * hg_trace(H);
  hg_symmetric_part(H, sigma);
  for (CeedInt c = 0; c < 6; c++) sigma[c] = 2. * mu * sigma[c] + (c < 3 ? pressure : 0.);
}

CEED_QFUNCTION_HELPER
CeedScalar hg_linear_energy(const CeedScalar *H, CeedScalar K, CeedScalar mu) {
  CeedScalar e[6];
  hg_symmetric_part(H, e);
  const CeedScalar trace = e[0] + e[1] + e[2];
  const CeedScalar square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 2. * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  return mu * square + 0.5 * hg_lambda(K, mu) * trace * trace;
}

/// dv = w ∇v : P F_nᵀ / J_n for a symmetric P
CEED_QFUNCTION_HELPER
void hg_linear_output(CeedInt Q, CeedInt i, const HgKinematics *k, const CeedScalar *sigma, CeedScalar *dv) {
  CeedScalar P[9], P_tilde[9];
  hg_unpack_symmetric(sigma, P);
  hg_multiply_transpose(P, k->F_n, P_tilde);
  hg_gradient_transpose(Q, i, k->w, k->dXdx, P_tilde, dv);
}

/// in: q_data (10), F (9), moduli (2), ∇u (9); out: ∇v (9)
CEED_QFUNCTION(HgLinearResidual)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *dv = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    CeedScalar sigma[6];
    hg_load_kinematics(Q, i, q_data, F, du, &k);
    hg_linear_stress(k.H, moduli[i], moduli[Q + i], sigma);
    hg_linear_output(Q, i, &k, sigma, dv);
  }
  return 0;
}

/// in: q_data (10), F (9), moduli (2), ∇δu (9); out: ∇v (9). δF = ∇δu F_n, δP = 2μ sym δF + λ tr(δF) I.
CEED_QFUNCTION(HgLinearJacobian)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *dv = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    CeedScalar dF[9], sigma[6];
    hg_load_reference(Q, i, q_data, F, &k);
    hg_gradient(Q, i, du, k.dXdx, k.dH);
    hg_multiply(k.dH, k.F_n, dF);
    hg_linear_stress(dF, moduli[i], moduli[Q + i], sigma);
    hg_linear_output(Q, i, &k, sigma, dv);
  }
  return 0;
}

/// in: q_data (10), F (9), moduli (2), ∇u (9); out: w ψ / J_n (1)
CEED_QFUNCTION(HgLinearEnergy)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *energy = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    hg_load_kinematics(Q, i, q_data, F, du, &k);
    energy[i] = k.w * hg_linear_energy(k.H, moduli[i], moduli[Q + i]);
  }
  return 0;
}

/// in: q_data (10), F (9), moduli (2), ∇u (9); out: diagnostic values (10)
CEED_QFUNCTION(HgLinearDiagnostic)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *diagnostic = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    CeedScalar sigma[6];
    hg_load_kinematics(Q, i, q_data, F, du, &k);
    hg_linear_stress(k.H, moduli[i], moduli[Q + i], sigma);
    hg_store_diagnostic(Q, i, sigma, 1. + k.J_minus_1, hg_linear_energy(k.H, moduli[i], moduli[Q + i]), diagnostic);
  }
  return 0;
}

#endif
