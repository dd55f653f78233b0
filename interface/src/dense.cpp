#include "dense.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "ceed.hpp"

namespace hg {

namespace {

constexpr CeedScalar epsilon = std::numeric_limits<CeedScalar>::epsilon();

std::vector<CeedScalar> identity(CeedInt n) {
  std::vector<CeedScalar> a(static_cast<std::size_t>(n) * n, 0.0);
  for (CeedInt i = 0; i < n; i++) a[static_cast<std::size_t>(i) * n + i] = 1.0;
  return a;
}

/// R X = B from below for R n by n in the upper triangle of r (row stride n), B and X n by num_columns, in place.
void solve_upper(const CeedScalar *r, CeedInt n, CeedScalar *x, CeedInt num_columns) {
  for (CeedInt i = n; i-- > 0;) {
    CeedScalar *x_i = x + static_cast<CeedSize>(i) * num_columns;
    for (CeedInt l = i + 1; l < n; l++) {
      const CeedScalar r_il = r[i * n + l], *x_l = x + static_cast<CeedSize>(l) * num_columns;
      for (CeedInt j = 0; j < num_columns; j++) x_i[j] -= r_il * x_l[j];
    }
    for (CeedInt j = 0; j < num_columns; j++) x_i[j] /= r[i * n + i];
  }
}

/// B = U^T U with U upper triangular.
std::vector<CeedScalar> cholesky(std::span<const CeedScalar> b, CeedInt n) {
  std::vector<CeedScalar> u(b.begin(), b.end());
  CeedScalar largest = 0.0;
  for (CeedInt k = 0; k < n; k++) largest = std::max(largest, std::abs(b[k * n + k]));
  for (CeedInt k = 0; k < n; k++) {
    CeedScalar pivot = u[k * n + k];
    for (CeedInt l = 0; l < k; l++) pivot -= u[l * n + k] * u[l * n + k];
    require(pivot > n * epsilon * largest, CEED_ERROR_MINOR, [&] {
      return text("Simultaneous diagonalization: pivot %" CeedInt_FMT
                  " of B is %g; expected a symmetric positive definite matrix",
                  k, pivot);
    });
    u[k * n + k] = std::sqrt(pivot);
    for (CeedInt j = k + 1; j < n; j++) {
      for (CeedInt l = 0; l < k; l++) u[k * n + j] -= u[l * n + k] * u[l * n + j];
      u[k * n + j] /= u[k * n + k];
    }
  }
  return u;
}

}  // namespace

void qr_factorize(CeedScalar *a, CeedScalar *tau, CeedInt m, CeedInt n, const char *what) {
  require(m >= n, CEED_ERROR_DIMENSION, [&] {
    return text("%s has %" CeedInt_FMT " rows and %" CeedInt_FMT " columns; expected at least as many rows as columns",
                what, m, n);
  });
  std::vector<CeedScalar> v(m);
  for (CeedInt k = 0; k < n; k++) {
    CeedScalar below = 0.0;
    for (CeedInt i = k + 1; i < m; i++) below = std::hypot(below, a[i * n + k]);
    tau[k] = 0.0;
    if (below == 0.0) continue;  // H_k = I
    // H_k takes (alpha, ...) to (beta, 0, ...); the sign of beta adds magnitudes in alpha - beta: no cancellation.
    const CeedScalar alpha = a[k * n + k], beta = -std::copysign(std::hypot(alpha, below), alpha);
    tau[k] = (beta - alpha) / beta;
    v[k] = 1.0;
    for (CeedInt i = k + 1; i < m; i++) v[i] = a[i * n + k] / (alpha - beta);
    for (CeedInt j = k + 1; j < n; j++) {
      CeedScalar v_a = 0.0;
      for (CeedInt i = k; i < m; i++) v_a += v[i] * a[i * n + j];
      for (CeedInt i = k; i < m; i++) a[i * n + j] -= tau[k] * v_a * v[i];
    }
    a[k * n + k] = beta;
    for (CeedInt i = k + 1; i < m; i++) a[i * n + k] = v[i];
  }
}

void apply_q(CeedScalar *a, const CeedScalar *q, const CeedScalar *tau, bool is_transpose, CeedInt m, CeedInt n,
             CeedInt k, CeedInt row, CeedInt col) {
  const auto at = [&](CeedInt i, CeedInt j) -> CeedScalar & {
    return a[static_cast<CeedSize>(i) * row + static_cast<CeedSize>(j) * col];
  };
  std::vector<CeedScalar> v_a(n);
  for (CeedInt step = 0; step < k; step++) {
    const CeedInt r = is_transpose ? step : k - 1 - step;
    const auto v = [&](CeedInt i) { return i == r ? 1.0 : q[static_cast<CeedSize>(i) * k + r]; };
    std::fill(v_a.begin(), v_a.end(), 0.0);
    for (CeedInt i = r; i < m; i++) {
      for (CeedInt j = 0; j < n; j++) v_a[j] += v(i) * at(i, j);
    }
    for (CeedInt i = r; i < m; i++) {
      for (CeedInt j = 0; j < n; j++) at(i, j) -= tau[r] * v(i) * v_a[j];
    }
  }
}

std::vector<CeedScalar> pseudo_inverse(std::span<const CeedScalar> a, CeedInt m, CeedInt n, const char *what) {
  std::vector<CeedScalar> r(a.begin(), a.end()), tau(std::max(n, 1));
  qr_factorize(r.data(), tau.data(), m, n, what);
  CeedScalar largest = 0.0, smallest = std::numeric_limits<CeedScalar>::infinity();
  for (CeedInt k = 0; k < n; k++) {
    largest = std::max(largest, std::abs(r[k * n + k]));
    smallest = std::min(smallest, std::abs(r[k * n + k]));
  }
  require(smallest > m * epsilon * largest, CEED_ERROR_MINOR, [&] {
    return text("%s has dependent columns: the diagonal of its R factor goes from %g down to %g", what, largest,
                smallest);
  });
  // The first n rows of Q^T are the transpose of Q [I; 0]: column stride m.
  std::vector<CeedScalar> x(static_cast<std::size_t>(n) * m, 0.0);
  for (CeedInt k = 0; k < n; k++) x[static_cast<std::size_t>(k) * m + k] = 1.0;
  apply_q(x.data(), r.data(), tau.data(), false, m, n, n, 1, m);
  solve_upper(r.data(), n, x.data(), m);
  return x;
}

std::vector<CeedScalar> multiply(std::span<const CeedScalar> a, std::span<const CeedScalar> b, CeedInt l, CeedInt m,
                                 CeedInt n) {
  std::vector<CeedScalar> c(static_cast<std::size_t>(l) * n, 0.0);
  for (CeedInt i = 0; i < l; i++) {
    for (CeedInt k = 0; k < m; k++) {
      const CeedScalar a_ik = a[static_cast<std::size_t>(i) * m + k];
      for (CeedInt j = 0; j < n; j++) {
        c[static_cast<std::size_t>(i) * n + j] += a_ik * b[static_cast<std::size_t>(k) * n + j];
      }
    }
  }
  return c;
}

// Cyclic Jacobi iteration: rotations zero one off-diagonal entry after another, A <- J^T A J, V <- V J. It converges
// quadratically, and small eigenvalues keep their digits.
void symmetric_eigen(CeedScalar *a, CeedScalar *lambda, CeedInt n, const char *what) {
  std::vector<CeedScalar> s(a, a + static_cast<std::size_t>(n) * n), v = identity(n);
  for (CeedInt i = 0; i < n; i++) {
    for (CeedInt j = 0; j <= i; j++) {
      require(std::isfinite(s[i * n + j]), CEED_ERROR_MINOR, [&] {
        return text("%s: entry (%" CeedInt_FMT ", %" CeedInt_FMT ") is %g; expected a finite number", what, i, j,
                    s[i * n + j]);
      });
      s[j * n + i] = s[i * n + j];
    }
  }
  // Rows (stride n) or columns (stride 1) p and q of m: (x, y) <- c (x - t y, t x + y).
  const auto rotate = [n](std::vector<CeedScalar> &m, CeedInt stride, CeedInt p, CeedInt q, CeedScalar c,
                          CeedScalar t) {
    const CeedInt along = stride == 1 ? n : 1;
    for (CeedInt k = 0; k < n; k++) {
      CeedScalar &x = m[k * along + p * stride], &y = m[k * along + q * stride];
      const CeedScalar old = x;
      x = c * (old - t * y);
      y = c * (t * old + y);
    }
  };
  // An entry counts as zero where it cannot change its diagonal entries; 64 sweeps are never needed.
  bool is_diagonal = false;
  for (int sweep = 0; sweep < 64 && !is_diagonal; sweep++) {
    is_diagonal = true;
    for (CeedInt p = 0; p < n; p++) {
      for (CeedInt q = p + 1; q < n; q++) {
        const CeedScalar off = s[p * n + q], diagonal = std::hypot(s[p * n + p], s[q * n + q]);
        if (std::abs(off) <= std::max(epsilon / 4 * diagonal, std::numeric_limits<CeedScalar>::min())) {
          s[p * n + q] = s[q * n + p] = 0.0;
          continue;
        }
        is_diagonal = false;
        // tan of the smaller angle: t^2 + 2 theta t - 1 = 0.
        const CeedScalar theta = (s[q * n + q] - s[p * n + p]) / (2 * off);
        const CeedScalar t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(1.0, theta));
        const CeedScalar c = 1 / std::hypot(1.0, t);
        rotate(s, 1, p, q, c, t);
        rotate(s, n, p, q, c, t);
        rotate(v, 1, p, q, c, t);
      }
    }
  }
  std::vector<CeedInt> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](CeedInt i, CeedInt j) { return s[i * n + i] < s[j * n + j]; });
  for (CeedInt j = 0; j < n; j++) {
    lambda[j] = s[order[j] * n + order[j]];
    for (CeedInt i = 0; i < n; i++) a[i * n + j] = v[i * n + order[j]];
  }
}

