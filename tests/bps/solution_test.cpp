/// @file
/// The manufactured solution of the bake-off problems: its derivatives by finite differences, its boundary values.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "qfunctions/bps/manufactured.h"
#include "support/random.hpp"

namespace {

struct Bubble {
  CeedScalar phi, grad[3], laplacian;
};

Bubble bubble(const CeedScalar x[3]) {
  Bubble b;
  BPBubble(x, &b.phi, b.grad, &b.laplacian);
  return b;
}

/// Central differences of φ with step h against ∇φ and Δφ: the larger error of the two.
struct Remainders {
  double gradient = 0, laplacian = 0;
};

Remainders remainders(const CeedScalar x[3], double h) {
  const Bubble at = bubble(x);
  Remainders result;
  double laplacian = 0;
  for (int i = 0; i < 3; i++) {
    CeedScalar left[3] = {x[0], x[1], x[2]}, right[3] = {x[0], x[1], x[2]};
    left[i] -= h;
    right[i] += h;
    const double l = bubble(left).phi, r = bubble(right).phi;
    result.gradient = std::max(result.gradient, std::abs((r - l) / (2 * h) - at.grad[i]));
    laplacian += (r - 2 * at.phi + l) / (h * h);
  }
  result.laplacian = std::abs(laplacian - at.laplacian);
  return result;
}

TEST(ManufacturedSolution, DerivativesAreThoseOfItsValues) {
  hg::test::Random random(3);
  for (int trial = 0; trial < 20; trial++) {
    const CeedScalar x[3] = {random.real(0, 1), random.real(0, 1), random.real(0, 1)};
    const Remainders coarse = remainders(x, 2e-2), fine = remainders(x, 1e-2);
    // Second order: halving the step divides the remainder by four.
    EXPECT_LT(fine.gradient, 2e-3);
    EXPECT_LT(fine.laplacian, 2e-2);
    EXPECT_NEAR(std::log2(coarse.gradient / fine.gradient), 2, 0.05);
    EXPECT_NEAR(std::log2(coarse.laplacian / fine.laplacian), 2, 0.05);
  }
}

TEST(ManufacturedSolution, VanishesOnTheBoundaryAndOnlyThere) {
  for (int face = 0; face < 6; face++) {
    CeedScalar x[3] = {0.3, 0.6, 0.45};
    x[face / 2] = face % 2;
    EXPECT_NEAR(bubble(x).phi, 0, 1e-15);
  }
  const CeedScalar inside[3] = {0.3, 0.6, 0.45};
  EXPECT_GT(bubble(inside).phi, 0.5);
}

TEST(ManufacturedSolution, HasNoSymmetryThatHidesExchangedAxes) {
  const CeedScalar x[3] = {0.2, 0.35, 0.45}, swapped[3][3] = {{0.35, 0.2, 0.45}, {0.45, 0.35, 0.2}, {0.2, 0.45, 0.35}};
  for (const auto &y : swapped) EXPECT_GT(std::abs(bubble(x).phi - bubble(y).phi), 1e-3);
}

/// At a point with J = 1 and w = 1, the source QFunctions return u_c, −Δu_c and ∇u_c.
TEST(ManufacturedSolution, SourcesFollowFromIt) {
  const CeedScalar x[3] = {0.2, 0.35, 0.45}, dx[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, w[1] = {1};
  const CeedScalar *const in[] = {x, dx, w};
  const Bubble at = bubble(x);
  BPSolution mass{1, 3}, poisson{0, 3};
  CeedScalar v[9];
  CeedScalar *const out[] = {v};
  ASSERT_EQ(BPMassSource(&mass, 1, in, out), 0);
  for (int c = 0; c < 3; c++) EXPECT_DOUBLE_EQ(v[c], (c + 1) * (1 + at.phi));
  ASSERT_EQ(BPPoissonSource(&poisson, 1, in, out), 0);
  for (int c = 0; c < 3; c++) EXPECT_DOUBLE_EQ(v[c], -(c + 1) * at.laplacian);
  ASSERT_EQ(BPPoissonFlux(&poisson, 1, in, out), 0);
  for (int d = 0; d < 3; d++)
    for (int c = 0; c < 3; c++) EXPECT_DOUBLE_EQ(v[c + 3 * d], (c + 1) * at.grad[d]);
}

/// The error of the exact solution is zero, and of zero it is the norm.
TEST(ManufacturedSolution, ErrorTermsMeasureTheDifference) {
  const CeedScalar x[3] = {0.2, 0.35, 0.45}, w[1] = {0.5};
  const CeedScalar dx[9] = {2, 0, 0, 0, 4, 0, 0, 0, 1};  // det J = 8; ∂u/∂X_d = J_dd ∂u/∂x_d
  const Bubble at = bubble(x);
  BPSolution solution{0, 1};
  CeedScalar u[1] = {at.phi}, du[3] = {2 * at.grad[0], 4 * at.grad[1], at.grad[2]}, terms[4];
  const CeedScalar *const in[] = {u, du, x, dx, w};
  CeedScalar *const out[] = {terms};
  ASSERT_EQ(BPError(&solution, 1, in, out), 0);
  EXPECT_NEAR(terms[0], 0, 1e-28);
  EXPECT_NEAR(terms[2], 0, 1e-28);
  EXPECT_DOUBLE_EQ(terms[1], 4 * at.phi * at.phi);
  const double grad_squared = at.grad[0] * at.grad[0] + at.grad[1] * at.grad[1] + at.grad[2] * at.grad[2];
  EXPECT_DOUBLE_EQ(terms[3], 4 * grad_squared);
  u[0] = du[0] = du[1] = du[2] = 0;
  ASSERT_EQ(BPError(&solution, 1, in, out), 0);
  EXPECT_DOUBLE_EQ(terms[0], terms[1]);
  EXPECT_DOUBLE_EQ(terms[2], terms[3]);
}

}  // namespace
