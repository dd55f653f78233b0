/// @file
/// The public C interface.
///
/// Every function returns a CeedErrorType as int, 0 for success, unless it says otherwise. On an error the handler of
/// the Ceed is called first (default: print and abort; see CeedSetErrorHandler()).
/// Handles are reference counted. A function named Create, ReferenceCopy or Get that hands out a handle hands out a
/// counted reference: the caller destroys it. Handles passed in are counted by whoever keeps them.
/// Different threads may use different objects of one Ceed; one object is used by one thread at a time.
///
/// Vectors of operators: an L-vector holds one value for each degree of freedom of a process; an E-vector holds the
/// degrees of freedom of each element apart; a Q-vector holds values at the (quadrature or material) points.
#ifndef CEED_CEED_H
#define CEED_CEED_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

#include "types.h"

#if defined(CEED_SKIP_VISIBILITY)
#define CEED_VISIBILITY(mode)
#else
#define CEED_VISIBILITY(mode) __attribute__((visibility(#mode)))
#endif

#ifdef __cplusplus
#define CEED_EXTERN extern "C" CEED_VISIBILITY(default)
#else
#define CEED_EXTERN extern CEED_VISIBILITY(default)
#endif

/// A backend with its resources; every other object belongs to one.
typedef struct Ceed_private *Ceed;
/// Marks work that has been started; all work is complete on return at present.
typedef struct CeedRequest_private *CeedRequest;
/// An array of CeedScalar on host or device, with access control.
typedef struct CeedVector_private *CeedVector;
/// The map between an L-vector and an E-vector.
typedef struct CeedElemRestriction_private *CeedElemRestriction;
/// A finite element space on the reference element and a quadrature rule.
typedef struct CeedBasis_private *CeedBasis;
/// One input or output of a QFunction.
typedef struct CeedQFunctionField_private *CeedQFunctionField;
/// The pointwise function of an operator.
typedef struct CeedQFunction_private *CeedQFunction;
/// One input or output of an operator.
typedef struct CeedOperatorField_private *CeedOperatorField;
/// User data that a QFunction receives.
typedef struct CeedQFunctionContext_private *CeedQFunctionContext;
/// A registered field of a context.
typedef struct CeedContextFieldLabel_private *CeedContextFieldLabel;
/// Restriction, basis, QFunction and their transposes, composed.
typedef struct CeedOperator_private *CeedOperator;
/// Any of the counted handles above, cast to this type.
typedef struct CeedObject_private *CeedObject;

/// @defgroup CeedObject Any object
/// @{
/// Prints the object in readable form.
CEED_EXTERN int CeedObjectView(CeedObject obj, FILE *stream);
/// Number of two-space steps by which View indents; not negative.
CEED_EXTERN int CeedObjectSetNumViewTabs(CeedObject obj, CeedInt num_tabs);
CEED_EXTERN int CeedObjectGetNumViewTabs(CeedObject obj, CeedInt *num_tabs);
/// The Ceed of the object, as a counted reference.
CEED_EXTERN int CeedObjectGetCeed(CeedObject obj, Ceed *ceed);
/// The Ceed of the object, not counted: valid while the object lives.
CEED_EXTERN Ceed CeedObjectReturnCeed(CeedObject obj);
/// Drops one reference and sets *obj to NULL; a NULL handle is fine.
CEED_EXTERN int CeedObjectDestroy(CeedObject *obj);
/// @}

/// @defgroup Ceed Backends and errors
/// @{
/// Registered resources: *n names in *resources and their priorities in *array (lower is preferred). The caller frees
/// both arrays with free(), not the names. Each of the two may be NULL.
CEED_EXTERN int CeedRegistryGetList(size_t *n, char ***const resources, CeedInt **array);
/// Opens the backend whose name begins with `resource`, in whole components ("/cpu/self" opens "/cpu/self/ref/serial");
/// of several the one with the lowest priority that this machine can run. What follows a colon
/// ("/gpu/cuda:device_id=1") is passed on to the backend. "help:" before the name prints the resources to stderr.
/// Error CEED_ERROR_MAJOR: no backend fits; the message lists those there are.
CEED_EXTERN int CeedInit(const char *resource, Ceed *ceed);
/// Stream (CUstream, hipStream_t) on which a device backend works; host backends take none.
CEED_EXTERN int CeedSetStream(Ceed ceed, void *handle);
CEED_EXTERN int CeedReferenceCopy(Ceed ceed, Ceed *ceed_copy);
/// Full name of the backend; valid while the Ceed lives.
CEED_EXTERN int CeedGetResource(Ceed ceed, const char **resource);
/// Whether the same operator applied twice gives the same bits.
CEED_EXTERN int CeedIsDeterministic(Ceed ceed, bool *is_deterministic);
/// Directory in which run-time compiling backends look for included files.
CEED_EXTERN int CeedAddJitSourceRoot(Ceed ceed, const char *jit_source_root);
/// Definition ("NAME" or "NAME=VALUE") for run-time compiled code.
CEED_EXTERN int CeedAddJitDefine(Ceed ceed, const char *jit_define);
/// Folder of a Rust package whose QFunctions are compiled when the program runs. Kept for backends that do so.
CEED_EXTERN int CeedAddRustSourceRoot(Ceed ceed, const char *rust_source_root);
CEED_EXTERN int CeedSetNumViewTabs(Ceed ceed, CeedInt num_tabs);
CEED_EXTERN int CeedGetNumViewTabs(Ceed ceed, CeedInt *num_tabs);
CEED_EXTERN int CeedView(Ceed ceed, FILE *stream);
CEED_EXTERN int CeedDestroy(Ceed *ceed);

/// Reports an error to the handler of the Ceed (of the process where it is NULL): file, line, function, code, format and
/// its arguments; use the macro CeedError(). One line, because bindings read this header line by line.
CEED_EXTERN int CeedErrorImpl(Ceed, const char *, int, const char *, int, const char *, ...);
/// Reports an error from here; its value is the code.
#define CeedError(ceed, ecode, ...) \
  (CeedErrorImpl((ceed), __FILE__, __LINE__, __func__, (ecode), __VA_ARGS__), (ecode))
/// What is called on an error: Ceed, file, line, function, code, format, arguments. Its value is ignored.
typedef int (*CeedErrorHandler)(Ceed, const char *, int, const char *, int, const char *, va_list *);
/// Chooses the handler: CeedErrorReturn, CeedErrorStore, CeedErrorAbort (the default), CeedErrorExit, or one's own.
/// The environment variable CEED_ERROR_HANDLER (`return`, `store`, `abort`, `exit`) sets it for each new Ceed.
CEED_EXTERN int CeedSetErrorHandler(Ceed ceed, CeedErrorHandler handler);
/// The message stored by CeedErrorStore(), or "No error message stored"; valid until the next one.
CEED_EXTERN int CeedGetErrorMessage(Ceed ceed, const char **err_msg);
/// Forgets the stored message and sets *err_msg to NULL.
CEED_EXTERN int CeedResetErrorMessage(Ceed ceed, const char **err_msg);
CEED_EXTERN int CeedErrorReturn(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                                const char *format, va_list *args);
CEED_EXTERN int CeedErrorStore(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                               const char *format, va_list *args);
CEED_EXTERN int CeedErrorAbort(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                               const char *format, va_list *args);
CEED_EXTERN int CeedErrorExit(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                              const char *format, va_list *args);

