#include "operators/fem_operators.hpp"

#include <algorithm>
#include <memory>

#include "operators/quadrature.hpp"
#include "options/error.hpp"

namespace hg {

FemOperators::FemOperators(const Mesh &mesh, const RegionMap &map, std::span<const RegionMaterial> regions,
                           CeedInt q_extra)
    : SolidOperators(mesh, regions) {
  if (map.num_regions() != static_cast<int>(regions.size())) {
    fail("%d regions on the mesh, but materials for %zu", map.num_regions(), regions.size());
  }
  map.require_all_cells();
  const auto q_1d = static_cast<CeedInt>(mesh.order + 1) + q_extra;
  points_per_cell_ = q_1d * q_1d * q_1d;

  std::vector<Integration> parts;
  for (const Material *material : materials()) {
    // the cells of this material, the regions that have it, and which of these each cell is in
    std::vector<CeedInt> cells;
    std::vector<int> entry, number(regions.size(), -1);
    auto region_of = std::make_shared<std::vector<int>>();
    std::vector<double> moduli, rho;
    for (std::size_t r = 0; r < regions.size(); r++) {
      if (regions[r].material != material) continue;
      number[r] = static_cast<int>(rho.size());
      const ElasticParameters &parameters = regions[r].parameters;
      moduli.insert(moduli.end(), {parameters.bulk_modulus(), parameters.shear_modulus()});
      rho.push_back(parameters.rho);
    }
    for (CeedInt cell = 0; cell < mesh.num_cells; cell++) {
      const int region = map.of_cell(cell);
      if (number[region] < 0) continue;
      cells.push_back(cell);
      entry.push_back(number[region]);
      region_of->push_back(region);
    }
    if (cells.empty()) continue;

    Integration part = quadrature_part(mesh, cells, q_1d);
    part.material = material;
    const CeedInt per_cell = points_per_cell_;
    part.region = [region_of, per_cell](CeedSize point) { return (*region_of)[point / per_cell]; };
    add_geometry(part);

    part.at_points[field_names::F] = undeformed(ceed_, cells.size(), per_cell);
    part.at_points[field_names::moduli] = cell_field(ceed_, moduli, 2, entry, per_cell);
    part.at_points[field_names::rho] = cell_field(ceed_, rho, 1, entry, per_cell);
    cells_.push_back(std::move(cells));
    parts.push_back(std::move(part));
  }
  build(std::move(parts));
}

std::vector<double> FemOperators::cell_diagnostics(CeedVector u) {
  std::vector<double> averages(static_cast<std::size_t>(mesh_->num_cells) * num_diagnostic, 0.);
  for (std::size_t k = 0; k < parts_.size(); k++) {
    const std::vector<double> values =
        evaluate(parts_[k], parts_[k].material->diagnostic, nullptr, field_names::diagnostic, u);
    const std::vector<double> q_data = to_host(parts_[k].at_points.at(field_names::q_data).values);
    for (std::size_t c = 0; c < cells_[k].size(); c++) {
      double *average = averages.data() + static_cast<std::size_t>(cells_[k][c]) * num_diagnostic;
      double volume = 0.;
      for (CeedInt q = 0; q < points_per_cell_; q++) {
        const std::size_t point = c * points_per_cell_ + q;
        const double w = q_data[10 * point];
        volume += w;
        for (CeedInt d = 0; d < num_diagnostic; d++) average[d] += w * values[point * num_diagnostic + d];
      }
      for (CeedInt d = 0; d < num_diagnostic; d++) average[d] /= volume;
    }
  }
  return averages;
}

}  // namespace hg
