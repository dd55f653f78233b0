/// @file
/// What backends, and programs that look deeper, may ask of objects. Handles returned by Get are counted unless said
/// otherwise.
#ifndef CEED_BACKEND_H
#define CEED_BACKEND_H

#include <ceed.h>
#include <limits.h>

#define CEED_UNUSED __attribute__((unused))
#define CEED_MAX_RESOURCE_LEN 1024
#define CEED_MAX_BACKEND_PRIORITY UINT_MAX
/// Alignment in bytes of arrays that the library allocates.
#define CEED_ALIGN 64

/// Returns from the calling function if the call failed.
#define CeedCall(...)          \
  do {                         \
    int ierr_ = __VA_ARGS__;   \
    if (ierr_) return ierr_;   \
  } while (0)
/// The same in a backend: whatever fails there leaves the object unusable.
#define CeedCallBackend(...)                                                 \
  do {                                                                       \
    int ierr_ = __VA_ARGS__;                                                 \
    if (ierr_) return ierr_ > CEED_ERROR_SUCCESS ? CEED_ERROR_BACKEND : ierr_; \
  } while (0)
/// Reports an error and returns it from the calling function unless `cond` holds.
#define CeedCheck(cond, ceed, ecode, ...)                        \
  do {                                                           \
    if (!(cond)) return CeedError(ceed, ecode, __VA_ARGS__);     \
  } while (0)

/// @name Ceed
/// @{
/// Whether CEED_DEBUG is set in the environment.
CEED_EXTERN int CeedIsDebug(Ceed ceed, bool *is_debug);
/// What stands before the first `delineator` in a resource, or all of it; the caller frees it with free().
CEED_EXTERN int CeedGetResourceRoot(Ceed ceed, const char *resource, const char *delineator, char **resource_root);
/// Pointer of the backend, set by its init.
CEED_EXTERN int CeedGetData(Ceed ceed, void *data);
CEED_EXTERN int CeedSetData(Ceed ceed, void *data);
CEED_EXTERN int CeedReference(Ceed ceed);
CEED_EXTERN int CeedSetDeterministic(Ceed ceed, bool is_deterministic);
/// Directories given by CeedAddJitSourceRoot(); the caller frees the list, not its strings, with Restore.
CEED_EXTERN int CeedGetJitSourceRoots(Ceed ceed, CeedInt *num_source_roots, const char ***jit_source_roots);
CEED_EXTERN int CeedRestoreJitSourceRoots(Ceed ceed, const char ***jit_source_roots);
CEED_EXTERN int CeedGetRustSourceRoots(Ceed ceed, CeedInt *num_source_roots, const char ***rust_source_roots);
CEED_EXTERN int CeedRestoreRustSourceRoots(Ceed ceed, const char ***rust_source_roots);
CEED_EXTERN int CeedGetJitDefines(Ceed ceed, CeedInt *num_defines, const char ***jit_defines);
CEED_EXTERN int CeedRestoreJitDefines(Ceed ceed, const char ***jit_defines);
/// A vector of `len` entries or more for scratch work, contents undefined: one that was given back, or a new one. The
/// caller gives it back with Restore, which forgets the handle; no array of it and no other reference may be held then.
CEED_EXTERN int CeedGetWorkVector(Ceed ceed, CeedSize len, CeedVector *vec);
CEED_EXTERN int CeedRestoreWorkVector(Ceed ceed, CeedVector *vec);
/// Destroys the work vectors that are shorter than min_len and not in use.
CEED_EXTERN int CeedClearWorkVectors(Ceed ceed, CeedSize min_len);
/// Memory of all work vectors in megabytes (10^6 bytes).
CEED_EXTERN int CeedGetWorkVectorMemoryUsage(Ceed ceed, CeedScalar *usage_mb);
/// @}

/// @name Vectors
/// @{
CEED_EXTERN int CeedVectorHasValidArray(CeedVector vec, bool *has_valid_array);
CEED_EXTERN int CeedVectorHasBorrowedArrayOfType(CeedVector vec, CeedMemType mem_type,
                                                 bool *has_borrowed_array_of_type);
/// Changes whenever the values may have changed; odd while there is a writer.
CEED_EXTERN int CeedVectorGetState(CeedVector vec, uint64_t *state);
CEED_EXTERN int CeedVectorGetData(CeedVector vec, void *data);
CEED_EXTERN int CeedVectorSetData(CeedVector vec, void *data);
CEED_EXTERN int CeedVectorReference(CeedVector vec);
/// @}

