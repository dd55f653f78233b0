/// @file
/// Neo-Hookean solid, current configuration: the residual uses τ and gradients at the end of the step,
///
///   w ∇v : P̃ = (w/J_n) ∇ₓv : τ,   ∇ₓv = ∇v ΔF⁻¹,
///
/// and its derivative, with L = ∇ₓδu and ε = sym L, is
///
///   (w/J_n) ∇ₓv : (L τ + λ J² tr(ε) I + 2 (μ − λ/2 (J² − 1)) ε).
///
/// The residual stores what this needs, so the Jacobian reads 18 + 9 values for each point and nothing else.
#ifndef HG_MATERIALS_NEO_HOOKEAN_CURRENT_H
#define HG_MATERIALS_NEO_HOOKEAN_CURRENT_H

#include "neo_hookean.h"

/// in: q_data (10), F (9), moduli (2), ∇u (9);
/// out: ∇v (9), linearization (18): w/J_n, dXdx ΔF⁻¹ (9), τ (6), λ J², μ − λ/2 (J² − 1)
CEED_QFUNCTION(HgNeoHookeanCurrentResidual)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *q_data = in[0], *F = in[1], *moduli = in[2], *du = in[3];
  CeedScalar *dv = out[0], *linearization = out[1];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    HgKinematics k;
    CeedScalar dF[9], dF_inverse[9], dXdx_current[9], tau[6], tau_full[9];
    const CeedScalar K = moduli[i], mu = moduli[Q + i], lambda = hg_lambda(K, mu);
    hg_load_kinematics(Q, i, q_data, F, du, &k);
    hg_neo_hookean_tau(k.H, k.J_minus_1, K, mu, tau);
    hg_unpack_symmetric(tau, tau_full);
    for (CeedInt c = 0; c < 9; c++) dF[c] = k.dH[c] + (c % 4 == 0 ? 1. : 0.);
    hg_inverse(dF, 1. + hg_determinant_minus_one(k.dH), dF_inverse);
    hg_multiply(k.dXdx, dF_inverse, dXdx_current);
    hg_gradient_transpose(Q, i, k.w, dXdx_current, tau_full, dv);

    const CeedScalar J_squared_minus_1 = hg_square_minus_one(k.J_minus_1);
    linearization[i] = k.w;
    hg_store(Q, i, 9, dXdx_current, linearization + Q);
    hg_store(Q, i, 6, tau, linearization + 10 * Q);
    linearization[16 * Q + i] = lambda * (1. + J_squared_minus_1);
    linearization[17 * Q + i] = mu - 0.5 * lambda * J_squared_minus_1;
  }
  return 0;
}

/// in: linearization (18), ∇δu (9); out: ∇v (9)
CEED_QFUNCTION(HgNeoHookeanCurrentJacobian)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  (void)ctx;
  const CeedScalar *linearization = in[0], *du = in[1];
  CeedScalar *dv = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    CeedScalar dXdx_current[9], tau[6], tau_full[9], L[9], epsilon[6], A[9], elastic[9];
    const CeedScalar w = linearization[i];
    const CeedScalar bulk = linearization[16 * Q + i], shear = linearization[17 * Q + i];
    hg_load(Q, i, 9, linearization + Q, dXdx_current);
    hg_load(Q, i, 6, linearization + 10 * Q, tau);
    hg_unpack_symmetric(tau, tau_full);
    hg_gradient(Q, i, du, dXdx_current, L);
    hg_symmetric_part(L, epsilon);
    hg_unpack_symmetric(epsilon, elastic);
    hg_multiply(L, tau_full, A);
    const CeedScalar spherical = bulk * hg_trace(L);
    for (CeedInt c = 0; c < 9; c++) A[c] += 2. * shear * elastic[c] + (c % 4 == 0 ? spherical : 0.);
    hg_gradient_transpose(Q, i, w, dXdx_current, A, dv);
  }
  return 0;
}

#endif