// B = U^T U; C = U^-T A U^-1 = V Lambda V^T; X = U^-1 V.
void simultaneous_diagonalize(std::span<const CeedScalar> a, std::span<const CeedScalar> b, CeedScalar *x,
                              CeedScalar *lambda, CeedInt n) {
  const auto u = cholesky(b, n);
  auto inverse = identity(n);
  solve_upper(u.data(), n, inverse.data(), n);
  std::vector<CeedScalar> transpose(inverse.size());
  for (CeedInt i = 0; i < n; i++) {
    for (CeedInt j = 0; j < n; j++) transpose[j * n + i] = inverse[i * n + j];
  }
  auto c = multiply(transpose, multiply(a, inverse, n, n, n), n, n, n);
  symmetric_eigen(c.data(), lambda, n, "Simultaneous diagonalization: U^-T A U^-1 for B = U^T U");
  const auto product = multiply(inverse, c, n, n, n);
  std::copy(product.begin(), product.end(), x);
}

}  // namespace hg

namespace {

void require_size(CeedInt size, const char *what) {
  hg::require(size >= 1, CEED_ERROR_DIMENSION,
              [&] { return hg::text("Dense algebra: %s is %" CeedInt_FMT "; expected 1 or more", what, size); });
}

std::span<const CeedScalar> square(const CeedScalar *a, CeedInt n) {
  return {a, static_cast<std::size_t>(n) * n};
}

}  // namespace