/// Kind of a restriction.
typedef enum {
  CEED_RESTRICTION_STANDARD = 1,
  CEED_RESTRICTION_ORIENTED = 2,
  CEED_RESTRICTION_CURL_ORIENTED = 3,
  CEED_RESTRICTION_STRIDED = 4,
  CEED_RESTRICTION_POINTS = 5,
} CeedRestrictionType;

/// @name Restrictions
/// @{
CEED_EXTERN int CeedElemRestrictionGetType(CeedElemRestriction rstr, CeedRestrictionType *rstr_type);
CEED_EXTERN int CeedElemRestrictionIsStrided(CeedElemRestriction rstr, bool *is_strided);
CEED_EXTERN int CeedElemRestrictionIsAtPoints(CeedElemRestriction rstr, bool *is_points);
/// Whether both have the same points in the same elements.
CEED_EXTERN int CeedElemRestrictionAtPointsAreCompatible(CeedElemRestriction rstr_a, CeedElemRestriction rstr_b,
                                                         bool *are_compatible);
/// Strides (node, component, element) as they were given: CEED_STRIDES_BACKEND stays three zeros, and
/// CeedElemRestrictionGetLLayout() gives the numbers they stand for.
CEED_EXTERN int CeedElemRestrictionGetStrides(CeedElemRestriction rstr, CeedInt strides[3]);
CEED_EXTERN int CeedElemRestrictionHasBackendStrides(CeedElemRestriction rstr, bool *has_backend_strides);
/// Read access to the offsets; destroying the restriction before Restore is an error. The tables of blocked restrictions
/// are in blocks and whole, as CeedElementMap (ceed/plugin.h) says.
CEED_EXTERN int CeedElemRestrictionGetOffsets(CeedElemRestriction rstr, CeedMemType mem_type, const CeedInt **offsets);
CEED_EXTERN int CeedElemRestrictionRestoreOffsets(CeedElemRestriction rstr, const CeedInt **offsets);
/// Read access to the signs of an oriented restriction and to the matrices of a curl-oriented one; NULL where it is not
/// one of these.
CEED_EXTERN int CeedElemRestrictionGetOrientations(CeedElemRestriction rstr, CeedMemType mem_type, const bool **orients);
CEED_EXTERN int CeedElemRestrictionRestoreOrientations(CeedElemRestriction rstr, const bool **orients);
CEED_EXTERN int CeedElemRestrictionGetCurlOrientations(CeedElemRestriction rstr, CeedMemType mem_type,
                                                       const CeedInt8 **curl_orients);
CEED_EXTERN int CeedElemRestrictionRestoreCurlOrientations(CeedElemRestriction rstr, const CeedInt8 **curl_orients);
/// Layout (node, component, element) of the L-vector (strided ones) and of the E-vector; {1, 0, 0} for a ragged E-vector
/// at points, where the rest varies: see CeedElemRestrictionGetAtPointsElementOffset().
CEED_EXTERN int CeedElemRestrictionGetLLayout(CeedElemRestriction rstr, CeedInt layout[3]);
CEED_EXTERN int CeedElemRestrictionGetELayout(CeedElemRestriction rstr, CeedInt layout[3]);
/// Where the values of element `elem` start in an E-vector at points.
CEED_EXTERN int CeedElemRestrictionGetAtPointsElementOffset(CeedElemRestriction rstr, CeedInt elem,
                                                            CeedSize *elem_offset);
/// For a backend that lays out vectors otherwise, while it is told of a new restriction (`create` in ceed/plugin.h), and
/// not later: the E-vector; the L-vector where the user left its strides to the backend; the length of an E-vector at
/// points, whose layout may be one for points that are alike in number.
CEED_EXTERN int CeedElemRestrictionSetELayout(CeedElemRestriction rstr, CeedInt layout[3]);
CEED_EXTERN int CeedElemRestrictionSetLLayout(CeedElemRestriction rstr, CeedInt layout[3]);
CEED_EXTERN int CeedElemRestrictionSetAtPointsEVectorSize(CeedElemRestriction rstr, CeedSize e_size);
CEED_EXTERN int CeedElemRestrictionGetData(CeedElemRestriction rstr, void *data);
CEED_EXTERN int CeedElemRestrictionSetData(CeedElemRestriction rstr, void *data);
CEED_EXTERN int CeedElemRestrictionReference(CeedElemRestriction rstr);
/// Floating point operations of one application.
CEED_EXTERN int CeedElemRestrictionGetFlopsEstimate(CeedElemRestriction rstr, CeedTransposeMode t_mode,
                                                    CeedSize *flops);
