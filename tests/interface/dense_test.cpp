// Dense algebra: what the factors multiply to, on random matrices.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace hg::test {
namespace {

constexpr CeedScalar epsilon = std::numeric_limits<CeedScalar>::epsilon();

class Dense : public testing::Test {
 protected:
  CeedHandle ceed{open(reference_resource)};
};

/// A B by the definition, for A l by m (or its transpose m by l) and B m by n.
Values product(const Values &a, const Values &b, CeedInt l, CeedInt m, CeedInt n, bool transpose_a = false) {
  Values c(static_cast<std::size_t>(l) * n, 0);
  for (CeedInt i = 0; i < l; i++) {
    for (CeedInt j = 0; j < n; j++) {
      for (CeedInt k = 0; k < m; k++) c[i * n + j] += (transpose_a ? a[k * l + i] : a[i * m + k]) * b[k * n + j];
    }
  }
  return c;
}

Values transposed(const Values &a, CeedInt m, CeedInt n) {
  Values t(a.size());
  for (CeedInt i = 0; i < m; i++) {
    for (CeedInt j = 0; j < n; j++) t[j * m + i] = a[i * n + j];
  }
  return t;
}

Values diagonal(const Values &d) {
  const std::size_t n = d.size();
  Values a(n * n, 0);
  for (std::size_t i = 0; i < n; i++) a[i * n + i] = d[i];
  return a;
}

Values identity(CeedInt n) {
  return diagonal(Values(static_cast<std::size_t>(n), 1));
}

Values random_symmetric(CeedInt n, Random &random) {
  Values a = random.reals(static_cast<CeedSize>(n) * n);
  for (CeedInt i = 0; i < n; i++) {
    for (CeedInt j = 0; j < i; j++) a[j * n + i] = a[i * n + j];
  }
  return a;
}

/// B^T B + I / 10
Values random_definite(CeedInt n, Random &random) {
  const Values b = random.reals(static_cast<CeedSize>(n) * n);
  Values a = product(b, b, n, n, n, true);
  for (CeedInt i = 0; i < n; i++) a[i * n + i] += 0.1;
  return a;
}

TEST_F(Dense, MultipliesMatrices) {
  Random random(1);
  for (int round = 0; round < 20; round++) {
    const CeedInt l = random.integer(1, 9), m = random.integer(1, 9), n = random.integer(1, 9);
    const Values a = random.reals(l * m), b = random.reals(m * n);
    Values c(static_cast<std::size_t>(l) * n, 17);
    ok(CeedMatrixMatrixMultiply(ceed, a.data(), b.data(), c.data(), l, n, m));
    expect_close(c, product(a, b, l, m, n), tolerance(m), "A B", 1);
  }
}

// Q R = A, Q^T Q = I, and Q^T A = R, with the factors where the interface says they are.
TEST_F(Dense, FactorsIntoOrthogonalAndTriangular) {
  Random random(2);
  for (int round = 0; round < 40; round++) {
    const CeedInt n = random.integer(1, 9), m = n + random.integer(0, 6);
    SCOPED_TRACE(testing::Message() << m << " by " << n);
    const Values a = random.reals(m * n);
    Values qr = a, tau(static_cast<std::size_t>(n)), r(a.size(), 0);
    ok(CeedQRFactorization(ceed, qr.data(), tau.data(), m, n));
    for (CeedInt i = 0; i < n; i++) {
      for (CeedInt j = i; j < n; j++) r[i * n + j] = qr[i * n + j];
    }
    // Q as the product of its reflectors, by the definition.
    Values q = identity(m);
    for (CeedInt k = 0; k < n; k++) {
      Values h = identity(m), v(static_cast<std::size_t>(m), 0);
      v[k] = 1;
      for (CeedInt i = k + 1; i < m; i++) v[i] = qr[i * n + k];
      for (CeedInt i = 0; i < m; i++) {
        for (CeedInt j = 0; j < m; j++) h[i * m + j] -= tau[k] * v[i] * v[j];
      }
      q = product(q, h, m, m, m);
    }
    const CeedScalar tol = 50 * epsilon;
    expect_close(product(q, r, m, m, n), a, tol, "Q R", 1);
    expect_close(product(q, q, m, m, m, true), identity(m), tol, "Q^T Q", 1);
    Values applied = r;
    ok(CeedHouseholderApplyQ(applied.data(), qr.data(), tau.data(), CEED_NOTRANSPOSE, m, n, n, n, 1));
    expect_close(applied, a, tol, "Q applied to R", 1);
    ok(CeedHouseholderApplyQ(applied.data(), qr.data(), tau.data(), CEED_TRANSPOSE, m, n, n, n, 1));
    expect_close(applied, r, tol, "Q^T applied to A", 1);
    // The same on a matrix whose columns are contiguous, and on one with gaps.
    const CeedInt columns = random.integer(1, 5);
    const Values x = random.reals(m * columns), qx = product(q, x, m, m, columns);
    Values by_columns = transposed(x, m, columns);
    ok(CeedHouseholderApplyQ(by_columns.data(), qr.data(), tau.data(), CEED_NOTRANSPOSE, m, columns, n, 1, m));
    expect_close(by_columns, transposed(qx, m, columns), tol, "column-major", 1);
    Values with_gaps(static_cast<std::size_t>(m) * columns * 2, 5);
    for (CeedInt i = 0; i < m * columns; i++) with_gaps[2 * i] = x[i];
    ok(CeedHouseholderApplyQ(with_gaps.data(), qr.data(), tau.data(), CEED_NOTRANSPOSE, m, columns, n, 2 * columns, 2));
    for (CeedInt i = 0; i < m * columns; i++) {
      EXPECT_NEAR(with_gaps[2 * i], qx[i], m * tol);
      EXPECT_EQ(with_gaps[2 * i + 1], 5);
    }
  }
}

// Columns that need no reflection, and columns of zeros.
TEST_F(Dense, FactorsTriangularAndRankDeficientMatrices) {
  for (const Values &a : {Values{2, 1, 0, 3, 0, 0}, Values{0, 1, 0, 2, 0, 3}, Values(6, 0.0)}) {
    Values qr = a, tau(2), r(6, 0);
    ok(CeedQRFactorization(ceed, qr.data(), tau.data(), 3, 2));
    r[0] = qr[0], r[1] = qr[1], r[3] = qr[3];
    ok(CeedHouseholderApplyQ(r.data(), qr.data(), tau.data(), CEED_NOTRANSPOSE, 3, 2, 2, 2, 1));
    expect_close(r, a, 10 * epsilon, "Q R", 1);
  }
}

// The four conditions of Moore and Penrose; two of them hold for any left inverse with a symmetric A A^+.
TEST_F(Dense, PseudoinverseFulfilsItsConditions) {
  Random random(3);
  for (int round = 0; round < 40; round++) {
    const CeedInt n = random.integer(1, 8), m = n + random.integer(0, 8);
    Values a = random.reals(m * n), x(static_cast<std::size_t>(n) * m, 17);
    for (CeedInt i = 0; i < n; i++) a[i * n + i] += 3;  // well conditioned
    ok(CeedMatrixPseudoinverse(ceed, a.data(), m, n, x.data()));
    expect_close(product(x, a, n, m, n), identity(n), 1e-13, "A^+ A = I", 1);
    const Values ax = product(a, x, m, n, m);
    expect_close(ax, transposed(ax, m, m), 1e-13, "A A^+ symmetric", 1);
  }
}

TEST_F(Dense, PseudoinverseNeedsIndependentColumns) {
  const Values a = {1, 2, 2, 4, 3, 6};
  Values x(6);
  expect_error(CeedMatrixPseudoinverse(ceed, a.data(), 3, 2, x.data()), CEED_ERROR_MINOR, {"dependent columns"});
  expect_error(CeedMatrixPseudoinverse(ceed, a.data(), 2, 3, x.data()), CEED_ERROR_DIMENSION, {"2 rows", "3 columns"});
}

TEST_F(Dense, DiagonalizesSymmetricMatrices) {
  Random random(4);
  for (int round = 0; round < 60; round++) {
    const CeedInt n = random.integer(1, 16);
    SCOPED_TRACE(testing::Message() << "n = " << n << ", round " << round);
    const CeedScalar scale = std::pow(10, random.integer(-20, 20));
    Values a = random_symmetric(n, random);
    for (CeedScalar &entry : a) entry *= scale;
    Values v = a, lambda(static_cast<std::size_t>(n));
    ok(CeedSymmetricSchurDecomposition(ceed, v.data(), lambda.data(), n));
    expect_close(product(product(v, diagonal(lambda), n, n, n), transposed(v, n, n), n, n, n), a, 50 * epsilon,
                 "V Lambda V^T");
    expect_close(product(v, v, n, n, n, true), identity(n), 50 * epsilon, "V^T V", 1);
    EXPECT_TRUE(std::is_sorted(lambda.begin(), lambda.end()));
  }
}

// Multiple eigenvalues, zeros and a graded matrix, whose small eigenvalue is right to its last digits.
TEST_F(Dense, DiagonalizesDegenerateMatrices) {
  for (const Values &a : {Values(16, 0.0), Values(16, 1.0), identity(4)}) {
    Values v = a, lambda(4);
    ok(CeedSymmetricSchurDecomposition(ceed, v.data(), lambda.data(), 4));
    expect_close(product(product(v, diagonal(lambda), 4, 4, 4), transposed(v, 4, 4), 4, 4, 4), a, 50 * epsilon,
                 "V Lambda V^T", 1);
    expect_close(product(v, v, 4, 4, 4, true), identity(4), 50 * epsilon, "V^T V", 1);
  }
  // lambda_1 lambda_2 = 1e-12 (1 - 1/4), lambda_1 + lambda_2 = 1 + 1e-12
  Values v = {1, 0.5e-6, 0.5e-6, 1e-12}, lambda(2);
  ok(CeedSymmetricSchurDecomposition(ceed, v.data(), lambda.data(), 2));
  EXPECT_NEAR(lambda[0] / 0.75e-12, 1, 1e-11);
}

TEST_F(Dense, DiagonalizesTwoMatricesAtOnce) {
  Random random(5);
  for (int round = 0; round < 40; round++) {
    const CeedInt n = random.integer(1, 10);
    const Values a = random_symmetric(n, random), b = random_definite(n, random);
    Values a_in = a, b_in = b, x(a.size()), lambda(static_cast<std::size_t>(n));
    ok(CeedSimultaneousDiagonalization(ceed, a_in.data(), b_in.data(), x.data(), lambda.data(), n));
    EXPECT_EQ(a_in, a);
    EXPECT_EQ(b_in, b);
    const CeedScalar size = max_norm(x) * max_norm(x) * n;
    expect_close(product(x, product(b, x, n, n, n), n, n, n, true), identity(n), 50 * epsilon * size, "X^T B X", 1);
    expect_close(product(x, product(a, x, n, n, n), n, n, n, true), diagonal(lambda), 50 * epsilon * size, "X^T A X",
                 1);
    EXPECT_TRUE(std::is_sorted(lambda.begin(), lambda.end()));
  }
}

TEST_F(Dense, RefusesBadInput) {
  Values a = {1, 2, 2, 1}, b = a, tau(2), x(4);
  expect_error(CeedQRFactorization(ceed, a.data(), tau.data(), 1, 2), CEED_ERROR_DIMENSION, {"1 rows", "2 columns"});
  expect_error(CeedQRFactorization(ceed, a.data(), tau.data(), 0, 2), CEED_ERROR_DIMENSION, {"m (rows) is 0"});
  expect_error(CeedQRFactorization(ceed, nullptr, tau.data(), 2, 2), CEED_ERROR_INCOMPLETE, {"mat"});
  expect_error(CeedQRFactorization(ceed, a.data(), nullptr, 2, 2), CEED_ERROR_INCOMPLETE, {"tau"});
  expect_error(CeedSimultaneousDiagonalization(ceed, a.data(), b.data(), x.data(), tau.data(), 2), CEED_ERROR_MINOR,
               {"pivot 1", "positive definite"});
  expect_error(CeedSymmetricSchurDecomposition(ceed, a.data(), nullptr, 2), CEED_ERROR_INCOMPLETE, {"lambda"});
  expect_error(CeedMatrixMatrixMultiply(ceed, a.data(), b.data(), x.data(), 2, 2, -1), CEED_ERROR_DIMENSION, {"kk"});
  a[2] = std::nan("");
  expect_error(CeedSymmetricSchurDecomposition(ceed, a.data(), tau.data(), 2), CEED_ERROR_MINOR,
               {"(1, 0)", "finite"});
  // These belong to no Ceed whose handler could be told.
  EXPECT_EQ(CeedHouseholderApplyQ(x.data(), b.data(), tau.data(), CEED_NOTRANSPOSE, 2, 2, 3, 2, 1),
            CEED_ERROR_DIMENSION);
  EXPECT_EQ(CeedHouseholderApplyQ(nullptr, b.data(), tau.data(), CEED_NOTRANSPOSE, 2, 2, 2, 2, 1),
            CEED_ERROR_INCOMPLETE);
}

}  // namespace
}  // namespace hg::test
