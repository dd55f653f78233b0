/// @file
/// Neo-Hookean solid, initial configuration: P = F S with
///
///   S = λ/2 (J² − 1) C⁻¹ + 2μ C⁻¹ E,   C = I + 2E,   E = sym H + Hᵀ H/2,
///
/// which is μ (I − C⁻¹) + λ/2 (J² − 1) C⁻¹ without the difference of near-equal tensors. The weak form on the mesh of
/// the step is w ∇v : P F_nᵀ / J_n, and its derivative, with δF = ∇δu F_n and δE = sym(Fᵀ δF), is
///
///   δP = δF S + F δS,   δS = λ J² (C⁻¹ : δE) C⁻¹ + (2μ − λ (J² − 1)) C⁻¹ δE C⁻¹.
#ifndef HG_MATERIALS_NEO_HOOKEAN_INITIAL_H
#define HG_MATERIALS_NEO_HOOKEAN_INITIAL_H

#include "neo_hookean.h"

/// F (9), C⁻¹ (9), S (9) from H; NaN where J <= 0
CEED_QFUNCTION_HELPER
void hg_neo_hookean_second_piola(const CeedScalar *H, CeedScalar J_minus_1, CeedScalar K, CeedScalar mu, CeedScalar *F,
                                 CeedScalar *C_inverse, CeedScalar *S) {
  CeedScalar E[9], C[9];
  const CeedScalar J = 1. + J_minus_1;
  const CeedScalar volumetric = 0.5 * hg_lambda(K, mu) * hg_square_minus_one(J_minus_1) + hg_nan_if_inverted(J);
  for (CeedInt i = 0; i < 3; i++) {
    for (CeedInt j = 0; j < 3; j++) {
      const CeedScalar HtH = H[i] * H[j] + H[3 + i] * H[3 + j] + H[6 + i] * H[6 + j];
      E[3 * i + j] = 0.5 * (H[3 * i + j] + H[3 * j + i] + HtH);
      C[3 * i + j] = 2. * E[3 * i + j] + (i == j ? 1. : 0.);
      F[3 * i + j] = H[3 * i + j] + (i == j ? 1. : 0.);
    }
  }
  hg_inverse(C, J * J, C_inverse);
  hg_multiply(C_inverse, E, S);
  for (CeedInt c = 0; c < 9; c++) S[c] = 2. * mu * S[c] + volumetric * C_inverse[c];
}

/// dv = w ∇v : P F_nᵀ / J_n
CEED_QFUNCTION_HELPER
void hg_neo_hookean_initial_output(CeedInt Q, CeedInt i, const HgKinematics *k, const CeedScalar *P, CeedScalar *dv) {
  CeedScalar P_tilde[9];
  hg_multiply_transpose(P, k->F_n, P_tilde);
  hg_gradient_transpose(Q, i, k->w, k->dXdx, P_tilde, dv);
}

/// in: q_data (10), F (9), moduli (2), ∇u (9); out: ∇v (9), linearization (9): H
CEED_QFUNCTION(HgNeoHookeanInitialResidual)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F_n = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *dv = out[0], *linearization = out[1];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    CeedScalar F[9], C_inverse[9], S[9], P[9];
    hg_load_kinematics(Q, i, q_data, F_n, du, &k);
    hg_neo_hookean_second_piola(k.H, k.J_minus_1, moduli[i], moduli[Q + i], F, C_inverse, S);
    hg_multiply(F, S, P);
    hg_neo_hookean_initial_output(Q, i, &k, P, dv);
    hg_store(Q, i, 9, k.H, linearization);
  }
  return 0;
}

/// in: q_data (10), F (9), moduli (2), linearization (9), ∇δu (9); out: ∇v (9)
CEED_QFUNCTION(HgNeoHookeanInitialJacobian)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F_n = in[1], *moduli = in[2], *linearization = in[3], *du = in[4];
  CeedScalar *dv = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    CeedScalar F[9], C_inverse[9], S[9], dF[9], dE[9], M[9], dS[9], dP[9], FdS[9];
    const CeedScalar K = moduli[i], mu = moduli[Q + i], lambda = hg_lambda(K, mu);
    hg_load_reference(Q, i, q_data, F_n, &k);
    hg_load(Q, i, 9, linearization, k.H);
    k.J_minus_1 = hg_determinant_minus_one(k.H);
    hg_neo_hookean_second_piola(k.H, k.J_minus_1, K, mu, F, C_inverse, S);

    hg_gradient(Q, i, du, k.dXdx, k.dH);
    hg_multiply(k.dH, k.F_n, dF);
    for (CeedInt r = 0; r < 3; r++) {
      for (CeedInt c = 0; c < 3; c++) {
        CeedScalar sum = 0.;
        for (CeedInt m = 0; m < 3; m++) sum += F[3 * m + r] * dF[3 * m + c] + F[3 * m + c] * dF[3 * m + r];
        dE[3 * r + c] = 0.5 * sum;
      }
    }
    hg_multiply(C_inverse, dE, M);
    hg_multiply(M, C_inverse, dS);
    const CeedScalar J_squared_minus_1 = hg_square_minus_one(k.J_minus_1);
    const CeedScalar volumetric = lambda * (1. + J_squared_minus_1) * hg_contract(C_inverse, dE);
    const CeedScalar shear = 2. * mu - lambda * J_squared_minus_1;
    for (CeedInt c = 0; c < 9; c++) dS[c] = shear * dS[c] + volumetric * C_inverse[c];
    hg_multiply(dF, S, dP);
    hg_multiply(F, dS, FdS);
    for (CeedInt c = 0; c < 9; c++) dP[c] += FdS[c];
    hg_neo_hookean_initial_output(Q, i, &k, dP, dv);
  }
  return 0;
}

#endif
