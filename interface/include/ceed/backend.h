/// @file
/// What backends, and programs that look deeper, may ask of objects. The contract of ceed.h holds here, too.
///
/// Each object has a pointer for its backend, which the core keeps and does not look at:
/// - `data`: the pointer, where it is set; where it is asked for, the address of a pointer
///
/// Flops count each multiplication and each addition.
#ifndef CEED_BACKEND_H
#define CEED_BACKEND_H

#include <ceed.h>
#include <limits.h>

/// Keeps the compiler from warning of what is not used.
#define CEED_UNUSED __attribute__((unused))
/// A buffer of so many characters holds every resource.
#define CEED_MAX_RESOURCE_LEN 1024
/// Priority of a backend that is taken only where what is asked for begins no other one's name, be that available or
/// not.
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

/// @defgroup BackendCeed Of a Ceed
/// Errors: CEED_ERROR_MINOR: an argument is NULL.
/// @{

/// Whether CEED_DEBUG or DEBUG is set in the environment. Never fails; `ceed` may be NULL.
CEED_EXTERN int CeedIsDebug(Ceed ceed, bool *is_debug);
/// What stands before the first `delineator` in a `resource`, or all of it; the caller frees *resource_root with
/// free(). `ceed`, to which errors are told, may be NULL.
CEED_EXTERN int CeedGetResourceRoot(Ceed ceed, const char *resource, const char *delineator, char **resource_root);
/// Pointer of the backend, set by its init.
CEED_EXTERN int CeedGetData(Ceed ceed, void *data);
/// Sets the pointer of the backend.
CEED_EXTERN int CeedSetData(Ceed ceed, void *data);
/// Counts one reference more.
CEED_EXTERN int CeedReference(Ceed ceed);
/// Says whether the same operator applied twice gives the same bits (`is_deterministic`).
CEED_EXTERN int CeedSetDeterministic(Ceed ceed, bool is_deterministic);
/// Folders given by CeedAddJitSourceRoot(), `num_source_roots` of them; the caller frees the list, not its texts, with
/// CeedRestoreJitSourceRoots().
CEED_EXTERN int CeedGetJitSourceRoots(Ceed ceed, CeedInt *num_source_roots, const char ***jit_source_roots);
/// Frees the list *jit_source_roots and sets it to NULL. Never fails.
CEED_EXTERN int CeedRestoreJitSourceRoots(Ceed ceed, const char ***jit_source_roots);
/// Folders given by CeedAddRustSourceRoot(), `num_source_roots` of them; the caller frees the list, not its texts, with
/// CeedRestoreRustSourceRoots().
CEED_EXTERN int CeedGetRustSourceRoots(Ceed ceed, CeedInt *num_source_roots, const char ***rust_source_roots);
/// Frees the list *rust_source_roots and sets it to NULL. Never fails.
CEED_EXTERN int CeedRestoreRustSourceRoots(Ceed ceed, const char ***rust_source_roots);
/// What CeedAddJitDefine() added, `num_defines` of them; the caller frees the list, not its texts, with
/// CeedRestoreJitDefines().
CEED_EXTERN int CeedGetJitDefines(Ceed ceed, CeedInt *num_defines, const char ***jit_defines);
/// Frees the list *jit_defines and sets it to NULL. Never fails.
CEED_EXTERN int CeedRestoreJitDefines(Ceed ceed, const char ***jit_defines);
/// A vector of `len` entries or more for scratch work, contents undefined: one that was given back, or a new one. The
/// caller gives it back with CeedRestoreWorkVector(). Error CEED_ERROR_DIMENSION: `len` is negative.
CEED_EXTERN int CeedGetWorkVector(Ceed ceed, CeedSize len, CeedVector *vec);
/// Takes *vec back and sets it to NULL. Errors: CEED_ERROR_ACCESS: an array of it or another reference is held;
/// CEED_ERROR_MAJOR: it is no work vector of this Ceed, or was given back.
CEED_EXTERN int CeedRestoreWorkVector(Ceed ceed, CeedVector *vec);
/// Destroys the work vectors that are shorter than `min_len` and not in use.
CEED_EXTERN int CeedClearWorkVectors(Ceed ceed, CeedSize min_len);
/// Memory of all work vectors in megabytes (10^6 bytes).
CEED_EXTERN int CeedGetWorkVectorMemoryUsage(Ceed ceed, CeedScalar *usage_mb);
/// @}

