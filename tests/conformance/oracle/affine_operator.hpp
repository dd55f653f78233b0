/// @file
/// An operator with a context: v = w factor (shift + u) in one scalar space, qfunctions/simple.h.
#pragma once

#include "box.hpp"
#include "conformance/qfunctions/affine_context.h"

namespace hg::test {

struct AffineOperator {
  AffineOperator(Ceed ceed, const Box &mesh, CeedInt Q_1d, CeedInt vec_length, const AffineContext &values);
  /// Replaces the data of the context.
  void set_context(const AffineContext &values);

  Restriction rstr;
  Basis basis;
  Context context;  ///< its fields are registered: "factor", "shift" (double), "multiple" (int32), "is negative" (bool)
  QFunction qf;
  Operator op;
};

/// op applied to `in`.
Values apply_to(Ceed ceed, CeedOperator op, const Values &in);

}  // namespace hg::test