/// Version of the interface that this library implements.
#define CEED_VERSION_MAJOR 0
#define CEED_VERSION_MINOR 12
#define CEED_VERSION_PATCH 0
#define CEED_VERSION_RELEASE false
/// Whether the interface is at least the given version; an unreleased one counts as the newest.
#define CEED_VERSION_GE(major, minor, patch)                                                   \
  (!CEED_VERSION_RELEASE || CEED_VERSION_MAJOR > (major) ||                                    \
   (CEED_VERSION_MAJOR == (major) && (CEED_VERSION_MINOR > (minor) ||                          \
                                      (CEED_VERSION_MINOR == (minor) && CEED_VERSION_PATCH >= (patch)))))
/// Version of the interface in the library that is loaded; any pointer may be NULL.
CEED_EXTERN int CeedGetVersion(int *major, int *minor, int *patch, bool *release);
/// Revision from which the library was built, or "unknown".
CEED_EXTERN int CeedGetGitVersion(const char **git_version);
/// Name, version, compiler and options of the library, several lines.
CEED_EXTERN int CeedGetBuildConfiguration(const char **build_config);
/// Whether run-time compilation for devices is to use clang.
CEED_EXTERN int CeedSetIsClang(Ceed ceed, bool isClang);
CEED_EXTERN int CeedGetIsClang(Ceed ceed, bool *isClang);
CEED_EXTERN int CeedGetScalarType(CeedScalarType *scalar_type);
CEED_EXTERN int CeedGetPreferredMemType(Ceed ceed, CeedMemType *type);
/// Loads the backends; done by the first call that needs them.
CEED_EXTERN int CeedRegisterAll(void);
/// Registers the gallery of QFunctions; done by the first call that needs it.
CEED_EXTERN int CeedQFunctionRegisterAll(void);

/// Names of the enumerations' values, indexed by value (CeedErrorTypes: from -3 on).
CEED_EXTERN const char *const *CeedErrorTypes;
CEED_EXTERN const char *const CeedMemTypes[];
CEED_EXTERN const char *const CeedCopyModes[];
CEED_EXTERN const char *const CeedTransposeModes[];
CEED_EXTERN const char *const CeedEvalModes[];
CEED_EXTERN const char *const CeedQuadModes[];
CEED_EXTERN const char *const CeedElemTopologies[];
CEED_EXTERN const char *const CeedContextFieldTypes[];
/// @}

/// @defgroup CeedVector Vectors
/// An array has one writer or many readers at a time. A second writer, a reader beside a writer, destruction with a
/// writer, restoring what was not granted and syncing while locked are CEED_ERROR_ACCESS.
/// @{
/// A vector of `len` >= 0 entries; it holds no values until they are set.
CEED_EXTERN int CeedVectorCreate(Ceed ceed, CeedSize len, CeedVector *vec);
CEED_EXTERN int CeedVectorReferenceCopy(CeedVector vec, CeedVector *vec_copy);
/// Copies the values; lengths are equal.
CEED_EXTERN int CeedVectorCopy(CeedVector vec, CeedVector vec_copy);
/// Copies the entries start, start+step, ... below stop (stop < 0: to the end); the rest of vec_copy stays.
CEED_EXTERN int CeedVectorCopyStrided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step,
                                      CeedVector vec_copy);
/// Gives the vector an array of its length. Values are copied into the array in use, be it lent by the user.
CEED_EXTERN int CeedVectorSetArray(CeedVector vec, CeedMemType mem_type, CeedCopyMode copy_mode, CeedScalar *array);
CEED_EXTERN int CeedVectorSetValue(CeedVector vec, CeedScalar value);
CEED_EXTERN int CeedVectorSetValueStrided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step,
                                          CeedScalar value);
/// Makes the array that the user lent (CEED_USE_POINTER) hold the current values.
CEED_EXTERN int CeedVectorSyncArray(CeedVector vec, CeedMemType mem_type);
/// Takes back a lent array; the vector keeps no values. `array` may be NULL.
CEED_EXTERN int CeedVectorTakeArray(CeedVector vec, CeedMemType mem_type, CeedScalar **array);
/// Read and write access; each Get is followed by its Restore.
CEED_EXTERN int CeedVectorGetArray(CeedVector vec, CeedMemType mem_type, CeedScalar **array);
CEED_EXTERN int CeedVectorGetArrayRead(CeedVector vec, CeedMemType mem_type, const CeedScalar **array);
/// Write access; the contents are undefined and all of them must be written.
CEED_EXTERN int CeedVectorGetArrayWrite(CeedVector vec, CeedMemType mem_type, CeedScalar **array);
CEED_EXTERN int CeedVectorRestoreArray(CeedVector vec, CeedScalar **array);
CEED_EXTERN int CeedVectorRestoreArrayRead(CeedVector vec, const CeedScalar **array);
CEED_EXTERN int CeedVectorNorm(CeedVector vec, CeedNormType type, CeedScalar *norm);
/// x = alpha x
CEED_EXTERN int CeedVectorScale(CeedVector x, CeedScalar alpha);
/// Sets entries with |x_i| <= threshold to zero.
CEED_EXTERN int CeedVectorFilter(CeedVector x, CeedScalar threshold);
/// y = alpha x + y; x and y differ.
CEED_EXTERN int CeedVectorAXPY(CeedVector y, CeedScalar alpha, CeedVector x);
/// y = alpha x + beta y; x and y differ.
CEED_EXTERN int CeedVectorAXPBY(CeedVector y, CeedScalar alpha, CeedScalar beta, CeedVector x);
/// w_i = x_i y_i; any two or all three may be the same vector.
CEED_EXTERN int CeedVectorPointwiseMult(CeedVector w, CeedVector x, CeedVector y);
/// x_i = 1 / x_i where |x_i| > CEED_EPSILON; other entries stay.
CEED_EXTERN int CeedVectorReciprocal(CeedVector vec);
CEED_EXTERN int CeedVectorSetNumViewTabs(CeedVector vec, CeedInt num_tabs);
CEED_EXTERN int CeedVectorGetNumViewTabs(CeedVector vec, CeedInt *num_tabs);
/// Prints entries start, start+step, ... below stop (above it for a negative step; stop < 0: to the end) with the printf
/// format fp_fmt (NULL: "%g").
CEED_EXTERN int CeedVectorViewRange(CeedVector vec, CeedSize start, CeedSize stop, CeedInt step, const char *fp_fmt,
                                    FILE *stream);