/// @defgroup BackendVector Of a vector
/// Errors: CEED_ERROR_INCOMPATIBLE: CEED_VECTOR_ACTIVE or CEED_VECTOR_NONE; CEED_ERROR_MINOR: an unknown type of
/// memory.
/// @{

/// Whether the vector holds values.
CEED_EXTERN int CeedVectorHasValidArray(CeedVector vec, bool *has_valid_array);
/// Whether it uses an array that the user lent, in this memory.
CEED_EXTERN int CeedVectorHasBorrowedArrayOfType(CeedVector vec, CeedMemType mem_type,
                                                 bool *has_borrowed_array_of_type);
/// Changes whenever the values may have changed; odd while there is a writer.
CEED_EXTERN int CeedVectorGetState(CeedVector vec, uint64_t *state);
/// The pointer of the backend.
CEED_EXTERN int CeedVectorGetData(CeedVector vec, void *data);
/// Sets the pointer of the backend.
CEED_EXTERN int CeedVectorSetData(CeedVector vec, void *data);
/// Counts one reference more.
CEED_EXTERN int CeedVectorReference(CeedVector vec);
/// @}

/// @defgroup BackendRestriction Of a restriction
/// Errors:
/// - CEED_ERROR_INCOMPATIBLE: CEED_ELEMRESTRICTION_NONE, or one that has no points where they are asked for.
/// - CEED_ERROR_MINOR: it has no strides where they are asked for; an unknown type of memory.
/// - CEED_ERROR_DIMENSION: there is no such element; a size is too small.
/// - CEED_ERROR_UNSUPPORTED: tables on a device.
/// - CEED_ERROR_ACCESS: what is restored was not granted; a layout is set after the restriction was made.
/// @{

/// Kind of a restriction.
typedef enum {
  CEED_RESTRICTION_STANDARD = 1,       ///< an offset for each node
  CEED_RESTRICTION_ORIENTED = 2,       ///< and a sign
  CEED_RESTRICTION_CURL_ORIENTED = 3,  ///< and a tridiagonal matrix for each element
  CEED_RESTRICTION_STRIDED = 4,        ///< strides, without offsets
  CEED_RESTRICTION_POINTS = 5,         ///< at points, their number an element's own
} CeedRestrictionType;

/// Kind of the restriction; copies without orientation are of the standard type.
CEED_EXTERN int CeedElemRestrictionGetType(CeedElemRestriction rstr, CeedRestrictionType *rstr_type);
/// Whether it has strides in place of offsets.
CEED_EXTERN int CeedElemRestrictionIsStrided(CeedElemRestriction rstr, bool *is_strided);
/// Whether it was made by CeedElemRestrictionCreateAtPoints().
CEED_EXTERN int CeedElemRestrictionIsAtPoints(CeedElemRestriction rstr, bool *is_points);
/// Whether `rstr_a` and `rstr_b` have the same points in the same elements (`are_compatible`).
CEED_EXTERN int CeedElemRestrictionAtPointsAreCompatible(CeedElemRestriction rstr_a, CeedElemRestriction rstr_b,
                                                         bool *are_compatible);
