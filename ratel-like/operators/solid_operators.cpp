#include "operators/solid_operators.hpp"

#include <string_view>
#include <utility>

#include "operators/qfunction_specs.hpp"
#include "operators/quadrature.hpp"
#include "options/error.hpp"
#include "qfunctions/common/contexts.h"

namespace hg {

SolidOperators::SolidOperators(const Mesh &mesh, std::span<const RegionMaterial> regions)
    : mesh_(&mesh), ceed_(mesh.ceed), regions_(regions.begin(), regions.end()), cache_(mesh.ceed) {
  for (const RegionMaterial &region : regions_) {
    if (!region.material) fail("a region has no material");
  }
  ceed_check(CeedVectorCreate(ceed_, mesh.local_size, scratch_.put()));
  body_force_context_ = make_context(ceed_, HgBodyForceContext{});
  ceed_check(CeedQFunctionContextRegisterDouble(body_force_context_, "acceleration", 0, 3, "acceleration g"));
  mms_context_ = make_context(ceed_, HgMmsLinearContext{});
  ceed_check(CeedQFunctionContextRegisterDouble(mms_context_, "amplitude", 0, 1, "amplitude of the displacement"));
}

CeedOperatorHandle SolidOperators::compose(const QFunctionSpec &spec, CeedQFunctionContext context) {
  CeedOperatorHandle composite;
  ceed_check(CeedOperatorCreateComposite(ceed_, composite.put()));
  for (const Integration &part : parts_) {
    ceed_check(CeedOperatorCompositeAddSub(composite, part.make(cache_, spec, context)));
  }
  return composite;
}

void SolidOperators::build(std::vector<Integration> parts, std::optional<Integration> support) {
  body_force_.reset();
  mms_force_.reset();
  parts_ = std::move(parts);
  ceed_check(CeedOperatorCreateComposite(ceed_, residual_.put()));
  ceed_check(CeedOperatorCreateComposite(ceed_, jacobian_.put()));
  const auto add = [&](Integration &part) {
    const Material &material = *part.material;
    if (material.num_linearization) part.add(field_names::linearization, material.num_linearization);
    ceed_check(CeedOperatorCompositeAddSub(residual_, part.make(cache_, material.residual)));
    ceed_check(CeedOperatorCompositeAddSub(jacobian_, part.make(cache_, material.jacobian)));
  };
  for (Integration &part : parts_) add(part);
  if (support) add(*support);
}

void SolidOperators::add_geometry(Integration &part) {
  const Integration::AtPoints &q_data = part.add(field_names::q_data, 10);
  const QFunctionSpec &spec = part.points ? specs::geometry_points : specs::geometry;
  const CeedOperatorHandle op = part.make(cache_, spec, nullptr, field_names::q_data);
  ceed_check(CeedOperatorApply(op, CEED_VECTOR_NONE, q_data.values, CEED_REQUEST_IMMEDIATE));
}

void SolidOperators::add_coordinates(Integration &part) {
  if (part.at_points.contains(field_names::x)) return;
  const Integration::AtPoints &x = part.add(field_names::x, 3);
  const CeedQFunctionContextHandle context = make_context(ceed_, HgMassContext{3});
  const CeedOperatorHandle op =
      part.make(cache_, specs::copy({"nodes", 3, CEED_EVAL_INTERP}, {field_names::x, 3, CEED_EVAL_NONE}), context,
                field_names::x);
  ceed_check(CeedOperatorApply(op, CEED_VECTOR_NONE, x.values, CEED_REQUEST_IMMEDIATE));
}

std::vector<double> SolidOperators::evaluate(const Integration &part, const QFunctionSpec &spec,
                                             CeedQFunctionContext context, const char *output, CeedVector active) {
  CeedInt num_comp = 0;
  for (const QFunctionField &field : spec.outputs) {
    if (std::string_view(field.name) == output) num_comp = field.size;
  }
  CeedVectorHandle values;
  ceed_check(CeedVectorCreate(ceed_, part.num_points * num_comp, values.put()));
  const CeedOperatorHandle op = part.make(cache_, spec, context, output);
  ceed_check(CeedOperatorApply(op, active, values, CEED_REQUEST_IMMEDIATE));
  return to_host(values);
}

void SolidOperators::linearize(CeedVector u) {
  ceed_check(CeedOperatorApply(residual_, u, scratch_, CEED_REQUEST_IMMEDIATE));
}

void SolidOperators::body_force(const std::array<double, 3> &acceleration, CeedVector f) {
  set_context(body_force_context_, HgBodyForceContext{{acceleration[0], acceleration[1], acceleration[2]}});
  if (!body_force_) body_force_ = compose(specs::body_force, body_force_context_);
  ceed_check(CeedOperatorApply(body_force_, CEED_VECTOR_NONE, f, CEED_REQUEST_IMMEDIATE));
}

void SolidOperators::mms_force(double amplitude, CeedVector f) {
  set_context(mms_context_, HgMmsLinearContext{amplitude});
  if (!mms_force_) {
    for (Integration &part : parts_) add_coordinates(part);
    mms_force_ = compose(specs::mms_force, mms_context_);
  }
  ceed_check(CeedOperatorApply(mms_force_, CEED_VECTOR_NONE, f, CEED_REQUEST_IMMEDIATE));
}

double SolidOperators::mms_error_squared(double amplitude, CeedVector u) {
  set_context(mms_context_, HgMmsLinearContext{amplitude});
  double sum = 0.;
  for (Integration &part : parts_) {
    add_coordinates(part);
    for (const double error : evaluate(part, specs::mms_error, mms_context_, "error", u)) sum += error;
  }
  return sum;
}

double SolidOperators::mms_error_squared_on_mesh(double amplitude, CeedVector u) {
  if (mesh_->num_cells == 0) return 0.;
  Integration part = quadrature_part(*mesh_, static_cast<CeedInt>(mesh_->order + 1));
  add_geometry(part);
  add_coordinates(part);
  set_context(mms_context_, HgMmsLinearContext{amplitude});
  double sum = 0.;
  for (const double error : evaluate(part, specs::mms_error, mms_context_, "error", u)) sum += error;
  return sum;
}

std::vector<RegionIntegrals> SolidOperators::integrals(CeedVector u) {
  std::vector<RegionIntegrals> sums(regions_.size());
  for (const Integration &part : parts_) {
    const std::vector<double> values = evaluate(part, specs::integrals, nullptr, "integrals", u);
    const std::vector<double> energy = evaluate(part, part.material->energy, nullptr, field_names::energy, u);
    for (CeedSize p = 0; p < part.num_points; p++) {
      const double *value = values.data() + 5 * p;
      RegionIntegrals &sum = sums[part.region(p)];
      sum.volume += value[0];
      sum.mass += value[1];
      sum.strain_energy += energy[p];
      for (int c = 0; c < 3; c++) sum.mass_displacement[c] += value[2 + c];
    }
  }
  return sums;
}

}  // namespace hg