CEED_EXTERN int CeedVectorView(CeedVector vec, const char *fp_fmt, FILE *stream);
CEED_EXTERN int CeedVectorGetCeed(CeedVector vec, Ceed *ceed);
CEED_EXTERN Ceed CeedVectorReturnCeed(CeedVector vec);
CEED_EXTERN int CeedVectorGetLength(CeedVector vec, CeedSize *length);
CEED_EXTERN int CeedVectorDestroy(CeedVector *vec);

/// For the argument `request`: complete on return; in the order of the calls.
CEED_EXTERN CeedRequest *const CEED_REQUEST_IMMEDIATE;
CEED_EXTERN CeedRequest *const CEED_REQUEST_ORDERED;
CEED_EXTERN int CeedRequestWait(CeedRequest *req);
/// @}

/// @defgroup CeedElemRestriction Element restrictions
/// An E-vector is laid out as (node, component, element), node fastest, unless the backend says otherwise. At points it
/// is (point, component), point fastest, for one element after another, each with its own number of points.
/// @{
/// Stands for the input of CeedOperatorApply() and its output.
CEED_EXTERN const CeedVector CEED_VECTOR_ACTIVE;
/// For a field of quadrature weights, which needs no vector.
CEED_EXTERN const CeedVector CEED_VECTOR_NONE;
/// For fields that are used as they are stored at the points.
CEED_EXTERN const CeedBasis CEED_BASIS_NONE;
/// For a field of quadrature weights.
CEED_EXTERN const CeedElemRestriction CEED_ELEMRESTRICTION_NONE;
/// For the linearisations that CeedOperatorCreate() does not need.
CEED_EXTERN const CeedQFunction CEED_QFUNCTION_NONE;
/// Strides by which the backend lays out E-vectors as it likes best; compared by value (three zeros).
CEED_EXTERN const CeedInt CEED_STRIDES_BACKEND[3];

/// Component c of node n in element e is at offsets[n + e*elem_size] + c*comp_stride in an L-vector of l_size entries.
/// `offsets`: num_elem * elem_size entries; every index they lead to must be in [0, l_size).
CEED_EXTERN int CeedElemRestrictionCreate(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                          CeedInt comp_stride, CeedSize l_size, CeedMemType mem_type,
                                          CeedCopyMode copy_mode, const CeedInt *offsets, CeedElemRestriction *rstr);
/// The same with a sign for each node, all components alike: orients[n + e*elem_size] is true where the element has the
/// opposite direction, as with the fluxes of H(div). `orients` is treated as `offsets` is.
CEED_EXTERN int CeedElemRestrictionCreateOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                                  CeedInt comp_stride, CeedSize l_size, CeedMemType mem_type,
                                                  CeedCopyMode copy_mode, const CeedInt *offsets, const bool *orients,
                                                  CeedElemRestriction *rstr);
/// The same with a tridiagonal matrix T for each element, all components alike, as tangents on the faces of H(curl)
/// need: the element's values are T times those that the offsets pick, and T^T goes the other way. T(n,n-1), T(n,n),
/// T(n,n+1) are curl_orients[3*(n + e*elem_size) + 0, 1, 2]; the two outside of T have no meaning. `curl_orients` is
/// treated as `offsets` is.
CEED_EXTERN int CeedElemRestrictionCreateCurlOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size,
                                                      CeedInt num_comp, CeedInt comp_stride, CeedSize l_size,
                                                      CeedMemType mem_type, CeedCopyMode copy_mode,
                                                      const CeedInt *offsets, const CeedInt8 *curl_orients,
                                                      CeedElemRestriction *rstr);
/// Component c of node n in element e is at n*strides[0] + c*strides[1] + e*strides[2].
CEED_EXTERN int CeedElemRestrictionCreateStrided(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                                 CeedSize l_size, const CeedInt strides[3], CeedElemRestriction *rstr);
/// The same four in blocks of block_size elements, whose values lie next to each other in the E-vector: with B =
/// block_size, node n of component c of element e is at (n*B + e%B)*layout[0] + c*B*layout[1] + (e/B)*B*layout[2], the
/// layout that of CeedElemRestrictionGetELayout(). A last block that is not full is filled by copies of the last
/// element; the transposed restriction does not read them. The arguments are those of the restriction without blocks.
CEED_EXTERN int CeedElemRestrictionCreateBlocked(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt block_size,
                                                 CeedInt num_comp, CeedInt comp_stride, CeedSize l_size,
                                                 CeedMemType mem_type, CeedCopyMode copy_mode, const CeedInt *offsets,
                                                 CeedElemRestriction *rstr);
CEED_EXTERN int CeedElemRestrictionCreateBlockedOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size,
                                                         CeedInt block_size, CeedInt num_comp, CeedInt comp_stride,
                                                         CeedSize l_size, CeedMemType mem_type, CeedCopyMode copy_mode,
                                                         const CeedInt *offsets, const bool *orients,
                                                         CeedElemRestriction *rstr);
CEED_EXTERN int CeedElemRestrictionCreateBlockedCurlOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size,
                                                             CeedInt block_size, CeedInt num_comp, CeedInt comp_stride,
                                                             CeedSize l_size, CeedMemType mem_type,
                                                             CeedCopyMode copy_mode, const CeedInt *offsets,
                                                             const CeedInt8 *curl_orients, CeedElemRestriction *rstr);
CEED_EXTERN int CeedElemRestrictionCreateBlockedStrided(Ceed ceed, CeedInt num_elem, CeedInt elem_size,
                                                        CeedInt block_size, CeedInt num_comp, CeedSize l_size,
                                                        const CeedInt strides[3], CeedElemRestriction *rstr);
/// Points of element e are those at offsets[offsets[e]] ... offsets[offsets[e+1] - 1]: num_elem+1 starts, counted from
/// the beginning of the array (so the first is num_elem+1), then the point numbers, each below l_size / num_comp. A
/// point may belong to several elements: there are num_points or more of them. Component c of point i is at
/// i*num_comp + c of the L-vector.
CEED_EXTERN int CeedElemRestrictionCreateAtPoints(Ceed ceed, CeedInt num_elem, CeedInt num_points, CeedInt num_comp,
                                                  CeedSize l_size, CeedMemType mem_type, CeedCopyMode copy_mode,
                                                  const CeedInt *offsets, CeedElemRestriction *rstr);
