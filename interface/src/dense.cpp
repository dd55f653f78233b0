#include "dense.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.hpp"

namespace hg {

namespace {

/// Applies I - 2 w w^T / (w^T w) from the left to columns first..last-1 of `a` (rows k..m-1), w given from row k on.
void reflect(std::vector<CeedScalar> &a, CeedInt m, CeedInt n, CeedInt k, CeedInt first,
             const std::vector<CeedScalar> &w) {
  CeedScalar w_w = 0.0;
  for (CeedInt i = k; i < m; i++) w_w += w[i] * w[i];
  if (w_w == 0.0) return;
  for (CeedInt j = first; j < n; j++) {
    CeedScalar w_a = 0.0;
    for (CeedInt i = k; i < m; i++) w_a += w[i] * a[i * n + j];
    const CeedScalar factor = 2.0 * w_a / w_w;
    for (CeedInt i = k; i < m; i++) a[i * n + j] -= factor * w[i];
  }
}

}  // namespace

std::vector<CeedScalar> pseudo_inverse(const std::vector<CeedScalar> &a, CeedInt m, CeedInt n, const char *what) {
  require(m >= n, CEED_ERROR_DIMENSION, [&] {
    return text("%s has %" CeedInt_FMT " rows and %" CeedInt_FMT " columns; expected at least as many rows as columns",
                what, m, n);
  });
  // Q^T A = R by reflections, applied to the identity as well: q_t ends as Q^T.
  std::vector<CeedScalar> r = a, q_t(static_cast<std::size_t>(m) * m, 0.0), w(m);
  for (CeedInt i = 0; i < m; i++) q_t[i * m + i] = 1.0;
  for (CeedInt k = 0; k < n; k++) {
    CeedScalar norm = 0.0;
    for (CeedInt i = k; i < m; i++) norm = std::hypot(norm, r[i * n + k]);
    for (CeedInt i = k; i < m; i++) w[i] = r[i * n + k];
    // The sign that adds magnitudes: no cancellation.
    w[k] += std::copysign(norm, w[k]);
    reflect(r, m, n, k, k, w);
    reflect(q_t, m, m, k, 0, w);
  }

  CeedScalar largest = 0.0, smallest = std::numeric_limits<CeedScalar>::infinity();
  for (CeedInt k = 0; k < n; k++) {
    largest = std::max(largest, std::abs(r[k * n + k]));
    smallest = std::min(smallest, std::abs(r[k * n + k]));
  }
  require(smallest > m * std::numeric_limits<CeedScalar>::epsilon() * largest, CEED_ERROR_MINOR, [&] {
    return text("%s has dependent columns: the diagonal of its R factor goes from %g down to %g", what, largest,
                smallest);
  });

  // R X = (Q^T)_(first n rows) by back substitution.
  std::vector<CeedScalar> x(static_cast<std::size_t>(n) * m);
  for (CeedInt k = n; k-- > 0;) {
    for (CeedInt j = 0; j < m; j++) {
      CeedScalar sum = q_t[k * m + j];
      for (CeedInt l = k + 1; l < n; l++) sum -= r[k * n + l] * x[l * m + j];
      x[k * m + j] = sum / r[k * n + k];
    }
  }
  return x;
}

std::vector<CeedScalar> multiply(const std::vector<CeedScalar> &a, const std::vector<CeedScalar> &b, CeedInt l,
                                 CeedInt m, CeedInt n) {
  std::vector<CeedScalar> c(static_cast<std::size_t>(l) * n, 0.0);
  for (CeedInt i = 0; i < l; i++) {
    for (CeedInt k = 0; k < m; k++) {
      for (CeedInt j = 0; j < n; j++) c[i * n + j] += a[i * m + k] * b[k * n + j];
    }
  }
  return c;
}

}  // namespace hg
