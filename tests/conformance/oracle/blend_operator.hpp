/// @file
/// Linear operators of any fields, with the QFunction of qfunctions/blend.h.
#pragma once

#include <vector>

#include "support/errors.hpp"
#include "support/values.hpp"

namespace hg::test {

/// One input or output; names are in0, in1, … and out0, out1, …
struct BlendField {
  CeedEvalMode mode;
  CeedInt size;  ///< values at a point
  CeedElemRestriction rstr;
  CeedBasis basis;
  CeedVector vec;
};

/// The points of an operator at points.
struct BlendPoints {
  CeedElemRestriction rstr = nullptr;  ///< NULL: the operator is at quadrature points
  CeedVector coordinates = nullptr;
};

/// The seed chooses the coefficients.
Operator make_blend(Ceed ceed, CeedInt seed, const std::vector<BlendField> &inputs,
                    const std::vector<BlendField> &outputs, const BlendPoints &points = {});

/// The matrix of an operator, row-major, by its action on unit vectors.
Values dense_by_unit_vectors(Ceed ceed, CeedOperator op);

}  // namespace hg::test