/// A restriction of the same nodes without the signs of the orientation: matrices of curl-oriented ones become their
/// absolute values, oriented ones have no orientation left. Others are copied as they are. The tables are shared.
CEED_EXTERN int CeedElemRestrictionCreateUnsignedCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_unsigned);
/// A restriction of the same nodes without any orientation. The tables are shared.
CEED_EXTERN int CeedElemRestrictionCreateUnorientedCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_unoriented);
CEED_EXTERN int CeedElemRestrictionReferenceCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_copy);
/// Vectors of the right lengths; either may be NULL.
CEED_EXTERN int CeedElemRestrictionCreateVector(CeedElemRestriction rstr, CeedVector *lvec, CeedVector *evec);
/// CEED_NOTRANSPOSE: E-vector ru = R u. CEED_TRANSPOSE: L-vector ru += R^T u. The vectors may be longer than needed;
/// what is beyond stays.
CEED_EXTERN int CeedElemRestrictionApply(CeedElemRestriction rstr, CeedTransposeMode t_mode, CeedVector u,
                                         CeedVector ru, CeedRequest *request);
/// The same for one block of elements, [0, number of blocks): the E-vector holds that block, (element, node, component),
/// element fastest, and may be longer. Without blocks, and at points, each element is a block.
CEED_EXTERN int CeedElemRestrictionApplyBlock(CeedElemRestriction rstr, CeedInt block, CeedTransposeMode t_mode,
                                              CeedVector u, CeedVector ru, CeedRequest *request);
/// The same for the points of one element: its vector holds component c of its point p at [c*num_points + p], with the
/// element's own num_points, and may be longer than that.
CEED_EXTERN int CeedElemRestrictionApplyAtPointsInElement(CeedElemRestriction rstr, CeedInt elem,
                                                          CeedTransposeMode t_mode, CeedVector u, CeedVector ru,
                                                          CeedRequest *request);
CEED_EXTERN int CeedElemRestrictionGetCeed(CeedElemRestriction rstr, Ceed *ceed);
CEED_EXTERN Ceed CeedElemRestrictionReturnCeed(CeedElemRestriction rstr);
CEED_EXTERN int CeedElemRestrictionGetCompStride(CeedElemRestriction rstr, CeedInt *comp_stride);
CEED_EXTERN int CeedElemRestrictionGetNumElements(CeedElemRestriction rstr, CeedInt *num_elem);
/// Nodes of an element; at points the largest number of points of an element.
CEED_EXTERN int CeedElemRestrictionGetElementSize(CeedElemRestriction rstr, CeedInt *elem_size);
CEED_EXTERN int CeedElemRestrictionGetNumPoints(CeedElemRestriction rstr, CeedInt *num_points);
CEED_EXTERN int CeedElemRestrictionGetNumPointsInElement(CeedElemRestriction rstr, CeedInt elem, CeedInt *num_points);
CEED_EXTERN int CeedElemRestrictionGetMaxPointsInElement(CeedElemRestriction rstr, CeedInt *max_points);
CEED_EXTERN int CeedElemRestrictionGetMinPointsInElement(CeedElemRestriction rstr, CeedInt *min_points);
CEED_EXTERN int CeedElemRestrictionGetMinMaxPointsInElement(CeedElemRestriction rstr, CeedInt *min_points,
                                                            CeedInt *max_points);
CEED_EXTERN int CeedElemRestrictionGetLVectorSize(CeedElemRestriction rstr, CeedSize *l_size);
CEED_EXTERN int CeedElemRestrictionGetEVectorSize(CeedElemRestriction rstr, CeedSize *e_size);
CEED_EXTERN int CeedElemRestrictionGetNumComponents(CeedElemRestriction rstr, CeedInt *num_comp);
CEED_EXTERN int CeedElemRestrictionGetNumBlocks(CeedElemRestriction rstr, CeedInt *num_block);
CEED_EXTERN int CeedElemRestrictionGetBlockSize(CeedElemRestriction rstr, CeedInt *block_size);
/// mult_i = number of element nodes that refer to entry i of the L-vector, whatever their orientation.
CEED_EXTERN int CeedElemRestrictionGetMultiplicity(CeedElemRestriction rstr, CeedVector mult);
CEED_EXTERN int CeedElemRestrictionSetNumViewTabs(CeedElemRestriction rstr, CeedInt num_tabs);
CEED_EXTERN int CeedElemRestrictionGetNumViewTabs(CeedElemRestriction rstr, CeedInt *num_tabs);
CEED_EXTERN int CeedElemRestrictionView(CeedElemRestriction rstr, FILE *stream);
CEED_EXTERN int CeedElemRestrictionDestroy(CeedElemRestriction *rstr);
/// @}

/// @defgroup CeedBasis Bases
/// Reference elements of tensor-product bases are [-1,1]^dim; nodes and quadrature points are numbered with x fastest.
/// Other bases are in H^1, H(div) or H(curl), and are known by their matrices at the quadrature points of an element of
/// any shape. Values (CEED_EVAL_INTERP) have q_comp = 1 entry a component in H^1 and dim entries in H(div) and H(curl).
/// Each space has one derivative: the gradient in H^1 (q_comp = dim), the divergence in H(div) (1), the curl in H(curl)
/// (3 in three dimensions, else 1). Matrices are q_comp by Q by num_nodes, row-major.
/// Arrays for several elements hold one element after another. Within an element: at nodes (node, component), node
/// fastest; values and derivatives at points (point, component, entry), point fastest; quadrature weights one for each
/// point.
/// @{
/// Lagrange basis of degree P-1 on Gauss-Lobatto nodes (P = 1: the constant) with Q points a direction, `num_comp`
/// components. dim 1 to 3, P >= 1, Q >= 1 (>= 2 for Gauss-Lobatto points).
CEED_EXTERN int CeedBasisCreateTensorH1Lagrange(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P, CeedInt Q,
                                                CeedQuadMode quad_mode, CeedBasis *basis);
/// Tensor-product basis from 1D matrices (row-major, Q_1d by P_1d), points and weights; all are copied. Away from the
/// quadrature points its functions are the polynomials of degree Q_1d - 1 through the values there.
CEED_EXTERN int CeedBasisCreateTensorH1(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P_1d, CeedInt Q_1d,
                                        const CeedScalar *interp_1d, const CeedScalar *grad_1d,
                                        const CeedScalar *q_ref_1d, const CeedScalar *q_weight_1d, CeedBasis *basis);
/// Bases from full matrices for an element of any shape; all is copied. q_ref (point, direction; point fastest) and
/// q_weights may be NULL and are then zero; the derivative may be NULL, and then cannot be evaluated. num_comp copies of
/// the space, num_nodes degrees of freedom each.
CEED_EXTERN int CeedBasisCreateH1(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes, CeedInt nqpts,
                                  const CeedScalar *interp, const CeedScalar *grad, const CeedScalar *q_ref,
                                  const CeedScalar *q_weights, CeedBasis *basis);