/// @}

/// Space that a basis spans.
typedef enum {
  CEED_FE_SPACE_H1 = 1,
  CEED_FE_SPACE_HDIV = 2,
  CEED_FE_SPACE_HCURL = 3,
} CeedFESpace;
CEED_EXTERN const char *const CeedFESpaces[];

/// @name Bases
/// @{
/// D = grad_1d interp_1d^+ (pseudoinverse), Q_1d by Q_1d, row-major, which takes values at the quadrature points to
/// derivatives there: D interp_1d = grad_1d. Needs Q_1d >= P_1d and independent columns of interp_1d.
CEED_EXTERN int CeedBasisGetCollocatedGrad(CeedBasis basis, CeedScalar *colo_grad_1d);
/// Q_1d by P_1d matrix, row-major, from values at the nodes to the Chebyshev coefficients (of T_0 ... T_(Q_1d-1)) of
/// the polynomial through the values at the quadrature points.
CEED_EXTERN int CeedBasisGetChebyshevInterp1D(CeedBasis basis, CeedScalar *chebyshev_interp_1d);
/// The 1D basis functions as they are evaluated at arbitrary points: num_coeff by P_1d matrix, row-major, whose entry
/// (k, j) is the coefficient of the Chebyshev polynomial T_k in the function of node j. P_1d rows for Lagrange bases,
/// Q_1d for bases from the user's matrices. The basis keeps it. 0 and NULL where the basis cannot be evaluated there:
/// no tensor product, or Q_1d < P_1d.
CEED_EXTERN int CeedBasisGetChebyshevCoefficients1D(CeedBasis basis, CeedInt *num_coeff,
                                                    const CeedScalar **chebyshev_1d);
CEED_EXTERN int CeedBasisIsTensor(CeedBasis basis, bool *is_tensor);
/// Whether the quadrature points are the nodes: interpolation is the identity.
CEED_EXTERN int CeedBasisIsCollocated(CeedBasis basis, bool *is_collocated);
CEED_EXTERN int CeedBasisGetData(CeedBasis basis, void *data);
CEED_EXTERN int CeedBasisSetData(CeedBasis basis, void *data);
CEED_EXTERN int CeedBasisReference(CeedBasis basis);
/// Values at a point for one component: 1 for CEED_EVAL_NONE, CEED_EVAL_WEIGHT and CEED_EVAL_DIV; CEED_EVAL_INTERP: 1
/// in H^1, else dim; CEED_EVAL_GRAD: dim; CEED_EVAL_CURL: 3 in three dimensions, else 1. An error for a mode that the
/// space does not have; CEED_BASIS_NONE has no derivatives.
CEED_EXTERN int CeedBasisGetNumQuadratureComponents(CeedBasis basis, CeedEvalMode eval_mode, CeedInt *q_comp);
/// CEED_EVAL_GRAD in H^1, CEED_EVAL_DIV in H(div), CEED_EVAL_CURL in H(curl); CEED_EVAL_NONE where the basis was made
/// without a matrix for it.
CEED_EXTERN int CeedBasisGetDerivativeMode(CeedBasis basis, CeedEvalMode *eval_mode);
/// The basis as a matrix, q_comp by Q by num_nodes, row-major, in any mode but CEED_EVAL_WEIGHT; the basis keeps it. For
/// CEED_EVAL_NONE that is `identity`, which else may be NULL.
CEED_EXTERN int CeedOperatorGetBasisPointer(CeedBasis basis, CeedEvalMode eval_mode, const CeedScalar *identity,
                                            const CeedScalar **basis_ptr);
/// Floating point operations for one element, sum-factorised for tensor products; at points for num_points points.
CEED_EXTERN int CeedBasisGetFlopsEstimate(CeedBasis basis, CeedTransposeMode t_mode, CeedEvalMode eval_mode,
                                          bool is_at_points, CeedInt num_points, CeedSize *flops);
CEED_EXTERN int CeedBasisGetFESpace(CeedBasis basis, CeedFESpace *fe_space);
CEED_EXTERN int CeedBasisGetTopologyDimension(CeedElemTopology topo, CeedInt *dim);
/// Values and derivatives of all nodes' basis functions at a reference point: interp[n], grad[d*num_nodes + n]; either
/// may be NULL. Error as CeedBasisApplyAtPoints().
CEED_EXTERN int CeedBasisEvaluateAtPoint(CeedBasis basis, const CeedScalar *x_ref, CeedScalar *interp,
                                         CeedScalar *grad);
