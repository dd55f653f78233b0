#include "materials/descriptors.hpp"
#include "qfunctions/materials/neo_hookean_current.h"
#include "qfunctions/materials/neo_hookean_initial.h"

namespace hg {

using namespace material_fields;

namespace {

constexpr QFunctionSpec energy{"HgNeoHookeanEnergy", HgNeoHookeanEnergy, HgNeoHookeanEnergy_loc, state_and_grad_u,
                               only_energy};
constexpr QFunctionSpec diagnostic{"HgNeoHookeanDiagnostic", HgNeoHookeanDiagnostic, HgNeoHookeanDiagnostic_loc,
                                   state_and_grad_u, only_diagnostic};

constexpr QFunctionField initial_linearization{field_names::linearization, 9, CEED_EVAL_NONE};
constexpr QFunctionField initial_residual_outputs[] = {grad_v, initial_linearization};
constexpr QFunctionField initial_jacobian_inputs[] = {q_data, F, moduli, initial_linearization, grad_u};

constexpr QFunctionField current_linearization{field_names::linearization, 18, CEED_EVAL_NONE};
constexpr QFunctionField current_residual_outputs[] = {grad_v, current_linearization};
constexpr QFunctionField current_jacobian_inputs[] = {current_linearization, grad_u};
constexpr std::string_view current_aliases[] = {"elasticity-mpm-neo-hookean-current"};

}  // namespace

const Material neo_hookean_initial_material{
    .name = "elasticity-neo-hookean-initial",
    .aliases = {},
    .summary = "compressible neo-Hookean solid, linearised in the initial configuration",
    .num_linearization = 9,
    .residual = {"HgNeoHookeanInitialResidual", HgNeoHookeanInitialResidual, HgNeoHookeanInitialResidual_loc,
                 state_and_grad_u, initial_residual_outputs},
    .jacobian = {"HgNeoHookeanInitialJacobian", HgNeoHookeanInitialJacobian, HgNeoHookeanInitialJacobian_loc,
                 initial_jacobian_inputs, only_grad_v},
    .energy = energy,
    .diagnostic = diagnostic,
};

const Material neo_hookean_current_material{
    .name = "elasticity-neo-hookean-current",
    .aliases = current_aliases,
    .summary = "compressible neo-Hookean solid, linearised in the current configuration",
    .num_linearization = 18,
    .residual = {"HgNeoHookeanCurrentResidual", HgNeoHookeanCurrentResidual, HgNeoHookeanCurrentResidual_loc,
                 state_and_grad_u, current_residual_outputs},
    .jacobian = {"HgNeoHookeanCurrentJacobian", HgNeoHookeanCurrentJacobian, HgNeoHookeanCurrentJacobian_loc,
                 current_jacobian_inputs, only_grad_v},
    .energy = energy,
    .diagnostic = diagnostic,
};

}  // namespace hg
