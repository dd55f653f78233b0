#include <cmath>
#include <limits>
#include <numbers>

#include "error.hpp"

namespace {

/// Points are found in extended precision, so that they and the weights (which depend on the points steeply near the
/// ends of the interval) are right to the last place of a CeedScalar.
using Real = long double;

/// P_n and P_(n-1) at x, by (k+1) P_(k+1) = (2k+1) x P_k - k P_(k-1); n >= 1.
struct Legendre {
  Real value, previous;
};
Legendre legendre(CeedInt n, Real x) {
  Real previous = 1, value = x;
  for (CeedInt k = 1; k < n; k++) {
    const Real next = ((2 * k + 1) * x * value - k * previous) / (k + 1);
    previous = value;
    value = next;
  }
  return {value, previous};
}

/// P_n'(x) = n (P_(n-1) - x P_n) / (1 - x^2), |x| < 1.
Real derivative(CeedInt n, Real x, const Legendre &p) {
  return n * (p.previous - x * p.value) / ((1 - x) * (1 + x));
}

/// Newton iteration x -= step(x) until the steps are at rounding.
template <typename Step>
Real newton(Real x, Step &&step) {
  constexpr int max_iterations = 100;
  Real last = 1;
  for (int i = 0; i < max_iterations; i++) {
    const Real dx = step(x);
    x -= dx;
    // Quadratic convergence ends where steps no longer shrink.
    if (std::abs(dx) <= std::numeric_limits<Real>::epsilon() || (i > 3 && std::abs(dx) >= last)) break;
    last = std::abs(dx);
  }
  return x;
}

/// Stores point i of Q (counted from the right end) and its mirror image. The middle point of an odd rule is exactly 0.
void store(CeedInt Q, CeedInt i, Real x, Real w, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d) {
  if (2 * i + 1 == Q) x = 0;
  q_ref_1d[i] = static_cast<CeedScalar>(-x);
  q_ref_1d[Q - 1 - i] = static_cast<CeedScalar>(x);
  if (q_weight_1d != nullptr) q_weight_1d[i] = q_weight_1d[Q - 1 - i] = static_cast<CeedScalar>(w);
}

void require_points(const char *rule, CeedInt Q, CeedInt least, const CeedScalar *q_ref_1d) {
  hg::require(Q >= least, CEED_ERROR_DIMENSION, [&] {
    return hg::text("%s quadrature: Q is %" CeedInt_FMT "; expected at least %" CeedInt_FMT " points", rule, Q, least);
  });
  hg::require(q_ref_1d != nullptr, CEED_ERROR_INCOMPLETE,
              [&] { return hg::text("%s quadrature: q_ref_1d is NULL; expected an array of Q entries", rule); });
}

}  // namespace

// Gauss: the roots of P_Q, w = 2 / ((1 - x^2) P_Q'(x)^2).
int CeedGaussQuadrature(CeedInt Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d) {
  return hg::guard(nullptr, [&] {
    require_points("Gauss", Q, 1, q_ref_1d);
    for (CeedInt i = 0; i <= (Q - 1) / 2; i++) {
      Real x = std::cos(std::numbers::pi_v<Real> * (i + Real(0.75)) / (Q + Real(0.5)));
      x = newton(x, [&](Real y) {
        const Legendre p = legendre(Q, y);
        return p.value / derivative(Q, y, p);
      });
      if (2 * i + 1 == Q) x = 0;
      const Real slope = derivative(Q, x, legendre(Q, x));
      store(Q, i, x, 2 / ((1 - x) * (1 + x) * slope * slope), q_ref_1d, q_weight_1d);
    }
  });
}

// Gauss-Lobatto, n = Q - 1: the ends and the roots of P_n', w = 2 / (n (n+1) P_n(x)^2).
// Newton uses Legendre's equation, (1 - x^2) P_n'' = 2 x P_n' - n (n+1) P_n.
int CeedLobattoQuadrature(CeedInt Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d) {
  return hg::guard(nullptr, [&] {
    require_points("Gauss-Lobatto", Q, 2, q_ref_1d);
    const CeedInt n = Q - 1;
    const Real n_n1 = static_cast<Real>(n) * (n + 1);
    store(Q, 0, 1, 2 / n_n1, q_ref_1d, q_weight_1d);
    for (CeedInt i = 1; i <= (Q - 1) / 2; i++) {
      // Asymptotic roots of P_n' as the starting values.
      const Real phase = i + Real(0.25), pi = std::numbers::pi_v<Real>;
      Real x = std::cos(phase * pi / n - 3 / (8 * n * pi * phase));
      x = newton(x, [&](Real y) {
        const Legendre p = legendre(n, y);
        const Real slope = derivative(n, y, p);
        return slope * (1 - y) * (1 + y) / (2 * y * slope - n_n1 * p.value);
      });
      if (2 * i + 1 == Q) x = 0;
      const Real value = legendre(n, x).value;
      store(Q, i, x, 2 / (n_n1 * value * value), q_ref_1d, q_weight_1d);
    }
  });
}