/// Strides (node, component, element) as they were given: CEED_STRIDES_BACKEND stays three zeros, and
/// CeedElemRestrictionGetLLayout() gives the numbers they stand for.
CEED_EXTERN int CeedElemRestrictionGetStrides(CeedElemRestriction rstr, CeedInt strides[3]);
/// Whether the user left the strides to the backend.
CEED_EXTERN int CeedElemRestrictionHasBackendStrides(CeedElemRestriction rstr, bool *has_backend_strides);
/// Read access to the offsets, an entry for each node of each element (at points: starts, then points), which the
/// restriction keeps, until CeedElemRestrictionRestoreOffsets(); destroying it before is an error. The tables of
/// blocked restrictions are in blocks and whole, as CeedElementMap (ceed/plugin.h) says. NULL for strided ones.
CEED_EXTERN int CeedElemRestrictionGetOffsets(CeedElemRestriction rstr, CeedMemType mem_type, const CeedInt **offsets);
/// Ends a read access, and sets *offsets to NULL.
CEED_EXTERN int CeedElemRestrictionRestoreOffsets(CeedElemRestriction rstr, const CeedInt **offsets);
/// Read access to the orientations of an oriented restriction, an entry for each node of each element, which it keeps;
/// NULL where it is another.
CEED_EXTERN int CeedElemRestrictionGetOrientations(CeedElemRestriction rstr, CeedMemType mem_type, const bool **orients);
/// Ends a read access, and sets *orients to NULL.
CEED_EXTERN int CeedElemRestrictionRestoreOrientations(CeedElemRestriction rstr, const bool **orients);
/// Read access to the matrices of a curl-oriented restriction, three entries for each node of each element, which it
/// keeps; NULL where it is another.
CEED_EXTERN int CeedElemRestrictionGetCurlOrientations(CeedElemRestriction rstr, CeedMemType mem_type,
                                                       const CeedInt8 **curl_orients);
/// Ends a read access, and sets *curl_orients to NULL.
CEED_EXTERN int CeedElemRestrictionRestoreCurlOrientations(CeedElemRestriction rstr, const CeedInt8 **curl_orients);
/// Layout (node, component, element) of the L-vector of a strided restriction.
CEED_EXTERN int CeedElemRestrictionGetLLayout(CeedElemRestriction rstr, CeedInt layout[3]);
/// Layout (node, component, element) of the E-vector; {1, 0, 0} for a ragged one at points, where the rest varies: see
/// CeedElemRestrictionGetAtPointsElementOffset().
CEED_EXTERN int CeedElemRestrictionGetELayout(CeedElemRestriction rstr, CeedInt layout[3]);
/// Where the values of element `elem` start in an E-vector at points.
CEED_EXTERN int CeedElemRestrictionGetAtPointsElementOffset(CeedElemRestriction rstr, CeedInt elem,
                                                            CeedSize *elem_offset);
/// For a backend that lays out E-vectors otherwise: sets their `layout` (node, component, element) while the backend is
/// told of a new restriction (`create` in ceed/plugin.h), and not later.
CEED_EXTERN int CeedElemRestrictionSetELayout(CeedElemRestriction rstr, CeedInt layout[3]);
/// The same for the `layout` of the L-vector, where the user left its strides to the backend; else CEED_ERROR_MINOR.
CEED_EXTERN int CeedElemRestrictionSetLLayout(CeedElemRestriction rstr, CeedInt layout[3]);
/// The same for the length `e_size` of an E-vector at points, whose layout may be one for points that are alike in
/// number; at least what the points of all elements need.
CEED_EXTERN int CeedElemRestrictionSetAtPointsEVectorSize(CeedElemRestriction rstr, CeedSize e_size);
/// The pointer of the backend.
CEED_EXTERN int CeedElemRestrictionGetData(CeedElemRestriction rstr, void *data);
/// Sets the pointer of the backend.
CEED_EXTERN int CeedElemRestrictionSetData(CeedElemRestriction rstr, void *data);
/// Counts one reference more.
CEED_EXTERN int CeedElemRestrictionReference(CeedElemRestriction rstr);
/// Floating point operations of one application.
CEED_EXTERN int CeedElemRestrictionGetFlopsEstimate(CeedElemRestriction rstr, CeedTransposeMode t_mode,
                                                    CeedSize *flops);
/// @}

/// @defgroup BackendBasis Of a basis
/// Errors:
/// - CEED_ERROR_INCOMPATIBLE: CEED_BASIS_NONE, where matrices are needed.
/// - CEED_ERROR_MINOR: a tensor product is needed; columns of interp_1d depend on each other.
/// - CEED_ERROR_DIMENSION: fewer quadrature points than nodes, or a negative number of points.
/// - CEED_ERROR_UNSUPPORTED: a mode that the space or the basis does not have, points that a basis cannot be evaluated
///   at.
/// @{

/// Space that a basis spans.
typedef enum {
  CEED_FE_SPACE_H1 = 1,     ///< numbers with a gradient
  CEED_FE_SPACE_HDIV = 2,   ///< vectors with a divergence
  CEED_FE_SPACE_HCURL = 3,  ///< vectors with a curl
} CeedFESpace;
/// Names of CeedFESpace, indexed by value.
CEED_EXTERN const char *const CeedFESpaces[];

