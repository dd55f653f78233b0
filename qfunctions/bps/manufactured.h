/// @file
/// Manufactured solution of the bake-off problems on the unit cube: right-hand sides and errors.
///
/// φ(x) = exp(a·x) Π_i sin(π x_i), a = (1/2, −1/4, 1/3), is zero on the boundary and has no symmetry that would hide
/// exchanged axes. Component c of the solution is u_c = (c + 1)(s + φ): s = 0 for Poisson, with u = 0 on the boundary;
/// s = 1 for the mass problems, an L2 projection without boundary condition.
#pragma once

#include "../common/jacobian.h"

#ifndef CEED_RUNNING_JIT_PASS
#include <math.h>
#endif

/// Context of every QFunction in this file.
struct BPSolution {
  double shift;      ///< s
  int32_t num_comp;  ///< 1 or 3
};

/// φ, ∇φ and Δφ at x.
CEED_QFUNCTION_HELPER
void BPBubble(const CeedScalar x[3], CeedScalar *phi, CeedScalar grad[3], CeedScalar *laplacian) {
  const CeedScalar pi = 3.14159265358979323846;
  const CeedScalar a[3] = {0.5, -0.25, 1. / 3.};
  const CeedScalar s[3] = {sin(pi * x[0]), sin(pi * x[1]), sin(pi * x[2])};
  const CeedScalar c[3] = {pi * cos(pi * x[0]), pi * cos(pi * x[1]), pi * cos(pi * x[2])};
  const CeedScalar e = exp(a[0] * x[0] + a[1] * x[1] + a[2] * x[2]);
  const CeedScalar S = s[0] * s[1] * s[2];
  const CeedScalar dS[3] = {c[0] * s[1] * s[2], s[0] * c[1] * s[2], s[0] * s[1] * c[2]};

  *phi = e * S;
  for (int i = 0; i < 3; i++) grad[i] = e * (dS[i] + a[i] * S);
  *laplacian = e * (-3 * pi * pi * S + 2 * (a[0] * dS[0] + a[1] * dS[1] + a[2] * dS[2]) +
                    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * S);
}

/// Mass problems: v_c = w det J u_c(x).
/// in[0] x (3), in[1] gradient of the coordinates (9), in[2] weight (1); out[0] v (num_comp).
CEED_QFUNCTION(BPMassSource)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const struct BPSolution *solution = (const struct BPSolution *)ctx;
  const CeedScalar *X = in[0], *dx = in[1], *w = in[2];
  CeedScalar *v = out[0];

  for (CeedInt q = 0; q < Q; q++) {
    const CeedScalar x[3] = {X[q], X[q + Q], X[q + Q * 2]};
    CeedScalar A[3][3], phi, grad[3], laplacian;
    const CeedScalar w_detJ = w[q] * JacobianAdjugate3D(Q, q, dx, A);

    BPBubble(x, &phi, grad, &laplacian);
    for (CeedInt c = 0; c < solution->num_comp; c++) v[q + Q * c] = w_detJ * (c + 1) * (solution->shift + phi);
  }
  return CEED_ERROR_SUCCESS;
}

/// Poisson problems, the source: v_c = −w det J Δu_c(x).
/// in[0] x (3), in[1] gradient of the coordinates (9), in[2] weight (1); out[0] v (num_comp).
CEED_QFUNCTION(BPPoissonSource)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const struct BPSolution *solution = (const struct BPSolution *)ctx;
  const CeedScalar *X = in[0], *dx = in[1], *w = in[2];
  CeedScalar *v = out[0];

  for (CeedInt q = 0; q < Q; q++) {
    const CeedScalar x[3] = {X[q], X[q + Q], X[q + Q * 2]};
    CeedScalar A[3][3], phi, grad[3], laplacian;
    const CeedScalar w_detJ = w[q] * JacobianAdjugate3D(Q, q, dx, A);

    BPBubble(x, &phi, grad, &laplacian);
    for (CeedInt c = 0; c < solution->num_comp; c++) v[q + Q * c] = -w_detJ * (c + 1) * laplacian;
  }
  return CEED_ERROR_SUCCESS;
}

/// Poisson problems, the source in weak form ∫ ∇v·∇u: dv_c = w adj(J) ∇u_c(x).
/// in[0] x (3), in[1] gradient of the coordinates (9), in[2] weight (1); out[0] reference gradient for v (3 num_comp).
CEED_QFUNCTION(BPPoissonFlux)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const struct BPSolution *solution = (const struct BPSolution *)ctx;
  const CeedInt num_comp = solution->num_comp;
  const CeedScalar *X = in[0], *dx = in[1], *w = in[2];
  CeedScalar *dv = out[0];

  for (CeedInt q = 0; q < Q; q++) {
    const CeedScalar x[3] = {X[q], X[q + Q], X[q + Q * 2]};
    CeedScalar A[3][3], phi, grad[3], laplacian;

    JacobianAdjugate3D(Q, q, dx, A);
    BPBubble(x, &phi, grad, &laplacian);
    for (CeedInt d = 0; d < 3; d++) {
      const CeedScalar flux = w[q] * (A[d][0] * grad[0] + A[d][1] * grad[1] + A[d][2] * grad[2]);

      for (CeedInt c = 0; c < num_comp; c++) dv[q + Q * (c + num_comp * d)] = (c + 1) * flux;
    }
  }
  return CEED_ERROR_SUCCESS;
}

/// Terms of the error norms: w det J times (|u_h − u|², |u|², |∇u_h − ∇u|², |∇u|²), summed over the components.
/// in[0] u_h (num_comp), in[1] its reference gradient (3 num_comp), in[2] x (3), in[3] gradient of the coordinates (9),
/// in[4] weight (1); out[0] terms (4).
CEED_QFUNCTION(BPError)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const struct BPSolution *solution = (const struct BPSolution *)ctx;
  const CeedInt num_comp = solution->num_comp;
  const CeedScalar *u = in[0], *du = in[1], *X = in[2], *dx = in[3], *w = in[4];
  CeedScalar *terms = out[0];

  for (CeedInt q = 0; q < Q; q++) {
    const CeedScalar x[3] = {X[q], X[q + Q], X[q + Q * 2]};
    CeedScalar A[3][3], phi, grad[3], laplacian, sum[4] = {0, 0, 0, 0};
    const CeedScalar detJ = JacobianAdjugate3D(Q, q, dx, A);

    BPBubble(x, &phi, grad, &laplacian);
    for (CeedInt c = 0; c < num_comp; c++) {
      const CeedScalar exact = (c + 1) * (solution->shift + phi);
      const CeedScalar difference = u[q + Q * c] - exact;

      sum[0] += difference * difference;
      sum[1] += exact * exact;
      for (CeedInt i = 0; i < 3; i++) {
        // ∂u_h/∂x_i = Σ_d ∂X_d/∂x_i ∂u_h/∂X_d
        const CeedScalar exact_i = (c + 1) * grad[i];
        const CeedScalar grad_i = (A[0][i] * du[q + Q * c] + A[1][i] * du[q + Q * (c + num_comp)] +
                                   A[2][i] * du[q + Q * (c + num_comp * 2)]) /
                                  detJ;

        sum[2] += (grad_i - exact_i) * (grad_i - exact_i);
        sum[3] += exact_i * exact_i;
      }
    }
    for (CeedInt i = 0; i < 4; i++) terms[q + Q * i] = w[q] * detJ * sum[i];
  }
  return CEED_ERROR_SUCCESS;
}
