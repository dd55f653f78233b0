#include "affine_operator.hpp"

#include <cstddef>

#include "conformance/qfunctions/affine.h"

namespace hg::test {

AffineOperator::AffineOperator(Ceed ceed, const Box &mesh, CeedInt Q_1d, CeedInt vec_length,
                               const AffineContext &values) {
  rstr = mesh.restriction(ceed, 1);
  ok(CeedBasisCreateTensorH1Lagrange(ceed, mesh.dim, 1, mesh.P_1d, Q_1d, CEED_GAUSS, basis.out()));
  ok(CeedQFunctionContextCreate(ceed, context.out()));
  set_context(values);
  ok(CeedQFunctionContextRegisterDouble(context, "factor", offsetof(AffineContext, factor), 1, "scales everything"));
  ok(CeedQFunctionContextRegisterDouble(context, "shift", offsetof(AffineContext, shift), 1, "added to u"));
  ok(CeedQFunctionContextRegisterInt32(context, "multiple", offsetof(AffineContext, multiple), 1,
                                       "what Q must be a multiple of"));
  ok(CeedQFunctionContextRegisterBoolean(context, "is negative", offsetof(AffineContext, is_negative), 1,
                                         "changes the sign"));
  ok(CeedQFunctionCreateInterior(ceed, vec_length, affine, affine_loc, qf.out()));
  ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "w", 1, CEED_EVAL_WEIGHT));
  ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionSetContext(qf, context));
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "u", rstr, basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "w", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE));
  ok(CeedOperatorSetField(op, "v", rstr, basis, CEED_VECTOR_ACTIVE));
}

void AffineOperator::set_context(const AffineContext &values) {
  ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof values,
                                 const_cast<AffineContext *>(&values)));
}

Values apply_to(Ceed ceed, CeedOperator op, const Values &in) {
  CeedSize length = 0;
  ok(CeedOperatorGetActiveVectorLengths(op, nullptr, &length));
  const Vector u = make_vector(ceed, in), v = make_vector(ceed, length, 1e30);
  ok(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE));
  return values_of(v);
}

}  // namespace hg::test