int CeedMatrixMatrixMultiply(Ceed ceed, const CeedScalar *mat_A, const CeedScalar *mat_B, CeedScalar *mat_C, CeedInt m,
                             CeedInt n, CeedInt kk) {
  return hg::guard(ceed, [&] {
    require_size(m, "m (rows of A)");
    require_size(n, "n (columns of B)");
    require_size(kk, "kk (columns of A)");
    hg::require_argument(mat_A, "mat_A (m by kk)");
    hg::require_argument(mat_B, "mat_B (kk by n)");
    hg::require_argument(mat_C, "mat_C (m by n)");
    const auto c =
        hg::multiply({mat_A, static_cast<std::size_t>(m) * kk}, {mat_B, static_cast<std::size_t>(kk) * n}, m, kk, n);
    std::copy(c.begin(), c.end(), mat_C);
  });
}

int CeedQRFactorization(Ceed ceed, CeedScalar *mat, CeedScalar *tau, CeedInt m, CeedInt n) {
  return hg::guard(ceed, [&] {
    require_size(m, "m (rows)");
    require_size(n, "n (columns)");
    hg::require_argument(mat, "mat (m by n)");
    hg::require_argument(tau, "tau (n factors)");
    hg::qr_factorize(mat, tau, m, n, "QR factorization: the matrix");
  });
}