/// `colo_grad_1d` = D = grad_1d interp_1d^+ (pseudoinverse), Q_1d by Q_1d, row-major, which takes values at the
/// quadrature points to derivatives there: D interp_1d = grad_1d. Needs Q_1d >= P_1d and independent columns of
/// interp_1d.
CEED_EXTERN int CeedBasisGetCollocatedGrad(CeedBasis basis, CeedScalar *colo_grad_1d);
/// Q_1d by P_1d matrix, row-major, from values at the nodes to the Chebyshev coefficients (of T_0 ... T_(Q_1d-1)) of
/// the polynomial through the values at the quadrature points.
CEED_EXTERN int CeedBasisGetChebyshevInterp1D(CeedBasis basis, CeedScalar *chebyshev_interp_1d);
/// The 1D basis functions as they are evaluated at arbitrary points: num_coeff by P_1d matrix, row-major, whose entry
/// (k, j) is the coefficient of the Chebyshev polynomial T_k in the function of node j. P_1d rows for Lagrange bases,
/// Q_1d for bases from the user's matrices. The basis keeps it. `num_coeff` may be NULL. 0 and NULL where the basis
/// cannot be evaluated there: no tensor product, or Q_1d < P_1d.
CEED_EXTERN int CeedBasisGetChebyshevCoefficients1D(CeedBasis basis, CeedInt *num_coeff,
                                                    const CeedScalar **chebyshev_1d);
/// Whether it is a tensor product of one dimension.
CEED_EXTERN int CeedBasisIsTensor(CeedBasis basis, bool *is_tensor);
/// Whether the quadrature points are the nodes: interpolation is the identity.
CEED_EXTERN int CeedBasisIsCollocated(CeedBasis basis, bool *is_collocated);
/// The pointer of the backend.
CEED_EXTERN int CeedBasisGetData(CeedBasis basis, void *data);
/// Sets the pointer of the backend.
CEED_EXTERN int CeedBasisSetData(CeedBasis basis, void *data);
/// Counts one reference more.
CEED_EXTERN int CeedBasisReference(CeedBasis basis);
/// Values at a point for one component: 1 for CEED_EVAL_NONE, CEED_EVAL_WEIGHT and CEED_EVAL_DIV; CEED_EVAL_INTERP: 1
/// in H^1, else dim; CEED_EVAL_GRAD: dim; CEED_EVAL_CURL: 3 in three dimensions, else 1. An error for a mode that the
/// space does not have; CEED_BASIS_NONE has no derivatives.
CEED_EXTERN int CeedBasisGetNumQuadratureComponents(CeedBasis basis, CeedEvalMode eval_mode, CeedInt *q_comp);
/// CEED_EVAL_GRAD in H^1, CEED_EVAL_DIV in H(div), CEED_EVAL_CURL in H(curl); CEED_EVAL_NONE where the basis was made
/// without a matrix for it.
CEED_EXTERN int CeedBasisGetDerivativeMode(CeedBasis basis, CeedEvalMode *eval_mode);
/// The basis as a matrix, q_comp by Q by num_nodes, row-major, in any mode but CEED_EVAL_WEIGHT; the basis keeps it.
/// For CEED_EVAL_NONE that is `identity`, which else may be NULL.
CEED_EXTERN int CeedOperatorGetBasisPointer(CeedBasis basis, CeedEvalMode eval_mode, const CeedScalar *identity,
                                            const CeedScalar **basis_ptr);
/// Floating point operations for one element, sum-factorised for tensor products; at points (`is_at_points`) for
/// num_points points.
CEED_EXTERN int CeedBasisGetFlopsEstimate(CeedBasis basis, CeedTransposeMode t_mode, CeedEvalMode eval_mode,
                                          bool is_at_points, CeedInt num_points, CeedSize *flops);
