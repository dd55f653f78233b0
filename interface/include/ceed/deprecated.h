/// @file
/// Former names of functions, for programs that still use them. Included by ceed/ceed.h.
#ifndef CEED_DEPRECATED_H
#define CEED_DEPRECATED_H

#include "ceed.h"

#if defined(__GNUC__) || defined(__clang__)
#define CEED_FORMER_NAME_OF(name) __attribute__((deprecated("its name is " #name "()"))) static inline
#else
#define CEED_FORMER_NAME_OF(name) static inline
#endif

CEED_FORMER_NAME_OF(CeedOperatorCreateComposite)
int CeedCompositeOperatorCreate(Ceed ceed, CeedOperator *op) { return CeedOperatorCreateComposite(ceed, op); }

CEED_FORMER_NAME_OF(CeedOperatorCompositeAddSub)
int CeedCompositeOperatorAddSub(CeedOperator composite_op, CeedOperator sub_op) {
  return CeedOperatorCompositeAddSub(composite_op, sub_op);
}

CEED_FORMER_NAME_OF(CeedOperatorCompositeGetNumSub)
int CeedCompositeOperatorGetNumSub(CeedOperator op, CeedInt *num_suboperators) {
  return CeedOperatorCompositeGetNumSub(op, num_suboperators);
}

CEED_FORMER_NAME_OF(CeedOperatorCompositeGetSubList)
int CeedCompositeOperatorGetSubList(CeedOperator op, CeedOperator **sub_operators) {
  return CeedOperatorCompositeGetSubList(op, sub_operators);
}

CEED_FORMER_NAME_OF(CeedOperatorCompositeGetSubByName)
int CeedCompositeOperatorGetSubByName(CeedOperator op, const char *op_name, CeedOperator *sub_op) {
  return CeedOperatorCompositeGetSubByName(op, op_name, sub_op);
}

CEED_FORMER_NAME_OF(CeedOperatorCompositeGetMultiplicity)
int CeedCompositeOperatorGetMultiplicity(CeedOperator op, CeedInt num_skip_indices, CeedInt *skip_indices,
                                         CeedVector mult) {
  return CeedOperatorCompositeGetMultiplicity(op, num_skip_indices, skip_indices, mult);
}

#undef CEED_FORMER_NAME_OF

#endif