int CeedHouseholderApplyQ(CeedScalar *mat_A, const CeedScalar *mat_Q, const CeedScalar *tau, CeedTransposeMode t_mode,
                          CeedInt m, CeedInt n, CeedInt k, CeedInt row, CeedInt col) {
  return hg::guard(nullptr, [&] {
    require_size(m, "m (rows of A)");
    require_size(n, "n (columns of A)");
    hg::require(k >= 0 && k <= m, CEED_ERROR_DIMENSION, [&] {
      return hg::text("Householder: k, the number of reflectors, is %" CeedInt_FMT "; expected 0 to m = %" CeedInt_FMT,
                      k, m);
    });
    hg::require_argument(mat_A, "mat_A (m by n)");
    hg::require_argument(mat_Q, "mat_Q (m by k)");
    hg::require_argument(tau, "tau (k factors)");
    hg::require_transpose_mode(t_mode, "Householder");
    hg::apply_q(mat_A, mat_Q, tau, t_mode == CEED_TRANSPOSE, m, n, k, row, col);
  });
}

int CeedMatrixPseudoinverse(Ceed ceed, const CeedScalar *mat, CeedInt m, CeedInt n, CeedScalar *mat_pinv) {
  return hg::guard(ceed, [&] {
    require_size(m, "m (rows)");
    require_size(n, "n (columns)");
    hg::require_argument(mat, "mat (m by n)");
    hg::require_argument(mat_pinv, "mat_pinv (n by m)");
    const auto inverse = hg::pseudo_inverse({mat, static_cast<std::size_t>(m) * n}, m, n, "Pseudoinverse: the matrix");
    std::copy(inverse.begin(), inverse.end(), mat_pinv);
  });
}

int CeedSymmetricSchurDecomposition(Ceed ceed, CeedScalar *mat, CeedScalar *lambda, CeedInt n) {
  return hg::guard(ceed, [&] {
    require_size(n, "n (rows and columns)");
    hg::require_argument(mat, "mat (n by n)");
    hg::require_argument(lambda, "lambda (n eigenvalues)");
    hg::symmetric_eigen(mat, lambda, n, "Symmetric Schur decomposition");
  });
}

int CeedSimultaneousDiagonalization(Ceed ceed, CeedScalar *mat_A, CeedScalar *mat_B, CeedScalar *x, CeedScalar *lambda,
                                    CeedInt n) {
  return hg::guard(ceed, [&] {
    require_size(n, "n (rows and columns)");
    hg::require_argument(mat_A, "mat_A (n by n)");
    hg::require_argument(mat_B, "mat_B (n by n)");
    hg::require_argument(x, "x (n by n)");
    hg::require_argument(lambda, "lambda (n eigenvalues)");
    hg::simultaneous_diagonalize(square(mat_A, n), square(mat_B, n), x, lambda, n);
  });
}
