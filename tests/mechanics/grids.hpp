// Cell grids and maps shared by the tests of points.
#pragma once
#include <cmath>

#include "swarm/cell_grid.hpp"

namespace hg::test {

/// Smooth map of the unit cube that leaves its boundary in place, so that the domain stays the cube.
inline void bend_cube(double *x) {
  const double s = 0.08 * std::sin(M_PI * x[0]) * std::sin(M_PI * x[1]) * std::sin(M_PI * x[2]);
  x[0] += s;
  x[1] -= 1.3 * s;
  x[2] += 0.7 * s;
}

/// Affine map: boxes become parallelepipeds.
inline void shear(double *x) {
  const double y[3] = {x[0], x[1], x[2]};
  x[0] = y[0] + 0.3 * y[1] - 0.2 * y[2];
  x[1] = 0.1 * y[0] + 0.9 * y[1] + 0.25 * y[2];
  x[2] = -0.15 * y[0] + 0.05 * y[1] + 1.1 * y[2];
}

/// Quarter of a ring: the unit cube's x is the angle, y the radius.
inline void ring(double *x) {
  const double angle = 1.5 * M_PI * x[0], r = 0.3 + x[1];
  x[0] = r * std::sin(angle);
  x[1] = r * std::cos(angle);
}

/// Small deterministic generator in [0, 1).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 1) {}
  double operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace hg::test