/// Space that it spans.
CEED_EXTERN int CeedBasisGetFESpace(CeedBasis basis, CeedFESpace *fe_space);
/// Dimension of the element of shape `topo`.
CEED_EXTERN int CeedBasisGetTopologyDimension(CeedElemTopology topo, CeedInt *dim);
/// Values and derivatives of all nodes' basis functions at a reference point x_ref (dim coordinates): interp[n],
/// grad[d*num_nodes + n]; either may be NULL. Error as CeedBasisApplyAtPoints().
CEED_EXTERN int CeedBasisEvaluateAtPoint(CeedBasis basis, const CeedScalar *x_ref, CeedScalar *interp,
                                         CeedScalar *grad);
/// @}

/// @defgroup BackendDense Dense algebra on the host
/// Small row-major matrices. Arrays of a call do not overlap unless said otherwise. The Ceed, to which errors are told,
/// may be NULL. Errors:
/// - CEED_ERROR_DIMENSION: a size is less than 1, or there are fewer rows than columns.
/// - CEED_ERROR_MINOR: columns depend on each other, an entry is not finite, B is not positive definite.
/// @{

/// C = A B for mat_A m by kk, mat_B kk by n, mat_C m by n.
CEED_EXTERN int CeedMatrixMatrixMultiply(Ceed ceed, const CeedScalar *mat_A, const CeedScalar *mat_B,
                                         CeedScalar *mat_C, CeedInt m, CeedInt n, CeedInt kk);
/// A = Q R for A, `mat`, m by n with m >= n, in place: R on and above the diagonal; below it, column k holds v_k from
/// row k+1 on, and v_k is 1 in row k, 0 above. Q = H_0 ... H_(n-1) with H_k = I - tau_k v_k v_k^T; tau has n entries.
CEED_EXTERN int CeedQRFactorization(Ceed ceed, CeedScalar *mat, CeedScalar *tau, CeedInt m, CeedInt n);
/// A = Q A, or Q^T A for CEED_TRANSPOSE, with entry (i, j) of A (m by n) at mat_A[i*row + j*col] and Q the product of k
/// reflectors in mat_Q (m by k) and tau as CeedQRFactorization() gives them. Error CEED_ERROR_UNSUPPORTED: t_mode is
/// none.
CEED_EXTERN int CeedHouseholderApplyQ(CeedScalar *mat_A, const CeedScalar *mat_Q, const CeedScalar *tau,
                                      CeedTransposeMode t_mode, CeedInt m, CeedInt n, CeedInt k, CeedInt row,
                                      CeedInt col);
/// Moore-Penrose inverse `mat_pinv`, n by m, of an m by n matrix `mat` with m >= n and independent columns.
CEED_EXTERN int CeedMatrixPseudoinverse(Ceed ceed, const CeedScalar *mat, CeedInt m, CeedInt n, CeedScalar *mat_pinv);
/// A = V diag(lambda) V^T for A, `mat`, n by n, symmetric: overwrites it with V, whose columns are orthonormal. lambda
/// ascends.
CEED_EXTERN int CeedSymmetricSchurDecomposition(Ceed ceed, CeedScalar *mat, CeedScalar *lambda, CeedInt n);
/// X^T A X = diag(lambda), X^T B X = I for mat_A symmetric, mat_B symmetric positive definite, n by n. Both stay as
/// they are; X (`x`, n by n) and lambda, which ascends, come out.
CEED_EXTERN int CeedSimultaneousDiagonalization(Ceed ceed, CeedScalar *mat_A, CeedScalar *mat_B, CeedScalar *x,
                                                CeedScalar *lambda, CeedInt n);
/// @}

/// @defgroup BackendQFunction Of a QFunction and of a context
/// Errors of contexts are those of ceed.h:
/// - CEED_ERROR_ACCESS: the data are in use, or were not.
/// - CEED_ERROR_INCOMPLETE: there are no data.
/// - CEED_ERROR_DIMENSION: a field does not lie in the data.
/// - CEED_ERROR_MINOR: an argument is NULL, or no value of its enumeration.
/// - CEED_ERROR_UNSUPPORTED: the data of CEED_MEM_DEVICE; a label of another object or type.
/// - CEED_ERROR_INCOMPATIBLE: the QFunction is CEED_QFUNCTION_NONE.
///
/// - `field_label`: a label of this context
/// @{

