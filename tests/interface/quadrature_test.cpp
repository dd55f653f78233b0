// Gauss and Gauss-Lobatto rules.
#include <ceed.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "support/errors.hpp"

namespace hg::test {
namespace {

using Rule = int (*)(CeedInt, CeedScalar *, CeedScalar *);

struct RuleCase {
  const char *name;
  Rule rule;
  CeedInt least;    ///< points
  CeedInt deficit;  ///< exact to degree 2Q - deficit
};
std::ostream &operator<<(std::ostream &stream, const RuleCase &rule) {
  return stream << rule.name;
}
constexpr RuleCase rules[] = {{"Gauss", CeedGaussQuadrature, 1, 1}, {"Gauss-Lobatto", CeedLobattoQuadrature, 2, 3}};

/// P_n(x) and P_n'(x), |x| < 1 for the derivative.
struct Legendre {
  long double value, derivative;
};
Legendre legendre(CeedInt n, long double x) {
  if (n == 0) return {1, 0};
  long double last = 1, value = x;
  for (CeedInt k = 2; k <= n; k++) {
    const long double next = ((2 * k - 1) * x * value - (k - 1) * last) / k;
    last = value;
    value = next;
  }
  return {value, n * (last - x * value) / (1 - x * x)};
}

class QuadratureTest : public testing::TestWithParam<RuleCase> {
 protected:
  // There is no Ceed: errors go to the handler of the process.
  static void SetUpTestSuite() { setenv("CEED_ERROR_HANDLER", "return", 1); }
};
INSTANTIATE_TEST_SUITE_P(Rules, QuadratureTest, testing::ValuesIn(rules), [](const auto &info) {
  return std::string(info.param.name) == "Gauss" ? "Gauss" : "GaussLobatto";
});

// Every Legendre polynomial up to the degree but P_0 has integral 0; the square of the polynomial that vanishes at the
// points (but for the ends) shows that the degree is not higher.
TEST_P(QuadratureTest, IsExactToItsDegreeAndNoFurther) {
  for (CeedInt Q = GetParam().least; Q <= 64; Q++) {
    std::vector<CeedScalar> x(Q), w(Q);
    ASSERT_EQ(GetParam().rule(Q, x.data(), w.data()), CEED_ERROR_SUCCESS);
    const CeedInt degree = 2 * Q - GetParam().deficit;
    for (CeedInt k = 0; k <= degree; k++) {
      long double sum = 0;
      for (CeedInt i = 0; i < Q; i++) sum += w[i] * legendre(k, x[i]).value;
      ASSERT_NEAR(static_cast<double>(sum), k == 0 ? 2 : 0, 2e-15) << "Q " << Q << ", degree " << k;
    }
    // int P_Q^2 = 2/(2Q+1), int (1-x^2) P_n'^2 = 2n(n+1)/(2n+1).
    const bool is_gauss = GetParam().deficit == 1;
    const CeedInt n = is_gauss ? Q : Q - 1;
    long double sum = 0;
    for (CeedInt i = 0; i < Q; i++) {
      const Legendre p = legendre(n, x[i]);
      if (is_gauss) {
        sum += w[i] * p.value * p.value;
      } else if (std::abs(x[i]) < 1) {
        sum += w[i] * (1 - x[i] * static_cast<long double>(x[i])) * p.derivative * p.derivative;
      }
    }
    EXPECT_LT(static_cast<double>(sum), 1e-20) << "Q " << Q;
  }
}

TEST_P(QuadratureTest, MakesLegendrePolynomialsOrthogonal) {
  for (const CeedInt Q : {2, 5, 16, 33, 64}) {
    std::vector<CeedScalar> x(Q), w(Q);
    ASSERT_EQ(GetParam().rule(Q, x.data(), w.data()), CEED_ERROR_SUCCESS);
    const CeedInt degree = 2 * Q - GetParam().deficit;
    for (CeedInt i = 0; i < Q; i++) {
      for (CeedInt j = 0; j <= i && i + j <= degree; j++) {
        long double sum = 0;
        for (CeedInt q = 0; q < Q; q++) sum += w[q] * legendre(i, x[q]).value * legendre(j, x[q]).value;
        ASSERT_NEAR(static_cast<double>(sum), i == j ? 2.0 / (2 * i + 1) : 0, 2e-15) << Q << ": " << i << ", " << j;
      }
    }
  }
}

TEST_P(QuadratureTest, PointsAreOrderedAndSymmetricAndWeightsPositive) {
  for (CeedInt Q = GetParam().least; Q <= 100; Q++) {
    std::vector<CeedScalar> x(Q), w(Q);
    ASSERT_EQ(GetParam().rule(Q, x.data(), w.data()), CEED_ERROR_SUCCESS);
    for (CeedInt i = 0; i < Q; i++) {
      EXPECT_EQ(x[i], -x[Q - 1 - i]);
      EXPECT_EQ(w[i], w[Q - 1 - i]);
      EXPECT_GT(w[i], 0);
      EXPECT_LE(std::abs(x[i]), 1);
      if (i > 0) {
        EXPECT_GT(x[i], x[i - 1]);
      }
    }
    std::vector<CeedScalar> alone(Q);
    ASSERT_EQ(GetParam().rule(Q, alone.data(), nullptr), CEED_ERROR_SUCCESS);
    EXPECT_EQ(alone, x);
  }
}

// The points are the roots to the last place of a double.
TEST(GaussQuadrature, PointsAreRootsToRounding) {
  for (CeedInt Q = 1; Q <= 64; Q++) {
    std::vector<CeedScalar> x(Q);
    ASSERT_EQ(CeedGaussQuadrature(Q, x.data(), nullptr), CEED_ERROR_SUCCESS);
    for (const CeedScalar point : x) {
      const Legendre p = legendre(Q, point);
      EXPECT_LE(static_cast<double>(std::abs(p.value / p.derivative)), 1.2e-16 * std::abs(point)) << "Q " << Q;
    }
  }
}

TEST(GaussQuadrature, KnowsTheClosedForms) {
  CeedScalar x[3], w[3];
  ASSERT_EQ(CeedGaussQuadrature(1, x, w), CEED_ERROR_SUCCESS);
  EXPECT_EQ(x[0], 0);
  EXPECT_DOUBLE_EQ(w[0], 2);
  ASSERT_EQ(CeedGaussQuadrature(3, x, w), CEED_ERROR_SUCCESS);
  EXPECT_DOUBLE_EQ(x[2], std::sqrt(0.6));
  EXPECT_DOUBLE_EQ(w[1], 8.0 / 9);
  EXPECT_DOUBLE_EQ(w[2], 5.0 / 9);
}

TEST(LobattoQuadrature, KnowsTheClosedForms) {
  CeedScalar x[5], w[5];
  ASSERT_EQ(CeedLobattoQuadrature(2, x, w), CEED_ERROR_SUCCESS);
  EXPECT_EQ(x[0], -1);
  EXPECT_EQ(x[1], 1);
  EXPECT_DOUBLE_EQ(w[0], 1);
  ASSERT_EQ(CeedLobattoQuadrature(5, x, w), CEED_ERROR_SUCCESS);
  EXPECT_EQ(x[4], 1);
  EXPECT_DOUBLE_EQ(x[3], std::sqrt(3.0 / 7));
  EXPECT_EQ(x[2], 0);
  EXPECT_DOUBLE_EQ(w[4], 0.1);
  EXPECT_DOUBLE_EQ(w[3], 49.0 / 90);
  EXPECT_DOUBLE_EQ(w[2], 32.0 / 45);
}

TEST_P(QuadratureTest, RefusesTooFewPointsAndNoArray) {
  CeedScalar x[1] = {17}, w[1] = {17};
  for (const CeedInt Q : {-1, GetParam().least - 1}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(GetParam().rule(Q, x, w), CEED_ERROR_DIMENSION);
    static_cast<void>(testing::internal::GetCapturedStderr());
  }
  EXPECT_EQ(x[0], 17);
  EXPECT_EQ(w[0], 17);
  EXPECT_EQ(GetParam().rule(3, nullptr, w), CEED_ERROR_INCOMPLETE);
}

}  // namespace
}  // namespace hg::test