CEED_EXTERN int CeedBasisCreateHdiv(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes,
                                    CeedInt nqpts, const CeedScalar *interp, const CeedScalar *div,
                                    const CeedScalar *q_ref, const CeedScalar *q_weights, CeedBasis *basis);
CEED_EXTERN int CeedBasisCreateHcurl(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes,
                                     CeedInt nqpts, const CeedScalar *interp, const CeedScalar *curl,
                                     const CeedScalar *q_ref, const CeedScalar *q_weights, CeedBasis *basis);
/// Basis that takes degrees of freedom of `basis_from` to those of `basis_to`, which are its quadrature points:
/// interp = interp_to^+ interp_from, and in H^1 grad = interp_to^+ grad_from, with the pseudoinverse interp_to^+. Both are
/// in one kind of space and share their quadrature points, at which those of `basis_to` are independent; tensor products
/// or not. It has the components of `basis_from`, is in H^1 (degrees of freedom are numbers), is a tensor product where
/// both are, and has no points or weights: zeros. From H(div) and H(curl) it has no derivative.
CEED_EXTERN int CeedBasisCreateProjection(CeedBasis basis_from, CeedBasis basis_to, CeedBasis *basis_project);
CEED_EXTERN int CeedBasisReferenceCopy(CeedBasis basis, CeedBasis *basis_copy);
CEED_EXTERN int CeedBasisSetNumViewTabs(CeedBasis basis, CeedInt num_tabs);
CEED_EXTERN int CeedBasisGetNumViewTabs(CeedBasis basis, CeedInt *num_tabs);
CEED_EXTERN int CeedBasisView(CeedBasis basis, FILE *stream);
/// v = B u from nodes to quadrature points, or v = B^T u back (then all of v is set, also what lies beyond num_elem
/// elements). For CEED_EVAL_WEIGHT, which has no transpose, u is CEED_VECTOR_NONE. Vectors may be longer than needed.
CEED_EXTERN int CeedBasisApply(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode,
                               CeedVector u, CeedVector v);
/// v += B^T u; only CEED_TRANSPOSE.
CEED_EXTERN int CeedBasisApplyAdd(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode,
                                  CeedVector u, CeedVector v);
/// The same at num_points[e] >= 0 arbitrary points of element e, with reference coordinates x_ref: (point, direction),
/// point fastest, within an element. x_ref and the values and derivatives of element e start after those of the points
/// of all elements before it. Weights at points are 1.
/// Error CEED_ERROR_UNSUPPORTED for bases that are known at their quadrature points alone: those without tensor product,
/// and those from the user's matrices with Q_1d < P_1d, which determine no polynomial.
CEED_EXTERN int CeedBasisApplyAtPoints(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points,
                                       CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector x_ref,
                                       CeedVector u, CeedVector v);
CEED_EXTERN int CeedBasisApplyAddAtPoints(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points,
                                          CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector x_ref,
                                          CeedVector u, CeedVector v);
CEED_EXTERN int CeedBasisGetCeed(CeedBasis basis, Ceed *ceed);
CEED_EXTERN Ceed CeedBasisReturnCeed(CeedBasis basis);
CEED_EXTERN int CeedBasisGetDimension(CeedBasis basis, CeedInt *dim);
CEED_EXTERN int CeedBasisGetTopology(CeedBasis basis, CeedElemTopology *topo);
CEED_EXTERN int CeedBasisGetNumComponents(CeedBasis basis, CeedInt *num_comp);
CEED_EXTERN int CeedBasisGetNumNodes(CeedBasis basis, CeedInt *P);
CEED_EXTERN int CeedBasisGetNumNodes1D(CeedBasis basis, CeedInt *P_1d);
CEED_EXTERN int CeedBasisGetNumQuadraturePoints(CeedBasis basis, CeedInt *Q);
CEED_EXTERN int CeedBasisGetNumQuadraturePoints1D(CeedBasis basis, CeedInt *Q_1d);
/// Reference points and weights (1D ones for tensor bases) and matrices; the basis keeps them. Interp1D and Grad1D are of
/// tensor bases alone; an error for the derivative of another space.
CEED_EXTERN int CeedBasisGetQRef(CeedBasis basis, const CeedScalar **q_ref);
CEED_EXTERN int CeedBasisGetQWeights(CeedBasis basis, const CeedScalar **q_weights);
CEED_EXTERN int CeedBasisGetInterp(CeedBasis basis, const CeedScalar **interp);
CEED_EXTERN int CeedBasisGetInterp1D(CeedBasis basis, const CeedScalar **interp_1d);
CEED_EXTERN int CeedBasisGetGrad(CeedBasis basis, const CeedScalar **grad);
CEED_EXTERN int CeedBasisGetGrad1D(CeedBasis basis, const CeedScalar **grad_1d);
CEED_EXTERN int CeedBasisGetDiv(CeedBasis basis, const CeedScalar **div);
CEED_EXTERN int CeedBasisGetCurl(CeedBasis basis, const CeedScalar **curl);
CEED_EXTERN int CeedBasisDestroy(CeedBasis *basis);
/// Q >= 1 Gauss points and weights on [-1,1], exact to degree 2Q-1; q_weight_1d may be NULL.
CEED_EXTERN int CeedGaussQuadrature(CeedInt Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d);
/// Q >= 2 Gauss-Lobatto points and weights on [-1,1], exact to degree 2Q-3; q_weight_1d may be NULL.
CEED_EXTERN int CeedLobattoQuadrature(CeedInt Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d);
/// @}

/// @defgroup CeedQFunction QFunctions
/// @{
/// The function itself: in[i] and out[i] hold component c of point q at [c*Q + q]. It returns 0, or an error code.
typedef int (*CeedQFunctionUser)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out);
/// vec_length: the Q that the function is called with is a multiple of it. `source`: "file:function".
CEED_EXTERN int CeedQFunctionCreateInterior(Ceed ceed, CeedInt vec_length, CeedQFunctionUser f, const char *source,
                                            CeedQFunction *qf);
/// A QFunction of the gallery, with its fields.
CEED_EXTERN int CeedQFunctionCreateInteriorByName(Ceed ceed, const char *name, CeedQFunction *qf);
/// Copies `size` components from field "input" to field "output".
CEED_EXTERN int CeedQFunctionCreateIdentity(Ceed ceed, CeedInt size, CeedEvalMode in_mode, CeedEvalMode out_mode,
                                            CeedQFunction *qf);
