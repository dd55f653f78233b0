#include "operators/quadrature.hpp"

#include <numeric>
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

Integration quadrature_part(const Mesh &mesh, CeedInt q_1d) {
  std::vector<CeedInt> cells(mesh.num_cells);
  std::iota(cells.begin(), cells.end(), 0);
  return quadrature_part(mesh, cells, q_1d);
}

Integration::AtPoints cell_field(Ceed ceed, std::span<const double> table, CeedInt num_comp, std::span<const int> entry,
                                 CeedInt points_per_cell) {
  Integration::AtPoints field;
  field.values = make_vector(ceed, table);
  const auto num_cells = static_cast<CeedInt>(entry.size());
  const auto length = static_cast<CeedSize>(table.size());
  std::vector<CeedInt> offsets;
  offsets.reserve(entry.size() * points_per_cell);
  for (const int e : entry) offsets.insert(offsets.end(), points_per_cell, e * num_comp);
  ceed_check(CeedElemRestrictionCreate(ceed, num_cells, points_per_cell, num_comp, 1, length, CEED_MEM_HOST,
                                       CEED_COPY_VALUES, offsets.data(), field.rstr.put()));
  return field;
}

Integration::AtPoints undeformed(Ceed ceed, std::size_t num_cells, CeedInt points_per_cell) {
  constexpr double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return cell_field(ceed, identity, 9, std::vector<int>(num_cells, 0), points_per_cell);
}

}  // namespace hg
