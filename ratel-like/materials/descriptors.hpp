/// @file
/// The descriptors that material.cpp lists, and what their definitions share. A new material is a QFunction header, one
/// file here with its descriptor, and one line in material.cpp.
#pragma once

#include "materials/material.hpp"

namespace hg {

extern const Material linear_material;
extern const Material neo_hookean_initial_material;
extern const Material neo_hookean_current_material;

/// Fields that most materials use.
namespace material_fields {
inline constexpr QFunctionField q_data{field_names::q_data, 10, CEED_EVAL_NONE};
inline constexpr QFunctionField F{field_names::F, 9, CEED_EVAL_NONE};
inline constexpr QFunctionField moduli{field_names::moduli, 2, CEED_EVAL_NONE};
inline constexpr QFunctionField grad_u{field_names::u, 9, CEED_EVAL_GRAD};
inline constexpr QFunctionField grad_v{field_names::v, 9, CEED_EVAL_GRAD};

inline constexpr QFunctionField state_and_grad_u[] = {q_data, F, moduli, grad_u};
inline constexpr QFunctionField only_grad_v[] = {grad_v};
inline constexpr QFunctionField only_energy[] = {{field_names::energy, 1, CEED_EVAL_NONE}};
inline constexpr QFunctionField only_diagnostic[] = {{field_names::diagnostic, num_diagnostic, CEED_EVAL_NONE}};
}  // namespace material_fields

}  // namespace hg