CEED_EXTERN int CeedQFunctionReferenceCopy(CeedQFunction qf, CeedQFunction *qf_copy);
/// size: values at a point: components for NONE and INTERP, components times dim for GRAD, 1 for WEIGHT.
CEED_EXTERN int CeedQFunctionAddInput(CeedQFunction qf, const char *field_name, CeedInt size, CeedEvalMode eval_mode);
CEED_EXTERN int CeedQFunctionAddOutput(CeedQFunction qf, const char *field_name, CeedInt size, CeedEvalMode eval_mode);
/// The fields, owned by the QFunction; it can take no more of them. Any pointer may be NULL.
CEED_EXTERN int CeedQFunctionGetFields(CeedQFunction qf, CeedInt *num_input_fields, CeedQFunctionField **input_fields,
                                       CeedInt *num_output_fields, CeedQFunctionField **output_fields);
CEED_EXTERN int CeedQFunctionSetContext(CeedQFunction qf, CeedQFunctionContext ctx);
/// Promise that the function only reads its context (false); the default is true.
CEED_EXTERN int CeedQFunctionSetContextWritable(CeedQFunction qf, bool is_writable);
/// Floating point operations at a point, for CeedOperatorGetFlopsEstimate().
CEED_EXTERN int CeedQFunctionSetUserFlopsEstimate(CeedQFunction qf, CeedSize flops);
CEED_EXTERN int CeedQFunctionSetNumViewTabs(CeedQFunction qf, CeedInt num_tabs);
CEED_EXTERN int CeedQFunctionGetNumViewTabs(CeedQFunction qf, CeedInt *num_tabs);
CEED_EXTERN int CeedQFunctionView(CeedQFunction qf, FILE *stream);
CEED_EXTERN int CeedQFunctionGetCeed(CeedQFunction qf, Ceed *ceed);
CEED_EXTERN Ceed CeedQFunctionReturnCeed(CeedQFunction qf);
/// Calls the function at Q points; u and v hold a vector for each input and output. Q is a multiple of vec_length.
CEED_EXTERN int CeedQFunctionApply(CeedQFunction qf, CeedInt Q, CeedVector *u, CeedVector *v);
CEED_EXTERN int CeedQFunctionDestroy(CeedQFunction *qf);
CEED_EXTERN int CeedQFunctionFieldGetName(CeedQFunctionField qf_field, const char **field_name);
CEED_EXTERN int CeedQFunctionFieldGetSize(CeedQFunctionField qf_field, CeedInt *size);
CEED_EXTERN int CeedQFunctionFieldGetEvalMode(CeedQFunctionField qf_field, CeedEvalMode *eval_mode);
CEED_EXTERN int CeedQFunctionFieldGetData(CeedQFunctionField qf_field, const char **field_name, CeedInt *size,
                                          CeedEvalMode *eval_mode);

/// Frees the data of a context.
typedef int (*CeedQFunctionContextDataDestroyUser)(void *data);
CEED_EXTERN int CeedQFunctionContextCreate(Ceed ceed, CeedQFunctionContext *ctx);
CEED_EXTERN int CeedQFunctionContextReferenceCopy(CeedQFunctionContext ctx, CeedQFunctionContext *ctx_copy);
/// Gives the context `size` bytes of data.
CEED_EXTERN int CeedQFunctionContextSetData(CeedQFunctionContext ctx, CeedMemType mem_type, CeedCopyMode copy_mode,
                                            size_t size, void *data);
/// `data` is the address of a pointer, here and below. The access rules are those of a vector.
CEED_EXTERN int CeedQFunctionContextTakeData(CeedQFunctionContext ctx, CeedMemType mem_type, void *data);
CEED_EXTERN int CeedQFunctionContextGetData(CeedQFunctionContext ctx, CeedMemType mem_type, void *data);
CEED_EXTERN int CeedQFunctionContextGetDataRead(CeedQFunctionContext ctx, CeedMemType mem_type, void *data);
CEED_EXTERN int CeedQFunctionContextRestoreData(CeedQFunctionContext ctx, void *data);
CEED_EXTERN int CeedQFunctionContextRestoreDataRead(CeedQFunctionContext ctx, void *data);
/// Names `num_values` values at `field_offset` bytes from the start of the data.
CEED_EXTERN int CeedQFunctionContextRegisterDouble(CeedQFunctionContext ctx, const char *field_name,
                                                   size_t field_offset, size_t num_values,
                                                   const char *field_description);
CEED_EXTERN int CeedQFunctionContextRegisterInt32(CeedQFunctionContext ctx, const char *field_name,
                                                  size_t field_offset, size_t num_values,
                                                  const char *field_description);
CEED_EXTERN int CeedQFunctionContextRegisterBoolean(CeedQFunctionContext ctx, const char *field_name,
                                                    size_t field_offset, size_t num_values,
                                                    const char *field_description);
CEED_EXTERN int CeedQFunctionContextGetAllFieldLabels(CeedQFunctionContext ctx,
                                                      const CeedContextFieldLabel **field_labels, CeedInt *num_fields);
CEED_EXTERN int CeedContextFieldLabelGetDescription(CeedContextFieldLabel label, const char **field_name,
                                                    size_t *field_offset, size_t *num_values,
                                                    const char **field_description, CeedContextFieldType *field_type);
CEED_EXTERN int CeedQFunctionContextGetContextSize(CeedQFunctionContext ctx, size_t *ctx_size);
CEED_EXTERN int CeedQFunctionContextSetNumViewTabs(CeedQFunctionContext ctx, CeedInt num_tabs);
CEED_EXTERN int CeedQFunctionContextGetNumViewTabs(CeedQFunctionContext ctx, CeedInt *num_tabs);
CEED_EXTERN int CeedQFunctionContextView(CeedQFunctionContext ctx, FILE *stream);
/// `f` is called with the data (in memory of type f_mem_type) before the context frees or forgets it.
CEED_EXTERN int CeedQFunctionContextSetDataDestroy(CeedQFunctionContext ctx, CeedMemType f_mem_type,
                                                   CeedQFunctionContextDataDestroyUser f);
CEED_EXTERN int CeedQFunctionContextDestroy(CeedQFunctionContext *ctx);
/// @}

/// @defgroup CeedOperator Operators
/// @{
/// dqf and dqfT may be CEED_QFUNCTION_NONE.
CEED_EXTERN int CeedOperatorCreate(Ceed ceed, CeedQFunction qf, CeedQFunction dqf, CeedQFunction dqfT,
                                   CeedOperator *op);
/// The QFunction acts at points given by CeedOperatorAtPointsSetPoints(), their number may differ between elements.
CEED_EXTERN int CeedOperatorCreateAtPoints(Ceed ceed, CeedQFunction qf, CeedQFunction dqf, CeedQFunction dqfT,
                                           CeedOperator *op);
