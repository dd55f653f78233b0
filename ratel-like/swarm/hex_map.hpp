#pragma once
#include <algorithm>
#include <cmath>
#include <span>

namespace hg {

/// Trilinear map of one hexahedron in monomial form,
///   x(ξ) = a₀ + a₁ ξ + a₂ η + a₃ ζ + a₄ ξη + a₅ ηζ + a₆ ξζ + a₇ ξηζ,
/// with the inverse of its linear part, which starts Newton, and is all of the inverse where a₄…a₇ vanish.
struct HexMap {
  double a[8][3];
  double inv[9];  ///< inverse of [a₁ a₂ a₃], row-major ∂ξ_k/∂x_j; zero where that matrix is singular
  bool affine;

  /// Bilinear terms below this share of the cell's size are rounding.
  static constexpr double kAffineTolerance = 1e-13;

  /// corners: 8 × 3 in tensor order.
  static HexMap from_corners(std::span<const double, 24> corners) {
    HexMap m;
    for (int d = 0; d < 3; d++) {
      double x[8];
      for (int b = 0; b < 8; b++) x[b] = corners[3 * b + d];
      // Sums over the corners with the signs of each monomial, direction by direction.
      const double p0 = x[0] + x[1], m0 = x[1] - x[0], p1 = x[2] + x[3], m1 = x[3] - x[2];
      const double p2 = x[4] + x[5], m2 = x[5] - x[4], p3 = x[6] + x[7], m3 = x[7] - x[6];
      m.a[0][d] = ((p0 + p1) + (p2 + p3)) / 8.0;
      m.a[1][d] = ((m0 + m1) + (m2 + m3)) / 8.0;
      m.a[2][d] = ((p1 - p0) + (p3 - p2)) / 8.0;
      m.a[3][d] = ((p2 - p0) + (p3 - p1)) / 8.0;
      m.a[4][d] = ((m1 - m0) + (m3 - m2)) / 8.0;
      m.a[5][d] = ((p3 - p2) - (p1 - p0)) / 8.0;
      m.a[6][d] = ((m2 - m0) + (m3 - m1)) / 8.0;
      m.a[7][d] = ((m3 - m2) - (m1 - m0)) / 8.0;
    }
    double linear = 0.0, rest = 0.0;
    for (int d = 0; d < 3; d++) {
      for (int k = 1; k < 4; k++) linear = std::max(linear, std::abs(m.a[k][d]));
      for (int k = 4; k < 8; k++) rest = std::max(rest, std::abs(m.a[k][d]));
    }
    double J[9];
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) J[3 * i + j] = m.a[1 + j][i];
    }
    const double det = invert3(J, m.inv);
    if (!(std::abs(det) > 1e-300)) std::fill(m.inv, m.inv + 9, 0.0);
    m.affine = rest <= kAffineTolerance * linear && det > 0.0;
    return m;
  }

  void position(const double xi[3], double x[3]) const {
    for (int d = 0; d < 3; d++) {
      x[d] = a[0][d] + xi[0] * (a[1][d] + xi[1] * (a[4][d] + xi[2] * a[7][d]) + xi[2] * a[6][d]) +
             xi[1] * (a[2][d] + xi[2] * a[5][d]) + xi[2] * a[3][d];
    }
  }

  /// dxdX[3 i + j] = ∂x_i/∂ξ_j; returns det.
  double jacobian(const double xi[3], double dxdX[9]) const {
    for (int d = 0; d < 3; d++) {
      dxdX[3 * d + 0] = a[1][d] + xi[1] * a[4][d] + xi[2] * (a[6][d] + xi[1] * a[7][d]);
      dxdX[3 * d + 1] = a[2][d] + xi[0] * a[4][d] + xi[2] * (a[5][d] + xi[0] * a[7][d]);
      dxdX[3 * d + 2] = a[3][d] + xi[1] * a[5][d] + xi[0] * (a[6][d] + xi[1] * a[7][d]);
    }
    return det3(dxdX);
  }

  /// ξ of x. Returns false where Newton does not converge (far outside a distorted cell); ξ is then the answer of the
  /// linear part, good enough to choose a face by.
  bool inverse(const double x[3], double xi[3]) const {
    const double y[3] = {x[0] - a[0][0], x[1] - a[0][1], x[2] - a[0][2]};
    for (int k = 0; k < 3; k++) xi[k] = inv[3 * k] * y[0] + inv[3 * k + 1] * y[1] + inv[3 * k + 2] * y[2];
    if (affine) return true;
    constexpr int kMaxIterations = 12;
    constexpr double kFar = 8.0;        // in cell half-widths
    constexpr double kLastStep = 1e-8;  // Newton squares the error: the step after this one is rounding
    double z[3] = {xi[0], xi[1], xi[2]};
    for (int it = 0; it < kMaxIterations; it++) {
      double J[9], r[3], step[3];
      for (int d = 0; d < 3; d++) {
        const double jx = a[1][d] + z[1] * a[4][d] + z[2] * (a[6][d] + z[1] * a[7][d]);
        J[3 * d + 0] = jx;
        J[3 * d + 1] = a[2][d] + z[0] * a[4][d] + z[2] * (a[5][d] + z[0] * a[7][d]);
        J[3 * d + 2] = a[3][d] + z[1] * a[5][d] + z[0] * (a[6][d] + z[1] * a[7][d]);
        r[d] = y[d] - (z[0] * jx + z[1] * (a[2][d] + z[2] * a[5][d]) + z[2] * a[3][d]);
      }
      if (!solve3(J, r, step)) return false;
      for (int k = 0; k < 3; k++) z[k] += step[k];
      const double size = std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
      const double far = std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
      if (!(far < kFar)) return false;
      if (size < kLastStep) {
        std::copy(z, z + 3, xi);
        return true;
      }
    }
    return false;
  }

  static double det3(const double A[9]) {
    return A[0] * (A[4] * A[8] - A[5] * A[7]) - A[1] * (A[3] * A[8] - A[5] * A[6]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
  }

  /// B = A⁻¹ by cofactors; returns det A, and B is not finite where that is zero.
  static double invert3(const double A[9], double B[9]) {
    const double det = det3(A), s = 1.0 / det;
    B[0] = (A[4] * A[8] - A[5] * A[7]) * s;
    B[1] = (A[2] * A[7] - A[1] * A[8]) * s;
    B[2] = (A[1] * A[5] - A[2] * A[4]) * s;
    B[3] = (A[5] * A[6] - A[3] * A[8]) * s;
    B[4] = (A[0] * A[8] - A[2] * A[6]) * s;
    B[5] = (A[2] * A[3] - A[0] * A[5]) * s;
    B[6] = (A[3] * A[7] - A[4] * A[6]) * s;
    B[7] = (A[1] * A[6] - A[0] * A[7]) * s;
    B[8] = (A[0] * A[4] - A[1] * A[3]) * s;
    return det;
  }

  /// x = A⁻¹ r by Cramer's rule; false where A is singular.
  static bool solve3(const double A[9], const double r[3], double x[3]) {
    const double c0 = A[4] * A[8] - A[5] * A[7], c1 = A[5] * A[6] - A[3] * A[8], c2 = A[3] * A[7] - A[4] * A[6];
    const double det = A[0] * c0 + A[1] * c1 + A[2] * c2;
    if (det == 0.0) return false;
    const double s = 1.0 / det;
    x[0] = s * (c0 * r[0] + (A[2] * A[7] - A[1] * A[8]) * r[1] + (A[1] * A[5] - A[2] * A[4]) * r[2]);
    x[1] = s * (c1 * r[0] + (A[0] * A[8] - A[2] * A[6]) * r[1] + (A[2] * A[3] - A[0] * A[5]) * r[2]);
    x[2] = s * (c2 * r[0] + (A[1] * A[6] - A[0] * A[7]) * r[1] + (A[0] * A[4] - A[1] * A[3]) * r[2]);
    return true;
  }
};

}  // namespace hg