/// @}

/// @name Dense algebra on the host
/// Small row-major matrices. Arrays of a call do not overlap unless said otherwise.
/// @{
/// C = A B for A m by kk, B kk by n.
CEED_EXTERN int CeedMatrixMatrixMultiply(Ceed ceed, const CeedScalar *mat_A, const CeedScalar *mat_B,
                                         CeedScalar *mat_C, CeedInt m, CeedInt n, CeedInt kk);
/// A = Q R for A m by n with m >= n, in place: R on and above the diagonal; below it, column k holds v_k from row k+1 on,
/// and v_k is 1 in row k, 0 above. Q = H_0 ... H_(n-1) with H_k = I - tau_k v_k v_k^T; tau has n entries.
CEED_EXTERN int CeedQRFactorization(Ceed ceed, CeedScalar *mat, CeedScalar *tau, CeedInt m, CeedInt n);
/// A = Q A, or Q^T A for CEED_TRANSPOSE, with entry (i, j) of A (m by n) at mat_A[i*row + j*col] and Q the product of k
/// reflectors in mat_Q (m by k) and tau as CeedQRFactorization() gives them.
CEED_EXTERN int CeedHouseholderApplyQ(CeedScalar *mat_A, const CeedScalar *mat_Q, const CeedScalar *tau,
                                      CeedTransposeMode t_mode, CeedInt m, CeedInt n, CeedInt k, CeedInt row,
                                      CeedInt col);
/// Moore-Penrose inverse, n by m, of an m by n matrix with m >= n and independent columns.
CEED_EXTERN int CeedMatrixPseudoinverse(Ceed ceed, const CeedScalar *mat, CeedInt m, CeedInt n, CeedScalar *mat_pinv);
/// A = V diag(lambda) V^T for A n by n, symmetric: overwrites it with V, whose columns are orthonormal. lambda ascends.
CEED_EXTERN int CeedSymmetricSchurDecomposition(Ceed ceed, CeedScalar *mat, CeedScalar *lambda, CeedInt n);
/// X^T A X = diag(lambda), X^T B X = I for A symmetric, B symmetric positive definite. Both stay as they are; lambda
/// ascends.
CEED_EXTERN int CeedSimultaneousDiagonalization(Ceed ceed, CeedScalar *mat_A, CeedScalar *mat_B, CeedScalar *x,
                                                CeedScalar *lambda, CeedInt n);
/// @}

/// @name QFunctions and contexts
/// @{
CEED_EXTERN int CeedQFunctionRegister(const char *name, const char *source, CeedInt vec_length, CeedQFunctionUser f,
                                      int (*init)(Ceed, const char *, CeedQFunction));
CEED_EXTERN int CeedQFunctionGetVectorLength(CeedQFunction qf, CeedInt *vec_length);
CEED_EXTERN int CeedQFunctionGetNumArgs(CeedQFunction qf, CeedInt *num_input_fields, CeedInt *num_output_fields);
CEED_EXTERN int CeedQFunctionGetKernelName(CeedQFunction qf, const char **kernel_name);
CEED_EXTERN int CeedQFunctionGetName(CeedQFunction qf, const char **name);
/// File of the function's source; NULL where none was given.
CEED_EXTERN int CeedQFunctionGetSourcePath(CeedQFunction qf, const char **source_path);
CEED_EXTERN int CeedQFunctionGetUserFunction(CeedQFunction qf, CeedQFunctionUser *f);
/// *ctx is NULL where the function has none.
CEED_EXTERN int CeedQFunctionGetContext(CeedQFunction qf, CeedQFunctionContext *ctx);
/// Data of the context (*data is NULL where there is none) with the access that the function was promised.
CEED_EXTERN int CeedQFunctionGetContextData(CeedQFunction qf, CeedMemType mem_type, void *data);
CEED_EXTERN int CeedQFunctionRestoreContextData(CeedQFunction qf, void *data);
/// The same for the context that the user set: where a QFunction calls a subroutine in Fortran, its own context says which.
CEED_EXTERN int CeedQFunctionGetInnerContext(CeedQFunction qf, CeedQFunctionContext *ctx);
CEED_EXTERN int CeedQFunctionGetInnerContextData(CeedQFunction qf, CeedMemType mem_type, void *data);
CEED_EXTERN int CeedQFunctionRestoreInnerContextData(CeedQFunction qf, void *data);
CEED_EXTERN int CeedQFunctionIsIdentity(CeedQFunction qf, bool *is_identity);
CEED_EXTERN int CeedQFunctionIsContextWritable(CeedQFunction qf, bool *is_writable);
CEED_EXTERN int CeedQFunctionGetData(CeedQFunction qf, void *data);
CEED_EXTERN int CeedQFunctionSetData(CeedQFunction qf, void *data);
CEED_EXTERN int CeedQFunctionIsImmutable(CeedQFunction qf, bool *is_immutable);
CEED_EXTERN int CeedQFunctionSetImmutable(CeedQFunction qf);
CEED_EXTERN int CeedQFunctionReference(CeedQFunction qf);
CEED_EXTERN int CeedQFunctionGetFlopsEstimate(CeedQFunction qf, CeedSize *flops);
CEED_EXTERN int CeedQFunctionContextGetCeed(CeedQFunctionContext ctx, Ceed *ceed);
CEED_EXTERN Ceed CeedQFunctionContextReturnCeed(CeedQFunctionContext ctx);
CEED_EXTERN int CeedQFunctionContextHasValidData(CeedQFunctionContext ctx, bool *has_valid_data);
CEED_EXTERN int CeedQFunctionContextHasBorrowedDataOfType(CeedQFunctionContext ctx, CeedMemType mem_type,
                                                          bool *has_borrowed_data_of_type);
