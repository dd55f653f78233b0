#include "swarm/cell_grid.hpp"

namespace hg {

CellGrid make_box_grid(std::array<int, 3> cells, std::array<double, 3> lower, std::array<double, 3> upper,
                       void (*map)(double *x)) {
  const std::int32_t nx = cells[0], ny = cells[1], nz = cells[2];
  const std::size_t num_cells = static_cast<std::size_t>(nx) * ny * nz;
  CellGrid grid;
  grid.corners.resize(num_cells * 24);
  grid.neighbours.resize(num_cells * 6);
  grid.cell_ids.resize(num_cells);
  for (std::int32_t k = 0; k < nz; k++) {
    for (std::int32_t j = 0; j < ny; j++) {
      for (std::int32_t i = 0; i < nx; i++) {
        const std::int32_t c = i + nx * (j + ny * k);
        const std::int32_t at[3] = {i, j, k}, stride[3] = {1, nx, nx * ny};
        grid.cell_ids[c] = c;
        for (int b = 0; b < 8; b++) {
          double *x = &grid.corners[(static_cast<std::size_t>(c) * 8 + b) * 3];
          for (int d = 0; d < 3; d++) {
            const double t = static_cast<double>(at[d] + ((b >> d) & 1)) / cells[d];
            x[d] = lower[d] * (1.0 - t) + upper[d] * t;
          }
          if (map) map(x);
        }
        for (int d = 0; d < 3; d++) {
          std::int32_t *n = &grid.neighbours[static_cast<std::size_t>(c) * 6 + 2 * d];
          n[0] = at[d] > 0 ? c - stride[d] : CellGrid::kBoundary;
          n[1] = at[d] < cells[d] - 1 ? c + stride[d] : CellGrid::kBoundary;
        }
      }
    }
  }
  return grid;
}

}  // namespace hg
