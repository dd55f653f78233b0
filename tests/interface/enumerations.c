#include "enumerations.h"

#include <stddef.h>

#define CALL(name, ...)                                                                                           \
  static int name(EnumerationObjects *o, int value) {                                                             \
    CeedScalar x[36] = {0};                                                                                       \
    CeedScalar *array = NULL;                                                                                     \
    const CeedScalar *read = NULL;                                                                                \
    const CeedInt *offsets = NULL;                                                                                \
    CeedInt integers[4] = {0, 1, 2, 3};                                                                           \
    CeedSize size = 0;                                                                                            \
    void *data = NULL;                                                                                            \
    bool flag = false;                                                                                            \
    (void)o, (void)x, (void)array, (void)read, (void)offsets, (void)integers, (void)size, (void)data, (void)flag; \
    return __VA_ARGS__;                                                                                           \
  }

CALL(restriction_apply, CeedElemRestrictionApply(o->rstr, (CeedTransposeMode)value, o->vec, o->other, NULL))
CALL(restriction_apply_block,
     CeedElemRestrictionApplyBlock(o->rstr, 0, (CeedTransposeMode)value, o->vec, o->other, NULL))
CALL(restriction_apply_points,
     CeedElemRestrictionApplyAtPointsInElement(o->points, 0, (CeedTransposeMode)value, o->vec, o->other, NULL))
CALL(restriction_flops, CeedElemRestrictionGetFlopsEstimate(o->rstr, (CeedTransposeMode)value, &size))
CALL(restriction_offsets, CeedElemRestrictionGetOffsets(o->rstr, (CeedMemType)value, &offsets))
CALL(restriction_memory,
     CeedElemRestrictionCreate(o->ceed, 1, 2, 1, 1, 6, (CeedMemType)value, CEED_COPY_VALUES, integers, &o->rstr))
CALL(restriction_copy,
     CeedElemRestrictionCreate(o->ceed, 1, 2, 1, 1, 6, CEED_MEM_HOST, (CeedCopyMode)value, integers, &o->rstr))
CALL(basis_apply, CeedBasisApply(o->basis, 1, (CeedTransposeMode)value, CEED_EVAL_INTERP, o->vec, o->other))
CALL(basis_apply_mode, CeedBasisApply(o->basis, 1, CEED_NOTRANSPOSE, (CeedEvalMode)value, o->vec, o->other))
CALL(basis_flops, CeedBasisGetFlopsEstimate(o->basis, (CeedTransposeMode)value, CEED_EVAL_INTERP, false, 0, &size))
CALL(basis_flops_mode, CeedBasisGetFlopsEstimate(o->basis, CEED_NOTRANSPOSE, (CeedEvalMode)value, false, 0, &size))
CALL(basis_components, CeedBasisGetNumQuadratureComponents(o->basis, (CeedEvalMode)value, integers))
CALL(basis_none_components, CeedBasisGetNumQuadratureComponents(CEED_BASIS_NONE, (CeedEvalMode)value, integers))
CALL(basis_matrix, CeedOperatorGetBasisPointer(o->basis, (CeedEvalMode)value, x, &read))
CALL(basis_quadrature, CeedBasisCreateTensorH1Lagrange(o->ceed, 1, 1, 2, 2, (CeedQuadMode)value, &o->basis))
CALL(basis_topology, CeedBasisCreateH1(o->ceed, (CeedElemTopology)value, 1, 2, 2, x, x, x, x, &o->basis))
CALL(topology_dimension, CeedBasisGetTopologyDimension((CeedElemTopology)value, integers))
CALL(householder, CeedHouseholderApplyQ(x, x, x, (CeedTransposeMode)value, 2, 2, 2, 2, 1))
CALL(vector_norm, CeedVectorNorm(o->vec, (CeedNormType)value, x))
CALL(vector_get, CeedVectorGetArray(o->vec, (CeedMemType)value, &array))
CALL(vector_read, CeedVectorGetArrayRead(o->vec, (CeedMemType)value, &read))
CALL(vector_write, CeedVectorGetArrayWrite(o->vec, (CeedMemType)value, &array))
CALL(vector_sync, CeedVectorSyncArray(o->vec, (CeedMemType)value))
CALL(vector_take, CeedVectorTakeArray(o->vec, (CeedMemType)value, &array))
CALL(vector_borrowed, CeedVectorHasBorrowedArrayOfType(o->vec, (CeedMemType)value, &flag))
CALL(vector_set_memory, CeedVectorSetArray(o->vec, (CeedMemType)value, CEED_COPY_VALUES, x))
CALL(vector_set_copy, CeedVectorSetArray(o->vec, CEED_MEM_HOST, (CeedCopyMode)value, x))
CALL(qfunction_input, CeedQFunctionAddInput(o->qf, "new", 1, (CeedEvalMode)value))
CALL(qfunction_output, CeedQFunctionAddOutput(o->qf, "new", 1, (CeedEvalMode)value))
CALL(identity_in, CeedQFunctionCreateIdentity(o->ceed, 1, (CeedEvalMode)value, CEED_EVAL_NONE, &o->qf))
CALL(context_memory, CeedQFunctionContextSetData(o->ctx, (CeedMemType)value, CEED_COPY_VALUES, 8, x))
CALL(context_copy, CeedQFunctionContextSetData(o->ctx, CEED_MEM_HOST, (CeedCopyMode)value, 8, x))
CALL(context_get, CeedQFunctionContextGetData(o->ctx, (CeedMemType)value, &data))
CALL(context_read, CeedQFunctionContextGetDataRead(o->ctx, (CeedMemType)value, &data))
CALL(context_take, CeedQFunctionContextTakeData(o->ctx, (CeedMemType)value, &data))
CALL(context_borrowed, CeedQFunctionContextHasBorrowedDataOfType(o->ctx, (CeedMemType)value, &flag))
CALL(context_destroy, CeedQFunctionContextSetDataDestroy(o->ctx, (CeedMemType)value, NULL))

#define ENTRY(name) \
  { #name, name }
const EnumerationCall enumeration_calls[] = {
    ENTRY(restriction_apply),
    ENTRY(restriction_apply_block),
    ENTRY(restriction_apply_points),
    ENTRY(restriction_flops),
    ENTRY(restriction_offsets),
    ENTRY(restriction_memory),
    ENTRY(restriction_copy),
    ENTRY(basis_apply),
    ENTRY(basis_apply_mode),
    ENTRY(basis_flops),
    ENTRY(basis_flops_mode),
    ENTRY(basis_components),
    ENTRY(basis_none_components),
    ENTRY(basis_matrix),
    ENTRY(basis_quadrature),
    ENTRY(basis_topology),
    ENTRY(topology_dimension),
    ENTRY(householder),
    ENTRY(vector_norm),
    ENTRY(vector_get),
    ENTRY(vector_read),
    ENTRY(vector_write),
    ENTRY(vector_sync),
    ENTRY(vector_take),
    ENTRY(vector_borrowed),
    ENTRY(vector_set_memory),
    ENTRY(vector_set_copy),
    ENTRY(qfunction_input),
    ENTRY(qfunction_output),
    ENTRY(identity_in),
    ENTRY(context_memory),
    ENTRY(context_copy),
    ENTRY(context_get),
    ENTRY(context_read),
    ENTRY(context_take),
    ENTRY(context_borrowed),
    ENTRY(context_destroy),
    {NULL, NULL},
};
