#include "operators/quadrature.hpp"

#include <vector>

#include "options/error.hpp"

namespace hg {

namespace {

/// The displacement restriction of some cells.
CeedElemRestrictionHandle some_cells(const Mesh &mesh, std::span<const CeedInt> cells) {
  const auto num_nodes = static_cast<CeedInt>((mesh.order + 1) * (mesh.order + 1) * (mesh.order + 1));
  std::vector<CeedInt> offsets;
  offsets.reserve(cells.size() * num_nodes);
  for (const CeedInt cell : cells) {
    const auto first = mesh.node_offsets().begin() + static_cast<std::ptrdiff_t>(cell) * num_nodes;
    offsets.insert(offsets.end(), first, first + num_nodes);
  }
  CeedElemRestrictionHandle rstr;
  ceed_check(CeedElemRestrictionCreate(mesh.ceed, static_cast<CeedInt>(cells.size()), num_nodes, 3, 1, mesh.local_size,
                                       CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), rstr.put()));
  return rstr;
}

}  // namespace

Integration quadrature_part(const Mesh &mesh, std::span<const CeedInt> cells, CeedInt q_1d) {
  Integration part;
  part.ceed = mesh.ceed;
  const auto num_cells = static_cast<CeedInt>(cells.size());
  const CeedInt per_cell = q_1d * q_1d * q_1d;
  part.num_points = static_cast<CeedSize>(num_cells) * per_cell;
  part.restriction = [ceed = mesh.ceed, num_cells, per_cell](CeedInt num_comp) {
    const CeedInt strides[3] = {num_comp, 1, num_comp * per_cell};
    CeedElemRestrictionHandle rstr;
    ceed_check(CeedElemRestrictionCreateStrided(ceed, num_cells, per_cell, num_comp,
                                                static_cast<CeedSize>(num_cells) * per_cell * num_comp, strides,
                                                rstr.put()));
    return rstr;
  };

  const bool all = num_cells == mesh.num_cells;
  const CeedBasisHandle basis = mesh.basis(mesh.order, 3, q_1d, CEED_GAUSS);
  for (const char *name : {field_names::u, field_names::v}) {
    part.on_mesh[name] = {all ? share(mesh.rstr_u.get()) : some_cells(mesh, cells), share(basis.get()), {}};
  }
  std::vector<double> corners;
  corners.reserve(cells.size() * 24);
  for (const CeedInt cell : cells) {
    const auto x = mesh.corners(cell);
    corners.insert(corners.end(), x.begin(), x.end());
  }
  Integration::OnMesh &nodes = part.on_mesh["nodes"];
  const CeedInt strides[3] = {3, 1, 24};
  ceed_check(CeedElemRestrictionCreateStrided(mesh.ceed, num_cells, 8, 3, static_cast<CeedSize>(corners.size()),
                                              strides, nodes.rstr.put()));
  nodes.basis = mesh.basis(1, 3, q_1d, CEED_GAUSS);
  nodes.values = make_vector(mesh.ceed, corners);
  return part;
}

}  // namespace hg
