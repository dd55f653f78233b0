#include "swarm/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "swarm/hash_grid.hpp"
#include "swarm/hex_map.hpp"

namespace hg {
namespace {

double largest(const double xi[3]) {
  return std::max({std::abs(xi[0]), std::abs(xi[1]), std::abs(xi[2])});
}

/// Closed-form inverse of an affine cell: what a walk on a box mesh touches, 96 bytes for a cell.
struct AffineInverse {
  double centre[3];
  double inv[9];
};

}  // namespace

struct HexLocator::Impl {
  explicit Impl(const CellGrid &g) : grid(g) {
    const std::int32_t n = g.num_cells();
    affine.resize(n);
    general.assign(n, -1);
    for (std::int32_t c = 0; c < n; c++) {
      const HexMap m = HexMap::from_corners(g.cell_corners(c));
      check(c, m);
      if (!m.affine) {
        general[c] = static_cast<std::int32_t>(maps.size());
        maps.push_back(m);
      }
      std::copy(m.a[0], m.a[0] + 3, affine[c].centre);
      std::copy(m.inv, m.inv + 9, affine[c].inv);
    }
    all_affine = maps.empty();
  }

  void check(std::int32_t c, const HexMap &m) const {
    double least = std::numeric_limits<double>::infinity();
    for (int b = 0; b < 8; b++) {
      const double xi[3] = {b & 1 ? 1.0 : -1.0, b & 2 ? 1.0 : -1.0, b & 4 ? 1.0 : -1.0};
      double J[9];
      const double det = m.jacobian(xi, J);
      if (!(det >= least)) least = det;
    }
    if (!(least > 0.0)) {
      const long long id = grid.cell_ids.empty() ? c : static_cast<long long>(grid.cell_ids[c]);
      throw std::invalid_argument("mesh cell " + std::to_string(id) +
                                  " is inverted or flat: its smallest corner Jacobian is " + std::to_string(least) +
                                  ", expected > 0");
    }
  }

  bool inverse(std::int32_t c, const double x[3], double xi[3]) const {
    if (all_affine || general[c] < 0) {
      const AffineInverse &m = affine[c];
      const double y[3] = {x[0] - m.centre[0], x[1] - m.centre[1], x[2] - m.centre[2]};
      for (int k = 0; k < 3; k++) xi[k] = m.inv[3 * k] * y[0] + m.inv[3 * k + 1] * y[1] + m.inv[3 * k + 2] * y[2];
      return true;
    }
    return maps[general[c]].inverse(x, xi);
  }

  HexMap map_of(std::int32_t c) const {
    return general[c] >= 0 ? maps[general[c]] : HexMap::from_corners(grid.cell_corners(c));
  }

  /// Of the cells behind the faces that ξ touches, the smallest that holds x too and is smaller than c; c if none.
  /// Answers in the numbers of CellGrid::neighbours.
  std::int32_t smaller_touching(const double x[3], std::int32_t c, const double xi[3]) const {
    std::int32_t best = c;
    std::span<const double, 24> best_corners = grid.cell_corners(c);
    for (int f = 0; f < 6; f++) {
      const double outward = f % 2 ? xi[f / 2] : -xi[f / 2];
      if (outward < 1.0 - kFaceTolerance) continue;
      const std::int32_t n = grid.neighbours[6 * static_cast<std::size_t>(c) + f];
      if (n == CellGrid::kBoundary) continue;
      const std::span<const double, 24> corners =
          n >= 0 ? grid.cell_corners(n) : std::span<const double, 24>(grid.remote[CellGrid::remote_index(n)].corners);
      if (!cell_less(corners, best_corners)) continue;
      double eta[3];
      const bool converged = n >= 0 ? inverse(n, x, eta) : HexMap::from_corners(corners).inverse(x, eta);
      if (converged && largest(eta) <= 1.0 + kFaceTolerance) {
        best = n;
        best_corners = corners;
      }
    }
    return best;
  }

  /// The neighbour behind the face that ξ violates most and that is not the boundary; kBoundary if there is none.
  std::int32_t next_cell(std::int32_t c, const double xi[3]) const {
    std::int32_t next = CellGrid::kBoundary;
    double worst = 1.0 + kFaceTolerance;
    for (int d = 0; d < 3; d++) {
      if (std::abs(xi[d]) <= worst) continue;
      const std::int32_t n = grid.neighbours[6 * static_cast<std::size_t>(c) + 2 * d + (xi[d] > 0.0)];
      if (n == CellGrid::kBoundary) continue;
      next = n;
      worst = std::abs(xi[d]);
    }
    return next;
  }

  const HashGrid &hash() const {
    std::call_once(hash_once, [&] { hash_grid.emplace(grid, 1e-8); });
    return *hash_grid;
  }