/// Adds a QFunction to the gallery, in place of one with this `name`: `source`, `vec_length` and `f` as in
/// CeedQFunctionCreateInterior(); `init` adds the fields, and is called with the new QFunction. The texts are copied.
CEED_EXTERN int CeedQFunctionRegister(const char *name, const char *source, CeedInt vec_length, CeedQFunctionUser f,
                                      int (*init)(Ceed, const char *, CeedQFunction));
/// What the number of points is a multiple of.
CEED_EXTERN int CeedQFunctionGetVectorLength(CeedQFunction qf, CeedInt *vec_length);
/// Numbers of fields; `num_input_fields` and `num_output_fields` may be NULL. Unlike CeedQFunctionGetFields() it lets
/// more be added.
CEED_EXTERN int CeedQFunctionGetNumArgs(CeedQFunction qf, CeedInt *num_input_fields, CeedInt *num_output_fields);
/// Name of the function, what follows the colon of the source.
CEED_EXTERN int CeedQFunctionGetKernelName(CeedQFunction qf, const char **kernel_name);
/// Name in the gallery, else that of the function.
CEED_EXTERN int CeedQFunctionGetName(CeedQFunction qf, const char **name);
/// File of the function's source; NULL where none was given.
CEED_EXTERN int CeedQFunctionGetSourcePath(CeedQFunction qf, const char **source_path);
/// The function itself.
CEED_EXTERN int CeedQFunctionGetUserFunction(CeedQFunction qf, CeedQFunctionUser *f);
/// Context of the function, counted; *ctx is NULL where it has none.
CEED_EXTERN int CeedQFunctionGetContext(CeedQFunction qf, CeedQFunctionContext *ctx);
/// Data of the context (*data is NULL where there is none) with the access that the function was promised, until
/// CeedQFunctionRestoreContextData().
CEED_EXTERN int CeedQFunctionGetContextData(CeedQFunction qf, CeedMemType mem_type, void *data);
/// Ends the access.
CEED_EXTERN int CeedQFunctionRestoreContextData(CeedQFunction qf, void *data);
/// The context that the user set, counted: where a QFunction calls a subroutine in Fortran, its own context says which,
/// and holds the user's. NULL where there is none.
CEED_EXTERN int CeedQFunctionGetInnerContext(CeedQFunction qf, CeedQFunctionContext *ctx);
/// CeedQFunctionGetContextData() of that context.
CEED_EXTERN int CeedQFunctionGetInnerContextData(CeedQFunction qf, CeedMemType mem_type, void *data);
/// Ends the access.
CEED_EXTERN int CeedQFunctionRestoreInnerContextData(CeedQFunction qf, void *data);
/// Whether it was made by CeedQFunctionCreateIdentity().
CEED_EXTERN int CeedQFunctionIsIdentity(CeedQFunction qf, bool *is_identity);
/// What CeedQFunctionSetContextWritable() said, or the default.
CEED_EXTERN int CeedQFunctionIsContextWritable(CeedQFunction qf, bool *is_writable);
/// The pointer of the backend.
CEED_EXTERN int CeedQFunctionGetData(CeedQFunction qf, void *data);
/// Sets the pointer of the backend.
CEED_EXTERN int CeedQFunctionSetData(CeedQFunction qf, void *data);
/// Whether it takes no more fields.
CEED_EXTERN int CeedQFunctionIsImmutable(CeedQFunction qf, bool *is_immutable);
/// From now on it takes no more fields.
CEED_EXTERN int CeedQFunctionSetImmutable(CeedQFunction qf);
/// Counts one reference more.
CEED_EXTERN int CeedQFunctionReference(CeedQFunction qf);
/// What CeedQFunctionSetUserFlopsEstimate() said. Error CEED_ERROR_INCOMPLETE: nothing.
CEED_EXTERN int CeedQFunctionGetFlopsEstimate(CeedQFunction qf, CeedSize *flops);
/// CeedObjectGetCeed() of a context.
CEED_EXTERN int CeedQFunctionContextGetCeed(CeedQFunctionContext ctx, Ceed *ceed);
/// CeedObjectReturnCeed() of a context: not counted.
CEED_EXTERN Ceed CeedQFunctionContextReturnCeed(CeedQFunctionContext ctx);
/// Whether it has data.
CEED_EXTERN int CeedQFunctionContextHasValidData(CeedQFunctionContext ctx, bool *has_valid_data);
/// Whether it uses data that the user lent, in this memory.
CEED_EXTERN int CeedQFunctionContextHasBorrowedDataOfType(CeedQFunctionContext ctx, CeedMemType mem_type,
                                                          bool *has_borrowed_data_of_type);