CEED_EXTERN int CeedQFunctionContextGetState(CeedQFunctionContext ctx, uint64_t *state);
/// *field_label is NULL where no field has that name.
CEED_EXTERN int CeedQFunctionContextGetFieldLabel(CeedQFunctionContext ctx, const char *field_name,
                                                  CeedContextFieldLabel *field_label);
CEED_EXTERN int CeedQFunctionContextSetDouble(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                              double *values);
CEED_EXTERN int CeedQFunctionContextGetDoubleRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                  size_t *num_values, const double **values);
CEED_EXTERN int CeedQFunctionContextRestoreDoubleRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                      const double **values);
CEED_EXTERN int CeedQFunctionContextSetInt32(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                             int32_t *values);
CEED_EXTERN int CeedQFunctionContextGetInt32Read(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                 size_t *num_values, const int32_t **values);
CEED_EXTERN int CeedQFunctionContextRestoreInt32Read(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                     const int32_t **values);
CEED_EXTERN int CeedQFunctionContextSetBoolean(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                               bool *values);
CEED_EXTERN int CeedQFunctionContextGetBooleanRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                   size_t *num_values, const bool **values);
CEED_EXTERN int CeedQFunctionContextRestoreBooleanRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                       const bool **values);
CEED_EXTERN int CeedQFunctionContextReference(CeedQFunctionContext ctx);
/// @}

/// @name Operators
/// @{
/// The basis and restriction of the active field; an error where there are several.
CEED_EXTERN int CeedOperatorGetActiveBasis(CeedOperator op, CeedBasis *active_basis);
CEED_EXTERN int CeedOperatorGetActiveBases(CeedOperator op, CeedBasis *active_input_basis,
                                           CeedBasis *active_output_basis);
CEED_EXTERN int CeedOperatorGetActiveElemRestriction(CeedOperator op, CeedElemRestriction *active_rstr);
CEED_EXTERN int CeedOperatorGetActiveElemRestrictions(CeedOperator op, CeedElemRestriction *active_input_rstr,
                                                      CeedElemRestriction *active_output_rstr);
CEED_EXTERN int CeedOperatorGetNumArgs(CeedOperator op, CeedInt *num_args);
CEED_EXTERN int CeedOperatorHasTensorBases(CeedOperator op, bool *has_tensor_bases);
CEED_EXTERN int CeedOperatorIsImmutable(CeedOperator op, bool *is_immutable);
CEED_EXTERN int CeedOperatorIsSetupDone(CeedOperator op, bool *is_setup_done);
CEED_EXTERN int CeedOperatorGetQFunction(CeedOperator op, CeedQFunction *qf);
CEED_EXTERN int CeedOperatorIsComposite(CeedOperator op, bool *is_composite);
CEED_EXTERN int CeedOperatorGetData(CeedOperator op, void *data);
CEED_EXTERN int CeedOperatorSetData(CeedOperator op, void *data);
CEED_EXTERN int CeedOperatorReference(CeedOperator op);
/// @}

#endif
