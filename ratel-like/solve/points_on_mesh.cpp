#include "solve/points_on_mesh.hpp"

#include <ceed/backend.h>

#include <utility>

#include "options/error.hpp"

namespace hg {

PointsOnMesh::PointsOnMesh(Setup &setup) : setup_(setup) {
  OptionGroup group(setup.comm, "", "Points on the mesh");
  const std::string kind =
      group.choice("mpm_projection", "how fields of points are projected to the mesh for -*_diagnostic_quantities",
                   {"lumped", "consistent"}, "lumped");
  if (!setup.output.diagnostics.empty()) series_.emplace(setup.comm, setup.output.diagnostics);
  if (!setup.output.view.empty()) view_.emplace(setup.comm, setup.output.view);
  if (series_ || view_) {
    projection_.emplace(*setup.mesh, 1, kind == "lumped" ? ProjectionKind::lumped : ProjectionKind::consistent);
  }
}

void PointsOnMesh::resume(PetscInt last_step) {
  if (series_) series_->resume(last_step);
}

bool PointsOnMesh::due(PetscInt step, bool last) const {
  return step > 0 && ((series_ && setup_.output.due(step, last)) || (view_ && last));
}

void PointsOnMesh::write(PetscInt step, double time, bool last, const MpmOperators &operators, const Swarm &swarm,
                         const std::vector<double> &diagnostics, std::span<const double> delta_u) {
  const Mesh &mesh = *setup_.mesh;
  projection_->attach(operators.points());

  const PointField<double> u(swarm, field::u);
  const std::size_t num_points = u.size() / 3;
  const auto column = [&](int first, int count) {
    std::vector<double> values(num_points * count);
    for (std::size_t p = 0; p < num_points; ++p) {
      for (int c = 0; c < count; ++c) values[p * count + c] = diagnostics[p * num_diagnostic + first + c];
    }
    return projection_->to_mesh(values, count);
  };
  const std::vector<double> stress = column(0, 6), pressure = column(6, 1), von_mises = column(7, 1);
  const std::vector<double> energy = column(9, 1), displacement = projection_->to_mesh(u.span(), 3);
  const NodeField nodes[] = {{"cauchy_stress", 6, stress},       {"pressure", 1, pressure},
                             {"von_mises_stress", 1, von_mises}, {"strain_energy_density", 1, energy},
                             {"displacement", 3, displacement},  {"volume", 1, projection_->node_volume()}};

  // the vertices of each cell, carried by Δu: corner (a, b, c) of a cell is node (pa, pb, pc) of its displacement
  std::vector<double> corners = mesh.corner_coords;
  const PetscInt p = mesh.order, row = p + 1;
  for (CeedInt cell = 0; cell < mesh.num_cells; ++cell) {
    const CeedInt *offsets = mesh.node_offsets().data() + static_cast<std::size_t>(cell) * row * row * row;
    for (int corner = 0; corner < 8; ++corner) {
      const PetscInt node = p * ((corner & 1) + row * ((corner >> 1 & 1) + row * (corner >> 2)));
      for (int c = 0; c < 3; ++c)
        corners[24 * static_cast<std::size_t>(cell) + 3 * corner + c] += delta_u[offsets[node] + c];
    }
  }
  const MeshSpace &space = mesh.space(1, 3);
  const CeedInt *offsets;
  ceed_check(CeedElemRestrictionGetOffsets(space.rstr, CEED_MEM_HOST, &offsets));
  const std::vector<CeedInt> cell_nodes(offsets, offsets + static_cast<std::size_t>(mesh.num_cells) * 8);
  ceed_check(CeedElemRestrictionRestoreOffsets(space.rstr, &offsets));
  const MeshView view{.order = 1, .num_nodes = space.local_size / 3, .cell_nodes = cell_nodes, .corners = corners};
  if (series_ && setup_.output.due(step, last)) series_->write(step, time, view, nodes);
  if (view_ && last) view_->write(step, time, view, nodes);
}

}  // namespace hg
