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

}  // namespace hg
