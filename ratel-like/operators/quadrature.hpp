/// @file
/// Gauss quadrature on cells, as an Integration.
#pragma once

#include <span>

#include "mesh/mesh.hpp"
#include "operators/integration.hpp"

namespace hg {

/// The q_1d³ Gauss points of these local cells: spaces u and v (displacement) and nodes (coordinates), restrictions at
/// the points; no data at the points yet, no material, no regions. Point q of the k-th cell has number k q_1d³ + q.
Integration quadrature_part(const Mesh &mesh, std::span<const CeedInt> cells, CeedInt q_1d);
/// The same for all local cells.
Integration quadrature_part(const Mesh &mesh, CeedInt q_1d);

/// A field that reads entry `entry[k]` of a table, num_comp values next to each other, at every point of the k-th cell.
Integration::AtPoints cell_field(Ceed ceed, std::span<const double> table, CeedInt num_comp, std::span<const int> entry,
                                 CeedInt points_per_cell);
/// F_n = I at every point of each of these cells.
Integration::AtPoints undeformed(Ceed ceed, std::size_t num_cells, CeedInt points_per_cell);

}  // namespace hg
