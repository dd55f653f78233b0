#include "operators/mpm_operators.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "operators/qfunction_specs.hpp"
#include "operators/quadrature.hpp"
#include "options/error.hpp"
#include "qfunctions/common/contexts.h"

namespace hg {

namespace {

struct CarriedField {
  const char *name;   ///< for QFunctions
  const char *field;  ///< in the swarm
  CeedInt num_comp;
};
constexpr CarriedField carried[] = {{field_names::F, field::F, 9},
                                    {"V", field::V, 1},
                                    {field_names::moduli, field::material, 2},
                                    {field_names::rho, field::rho0, 1},
                                    {field_names::x, field::x, 3},
                                    {"u_total", field::u, 3}};

struct UpdatedField {
  const char *name;
  const char *field;
  CeedInt num_comp;
};
constexpr UpdatedField updated[] = {{"x_new", field::x, 3},
                                    {"u_new", field::u, 3},
                                    {"v_new", field::v, 3},
                                    {"F_new", field::F, 9},
                                    {"V_new", field::V, 1}};

}  // namespace

MpmOperators::MpmOperators(const Mesh &mesh, std::span<const RegionMaterial> regions, double void_stiffness)
    : SolidOperators(mesh, regions), void_stiffness_(void_stiffness) {
  const auto q_1d = static_cast<CeedInt>(mesh.order + 1);
  basis_u_ = mesh.basis(mesh.order, 3, q_1d, CEED_GAUSS);
  basis_x_ = mesh.basis(1, 3, q_1d, CEED_GAUSS);
  update_context_ = make_context(ceed_, HgPointUpdateContext{1.});
  ceed_check(CeedQFunctionContextRegisterDouble(update_context_, "delta_t", 0, 1, "length of the step"));
  build({});
}

Integration MpmOperators::make_part(const std::function<CeedElemRestrictionHandle(CeedInt)> &restriction) const {
  Integration part;
  part.ceed = ceed_;
  part.restriction = restriction;
  part.points = restriction(3);
  for (const char *name : {field_names::u, field_names::v}) {
    part.on_mesh[name] = {share(mesh_->rstr_u.get()), share(basis_u_.get()), {}};
  }
  part.on_mesh["nodes"] = {share(mesh_->rstr_x.get()), share(basis_x_.get()), share(mesh_->x.get())};
  for (const CarriedField &field : carried) {
    part.at_points[field.name] = {restriction(field.num_comp), share(values_.at(field.name).get())};
  }
  return part;
}

std::optional<Integration> MpmOperators::make_void(const PointEpoch &epoch, const Swarm &swarm) {
  const auto num_cells = static_cast<std::size_t>(epoch.num_cells());
  active_cells_.assign(num_cells, 0);
  for (std::size_t c = 0; c < num_cells; c++) active_cells_[c] = epoch.starts()[c + 1] > epoch.starts()[c];
  if (void_stiffness_ == 0. || num_cells == 0) return {};

  const auto q_1d = static_cast<CeedInt>(mesh_->order + 1);
  const CeedInt per_cell = q_1d * q_1d * q_1d;
  if (cell_volumes_.empty()) {
    Integration mesh_part = quadrature_part(*mesh_, q_1d);
    add_geometry(mesh_part);
    const std::vector<double> q_data = to_host(mesh_part.at_points.at(field_names::q_data).values);
    cell_volumes_.assign(num_cells, 0.);
    for (CeedSize q = 0; q < mesh_part.num_points; q++) cell_volumes_[q / per_cell] += q_data[10 * q];
  }
  const ElasticParameters &softest = std::ranges::min_element(regions_, {}, [](const RegionMaterial &region) {
                                       return region.parameters.E;
                                     })->parameters;
  const PointField<double> V(swarm, field::V);
  std::vector<CeedInt> cells;
  std::vector<int> entry;
  std::vector<double> moduli;
  for (std::size_t c = 0; c < num_cells; c++) {
    double filled = 0.;
    for (CeedInt k = epoch.starts()[c]; k < epoch.starts()[c + 1]; k++) filled += V[epoch.order()[k]];
    const double factor = void_stiffness_ * (1. - 2. * filled / cell_volumes_[c]);
    if (factor <= 0.) continue;
    active_cells_[c] = 1;
    entry.push_back(static_cast<int>(cells.size()));
    cells.push_back(static_cast<CeedInt>(c));
    moduli.insert(moduli.end(), {factor * softest.bulk_modulus(), factor * softest.shear_modulus()});
  }
  if (cells.empty()) return {};
  Integration part = quadrature_part(*mesh_, cells, q_1d);
  part.material = &find_material("elasticity-linear");
  add_geometry(part);
  part.at_points[field_names::F] = undeformed(ceed_, cells.size(), per_cell);
  part.at_points[field_names::moduli] = cell_field(ceed_, moduli, 2, entry, per_cell);
  return part;
}

void MpmOperators::attach(const PointEpoch &epoch, const Swarm &swarm) {
  const CeedInt num_points = epoch.num_points();
  all_ = {};
  values_.clear();
  std::optional<Integration> support = make_void(epoch, swarm);
  if (num_points == 0) {
    build({}, std::move(support));
    return;
  }

  for (const CarriedField &field : carried) {
    values_[field.name] = epoch.vector(field.num_comp, PointField<double>(swarm, field.field).span());
  }
  const auto all_points = [&epoch](CeedInt num_comp) { return share(epoch.points(num_comp)); };
  all_ = make_part(all_points);
  all_.num_points = num_points;
  all_.x_ref = share(epoch.x_ref());
  add_geometry(all_);

  // region of each point, and the materials in use
  const PointField<std::int32_t> region_field(swarm, field::region);
  auto region = std::make_shared<std::vector<int>>(region_field.span().begin(), region_field.span().end());
  std::vector<const Material *> in_use;
  for (CeedInt p = 0; p < num_points; p++) {
    const int r = (*region)[p];
    if (r < 0 || r >= static_cast<int>(regions_.size())) {
      fail("point at storage index %d is in region %d, expected 0 to %zu", p, r, regions_.size() - 1);
    }
    const Material *material = regions_[r].material;
    if (std::ranges::find(in_use, material) == in_use.end()) in_use.push_back(material);
  }
  all_.region = [region](CeedSize p) { return (*region)[p]; };

  std::vector<Integration> parts;
  for (const Material *material : in_use) {
    std::function<CeedElemRestrictionHandle(CeedInt)> restriction = all_points;
    if (in_use.size() > 1) {
      // the points of this material, cell by cell, in the layout of CeedElemRestrictionCreateAtPoints
      auto offsets = std::make_shared<std::vector<CeedInt>>(epoch.num_cells() + 1);
      for (CeedInt c = 0; c < epoch.num_cells(); c++) {
        (*offsets)[c] = static_cast<CeedInt>(offsets->size());
        for (CeedInt k = epoch.starts()[c]; k < epoch.starts()[c + 1]; k++) {
          const CeedInt p = epoch.order()[k];
          if (regions_[(*region)[p]].material == material) offsets->push_back(p);
        }
      }
      (*offsets)[epoch.num_cells()] = static_cast<CeedInt>(offsets->size());
      restriction = [offsets, ceed = ceed_, num_cells = epoch.num_cells(), num_points](CeedInt num_comp) {
        const auto selected = static_cast<CeedInt>(offsets->size()) - num_cells - 1;
        CeedElemRestrictionHandle rstr;
        ceed_check(CeedElemRestrictionCreateAtPoints(ceed, num_cells, selected, num_comp,
                                                     static_cast<CeedSize>(num_points) * num_comp, CEED_MEM_HOST,
                                                     CEED_COPY_VALUES, offsets->data(), rstr.put()));
        return rstr;
      };
    }
    Integration part = make_part(restriction);
    part.material = material;
    part.num_points = num_points;
    part.x_ref = share(epoch.x_ref());
    part.region = all_.region;
    part.at_points[field_names::q_data] = {restriction(10), share(all_.at_points.at(field_names::q_data).values.get())};
    parts.push_back(std::move(part));
  }
  build(std::move(parts), std::move(support));
}

void MpmOperators::update_points(CeedVector delta_u, double delta_t, Swarm &swarm) {
  if (!all_.points) return;  // no points on this rank
  if (PointField<double>(swarm, field::V).size() != static_cast<std::size_t>(all_.num_points)) {
    fail("the swarm has %zu points, but the operators were attached to %td", PointField<double>(swarm, field::V).size(),
         all_.num_points);
  }
  set_context(update_context_, HgPointUpdateContext{delta_t});
  for (const UpdatedField &field : updated) all_.add(field.name, field.num_comp);
  const CeedOperatorHandle op = all_.make(cache_, specs::point_update, update_context_);
  ceed_check(CeedOperatorApply(op, delta_u, CEED_VECTOR_NONE, CEED_REQUEST_IMMEDIATE));

  const std::vector<double> V = to_host(all_.at_points.at("V_new").values);
  for (std::size_t p = 0; p < V.size(); p++) {
    if (V[p] > 0.) continue;
    const PointField<std::int64_t> id(swarm, field::id);
    const PointField<double> x(swarm, field::x);
    fail("inverted point: det(I + grad du) <= 0 at point %lld at (%g, %g, %g)", static_cast<long long>(id[p]), x[3 * p],
         x[3 * p + 1], x[3 * p + 2]);
  }
  for (const UpdatedField &field : updated) {
    const std::vector<double> values = to_host(all_.at_points.at(field.name).values);
    std::ranges::copy(values, PointField<double>(swarm, field.field).data());
    all_.at_points.erase(field.name);
  }
}

std::vector<double> MpmOperators::point_diagnostics(CeedVector delta_u) {
  std::vector<double> sum(static_cast<std::size_t>(all_.num_points) * num_diagnostic, 0.);
  for (const Integration &part : parts_) {
    const std::vector<double> values =
        evaluate(part, part.material->diagnostic, nullptr, field_names::diagnostic, delta_u);
    for (std::size_t k = 0; k < sum.size(); k++) sum[k] += values[k];  // zero where a point is of another material
  }
  return sum;
}

}  // namespace hg