/// Changes whenever the data may have changed; odd while there is a writer.
CEED_EXTERN int CeedQFunctionContextGetState(CeedQFunctionContext ctx, uint64_t *state);
/// The label of the field `field_name`, which the context keeps; NULL where there is none.
CEED_EXTERN int CeedQFunctionContextGetFieldLabel(CeedQFunctionContext ctx, const char *field_name,
                                                  CeedContextFieldLabel *field_label);
/// Sets a field of double to as many `values` as are registered; they are copied.
CEED_EXTERN int CeedQFunctionContextSetDouble(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                              double *values);
/// Read access to the `num_values` values in *values (double), which belong to the context, until they are restored.
/// num_values may be NULL.
CEED_EXTERN int CeedQFunctionContextGetDoubleRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                  size_t *num_values, const double **values);
/// Ends the access, and sets *values to NULL; `values` may be NULL.
CEED_EXTERN int CeedQFunctionContextRestoreDoubleRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                      const double **values);
/// Sets a field of int32_t to as many `values` as are registered; they are copied.
CEED_EXTERN int CeedQFunctionContextSetInt32(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                             int32_t *values);
/// Read access to the `num_values` values in *values (int32_t), which belong to the context, until they are restored.
/// num_values may be NULL.
CEED_EXTERN int CeedQFunctionContextGetInt32Read(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                 size_t *num_values, const int32_t **values);
/// Ends the access, and sets *values to NULL; `values` may be NULL.
CEED_EXTERN int CeedQFunctionContextRestoreInt32Read(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                     const int32_t **values);
/// Sets a field of bool to as many `values` as are registered; they are copied.
CEED_EXTERN int CeedQFunctionContextSetBoolean(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                               bool *values);
/// Read access to the `num_values` values in *values (bool), which belong to the context, until they are restored.
/// num_values may be NULL.
CEED_EXTERN int CeedQFunctionContextGetBooleanRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                   size_t *num_values, const bool **values);
/// Ends the access, and sets *values to NULL; `values` may be NULL.
CEED_EXTERN int CeedQFunctionContextRestoreBooleanRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label,
                                                       const bool **values);
/// Counts one reference more.
CEED_EXTERN int CeedQFunctionContextReference(CeedQFunctionContext ctx);
/// @}

/// @defgroup BackendOperator Of an operator
/// Errors: CEED_ERROR_MINOR: it is composite, or has several different active objects of the kind;
/// CEED_ERROR_INCOMPLETE: it has none.
/// @{

/// The basis of the active inputs, counted.
CEED_EXTERN int CeedOperatorGetActiveBasis(CeedOperator op, CeedBasis *active_basis);
/// Those of the active inputs and outputs, `active_input_basis` and `active_output_basis`, counted; either may be NULL.
CEED_EXTERN int CeedOperatorGetActiveBases(CeedOperator op, CeedBasis *active_input_basis,
                                           CeedBasis *active_output_basis);
/// The restriction of the active inputs, counted.
CEED_EXTERN int CeedOperatorGetActiveElemRestriction(CeedOperator op, CeedElemRestriction *active_rstr);
/// Those of the active inputs and outputs, `active_input_rstr` and `active_output_rstr`, counted; either may be NULL.
CEED_EXTERN int CeedOperatorGetActiveElemRestrictions(CeedOperator op, CeedElemRestriction *active_input_rstr,
                                                      CeedElemRestriction *active_output_rstr);
