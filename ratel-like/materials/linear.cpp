#include "qfunctions/materials/linear.h"

#include "materials/descriptors.hpp"

namespace hg {

using namespace material_fields;

static constexpr std::string_view aliases[] = {"elasticity-mpm-linear"};

const Material linear_material{
    .name = "elasticity-linear",
    .aliases = aliases,
    .summary = "linear elasticity, small strain",
    .num_linearization = 0,
    .residual = {"HgLinearResidual", HgLinearResidual, HgLinearResidual_loc, state_and_grad_u, only_grad_v},
    .jacobian = {"HgLinearJacobian", HgLinearJacobian, HgLinearJacobian_loc, state_and_grad_u, only_grad_v},
    .energy = {"HgLinearEnergy", HgLinearEnergy, HgLinearEnergy_loc, state_and_grad_u, only_energy},
    .diagnostic = {"HgLinearDiagnostic", HgLinearDiagnostic, HgLinearDiagnostic_loc, state_and_grad_u, only_diagnostic},
};

}  // namespace hg