  const CellGrid &grid;
  std::vector<AffineInverse> affine;
  std::vector<std::int32_t> general;  // index into maps, or -1 for an affine cell
  std::vector<HexMap> maps;
  bool all_affine = true;
  mutable std::once_flag hash_once;
  mutable std::optional<HashGrid> hash_grid;
};

HexLocator::HexLocator(const CellGrid &grid) : impl_(std::make_unique<Impl>(grid)) {}
HexLocator::~HexLocator() = default;
HexLocator::HexLocator(HexLocator &&) noexcept = default;

Location HexLocator::walk(const double x[3], std::int32_t guess) const {
  const Impl &im = *impl_;
  // The last cells walked: meeting one again means that the walk circles, which only distorted cells can make it do.
  constexpr int kMemory = 8;
  std::int32_t seen[kMemory];
  std::fill(seen, seen + kMemory, -1);
  Location at;
  at.index = guess;
  const std::int32_t most = im.grid.num_cells() + kMemory;
  for (std::int32_t step = 0; step < most; step++) {
    const std::int32_t c = at.index;
    const bool converged = im.inverse(c, x, at.xi);
    const double m = largest(at.xi);
    std::int32_t next;
    if (converged && m < 1.0 - kFaceTolerance) {
      at.place = PointPlace::kInside;
      return at;
    }
    if (converged && m <= 1.0 + kFaceTolerance) {
      next = im.smaller_touching(x, c, at.xi);
      if (next == c) {
        at.place = PointPlace::kInside;
        return at;
      }
    } else {
      if (!(m < std::numeric_limits<double>::infinity())) break;
      next = im.next_cell(c, at.xi);
      if (next == CellGrid::kBoundary) break;
    }
    if (next < 0) {
      at.place = PointPlace::kRemote;
      at.index = CellGrid::remote_index(next);
      return at;
    }
    if (std::find(seen, seen + kMemory, next) != seen + kMemory) break;
    seen[step % kMemory] = c;
    at.index = next;
  }
  at.place = PointPlace::kOutside;
  return at;
}

Location HexLocator::find(const double x[3]) const {
  const Impl &im = *impl_;
  Location best;
  for (const std::int32_t c : im.hash().candidates(x)) {
    double xi[3];
    if (!im.inverse(c, x, xi) || !(largest(xi) <= 1.0 + kFaceTolerance)) continue;
    if (best.place == PointPlace::kInside && !cell_less(im.grid.cell_corners(c), im.grid.cell_corners(best.index))) {
      continue;
    }
    best.place = PointPlace::kInside;
    best.index = c;
    std::copy(xi, xi + 3, best.xi);
  }
  return best;
}

std::size_t HexLocator::locate(std::span<const double> x, std::span<std::int32_t> cells, std::span<double> xi,
                               std::span<PointPlace> place) const {
  const std::size_t n = cells.size();
  const std::int32_t num_cells = impl_->grid.num_cells();
  std::size_t inside = 0;
  for (std::size_t i = 0; i < n; i++) {
    const double *xp = &x[3 * i];
    const std::int32_t guess = cells[i];
    Location at;
    if (guess >= 0 && guess < num_cells) {
      at = walk(xp, guess);
    }
    if (at.place == PointPlace::kOutside) {
      const Location found = find(xp);
      // From the cell found, one more walk settles a tie with cells of other ranks.
      if (found.place == PointPlace::kInside) {
        at = walk(xp, found.index);
        if (at.place == PointPlace::kOutside) at = found;
      }
    }
    cells[i] = at.index;
    place[i] = at.place;
    std::copy(at.xi, at.xi + 3, &xi[3 * i]);
    inside += at.place == PointPlace::kInside;
  }
  return inside;
}

double HexLocator::nearest(const double x[3], Location &where) const {
  double best = std::numeric_limits<double>::infinity();
  where = Location{};
  for (std::int32_t c = 0; c < impl_->grid.num_cells(); c++) {
    double xi[3], y[3];
    impl_->inverse(c, x, xi);
    for (double &t : xi) t = std::clamp(t, -1.0, 1.0);
    map(c, xi, y);
    const double r = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
    if (r < best) {
      best = r;
      where.place = PointPlace::kInside;
      where.index = c;
      std::copy(xi, xi + 3, where.xi);
    }
  }
  return best;
}

void HexLocator::map(std::int32_t c, const double xi[3], double x[3]) const {
  impl_->map_of(c).position(xi, x);
}

double HexLocator::jacobian(std::int32_t c, const double xi[3], double dxdX[9]) const {
  return impl_->map_of(c).jacobian(xi, dxdX);
}

double HexLocator::cell_volume(std::int32_t c) const {
  const HexMap m = impl_->map_of(c);
  const double g = 1.0 / std::sqrt(3.0);
  double volume = 0.0, J[9];
  for (int b = 0; b < 8; b++) {
    const double xi[3] = {b & 1 ? g : -g, b & 2 ? g : -g, b & 4 ? g : -g};
    volume += m.jacobian(xi, J);
  }
  return volume;
}

std::int32_t HexLocator::num_affine() const {
  return static_cast<std::int32_t>(impl_->affine.size() - impl_->maps.size());
}

bool cell_less(std::span<const double, 24> a, std::span<const double, 24> b) {
  const auto box = [](std::span<const double, 24> x) {
    std::array<double, 6> e{x[0], x[1], x[2], x[0], x[1], x[2]};
    for (int k = 1; k < 8; k++) {
      for (int d = 0; d < 3; d++) {
        e[d] = std::min(e[d], x[3 * k + d]);
        e[3 + d] = std::max(e[3 + d], x[3 * k + d]);
      }
    }
    return e;
  };
  const auto ea = box(a), eb = box(b);
  if (ea != eb) return ea < eb;
  const auto sorted = [](std::span<const double, 24> x) {
    std::array<std::array<double, 3>, 8> s;
    for (int k = 0; k < 8; k++) s[k] = {x[3 * k], x[3 * k + 1], x[3 * k + 2]};
    std::sort(s.begin(), s.end());
    return s;
  };
  return sorted(a) < sorted(b);
}

}  // namespace hg