/// Number of inputs and outputs; 0 for a composite.
CEED_EXTERN int CeedOperatorGetNumArgs(CeedOperator op, CeedInt *num_args);
/// Whether no field has a basis without tensor product.
CEED_EXTERN int CeedOperatorHasTensorBases(CeedOperator op, bool *has_tensor_bases);
/// Whether it takes no more fields or parts.
CEED_EXTERN int CeedOperatorIsImmutable(CeedOperator op, bool *is_immutable);
/// Whether it has been lowered, as its first use does; a composite never is.
CEED_EXTERN int CeedOperatorIsSetupDone(CeedOperator op, bool *is_setup_done);
/// The QFunction of a single operator, counted.
CEED_EXTERN int CeedOperatorGetQFunction(CeedOperator op, CeedQFunction *qf);
/// Whether it was made by CeedOperatorCreateComposite().
CEED_EXTERN int CeedOperatorIsComposite(CeedOperator op, bool *is_composite);
/// The pointer of the backend.
CEED_EXTERN int CeedOperatorGetData(CeedOperator op, void *data);
/// Sets the pointer of the backend.
CEED_EXTERN int CeedOperatorSetData(CeedOperator op, void *data);
/// Counts one reference more.
CEED_EXTERN int CeedOperatorReference(CeedOperator op);

/// What an operator is used for.
typedef enum {
  CEED_USE_APPLY = 0,                  ///< CeedOperatorApply() and its like
  CEED_USE_ASSEMBLE_QFUNCTION = 1,     ///< CeedOperatorLinearAssembleQFunction() and its like
  CEED_USE_ASSEMBLE = 2,               ///< CeedOperatorLinearAssemble()
  CEED_USE_ASSEMBLE_DIAGONAL = 3,      ///< CeedOperatorLinearAssembleDiagonal() and its like
  CEED_USE_ASSEMBLE_POINT_BLOCKS = 4,  ///< CeedOperatorLinearAssemblePointBlockDiagonal() and its like
} CeedOperatorUse;
/// Compiles, and brings to a device, what the first use of this kind would compile and bring there, but for vectors
/// that are passed to it; of a composite, for all its parts. Nothing is done twice, and an operator that is not
/// prepared is so when it is first used. Errors: those of CeedOperatorCheckReady(), which is called where it was not
/// (CEED_ERROR_INCOMPLETE, CEED_ERROR_DIMENSION, CEED_ERROR_INCOMPATIBLE); CEED_ERROR_INCOMPATIBLE for assemblies
/// without an active input or output, and for a number that is no use; where it cannot be compiled, those of the
/// backend.
CEED_EXTERN int CeedOperatorPrepareFor(CeedOperator op, CeedOperatorUse use);
/// The same for its application. Errors: those of CeedOperatorCheckReady() (CEED_ERROR_INCOMPLETE, CEED_ERROR_DIMENSION,
/// CEED_ERROR_INCOMPATIBLE), and of the backend.
CEED_EXTERN int CeedOperatorPrepare(CeedOperator op);

/// Bytes that an operator works with, beside its active input and output. An array that several fields or parts share
/// counts once; one that was lent by its user counts, too.
typedef struct {
  CeedSize program;       ///< the operator itself, lowered, and the context of its QFunction
  CeedSize restrictions;  ///< offsets and orientations
  CeedSize bases;         ///< matrices, points and weights
  CeedSize vectors;       ///< passive inputs and outputs, and the coordinates of points
  CeedSize assembly;      ///< an assembled QFunction that is kept for further assemblies
  CeedSize backend;       ///< what the backend keeps for it: its own forms of the above, and arrays to work on
  CeedSize total;         ///< the sum
} CeedOperatorMemory;
/// Counts them in *memory. What a backend makes only when the operator is applied is there from then on. Errors: those
/// of CeedOperatorCheckReady(), which is called where it was not (CEED_ERROR_INCOMPLETE, CEED_ERROR_DIMENSION,
/// CEED_ERROR_INCOMPATIBLE).
CEED_EXTERN int CeedOperatorGetMemory(CeedOperator op, CeedOperatorMemory *memory);

/// What has gone between the memories of the host and of a device.
typedef struct {
  CeedSize num_to_device;    ///< copies to the device
  CeedSize bytes_to_device;  ///< bytes of them
  CeedSize num_to_host;      ///< copies to the host
  CeedSize bytes_to_host;    ///< bytes of them
} CeedTransfers;
/// Counts them in *transfers, since `ceed` was made; all 0 where its backend works on the host.
CEED_EXTERN int CeedGetTransfers(Ceed ceed, CeedTransfers *transfers);
/// @}

#endif
