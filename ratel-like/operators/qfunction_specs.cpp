#include "operators/qfunction_specs.hpp"

#include <utility>

#include "qfunctions/bc/body_force.h"
#include "qfunctions/bc/mms_linear.h"
#include "qfunctions/common/geometry.h"
#include "qfunctions/common/integrals.h"
#include "qfunctions/mpm/geometry_points.h"
#include "qfunctions/mpm/point_update.h"

namespace hg::specs {

namespace {

using Field = QFunctionField;
constexpr CeedEvalMode none = CEED_EVAL_NONE, interp = CEED_EVAL_INTERP, grad = CEED_EVAL_GRAD;

constexpr Field q_data{"q_data", 10, none}, F{"F", 9, none}, moduli{"moduli", 2, none}, rho{"rho", 1, none};
constexpr Field x{"x", 3, none}, V{"V", 1, none}, u{"u", 3, interp}, grad_u{"grad_u", 9, grad}, v{"v", 3, interp};

constexpr Field geometry_in[] = {{"grad_nodes", 9, grad}, {"weight", 1, CEED_EVAL_WEIGHT}};
constexpr Field geometry_points_in[] = {{"grad_nodes", 9, grad}, V};
constexpr Field geometry_out[] = {q_data};
constexpr Field weight_in[] = {q_data};
constexpr Field weight_out[] = {{"scalar", 1, interp}};
constexpr Field integrals_in[] = {q_data, F, rho, u, grad_u};
constexpr Field integrals_out[] = {{"integrals", 5, none}};
constexpr Field body_force_in[] = {q_data, F, rho};
constexpr Field mms_force_in[] = {q_data, x, moduli};
constexpr Field force_out[] = {v};
constexpr Field mms_error_in[] = {q_data, x, u};
constexpr Field mms_error_out[] = {{"error", 1, none}};
constexpr Field point_update_in[] = {q_data, F, x, {"u_total", 3, none}, u, grad_u};
constexpr Field point_update_out[] = {
    {"x_new", 3, none}, {"u_new", 3, none}, {"v_new", 3, none}, {"F_new", 9, none}, {"V_new", 1, none}};

}  // namespace

const QFunctionSpec geometry{"HgGeometry", HgGeometry, HgGeometry_loc, geometry_in, geometry_out};
const QFunctionSpec geometry_points{"HgGeometryPoints", HgGeometryPoints, HgGeometryPoints_loc, geometry_points_in,
                                    geometry_out};
const QFunctionSpec weight{"HgWeight", HgWeight, HgWeight_loc, weight_in, weight_out};
const QFunctionSpec integrals{"HgIntegrals", HgIntegrals, HgIntegrals_loc, integrals_in, integrals_out};
const QFunctionSpec body_force{"HgBodyForce", HgBodyForce, HgBodyForce_loc, body_force_in, force_out};
const QFunctionSpec mms_force{"HgMmsLinearForce", HgMmsLinearForce, HgMmsLinearForce_loc, mms_force_in, force_out};
const QFunctionSpec mms_error{"HgMmsLinearError", HgMmsLinearError, HgMmsLinearError_loc, mms_error_in, mms_error_out};
const QFunctionSpec point_update{"HgPointUpdate", HgPointUpdate, HgPointUpdate_loc, point_update_in, point_update_out};

OwnedSpec::OwnedSpec(const char *function_name, CeedQFunctionUser function, const char *source,
                     std::vector<QFunctionField> inputs, std::vector<QFunctionField> outputs)
    : name_(function_name),
      function_(function),
      source_(source),
      inputs_(std::move(inputs)),
      outputs_(std::move(outputs)) {
  for (const auto *fields : {&inputs_, &outputs_}) {
    for (const Field &field : *fields) {
      name_ += std::string(" ") + field.name + ":" + std::to_string(field.size) + CeedEvalModes[field.mode];
    }
  }
}

OwnedSpec::operator QFunctionSpec() const {
  return {name_.c_str(), function_, source_, inputs_, outputs_};
}

OwnedSpec mass(const QFunctionField &input, const QFunctionField &output) {
  return {"HgMass", HgMass, HgMass_loc, {q_data, input}, {output}};
}

OwnedSpec copy(const QFunctionField &input, const QFunctionField &output) {
  return {"HgCopy", HgCopy, HgCopy_loc, {input}, {output}};
}

}  // namespace hg::specs
