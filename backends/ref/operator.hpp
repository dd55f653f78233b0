/// @file
/// Operators of the reference backend: one element after another, each step as it is defined.
#pragma once

#include <ceed/plugin.h>

namespace hg::ref {

void fill_qfunction_ops(CeedQFunctionOps &ops);
void fill_operator_ops(CeedOperatorOps &ops);

}  // namespace hg::ref