/// The sum of other operators.
CEED_EXTERN int CeedOperatorCreateComposite(Ceed ceed, CeedOperator *op);
CEED_EXTERN int CeedOperatorReferenceCopy(CeedOperator op, CeedOperator *op_copy);
/// Gives the field of the QFunction a restriction, a basis (CEED_BASIS_NONE for mode NONE) and a vector
/// (CEED_VECTOR_ACTIVE, CEED_VECTOR_NONE for weights, or a passive one). Each field is set once; only fields stored at
/// points (a restriction at points) may be set again, when points have moved.
CEED_EXTERN int CeedOperatorSetField(CeedOperator op, const char *field_name, CeedElemRestriction rstr,
                                     CeedBasis basis, CeedVector vec);
CEED_EXTERN int CeedOperatorGetFields(CeedOperator op, CeedInt *num_input_fields, CeedOperatorField **input_fields,
                                      CeedInt *num_output_fields, CeedOperatorField **output_fields);
/// Restriction (at points, dim components) and L-vector of the points' reference coordinates. May be called again with
/// other points of as many elements when points have moved; nothing is compiled again. If their number in some element
/// has changed, the fields stored at points are set again too, before the next use.
CEED_EXTERN int CeedOperatorAtPointsSetPoints(CeedOperator op, CeedElemRestriction rstr_points,
                                              CeedVector point_coords);
CEED_EXTERN int CeedOperatorAtPointsGetPoints(CeedOperator op, CeedElemRestriction *rstr_points,
                                              CeedVector *point_coords);
CEED_EXTERN int CeedOperatorIsAtPoints(CeedOperator op, bool *is_at_points);
CEED_EXTERN int CeedOperatorCompositeAddSub(CeedOperator composite_op, CeedOperator sub_op);
CEED_EXTERN int CeedOperatorCompositeGetNumSub(CeedOperator op, CeedInt *num_suboperators);
/// The list belongs to the composite operator; its entries are not counted.
CEED_EXTERN int CeedOperatorCompositeGetSubList(CeedOperator op, CeedOperator **sub_operators);
/// Not counted; *sub_op is NULL where no sub-operator has that name.
CEED_EXTERN int CeedOperatorCompositeGetSubByName(CeedOperator op, const char *op_name, CeedOperator *sub_op);
/// Whether sub-operators must run one after the other in the order in which they were added.
CEED_EXTERN int CeedOperatorCompositeSetSequential(CeedOperator op, bool is_sequential);
CEED_EXTERN int CeedOperatorCompositeIsSequential(CeedOperator op, bool *is_sequential);
/// mult_i = number of sub-operators, those with the given indices left out, that read entry i of the active input in
/// any of their elements. A sub-operator that is itself composite counts once. `mult`: as long as the active input.
CEED_EXTERN int CeedOperatorCompositeGetMultiplicity(CeedOperator op, CeedInt num_skip_indices, CeedInt *skip_indices,
                                                     CeedVector mult);
/// Whether all fields are set and fit together; done by the first use.
CEED_EXTERN int CeedOperatorCheckReady(CeedOperator op);
/// L-vector sizes of the active input and output, -1 where there is none; either pointer may be NULL.
CEED_EXTERN int CeedOperatorGetActiveVectorLengths(CeedOperator op, CeedSize *input_size, CeedSize *output_size);
/// Whether an assembled QFunction is kept for later assemblies until it is said to need an update.
CEED_EXTERN int CeedOperatorSetQFunctionAssemblyReuse(CeedOperator op, bool reuse_assembly_data);
CEED_EXTERN int CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(CeedOperator op, bool needs_data_update);
/// The linear QFunction as a matrix at each point: with n_in and n_out active values a point, `assembled` is an
/// L-vector of `rstr` with n_in*n_out components, component i*n_out + o the derivative of output o by input i.
CEED_EXTERN int CeedOperatorLinearAssembleQFunction(CeedOperator op, CeedVector *assembled, CeedElemRestriction *rstr,
                                                    CeedRequest *request);
/// The same into the objects of an earlier call where they are not NULL.
CEED_EXTERN int CeedOperatorLinearAssembleQFunctionBuildOrUpdate(CeedOperator op, CeedVector *assembled,
                                                                 CeedElemRestriction *rstr, CeedRequest *request);
/// Diagonal of a linear operator, active input and output of one length.
CEED_EXTERN int CeedOperatorLinearAssembleDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *request);
CEED_EXTERN int CeedOperatorLinearAssembleAddDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *request);
/// Point-block diagonal: for each node the num_comp by num_comp matrix that couples its components, row-major, row by
/// output. All active fields have num_comp components, equally far apart. `assembled` has num_comp times the length of
/// the active vectors; where components are N = length/num_comp entries apart, or 1, the blocks follow each other node
/// by node. In all cases the symbolic form says which row and column each entry belongs to; an entry that belongs to no
/// node is 0, and has row and column 0. The caller frees rows and cols with free().
CEED_EXTERN int CeedOperatorLinearAssemblePointBlockDiagonal(CeedOperator op, CeedVector assembled,
                                                             CeedRequest *request);
CEED_EXTERN int CeedOperatorLinearAssembleAddPointBlockDiagonal(CeedOperator op, CeedVector assembled,
                                                                CeedRequest *request);
CEED_EXTERN int CeedOperatorLinearAssemblePointBlockDiagonalSymbolic(CeedOperator op, CeedSize *num_entries,
                                                                     CeedInt **rows, CeedInt **cols);
/// Rows and columns of all element entries in coordinate form; several entries may meet. The caller frees both arrays
/// with free().
CEED_EXTERN int CeedOperatorLinearAssembleSymbolic(CeedOperator op, CeedSize *num_entries, CeedInt **rows,
                                                   CeedInt **cols);
CEED_EXTERN int CeedOperatorLinearAssembleGetNumEntries(CeedOperator op, CeedSize *num_entries);
/// Values in the order of CeedOperatorLinearAssembleSymbolic().
CEED_EXTERN int CeedOperatorLinearAssemble(CeedOperator op, CeedVector values);
/// A level of p-multigrid: `op_coarse` is the operator with the space of all active fields that have a basis replaced by
/// the coarse one (other fields, the QFunction and the points are shared), `op_prolong` takes a coarse L-vector to a fine
/// one, and `op_restrict` is its transpose. Fine and coarse space have the same elements, and bases at the same
/// quadrature points; at points, the coarse basis is evaluated where the points of `op_fine` are now.
/// Prolongation interpolates in each element and scales by 1/(m p_mult_fine), entry by entry, where m is the number of
/// nodes of elements that are that entry: with p_mult_fine = 1, or on many processes the number of those that share the
/// entry, a fine entry becomes the mean of what its elements propose. An entry of p_mult_fine that is 0 stays 0.
/// In a composite operator all sub-operators have the same active restriction and basis. For sub-operators on different
/// elements, make a level of each with p_mult_fine of CeedOperatorCompositeGetMultiplicity(), and compose those.
/// Each of the three handles may be NULL, and is then not made; p_mult_fine may be NULL without prolongation and
/// restriction. The caller destroys the operators.
/// The interpolation from coarse to fine nodes is here the projection of CeedBasisCreateProjection().
CEED_EXTERN int CeedOperatorMultigridLevelCreate(CeedOperator op_fine, CeedVector p_mult_fine,
                                                 CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                                                 CeedOperator *op_coarse, CeedOperator *op_prolong,
                                                 CeedOperator *op_restrict);
