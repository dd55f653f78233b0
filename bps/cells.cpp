#include "cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hg::bps {

std::array<double, 3> deform(const std::array<double, 3> &X) {
  const double s =
      std::sin(std::numbers::pi * X[0]) * std::sin(std::numbers::pi * X[1]) * std::sin(std::numbers::pi * X[2]);
  return {X[0] + 0.04 * s, X[1] - 0.03 * s, X[2] + 0.025 * s};
}

namespace {

/// Offsets of the nodes of every cell, (p + 1)³ a cell, for a box with `stride` scalars a node.
std::vector<CeedInt> tensor_offsets(std::array<CeedInt, 3> num_cells, CeedInt p, CeedInt stride) {
  const CeedSize nx = num_cells[0] * p + 1, ny = num_cells[1] * p + 1;
  std::vector<CeedInt> offsets;
  offsets.reserve(static_cast<std::size_t>(num_cells[0]) * num_cells[1] * num_cells[2] * (p + 1) * (p + 1) * (p + 1));
  for (CeedInt ez = 0; ez < num_cells[2]; ez++)
    for (CeedInt ey = 0; ey < num_cells[1]; ey++)
      for (CeedInt ex = 0; ex < num_cells[0]; ex++)
        for (CeedInt k = 0; k <= p; k++)
          for (CeedInt j = 0; j <= p; j++)
            for (CeedInt i = 0; i <= p; i++)
              offsets.push_back(
                  static_cast<CeedInt>(stride * ((ex * p + i) + nx * ((ey * p + j) + ny * (ez * p + k)))));
  return offsets;
}

}  // namespace

BoxMesh::BoxMesh(std::array<CeedInt, 3> num_cells, CeedInt degree, CeedInt num_comp)
    : num_cells_(num_cells), num_comp_(num_comp) {
  for (int d = 0; d < 3; d++) num_nodes_[d] = num_cells[d] * degree + 1;
  dof_offsets_ = tensor_offsets(num_cells, degree, num_comp);
  vertex_offsets_ = tensor_offsets(num_cells, 1, 3);
  for (CeedInt k = 0; k <= num_cells[2]; k++)
    for (CeedInt j = 0; j <= num_cells[1]; j++)
      for (CeedInt i = 0; i <= num_cells[0]; i++)
        for (double x : deform({double(i) / num_cells[0], double(j) / num_cells[1], double(k) / num_cells[2]}))
          coordinates_.push_back(x);
}

Cells BoxMesh::cells() const {
  return {num_cells_[0] * num_cells_[1] * num_cells_[2],
          static_cast<CeedSize>(num_comp_) * num_nodes_[0] * num_nodes_[1] * num_nodes_[2], dof_offsets_,
          vertex_offsets_, coordinates_};
}

std::vector<CeedScalar> BoxMesh::interior_mask() const {
  std::vector<CeedScalar> mask;
  const auto inside = [](CeedInt i, CeedInt n) { return 0 < i && i < n - 1; };
  for (CeedInt k = 0; k < num_nodes_[2]; k++)
    for (CeedInt j = 0; j < num_nodes_[1]; j++)
      for (CeedInt i = 0; i < num_nodes_[0]; i++)
        mask.insert(mask.end(), num_comp_,
                    inside(i, num_nodes_[0]) && inside(j, num_nodes_[1]) && inside(k, num_nodes_[2]) ? 1. : 0.);
  return mask;
}

std::array<CeedInt, 3> box_for_dofs(double num_dofs, CeedInt degree, CeedInt num_comp) {
  const double nodes_1d = std::cbrt(num_dofs / num_comp);
  const CeedInt low = std::max<CeedInt>(1, static_cast<CeedInt>((nodes_1d - 1) / degree));
  std::array<CeedInt, 3> best{low, low, low};
  double best_distance = INFINITY;
  for (int longer = 0; longer <= 3; longer++) {
    const std::array<CeedInt, 3> box{low + (longer > 0), low + (longer > 1), low + (longer > 2)};
    double dofs = num_comp;
    for (CeedInt n : box) dofs *= n * degree + 1.;
    const double distance = std::abs(std::log(dofs / num_dofs));
    if (distance < best_distance) {
      best_distance = distance;
      best = box;
    }
  }
  return best;
}

}  // namespace hg::bps
