/// @file
/// Manufactured solution of linear elasticity on the unit cube:
///
///   u_i = (i + 1) A₀ s₀ s₁ s₂,   s_k = sin(2π x_k − π/2) = −cos(2π x_k),   i = 0, 1, 2,
///
/// prescribed on the whole boundary, with the body force −∇·σ = −(μ Δu + (λ + μ) ∇(∇·u)).
/// Its L2 norm over the cube is A₀ √(14/8).
#ifndef HG_BC_MMS_LINEAR_H
#define HG_BC_MMS_LINEAR_H

#include "../common/contexts.h"
#include "../common/kinematics.h"

/// u (3) at x (3)
CEED_QFUNCTION_HELPER
void hg_mms_linear_displacement(const CeedScalar *x, CeedScalar amplitude, CeedScalar *u) {
  const CeedScalar two_pi = 6.283185307179586476925;
  const CeedScalar s = -cos(two_pi * x[0]) * cos(two_pi * x[1]) * cos(two_pi * x[2]);
  for (CeedInt c = 0; c < 3; c++) u[c] = (c + 1) * amplitude * s;
}

/// −∇·σ (3) at x (3)
CEED_QFUNCTION_HELPER
void hg_mms_linear_force(const CeedScalar *x, CeedScalar amplitude, CeedScalar lambda, CeedScalar mu,
                         CeedScalar *force) {
  const CeedScalar two_pi = 6.283185307179586476925;
  CeedScalar s[3], ds[3];  // s_k and its derivative
  for (CeedInt k = 0; k < 3; k++) {
    s[k] = -cos(two_pi * x[k]);
    ds[k] = two_pi * sin(two_pi * x[k]);
  }
  const CeedScalar second = -two_pi * two_pi * s[0] * s[1] * s[2];  // ∂²(s₀s₁s₂)/∂x_k² for every k
  const CeedScalar mixed[3] = {s[0] * ds[1] * ds[2], ds[0] * s[1] * ds[2], ds[0] * ds[1] * s[2]};
  for (CeedInt i = 0; i < 3; i++) {
    CeedScalar grad_div = 0.;
    for (CeedInt j = 0; j < 3; j++) grad_div += (j + 1) * (i == j ? second : mixed[3 - i - j]);
    force[i] = -amplitude * (mu * 3. * (i + 1) * second + (lambda + mu) * grad_div);
  }
}

/// in: q_data (10), x (3), moduli (2); out: v (3)
CEED_QFUNCTION(HgMmsLinearForce)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar amplitude = ((const HgMmsLinearContext *)ctx)->amplitude;
  const CeedScalar *w = in[0], *x = in[1], *moduli = in[2];
  CeedScalar *v = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    CeedScalar point[3], force[3];
    hg_load(Q, i, 3, x, point);
    hg_mms_linear_force(point, amplitude, hg_lambda(moduli[i], moduli[Q + i]), moduli[Q + i], force);
    for (CeedInt c = 0; c < 3; c++) v[c * Q + i] = w[i] * force[c];
  }
  return 0;
}

/// in: q_data (10), x (3), u (3); out: error (1): w |u − u_exact|²
CEED_QFUNCTION(HgMmsLinearError)
(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar amplitude = ((const HgMmsLinearContext *)ctx)->amplitude;
  const CeedScalar *w = in[0], *x = in[1], *u = in[2];
  CeedScalar *error = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) {
    CeedScalar point[3], exact[3], sum = 0.;
    hg_load(Q, i, 3, x, point);
    hg_mms_linear_displacement(point, amplitude, exact);
    for (CeedInt c = 0; c < 3; c++) sum += (u[c * Q + i] - exact[c]) * (u[c * Q + i] - exact[c]);
    error[i] = w[i] * sum;
  }
  return 0;
}

#endif