/// The same with an interpolation in one dimension, fine P_1d by coarse P_1d, row-major; both bases are tensor products.
CEED_EXTERN int CeedOperatorMultigridLevelCreateTensorH1(CeedOperator op_fine, CeedVector p_mult_fine,
                                                         CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                                                         const CeedScalar *interp_c_to_f, CeedOperator *op_coarse,
                                                         CeedOperator *op_prolong, CeedOperator *op_restrict);
/// The same with an interpolation of all nodes, fine by coarse, row-major.
CEED_EXTERN int CeedOperatorMultigridLevelCreateH1(CeedOperator op_fine, CeedVector p_mult_fine,
                                                   CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                                                   const CeedScalar *interp_c_to_f, CeedOperator *op_coarse,
                                                   CeedOperator *op_prolong, CeedOperator *op_restrict);
/// Inverse of each element of a single linear operator by fast diagonalisation, F = Σ_e R_e^T A_e^-1 R_e, for a
/// preconditioner. The active input and output have one tensor-product basis. A_e^-1 is exact for constant coefficients
/// of the mass and of the derivatives in each direction on elements that are boxes; else it is that of an operator with
/// the means of the diagonal of the assembled QFunction, positive definite where they are. Eigenvalues that vanish (to
/// 1e-12 of the element's largest), as that of the constants without mass, count as 1e-5 of the largest; an element on
/// which the operator vanishes gives zeros.
CEED_EXTERN int CeedOperatorCreateFDMElementInverse(CeedOperator op, CeedOperator *fdm_inv, CeedRequest *request);
/// The name that View prints and by which a composite is asked for its part; NULL takes it away.
CEED_EXTERN int CeedOperatorSetName(CeedOperator op, const char *name);
/// The name that was set; without one that of the operator's QFunction, and "" for a composite.
CEED_EXTERN int CeedOperatorGetName(CeedOperator op, const char **name);
CEED_EXTERN int CeedOperatorSetNumViewTabs(CeedOperator op, CeedInt num_tabs);
CEED_EXTERN int CeedOperatorGetNumViewTabs(CeedOperator op, CeedInt *num_tabs);
CEED_EXTERN int CeedOperatorView(CeedOperator op, FILE *stream);
CEED_EXTERN int CeedOperatorViewTerse(CeedOperator op, FILE *stream);
CEED_EXTERN int CeedOperatorGetCeed(CeedOperator op, Ceed *ceed);
CEED_EXTERN Ceed CeedOperatorReturnCeed(CeedOperator op);
CEED_EXTERN int CeedOperatorGetNumElements(CeedOperator op, CeedInt *num_elem);
/// Quadrature points of an element; at points the largest number of points of an element.
CEED_EXTERN int CeedOperatorGetNumQuadraturePoints(CeedOperator op, CeedInt *num_qpts);
/// Floating point operations of one application, as counted from the sizes of restrictions and bases and the
/// estimates given for the QFunctions.
CEED_EXTERN int CeedOperatorGetFlopsEstimate(CeedOperator op, CeedSize *flops);
/// Context of the QFunction; *ctx is NULL where it has none.
CEED_EXTERN int CeedOperatorGetContext(CeedOperator op, CeedQFunctionContext *ctx);
/// Label of a registered context field, for a composite operator of that field in all its sub-operators; *field_label
/// is NULL where there is none.
CEED_EXTERN int CeedOperatorGetContextFieldLabel(CeedOperator op, const char *field_name,
                                                 CeedContextFieldLabel *field_label);
CEED_EXTERN int CeedOperatorSetContextDouble(CeedOperator op, CeedContextFieldLabel field_label, double *values);
CEED_EXTERN int CeedOperatorGetContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                 size_t *num_values, const double **values);
CEED_EXTERN int CeedOperatorRestoreContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                     const double **values);
CEED_EXTERN int CeedOperatorSetContextInt32(CeedOperator op, CeedContextFieldLabel field_label, int32_t *values);
CEED_EXTERN int CeedOperatorGetContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label,
                                                size_t *num_values, const int32_t **values);
CEED_EXTERN int CeedOperatorRestoreContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label,
                                                    const int32_t **values);
CEED_EXTERN int CeedOperatorSetContextBoolean(CeedOperator op, CeedContextFieldLabel field_label, bool *values);
CEED_EXTERN int CeedOperatorGetContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                  size_t *num_values, const bool **values);
CEED_EXTERN int CeedOperatorRestoreContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                      const bool **values);
/// out = A in. CEED_VECTOR_NONE where there is no active input or output. Passive outputs are written.
CEED_EXTERN int CeedOperatorApply(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *request);
/// out += A in; passive outputs are added to as well.
CEED_EXTERN int CeedOperatorApplyAdd(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *request);
/// out += A in; passive outputs are written.
CEED_EXTERN int CeedOperatorApplyAddActive(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *request);
/// Frees what assemblies have kept.
CEED_EXTERN int CeedOperatorAssemblyDataStrip(CeedOperator op);
CEED_EXTERN int CeedOperatorDestroy(CeedOperator *op);
CEED_EXTERN int CeedOperatorGetFieldByName(CeedOperator op, const char *field_name, CeedOperatorField *op_field);
CEED_EXTERN int CeedOperatorFieldGetName(CeedOperatorField op_field, const char **field_name);
CEED_EXTERN int CeedOperatorFieldGetElemRestriction(CeedOperatorField op_field, CeedElemRestriction *rstr);
CEED_EXTERN int CeedOperatorFieldGetBasis(CeedOperatorField op_field, CeedBasis *basis);
CEED_EXTERN int CeedOperatorFieldGetVector(CeedOperatorField op_field, CeedVector *vec);
CEED_EXTERN int CeedOperatorFieldGetData(CeedOperatorField op_field, const char **field_name,
                                         CeedElemRestriction *rstr, CeedBasis *basis, CeedVector *vec);
/// @}

/// base to the power of `power` >= 0
static inline CeedInt CeedIntPow(CeedInt base, CeedInt power) {
  CeedInt product = 1;
  for (CeedInt i = 0; i < power; i++) product *= base;
  return product;
}
static inline CeedInt CeedIntMin(CeedInt a, CeedInt b) { return b < a ? b : a; }
static inline CeedInt CeedIntMax(CeedInt a, CeedInt b) { return a < b ? b : a; }

#include "deprecated.h"

#endif
