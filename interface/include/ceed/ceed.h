/// @file
/// The public C interface.
///
/// Every function returns a CeedErrorType as int, 0 for success, unless it says otherwise. On an error the handler of
/// the Ceed is called first (default: print and abort; see CeedSetErrorHandler()).
///
/// Different threads may use different objects of one Ceed. What is only read may be shared: their operators may stand on
/// the same restrictions, bases, QFunctions, contexts that are not writable (CeedQFunctionSetContextWritable()) and passive
/// inputs; any thread may copy a handle and drop it. What is written belongs to one thread at a time.
///
/// Vectors of operators: an L-vector holds one value for each degree of freedom of a process; an E-vector holds the
/// degrees of freedom of each element apart; a Q-vector holds values at the (quadrature or material) points. Lengths,
/// sizes and strides count entries of CeedScalar, unless bytes are named.
///
/// @par Arguments
/// The first argument is the object that a function is of. A function that makes an object (Create) or asks for
/// something (Get, Is, Has) stores the handle or the answer at its last argument. Addresses for answers and for new
/// handles, and what goes in, are not NULL unless a function says that they may be. These mean the same everywhere:
/// - `ceed`: the Ceed that a new object belongs to
/// - `mem_type`: where an array is; a backend that works on the host takes CEED_MEM_HOST alone
/// - `copy_mode`: what becomes of an array that is handed over
/// - `t_mode`: CEED_TRANSPOSE for the way from points to nodes, or from elements to the L-vector
/// - `eval_mode`: what of a field is meant: its values, a derivative, the weights
/// - `request`: CEED_REQUEST_IMMEDIATE or CEED_REQUEST_ORDERED, or NULL; with any, work is complete on return, or on
///   a device given to its stream: arrays on the host and norms are there when they are returned, arrays on the device
///   for what comes later in that stream
/// - `stream`: an open file, which is written to
/// - `num_tabs`: the steps, of two spaces each, by which View indents; 0 or more
///
/// @par Who ends what
/// Handles are counted. Handles passed in are counted by whoever keeps them: the caller may destroy its own at once.
/// - `*Create*`, `*ReferenceCopy`, `*Get*`: a handle that comes out is a counted reference, which the caller destroys
/// - `const char **`: a text that comes out belongs to the object, and is valid as long as that lives and the text is
///   not set again
///
/// @par Errors of all functions
/// - CEED_ERROR_INCOMPLETE: a handle, the address for an answer, or an array that is read, is NULL.
/// - CEED_ERROR_MAJOR: memory is short.
/// - CEED_ERROR_UNSUPPORTED: the backend does not do this.
/// - CEED_ERROR_BACKEND: the backend failed, or has no memory of this type.
///
/// What else may go wrong is said with each group and function. After an error all objects are as before, unless the
/// code is negative.
#ifndef CEED_CEED_H
#define CEED_CEED_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

#include "types.h"

/// Attribute of a function that the library exports; nothing where CEED_SKIP_VISIBILITY is defined.
#if defined(CEED_SKIP_VISIBILITY)
#define CEED_VISIBILITY(mode)
#else
#define CEED_VISIBILITY(mode) __attribute__((visibility(#mode)))
#endif

/// Opens the declaration of a function or of data that the library exports.
#ifdef __cplusplus
#define CEED_EXTERN extern "C" CEED_VISIBILITY(default)
#else
#define CEED_EXTERN extern CEED_VISIBILITY(default)
#endif

/// A backend with its resources; every other object belongs to one.
typedef struct Ceed_private *Ceed;
/// Marks work that has been started; none is left open at present.
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
/// What all objects have in common, for handles cast to CeedObject. Error CEED_ERROR_MINOR: an argument is out of range
/// or NULL.
/// @{

/// Prints the object in readable form, as its own View does.
CEED_EXTERN int CeedObjectView(CeedObject obj, FILE *stream);
/// Says how far View indents.
CEED_EXTERN int CeedObjectSetNumViewTabs(CeedObject obj, CeedInt num_tabs);
/// How far View indents; 0 for a new object.
CEED_EXTERN int CeedObjectGetNumViewTabs(CeedObject obj, CeedInt *num_tabs);
/// The Ceed of the object, as a counted reference.
CEED_EXTERN int CeedObjectGetCeed(CeedObject obj, Ceed *ceed);
/// The Ceed of the object, not counted: valid while the object lives. NULL where `obj` is.
CEED_EXTERN Ceed CeedObjectReturnCeed(CeedObject obj);
/// Drops one reference and sets *obj to NULL; a NULL handle is fine.
CEED_EXTERN int CeedObjectDestroy(CeedObject *obj);
/// @}

/// @defgroup Ceed Ceed
/// A Ceed is a backend that has been opened, and what its objects share. Errors: CEED_ERROR_MINOR: an argument is NULL
/// or empty; CEED_ERROR_MAJOR, CEED_ERROR_INCOMPATIBLE: the library's own backends could not be registered.
/// @{

/// Registered resources: *n names in *resources and their *n priorities in *array (lower is preferred). The caller
/// frees both arrays with free(), not the names, which live as long as the process. Each of the two may be NULL.
CEED_EXTERN int CeedRegistryGetList(size_t *n, char ***const resources, CeedInt **array);
/// Opens the backend whose name begins with `resource`, in whole components ("/cpu/self" opens "/cpu/self/ref/serial");
/// of several the one with the lowest priority that this machine can run. What follows a colon
/// ("/gpu/cuda:device_id=1") is passed on to the backend. "help:" before the name prints the resources to stderr. The
/// caller destroys *ceed, whose old value is not looked at. Backends on devices take the current device of the calling
/// thread (cudaSetDevice(), hipSetDevice()) where none is named, and make theirs the current one of whichever thread
/// uses them.
/// Error CEED_ERROR_MAJOR: no backend fits; the message lists those there are.
CEED_EXTERN int CeedInit(const char *resource, Ceed *ceed);
/// Stream `handle` (CUstream, hipStream_t) on which a device backend works from now on, after what was given to the one
/// before, for which this call does not wait. The caller keeps a stream alive until another one has been set, or the
/// Ceed is destroyed. Error CEED_ERROR_UNSUPPORTED: backends that work on the host take none.
CEED_EXTERN int CeedSetStream(Ceed ceed, void *handle);
/// Makes *ceed_copy another reference; what it held is dropped, so it is a live handle or NULL.
CEED_EXTERN int CeedReferenceCopy(Ceed ceed, Ceed *ceed_copy);
/// Full name of the backend; valid while the Ceed lives.
CEED_EXTERN int CeedGetResource(Ceed ceed, const char **resource);
/// Whether the same operator applied twice gives the same bits.
CEED_EXTERN int CeedIsDeterministic(Ceed ceed, bool *is_deterministic);
/// Adds `jit_source_root`, a folder in which backends that compile at run time look for included files.
CEED_EXTERN int CeedAddJitSourceRoot(Ceed ceed, const char *jit_source_root);
/// Adds `jit_define` ("NAME", "NAME=VALUE", or either after "-D") for QFunctions that are compiled at run time. Other
/// options, which begin with a dash, too, are given to compilers for the host alone.
CEED_EXTERN int CeedAddJitDefine(Ceed ceed, const char *jit_define);
/// Adds `rust_source_root`, the folder of a Rust package whose QFunctions are compiled when the program runs. Kept for
/// backends that do so.
CEED_EXTERN int CeedAddRustSourceRoot(Ceed ceed, const char *rust_source_root);
/// CeedObjectSetNumViewTabs() of a Ceed.
CEED_EXTERN int CeedSetNumViewTabs(Ceed ceed, CeedInt num_tabs);
/// CeedObjectGetNumViewTabs() of a Ceed.
CEED_EXTERN int CeedGetNumViewTabs(Ceed ceed, CeedInt *num_tabs);
/// Prints the resource and the preferred memory.
CEED_EXTERN int CeedView(Ceed ceed, FILE *stream);
/// Drops one reference and sets *ceed to NULL; the backend is closed when all objects of the Ceed are gone, too.
CEED_EXTERN int CeedDestroy(Ceed *ceed);
/// Version of the interface that this library implements.
#define CEED_VERSION_MAJOR 0
/// See CEED_VERSION_MAJOR.
#define CEED_VERSION_MINOR 12
/// See CEED_VERSION_MAJOR.
#define CEED_VERSION_PATCH 0
/// Whether this is a release of that version; false: of what follows it.
#define CEED_VERSION_RELEASE false
/// Whether the interface is at least the given version; an unreleased one counts as the newest.
#define CEED_VERSION_GE(major, minor, patch)                                                   \
  (!CEED_VERSION_RELEASE || CEED_VERSION_MAJOR > (major) ||                                    \
   (CEED_VERSION_MAJOR == (major) && (CEED_VERSION_MINOR > (minor) ||                          \
                                      (CEED_VERSION_MINOR == (minor) && CEED_VERSION_PATCH >= (patch)))))
/// Version `major`.`minor`.`patch` of the interface in the library that is loaded, and whether it is a `release`; any
/// pointer may be NULL. Never fails.
CEED_EXTERN int CeedGetVersion(int *major, int *minor, int *patch, bool *release);
/// Revision from which the library was built, or "unknown".
CEED_EXTERN int CeedGetGitVersion(const char **git_version);
/// Name, version, compiler and options of the library, several lines.
CEED_EXTERN int CeedGetBuildConfiguration(const char **build_config);
/// Says whether compilation for devices at run time is to use clang (`isClang`).
CEED_EXTERN int CeedSetIsClang(Ceed ceed, bool isClang);
/// What CeedSetIsClang() said; false for a new Ceed.
CEED_EXTERN int CeedGetIsClang(Ceed ceed, bool *isClang);
/// Precision of CeedScalar in the library that is loaded.
CEED_EXTERN int CeedGetScalarType(CeedScalarType *scalar_type);
/// Memory in which the backend works: arrays there are not copied.
CEED_EXTERN int CeedGetPreferredMemType(Ceed ceed, CeedMemType *type);
/// Loads the backends; done by the first call that needs them.
CEED_EXTERN int CeedRegisterAll(void);
/// Registers the gallery of QFunctions; done by the first call that needs it.
CEED_EXTERN int CeedQFunctionRegisterAll(void);
/// @}

/// @defgroup CeedError Errors
/// A message has the form `file:line in function(): message`, and goes to the handler of the Ceed that the failing
/// object belongs to; where there is none (CeedInit(), or a handle that is NULL), to that which the environment
/// variable CEED_ERROR_HANDLER names: `return`, `store`, `exit` or `abort`, the default.
///
/// Handlers have these arguments; those here always return `err_code`:
/// - `filename`, `line_no`, `func`: where the error was found
/// - `err_code`: the CeedErrorType
/// - `format`, `args`: the message, as for vprintf()
/// @{

/// Reports an error to the handler of the Ceed (of the process where it is NULL): file, line, function, code, format
/// and its arguments; use the macro CeedError(). Returns the code. One line, because bindings read this header line by
/// line.
CEED_EXTERN int CeedErrorImpl(Ceed, const char *, int, const char *, int, const char *, ...);
/// Reports an error from here; its value is the code.
#define CeedError(ceed, ecode, ...) \
  (CeedErrorImpl((ceed), __FILE__, __LINE__, __func__, (ecode), __VA_ARGS__), (ecode))
/// What is called on an error: Ceed, file, line, function, code, format, arguments. Its value is ignored.
typedef int (*CeedErrorHandler)(Ceed, const char *, int, const char *, int, const char *, va_list *);
/// Chooses the `handler`: CeedErrorReturn, CeedErrorStore, CeedErrorAbort, CeedErrorExit, or one's own. A new Ceed has
/// that of the environment. Error CEED_ERROR_MINOR: it is NULL.
CEED_EXTERN int CeedSetErrorHandler(Ceed ceed, CeedErrorHandler handler);
/// The message stored by CeedErrorStore(), or "No error message stored"; valid until it is reset. `ceed` may be NULL:
/// the message of this thread that came without a Ceed.
CEED_EXTERN int CeedGetErrorMessage(Ceed ceed, const char **err_msg);
/// Forgets the message that CeedGetErrorMessage() gives, and sets *err_msg to NULL.
CEED_EXTERN int CeedResetErrorMessage(Ceed ceed, const char **err_msg);
/// Handler that does nothing: the caller looks at the code.
CEED_EXTERN int CeedErrorReturn(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                                const char *format, va_list *args);
/// Handler that keeps the message for CeedGetErrorMessage().
CEED_EXTERN int CeedErrorStore(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                               const char *format, va_list *args);
/// Handler that prints the message to stderr and calls abort().
CEED_EXTERN int CeedErrorAbort(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                               const char *format, va_list *args);
/// Handler that prints the message to stderr and calls exit() with the code.
CEED_EXTERN int CeedErrorExit(Ceed ceed, const char *filename, int line_no, const char *func, int err_code,
                              const char *format, va_list *args);
/// @}

/// @defgroup CeedNames Names
/// Texts for the values of the enumerations, indexed by value; there is none between two values.
/// @{

/// Names of CeedErrorType, from -3 on.
CEED_EXTERN const char *const *CeedErrorTypes;
/// Names of CeedMemType.
CEED_EXTERN const char *const CeedMemTypes[];
/// Names of CeedCopyMode.
CEED_EXTERN const char *const CeedCopyModes[];
/// Names of CeedTransposeMode.
CEED_EXTERN const char *const CeedTransposeModes[];
/// Names of CeedEvalMode.
CEED_EXTERN const char *const CeedEvalModes[];
/// Names of CeedQuadMode.
CEED_EXTERN const char *const CeedQuadModes[];
/// Names of CeedElemTopology.
CEED_EXTERN const char *const CeedElemTopologies[];
/// Names of CeedContextFieldType.
CEED_EXTERN const char *const CeedContextFieldTypes[];
/// @}

/// @defgroup CeedVector Vectors
/// An array has one writer or many readers at a time. Errors:
/// - CEED_ERROR_ACCESS: a second writer, a reader beside a writer, destruction while an array is out, restoring what
///   was not granted, syncing or taking while locked. Functions that change a vector are writers, others readers.
/// - CEED_ERROR_INCOMPLETE: values are needed, and none were set.
/// - CEED_ERROR_DIMENSION: lengths differ, or an index or a range does not lie in the vector.
/// - CEED_ERROR_INCOMPATIBLE: CEED_VECTOR_ACTIVE or CEED_VECTOR_NONE stands where values are needed.
/// - CEED_ERROR_MINOR: an argument is NULL, or no value of its enumeration.
///
/// Ranges are the entries `start`, start + step, ... below `stop`, which is at most the length; a negative one stands
/// for it:
/// - `start`, `stop`, `step`: 0 <= start <= stop, step >= 1
/// @{

/// Stands for the input of CeedOperatorApply() and its output.
CEED_EXTERN const CeedVector CEED_VECTOR_ACTIVE;
/// For a field of quadrature weights, which needs no vector.
CEED_EXTERN const CeedVector CEED_VECTOR_NONE;
/// A vector of `len` >= 0 entries; it holds no values until they are set. The caller destroys *vec.
CEED_EXTERN int CeedVectorCreate(Ceed ceed, CeedSize len, CeedVector *vec);
/// Makes *vec_copy another reference; what it held is dropped, so it is a live handle or NULL.
CEED_EXTERN int CeedVectorReferenceCopy(CeedVector vec, CeedVector *vec_copy);
/// Copies the values to `vec_copy`; lengths are equal.
CEED_EXTERN int CeedVectorCopy(CeedVector vec, CeedVector vec_copy);
/// Copies the entries of a range, which lies in both vectors; the rest of `vec_copy`, which holds values, stays.
CEED_EXTERN int CeedVectorCopyStrided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step,
                                      CeedVector vec_copy);
/// Gives the vector an `array` of its length. Values are copied into the array in use, be it lent by the user.
/// CEED_USE_POINTER: the caller keeps the array alive until it is taken back or the vector is gone. CEED_OWN_POINTER:
/// the vector frees it with free().
CEED_EXTERN int CeedVectorSetArray(CeedVector vec, CeedMemType mem_type, CeedCopyMode copy_mode, CeedScalar *array);
/// Sets all entries to `value`.
CEED_EXTERN int CeedVectorSetValue(CeedVector vec, CeedScalar value);
/// Sets the entries of a range to `value`; the vector holds values.
CEED_EXTERN int CeedVectorSetValueStrided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step,
                                          CeedScalar value);
/// Makes the array that the user lent (CEED_USE_POINTER) hold the current values.
CEED_EXTERN int CeedVectorSyncArray(CeedVector vec, CeedMemType mem_type);
/// Takes back a lent array, with the current values of all entries; the vector keeps none. `array` may be NULL. Error
/// CEED_ERROR_INCOMPLETE: none was lent in this memory.
CEED_EXTERN int CeedVectorTakeArray(CeedVector vec, CeedMemType mem_type, CeedScalar **array);
/// Read and write access to all entries until CeedVectorRestoreArray(); the vector keeps the `array`.
CEED_EXTERN int CeedVectorGetArray(CeedVector vec, CeedMemType mem_type, CeedScalar **array);
/// Read access to all entries until CeedVectorRestoreArrayRead(); the vector keeps the `array`.
CEED_EXTERN int CeedVectorGetArrayRead(CeedVector vec, CeedMemType mem_type, const CeedScalar **array);
/// Write access until CeedVectorRestoreArray(): the contents are undefined and all of them must be written. The vector
/// needs no values before, and keeps the `array`.
CEED_EXTERN int CeedVectorGetArrayWrite(CeedVector vec, CeedMemType mem_type, CeedScalar **array);
/// Ends write access and sets *array to NULL; the array is the vector's again. `array` may be NULL, here and below.
CEED_EXTERN int CeedVectorRestoreArray(CeedVector vec, CeedScalar **array);
/// Ends a read access and sets *array to NULL; each Get has its own Restore.
CEED_EXTERN int CeedVectorRestoreArrayRead(CeedVector vec, const CeedScalar **array);
/// The `norm` of this `type`: Σ |x_i|, (Σ x_i^2)^(1/2) or max |x_i|; 0 for a vector without entries.
CEED_EXTERN int CeedVectorNorm(CeedVector vec, CeedNormType type, CeedScalar *norm);
/// x = alpha x
CEED_EXTERN int CeedVectorScale(CeedVector x, CeedScalar alpha);
/// Sets entries with |x_i| <= threshold to zero.
CEED_EXTERN int CeedVectorFilter(CeedVector x, CeedScalar threshold);
/// y = alpha x + y; error CEED_ERROR_UNSUPPORTED: x and y are one vector.
CEED_EXTERN int CeedVectorAXPY(CeedVector y, CeedScalar alpha, CeedVector x);
/// y = alpha x + beta y; error CEED_ERROR_UNSUPPORTED: x and y are one vector.
CEED_EXTERN int CeedVectorAXPBY(CeedVector y, CeedScalar alpha, CeedScalar beta, CeedVector x);
/// w_i = x_i y_i for w, x and y; any two or all three may be the same vector.
CEED_EXTERN int CeedVectorPointwiseMult(CeedVector w, CeedVector x, CeedVector y);
/// x_i = 1 / x_i where |x_i| > CEED_EPSILON; other entries stay.
CEED_EXTERN int CeedVectorReciprocal(CeedVector vec);
/// CeedObjectSetNumViewTabs() of a vector.
CEED_EXTERN int CeedVectorSetNumViewTabs(CeedVector vec, CeedInt num_tabs);
/// CeedObjectGetNumViewTabs() of a vector.
CEED_EXTERN int CeedVectorGetNumViewTabs(CeedVector vec, CeedInt *num_tabs);
/// Prints entries start, start+step, ... below stop (above it for a negative step; stop < 0: to the end) with the
/// printf format fp_fmt (NULL: "%g").
CEED_EXTERN int CeedVectorViewRange(CeedVector vec, CeedSize start, CeedSize stop, CeedInt step, const char *fp_fmt,
                                    FILE *stream);
/// Prints all entries with the printf format fp_fmt (NULL: "%g").
CEED_EXTERN int CeedVectorView(CeedVector vec, const char *fp_fmt, FILE *stream);
/// CeedObjectGetCeed() of a vector.
CEED_EXTERN int CeedVectorGetCeed(CeedVector vec, Ceed *ceed);
/// CeedObjectReturnCeed() of a vector: not counted.
CEED_EXTERN Ceed CeedVectorReturnCeed(CeedVector vec);
/// Number of entries.
CEED_EXTERN int CeedVectorGetLength(CeedVector vec, CeedSize *length);
/// Drops one reference and sets *vec to NULL; a NULL handle is fine.
CEED_EXTERN int CeedVectorDestroy(CeedVector *vec);

/// For the argument `request`: complete on return, or in the stream of a device.
CEED_EXTERN CeedRequest *const CEED_REQUEST_IMMEDIATE;
/// For the argument `request`: complete in the order of the calls.
CEED_EXTERN CeedRequest *const CEED_REQUEST_ORDERED;
/// Waits until the work of the request `req` is complete, and sets *req to NULL. Error CEED_ERROR_MINOR: `req` is NULL.
CEED_EXTERN int CeedRequestWait(CeedRequest *req);
/// @}

/// @defgroup CeedElemRestriction Element restrictions
/// An E-vector is laid out as (node, component, element), node fastest, unless the backend says otherwise. At points it
/// is (point, component), point fastest, for one element after another, each with its own number of points.
///
/// - `num_elem`: elements of this process; may be 0
/// - `elem_size`: nodes of an element; 1 or more
/// - `block_size`: elements of a block; 1 or more
/// - `num_comp`: components of a field; 1 or more
/// - `comp_stride`: entries of the L-vector from a component to the next; 1 or more for several components
/// - `l_size`: entries of the L-vector
/// - `offsets`, `orients`, `curl_orients`: tables on the host, for the nodes of each element. CEED_COPY_VALUES copies
///   them; CEED_USE_POINTER: the caller keeps them, unchanged, as long as the restriction lives; CEED_OWN_POINTER: the
///   restriction frees them with free(), if it comes to be
///
/// Errors:
/// - CEED_ERROR_DIMENSION: a size, an index or an entry of a table is out of range, or a vector is too short.
/// - CEED_ERROR_INCOMPATIBLE: CEED_ELEMRESTRICTION_NONE, or one that is not at points where points are asked for; input
///   and output are one vector; or one of them is CEED_VECTOR_ACTIVE or CEED_VECTOR_NONE.
/// - CEED_ERROR_INCOMPLETE: a vector that is read, or added to, holds no values.
/// - CEED_ERROR_ACCESS: an array of a vector is out; or offsets are, when the restriction is to be destroyed.
/// - CEED_ERROR_MINOR: an argument is NULL, or no value of its enumeration.
/// - CEED_ERROR_UNSUPPORTED: tables on a device.
/// @{

/// For a field of quadrature weights.
CEED_EXTERN const CeedElemRestriction CEED_ELEMRESTRICTION_NONE;
/// Strides by which the backend lays out E-vectors as it likes best; compared by value (three zeros).
CEED_EXTERN const CeedInt CEED_STRIDES_BACKEND[3];

/// Component c of node n in element e is at offsets[n + e*elem_size] + c*comp_stride in an L-vector of l_size entries.
/// `offsets`: num_elem * elem_size entries; every index they lead to must be in [0, l_size).
CEED_EXTERN int CeedElemRestrictionCreate(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                          CeedInt comp_stride, CeedSize l_size, CeedMemType mem_type,
                                          CeedCopyMode copy_mode, const CeedInt *offsets, CeedElemRestriction *rstr);
/// CeedElemRestrictionCreate() with a sign for each node, all components alike: orients[n + e*elem_size] is true where
/// the element has the opposite direction, as with the fluxes of H(div). `orients` is treated as `offsets` is.
CEED_EXTERN int CeedElemRestrictionCreateOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                                  CeedInt comp_stride, CeedSize l_size, CeedMemType mem_type,
                                                  CeedCopyMode copy_mode, const CeedInt *offsets, const bool *orients,
                                                  CeedElemRestriction *rstr);
/// CeedElemRestrictionCreate() with a tridiagonal matrix T for each element, all components alike, as tangents on the
/// faces of H(curl) need: the element's values are T times those that the offsets pick, and T^T goes the other way.
/// T(n,n-1), T(n,n), T(n,n+1) are curl_orients[3*(n + e*elem_size) + 0, 1, 2]; the two outside of T have no meaning.
/// `curl_orients` is treated as `offsets` is.
CEED_EXTERN int CeedElemRestrictionCreateCurlOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size,
                                                      CeedInt num_comp, CeedInt comp_stride, CeedSize l_size,
                                                      CeedMemType mem_type, CeedCopyMode copy_mode,
                                                      const CeedInt *offsets, const CeedInt8 *curl_orients,
                                                      CeedElemRestriction *rstr);
/// Component c of node n in element e is at n*strides[0] + c*strides[1] + e*strides[2], in [0, l_size).
/// CEED_STRIDES_BACKEND leaves them to the backend. `strides` are copied.
CEED_EXTERN int CeedElemRestrictionCreateStrided(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                                 CeedSize l_size, const CeedInt strides[3], CeedElemRestriction *rstr);
/// CeedElemRestrictionCreate() in blocks of block_size elements, whose values lie next to each other in the E-vector:
/// with B = block_size, node n of component c of element e is at (n*B + e%B)*layout[0] + c*B*layout[1] +
/// (e/B)*B*layout[2], the layout that of CeedElemRestrictionGetELayout(). A last block that is not full is filled by
/// copies of the last element; the transposed restriction does not read them. The arguments are those of the
/// restriction without blocks.
CEED_EXTERN int CeedElemRestrictionCreateBlocked(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt block_size,
                                                 CeedInt num_comp, CeedInt comp_stride, CeedSize l_size,
                                                 CeedMemType mem_type, CeedCopyMode copy_mode, const CeedInt *offsets,
                                                 CeedElemRestriction *rstr);
/// CeedElemRestrictionCreateOriented() in blocks.
CEED_EXTERN int CeedElemRestrictionCreateBlockedOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size,
                                                         CeedInt block_size, CeedInt num_comp, CeedInt comp_stride,
                                                         CeedSize l_size, CeedMemType mem_type, CeedCopyMode copy_mode,
                                                         const CeedInt *offsets, const bool *orients,
                                                         CeedElemRestriction *rstr);
/// CeedElemRestrictionCreateCurlOriented() in blocks.
CEED_EXTERN int CeedElemRestrictionCreateBlockedCurlOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size,
                                                             CeedInt block_size, CeedInt num_comp, CeedInt comp_stride,
                                                             CeedSize l_size, CeedMemType mem_type,
                                                             CeedCopyMode copy_mode, const CeedInt *offsets,
                                                             const CeedInt8 *curl_orients, CeedElemRestriction *rstr);
/// CeedElemRestrictionCreateStrided() in blocks; `strides` are those without blocks.
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
/// Makes *rstr_copy another reference; what it held is dropped, so it is a live handle or NULL.
CEED_EXTERN int CeedElemRestrictionReferenceCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_copy);
/// Vectors of the lengths of an L-vector (`lvec`) and of an E-vector (`evec`); either may be NULL, and is not made
/// then.
CEED_EXTERN int CeedElemRestrictionCreateVector(CeedElemRestriction rstr, CeedVector *lvec, CeedVector *evec);
/// CEED_NOTRANSPOSE: E-vector `ru` = R `u`. CEED_TRANSPOSE: L-vector ru += R^T u. The vectors may be longer than
/// needed; what is beyond stays.
CEED_EXTERN int CeedElemRestrictionApply(CeedElemRestriction rstr, CeedTransposeMode t_mode, CeedVector u,
                                         CeedVector ru, CeedRequest *request);
/// CeedElemRestrictionApply() for one `block` of elements, [0, number of blocks): the E-vector, `ru` or `u`, holds that
/// block, (element, node, component), element fastest, and may be longer. Without blocks, and at points, each element
/// is a block.
CEED_EXTERN int CeedElemRestrictionApplyBlock(CeedElemRestriction rstr, CeedInt block, CeedTransposeMode t_mode,
                                              CeedVector u, CeedVector ru, CeedRequest *request);
/// CeedElemRestrictionApply() for the points of the element `elem`: its vector, `ru` or `u`, holds component c of its
/// point p at [c*num_points + p], with the element's own num_points, and may be longer than that.
CEED_EXTERN int CeedElemRestrictionApplyAtPointsInElement(CeedElemRestriction rstr, CeedInt elem,
                                                          CeedTransposeMode t_mode, CeedVector u, CeedVector ru,
                                                          CeedRequest *request);
/// CeedObjectGetCeed() of a restriction.
CEED_EXTERN int CeedElemRestrictionGetCeed(CeedElemRestriction rstr, Ceed *ceed);
/// CeedObjectReturnCeed() of a restriction: not counted.
CEED_EXTERN Ceed CeedElemRestrictionReturnCeed(CeedElemRestriction rstr);
/// Entries of the L-vector from a component to the next; 1 at points, 0 for strided ones.
CEED_EXTERN int CeedElemRestrictionGetCompStride(CeedElemRestriction rstr, CeedInt *comp_stride);
/// Number of elements.
CEED_EXTERN int CeedElemRestrictionGetNumElements(CeedElemRestriction rstr, CeedInt *num_elem);
/// Nodes of an element; at points the largest number of points of an element.
CEED_EXTERN int CeedElemRestrictionGetElementSize(CeedElemRestriction rstr, CeedInt *elem_size);
/// Number of points, as it was given. Error CEED_ERROR_INCOMPATIBLE, here and below: it has no points.
CEED_EXTERN int CeedElemRestrictionGetNumPoints(CeedElemRestriction rstr, CeedInt *num_points);
/// Number of points of the element `elem`.
CEED_EXTERN int CeedElemRestrictionGetNumPointsInElement(CeedElemRestriction rstr, CeedInt elem, CeedInt *num_points);
/// Largest number of points of an element; 0 without elements.
CEED_EXTERN int CeedElemRestrictionGetMaxPointsInElement(CeedElemRestriction rstr, CeedInt *max_points);
/// Smallest number of points of an element; 0 without elements.
CEED_EXTERN int CeedElemRestrictionGetMinPointsInElement(CeedElemRestriction rstr, CeedInt *min_points);
/// Both, at once: `min_points` and `max_points` may be NULL.
CEED_EXTERN int CeedElemRestrictionGetMinMaxPointsInElement(CeedElemRestriction rstr, CeedInt *min_points,
                                                            CeedInt *max_points);
/// Entries of the L-vector.
CEED_EXTERN int CeedElemRestrictionGetLVectorSize(CeedElemRestriction rstr, CeedSize *l_size);
/// Entries of the E-vector, with the copies that fill the last block.
CEED_EXTERN int CeedElemRestrictionGetEVectorSize(CeedElemRestriction rstr, CeedSize *e_size);
/// Number of components.
CEED_EXTERN int CeedElemRestrictionGetNumComponents(CeedElemRestriction rstr, CeedInt *num_comp);
/// Number of blocks, the last one perhaps not full; that of elements where they are in no blocks.
CEED_EXTERN int CeedElemRestrictionGetNumBlocks(CeedElemRestriction rstr, CeedInt *num_block);
/// Elements of a block; 1 without blocks.
CEED_EXTERN int CeedElemRestrictionGetBlockSize(CeedElemRestriction rstr, CeedInt *block_size);
/// mult_i = number of element nodes that refer to entry i of the L-vector, whatever their orientation. `mult` has
/// l_size entries or more, and needs no values; those beyond become 0.
CEED_EXTERN int CeedElemRestrictionGetMultiplicity(CeedElemRestriction rstr, CeedVector mult);
/// CeedObjectSetNumViewTabs() of a restriction.
CEED_EXTERN int CeedElemRestrictionSetNumViewTabs(CeedElemRestriction rstr, CeedInt num_tabs);
/// CeedObjectGetNumViewTabs() of a restriction.
CEED_EXTERN int CeedElemRestrictionGetNumViewTabs(CeedElemRestriction rstr, CeedInt *num_tabs);
/// Prints kind and sizes, one line.
CEED_EXTERN int CeedElemRestrictionView(CeedElemRestriction rstr, FILE *stream);
/// Drops one reference and sets *rstr to NULL; a NULL handle is fine.
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
///
/// - `num_comp`: components of a field; 1 or more
/// - `num_elem`: elements that are evaluated; 0 or more
/// - `topo`: shape of the element, which says its dimension
/// - `num_nodes`, `nqpts`: degrees of freedom of an element and component, quadrature points of an element; 1 or more
/// - `interp`, `q_ref`, `q_weights`: values of the basis functions, the quadrature points and their weights; copied
/// - `u`, `v`: two vectors with the arrays above, as long as they need to be or longer; all of `u` that is read has
///   values
///
/// Errors:
/// - CEED_ERROR_DIMENSION: a size is out of range, or a vector is too short.
/// - CEED_ERROR_INCOMPATIBLE: CEED_BASIS_NONE; u and v are one vector, or CEED_VECTOR_ACTIVE or CEED_VECTOR_NONE.
/// - CEED_ERROR_UNSUPPORTED: the space, or this basis, has no such evaluation mode, or no transpose of it.
/// - CEED_ERROR_MINOR: a tensor product is needed; or columns of a matrix that is to be inverted depend on each other.
/// @{

/// For fields that are used as they are stored at the points.
CEED_EXTERN const CeedBasis CEED_BASIS_NONE;
/// Lagrange basis of degree P-1 on Gauss-Lobatto nodes (P = 1: the constant) with Q points a direction, of the family
/// `quad_mode`. dim 1 to 3, P >= 1, Q >= 1 (>= 2 for Gauss-Lobatto points).
CEED_EXTERN int CeedBasisCreateTensorH1Lagrange(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P, CeedInt Q,
                                                CeedQuadMode quad_mode, CeedBasis *basis);
/// Tensor-product basis from 1D matrices `interp_1d` and `grad_1d` (row-major, Q_1d by P_1d), points `q_ref_1d` and
/// weights `q_weight_1d` (Q_1d); all are copied. dim 1 to 3. Away from the quadrature points its functions are the
/// polynomials of degree Q_1d - 1 through the values there.
CEED_EXTERN int CeedBasisCreateTensorH1(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P_1d, CeedInt Q_1d,
                                        const CeedScalar *interp_1d, const CeedScalar *grad_1d,
                                        const CeedScalar *q_ref_1d, const CeedScalar *q_weight_1d, CeedBasis *basis);
/// Basis in H^1 from full matrices for an element of any shape: `interp` (nqpts by num_nodes) and `grad` (dim by nqpts
/// by num_nodes). q_ref (point, direction; point fastest) and q_weights may be NULL and are then zero; the derivative
/// may be NULL, and then cannot be evaluated. num_comp copies of the space, num_nodes degrees of freedom each. All is
/// copied.
CEED_EXTERN int CeedBasisCreateH1(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes, CeedInt nqpts,
                                  const CeedScalar *interp, const CeedScalar *grad, const CeedScalar *q_ref,
                                  const CeedScalar *q_weights, CeedBasis *basis);
/// The same in H(div): `interp` is dim by nqpts by num_nodes, `div` nqpts by num_nodes.
CEED_EXTERN int CeedBasisCreateHdiv(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes,
                                    CeedInt nqpts, const CeedScalar *interp, const CeedScalar *div,
                                    const CeedScalar *q_ref, const CeedScalar *q_weights, CeedBasis *basis);
/// The same in H(curl): `interp` is dim by nqpts by num_nodes, `curl` that in three dimensions, else nqpts by
/// num_nodes.
CEED_EXTERN int CeedBasisCreateHcurl(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes,
                                     CeedInt nqpts, const CeedScalar *interp, const CeedScalar *curl,
                                     const CeedScalar *q_ref, const CeedScalar *q_weights, CeedBasis *basis);
/// Basis that takes degrees of freedom of `basis_from` to those of `basis_to`, which are its quadrature points: interp
/// = interp_to^+ interp_from, and in H^1 grad = interp_to^+ grad_from, with the pseudoinverse interp_to^+. Both are in
/// one kind of space and share their quadrature points, at which those of `basis_to` are independent; tensor products
/// or not. It has the components of `basis_from`, is in H^1 (degrees of freedom are numbers), is a tensor product where
/// both are, and has no points or weights: zeros. From H(div) and H(curl) it has no derivative. The caller destroys
/// *basis_project. Error CEED_ERROR_MINOR: degrees of freedom of `basis_to` depend on each other at the points.
CEED_EXTERN int CeedBasisCreateProjection(CeedBasis basis_from, CeedBasis basis_to, CeedBasis *basis_project);
/// Makes *basis_copy another reference; what it held is dropped, so it is a live handle or NULL.
CEED_EXTERN int CeedBasisReferenceCopy(CeedBasis basis, CeedBasis *basis_copy);
/// CeedObjectSetNumViewTabs() of a basis.
CEED_EXTERN int CeedBasisSetNumViewTabs(CeedBasis basis, CeedInt num_tabs);
/// CeedObjectGetNumViewTabs() of a basis.
CEED_EXTERN int CeedBasisGetNumViewTabs(CeedBasis basis, CeedInt *num_tabs);
/// Prints sizes, points, weights and matrices.
CEED_EXTERN int CeedBasisView(CeedBasis basis, FILE *stream);
/// v = B u from nodes to quadrature points, or v = B^T u back (then all of v is set, also what lies beyond num_elem
/// elements). For CEED_EVAL_WEIGHT, which has no transpose, u is CEED_VECTOR_NONE. Vectors may be longer than needed.
CEED_EXTERN int CeedBasisApply(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode,
                               CeedVector u, CeedVector v);
/// v += B^T u; only CEED_TRANSPOSE.
CEED_EXTERN int CeedBasisApplyAdd(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode,
                                  CeedVector u, CeedVector v);
/// CeedBasisApply() at num_points[e] >= 0 arbitrary points of element e, with reference coordinates x_ref: (point,
/// direction), point fastest, within an element. x_ref and the values and derivatives of element e start after those of
/// the points of all elements before it. Weights at points are 1. Error CEED_ERROR_UNSUPPORTED for bases that are known
/// at their quadrature points alone: those without tensor product, and those from the user's matrices with Q_1d < P_1d,
/// which determine no polynomial.
CEED_EXTERN int CeedBasisApplyAtPoints(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points,
                                       CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector x_ref,
                                       CeedVector u, CeedVector v);
/// v += B^T u at such points; only CEED_TRANSPOSE. `num_points` and `x_ref` are those of CeedBasisApplyAtPoints().
CEED_EXTERN int CeedBasisApplyAddAtPoints(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points,
                                          CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector x_ref,
                                          CeedVector u, CeedVector v);
/// CeedObjectGetCeed() of a basis.
CEED_EXTERN int CeedBasisGetCeed(CeedBasis basis, Ceed *ceed);
/// CeedObjectReturnCeed() of a basis: not counted.
CEED_EXTERN Ceed CeedBasisReturnCeed(CeedBasis basis);
/// Dimension of the element, 1 to 3.
CEED_EXTERN int CeedBasisGetDimension(CeedBasis basis, CeedInt *dim);
/// Shape of the element.
CEED_EXTERN int CeedBasisGetTopology(CeedBasis basis, CeedElemTopology *topo);
/// Number of components.
CEED_EXTERN int CeedBasisGetNumComponents(CeedBasis basis, CeedInt *num_comp);
/// Degrees of freedom of an element, for one component.
CEED_EXTERN int CeedBasisGetNumNodes(CeedBasis basis, CeedInt *P);
/// Degrees of freedom in a direction, of tensor products alone.
CEED_EXTERN int CeedBasisGetNumNodes1D(CeedBasis basis, CeedInt *P_1d);
/// Quadrature points of an element.
CEED_EXTERN int CeedBasisGetNumQuadraturePoints(CeedBasis basis, CeedInt *Q);
/// Quadrature points in a direction, of tensor products alone.
CEED_EXTERN int CeedBasisGetNumQuadraturePoints1D(CeedBasis basis, CeedInt *Q_1d);
/// Reference coordinates of the quadrature points: Q_1d of them for tensor bases, else (point, direction), point
/// fastest. The basis keeps them.
CEED_EXTERN int CeedBasisGetQRef(CeedBasis basis, const CeedScalar **q_ref);
/// Quadrature weights: Q_1d of them for tensor bases, else Q. The basis keeps them.
CEED_EXTERN int CeedBasisGetQWeights(CeedBasis basis, const CeedScalar **q_weights);
/// Values at the quadrature points, q_comp by Q by num_nodes, of tensor bases too; the basis keeps the matrix.
CEED_EXTERN int CeedBasisGetInterp(CeedBasis basis, const CeedScalar **interp);
/// Values in one direction, Q_1d by P_1d, of tensor bases alone; the basis keeps the matrix.
CEED_EXTERN int CeedBasisGetInterp1D(CeedBasis basis, const CeedScalar **interp_1d);
/// Gradients, dim by Q by num_nodes; the basis keeps the matrix. Error CEED_ERROR_UNSUPPORTED, here and below: it has
/// none.
CEED_EXTERN int CeedBasisGetGrad(CeedBasis basis, const CeedScalar **grad);
/// Derivatives in one direction, Q_1d by P_1d, of tensor bases alone; the basis keeps the matrix.
CEED_EXTERN int CeedBasisGetGrad1D(CeedBasis basis, const CeedScalar **grad_1d);
/// Divergences, Q by num_nodes; the basis keeps the matrix.
CEED_EXTERN int CeedBasisGetDiv(CeedBasis basis, const CeedScalar **div);
/// Curls, q_comp by Q by num_nodes; the basis keeps the matrix.
CEED_EXTERN int CeedBasisGetCurl(CeedBasis basis, const CeedScalar **curl);
/// Drops one reference and sets *basis to NULL; a NULL handle is fine.
CEED_EXTERN int CeedBasisDestroy(CeedBasis *basis);
/// Q >= 1 Gauss points q_ref_1d, ascending, and weights q_weight_1d on [-1,1], exact to degree 2Q-1; the weights may be
/// NULL.
CEED_EXTERN int CeedGaussQuadrature(CeedInt Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d);
/// Q >= 2 Gauss-Lobatto points q_ref_1d, ascending, and weights q_weight_1d on [-1,1], exact to degree 2Q-3; the
/// weights may be NULL.
CEED_EXTERN int CeedLobattoQuadrature(CeedInt Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d);
/// @}

/// @defgroup CeedQFunction QFunctions
/// The pointwise function of an operator: from the values of its input fields at a point it makes those of its outputs.
///
/// Errors:
/// - CEED_ERROR_DIMENSION: a size or number of points is out of range, or a vector is too short.
/// - CEED_ERROR_INCOMPATIBLE: the QFunction is CEED_QFUNCTION_NONE.
/// - CEED_ERROR_MINOR: an argument is NULL, a name is taken, or an evaluation mode is none.
/// - CEED_ERROR_MAJOR: fields are added after it was used by an operator, applied, or asked for its fields.
/// - CEED_ERROR_ACCESS: fields are added to one of the gallery that counts components, while its context is in use.
/// @{

/// For the linearisations that CeedOperatorCreate() does not need.
CEED_EXTERN const CeedQFunction CEED_QFUNCTION_NONE;
/// The function itself: in[i] and out[i] hold component c of point q at [c*Q + q]. It returns 0, or an error code.
typedef int (*CeedQFunctionUser)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out);
/// A QFunction that calls `f`. vec_length: the Q that the function is called with is a multiple of it; 1 or more.
/// `source`: "file:function", as the macro CEED_QFUNCTION makes it in `<name>_loc`, for backends that compile it again;
/// may be NULL.
CEED_EXTERN int CeedQFunctionCreateInterior(Ceed ceed, CeedInt vec_length, CeedQFunctionUser f, const char *source,
                                            CeedQFunction *qf);
/// The QFunction of the gallery with this `name`, and its fields: Mass1DBuild (2D, 3D), MassApply, Vector3MassApply,
/// Poisson1DBuild (2D, 3D), Poisson1DApply (2D, 3D), Vector3Poisson1DApply (2D, 3D), and those to which the caller adds
/// fields: Identity, Identity to scalar, Scale, Scale (scalar). Error CEED_ERROR_UNSUPPORTED: there is none of this
/// name; the message lists them.
CEED_EXTERN int CeedQFunctionCreateInteriorByName(Ceed ceed, const char *name, CeedQFunction *qf);
/// A QFunction that copies `size` components from field "input", of mode `in_mode`, to field "output", of mode
/// `out_mode`.
CEED_EXTERN int CeedQFunctionCreateIdentity(Ceed ceed, CeedInt size, CeedEvalMode in_mode, CeedEvalMode out_mode,
                                            CeedQFunction *qf);
/// Makes *qf_copy another reference; what it held is dropped, so it is a live handle or NULL.
CEED_EXTERN int CeedQFunctionReferenceCopy(CeedQFunction qf, CeedQFunction *qf_copy);
/// Adds an input, `field_name`. size: values at a point: components for NONE, times
/// CeedBasisGetNumQuadratureComponents() for modes that a basis evaluates (dim for GRAD), 1 for WEIGHT. Value
/// d*num_comp + c of a gradient is the derivative of component c in direction d.
CEED_EXTERN int CeedQFunctionAddInput(CeedQFunction qf, const char *field_name, CeedInt size, CeedEvalMode eval_mode);
/// Adds an output, `field_name`, of `size` values at a point; of any mode but CEED_EVAL_WEIGHT.
CEED_EXTERN int CeedQFunctionAddOutput(CeedQFunction qf, const char *field_name, CeedInt size, CeedEvalMode eval_mode);
/// The fields, `num_input_fields` of them in *input_fields and `num_output_fields` in *output_fields, in the order in
/// which they were added. The QFunction keeps the lists and the fields, and can take no more of them. Any pointer may
/// be NULL.
CEED_EXTERN int CeedQFunctionGetFields(CeedQFunction qf, CeedInt *num_input_fields, CeedQFunctionField **input_fields,
                                       CeedInt *num_output_fields, CeedQFunctionField **output_fields);
/// Gives the function the data `ctx`; NULL: none. The context is counted.
CEED_EXTERN int CeedQFunctionSetContext(CeedQFunction qf, CeedQFunctionContext ctx);
/// Promise that the function only reads its context (`is_writable` is false); the default is true, in the gallery
/// false.
CEED_EXTERN int CeedQFunctionSetContextWritable(CeedQFunction qf, bool is_writable);
/// Floating point operations at a point, `flops` >= 0, for CeedOperatorGetFlopsEstimate(). Error
/// CEED_ERROR_INCOMPATIBLE: fewer.
CEED_EXTERN int CeedQFunctionSetUserFlopsEstimate(CeedQFunction qf, CeedSize flops);
/// CeedObjectSetNumViewTabs() of a QFunction.
CEED_EXTERN int CeedQFunctionSetNumViewTabs(CeedQFunction qf, CeedInt num_tabs);
/// CeedObjectGetNumViewTabs() of a QFunction.
CEED_EXTERN int CeedQFunctionGetNumViewTabs(CeedQFunction qf, CeedInt *num_tabs);
/// Prints the name and the fields.
CEED_EXTERN int CeedQFunctionView(CeedQFunction qf, FILE *stream);
/// CeedObjectGetCeed() of a QFunction.
CEED_EXTERN int CeedQFunctionGetCeed(CeedQFunction qf, Ceed *ceed);
/// CeedObjectReturnCeed() of a QFunction: not counted.
CEED_EXTERN Ceed CeedQFunctionReturnCeed(CeedQFunction qf);
/// Calls the function at Q points; u and v hold a vector of the caller's, which keeps it, for each input and output: Q
/// times the size of the field or more entries, component c of point q at [c*Q + q]. Q is a multiple of vec_length. It
/// returns the code of the function where that fails.
CEED_EXTERN int CeedQFunctionApply(CeedQFunction qf, CeedInt Q, CeedVector *u, CeedVector *v);
/// Drops one reference and sets *qf to NULL; a NULL handle is fine.
CEED_EXTERN int CeedQFunctionDestroy(CeedQFunction *qf);
/// Name of a field. Functions of a field fail where that is NULL, with CEED_ERROR_INCOMPLETE.
CEED_EXTERN int CeedQFunctionFieldGetName(CeedQFunctionField qf_field, const char **field_name);
/// Values of the field at a point.
CEED_EXTERN int CeedQFunctionFieldGetSize(CeedQFunctionField qf_field, CeedInt *size);
/// Evaluation mode of the field.
CEED_EXTERN int CeedQFunctionFieldGetEvalMode(CeedQFunctionField qf_field, CeedEvalMode *eval_mode);
/// All three at once: `field_name`, `size` and `eval_mode` may be NULL.
CEED_EXTERN int CeedQFunctionFieldGetData(CeedQFunctionField qf_field, const char **field_name, CeedInt *size,
                                          CeedEvalMode *eval_mode);
/// @}

/// @defgroup CeedQFunctionContext QFunction contexts
/// User data that a QFunction receives by its pointer ctx. Fields of the data can be registered with a name, and then
/// be set and read through a label, also in the contexts of operators that are in use.
///
/// The access rules are those of a vector: one writer, or many readers.
/// - `field_name`, `field_description`: copied; the description may be NULL
/// - `field_offset`: bytes from the start of the data to the first value
/// - `num_values`: values of the field, one after another; 1 or more
/// - `data`: where a function gives the data: the address of a pointer
///
/// Errors:
/// - CEED_ERROR_ACCESS: the data are in use, or were not.
/// - CEED_ERROR_INCOMPLETE: there are no data.
/// - CEED_ERROR_DIMENSION: a field does not lie in the data.
/// - CEED_ERROR_MINOR: an argument is NULL or empty, or no value of its enumeration.
/// - CEED_ERROR_UNSUPPORTED: the data of CEED_MEM_DEVICE; a name that is taken; a label of another object or type.
/// - CEED_ERROR_MAJOR: the function that destroys the data has failed.
/// @{

/// Frees the data of a context; returns 0, or an error code.
typedef int (*CeedQFunctionContextDataDestroyUser)(void *data);
/// A context without data.
CEED_EXTERN int CeedQFunctionContextCreate(Ceed ceed, CeedQFunctionContext *ctx);
/// Makes *ctx_copy another reference; what it held is dropped, so it is a live handle or NULL.
CEED_EXTERN int CeedQFunctionContextReferenceCopy(CeedQFunctionContext ctx, CeedQFunctionContext *ctx_copy);
/// Gives the context `size` bytes at `data`, in place of those it had. CEED_USE_POINTER: the caller keeps them alive
/// until they are taken back or the context is gone. CEED_OWN_POINTER: the context frees them with free().
CEED_EXTERN int CeedQFunctionContextSetData(CeedQFunctionContext ctx, CeedMemType mem_type, CeedCopyMode copy_mode,
                                            size_t size, void *data);
/// Takes back data that were lent with CEED_USE_POINTER; the context keeps none. `data` may be NULL. Error
/// CEED_ERROR_INCOMPLETE: none were lent.
CEED_EXTERN int CeedQFunctionContextTakeData(CeedQFunctionContext ctx, CeedMemType mem_type, void *data);
/// Read and write access until CeedQFunctionContextRestoreData().
CEED_EXTERN int CeedQFunctionContextGetData(CeedQFunctionContext ctx, CeedMemType mem_type, void *data);
/// Read access until CeedQFunctionContextRestoreDataRead().
CEED_EXTERN int CeedQFunctionContextGetDataRead(CeedQFunctionContext ctx, CeedMemType mem_type, void *data);
/// Ends write access and sets the pointer to NULL; `data` may be NULL.
CEED_EXTERN int CeedQFunctionContextRestoreData(CeedQFunctionContext ctx, void *data);
/// Ends a read access and sets the pointer to NULL; `data` may be NULL.
CEED_EXTERN int CeedQFunctionContextRestoreDataRead(CeedQFunctionContext ctx, void *data);
/// Registers a field of doubles. The name is new. It may come before the data; then it is checked when it is used.
CEED_EXTERN int CeedQFunctionContextRegisterDouble(CeedQFunctionContext ctx, const char *field_name,
                                                   size_t field_offset, size_t num_values,
                                                   const char *field_description);
/// Registers a field of int32_t.
CEED_EXTERN int CeedQFunctionContextRegisterInt32(CeedQFunctionContext ctx, const char *field_name,
                                                  size_t field_offset, size_t num_values,
                                                  const char *field_description);
/// Registers a field of bool.
CEED_EXTERN int CeedQFunctionContextRegisterBoolean(CeedQFunctionContext ctx, const char *field_name,
                                                    size_t field_offset, size_t num_values,
                                                    const char *field_description);
/// The labels of all fields, `num_fields` of them in *field_labels, in the order of registration. The context keeps the
/// list and the labels. Either pointer may be NULL.
CEED_EXTERN int CeedQFunctionContextGetAllFieldLabels(CeedQFunctionContext ctx,
                                                      const CeedContextFieldLabel **field_labels, CeedInt *num_fields);
/// What was registered: `field_name`, `field_offset` (SIZE_MAX for the label of a composite operator), `num_values`,
/// `field_description` and `field_type`; any pointer may be NULL. The texts live as long as the label.
CEED_EXTERN int CeedContextFieldLabelGetDescription(CeedContextFieldLabel label, const char **field_name,
                                                    size_t *field_offset, size_t *num_values,
                                                    const char **field_description, CeedContextFieldType *field_type);
/// Bytes of the data that were set last; 0 before.
CEED_EXTERN int CeedQFunctionContextGetContextSize(CeedQFunctionContext ctx, size_t *ctx_size);
/// CeedObjectSetNumViewTabs() of a context.
CEED_EXTERN int CeedQFunctionContextSetNumViewTabs(CeedQFunctionContext ctx, CeedInt num_tabs);
/// CeedObjectGetNumViewTabs() of a context.
CEED_EXTERN int CeedQFunctionContextGetNumViewTabs(CeedQFunctionContext ctx, CeedInt *num_tabs);
/// Prints the size of the data and the registered fields.
CEED_EXTERN int CeedQFunctionContextView(CeedQFunctionContext ctx, FILE *stream);
/// `f` is called with the data (in memory of type f_mem_type) before the context frees or forgets it; NULL: nothing is.
CEED_EXTERN int CeedQFunctionContextSetDataDestroy(CeedQFunctionContext ctx, CeedMemType f_mem_type,
                                                   CeedQFunctionContextDataDestroyUser f);
/// Drops one reference and sets *ctx to NULL; a NULL handle is fine.
CEED_EXTERN int CeedQFunctionContextDestroy(CeedQFunctionContext *ctx);
/// @}

/// @defgroup CeedOperator Operators
/// A = Σ_e R^T B^T D B R: restrictions R, bases B and a QFunction D, composed; or a sum of such operators. Active
/// fields are those whose vector is CEED_VECTOR_ACTIVE: they belong to the argument of an application and to its
/// result. Passive ones have a vector of their own.
///
/// - `field_name`: name of a field of the QFunction, or of a registered field of its context
/// - `field_label`: a label of this operator, from CeedOperatorGetContextFieldLabel()
/// - `in`, `out`: L-vectors of exactly the lengths that CeedOperatorGetActiveVectorLengths() tells; CEED_VECTOR_NONE
///   where there is no active input or output
///
/// Errors:
/// - CEED_ERROR_INCOMPLETE: a field is not set, points are missing, or a vector that is read holds no values.
/// - CEED_ERROR_DIMENSION: sizes of fields, objects or vectors do not fit.
/// - CEED_ERROR_INCOMPATIBLE: objects that do not belong together, such as a basis for CEED_EVAL_NONE, one vector for
///   input and output, several lengths of active vectors; assembly without an active input and an active output.
/// - CEED_ERROR_MINOR: a composite operator where a single one is asked for, or the other way; a field that was set
///   before; an argument is NULL.
/// - CEED_ERROR_MAJOR: a composite is added to after it was used, or its parts have active vectors of several lengths;
///   no memory for an assembly.
/// - CEED_ERROR_ACCESS: an array of a vector, or the data of a context, is out.
/// - CEED_ERROR_UNSUPPORTED: a mode or a point that a basis cannot be evaluated at, a label of another object.
///
/// The first use of an operator, be it to apply, assemble or ask for fields, ends its making: from then on it takes no
/// more fields or parts.
/// @{

/// An operator at the quadrature points of its bases. `qf` takes no more fields. dqf and dqfT are not looked at, and
/// may be CEED_QFUNCTION_NONE.
CEED_EXTERN int CeedOperatorCreate(Ceed ceed, CeedQFunction qf, CeedQFunction dqf, CeedQFunction dqfT,
                                   CeedOperator *op);
/// An operator whose QFunction `qf` acts at points given by CeedOperatorAtPointsSetPoints(); their number may differ
/// between elements. dqf and dqfT as above.
CEED_EXTERN int CeedOperatorCreateAtPoints(Ceed ceed, CeedQFunction qf, CeedQFunction dqf, CeedQFunction dqfT,
                                           CeedOperator *op);
/// The sum of other operators; without any it is zero, for vectors of any length.
CEED_EXTERN int CeedOperatorCreateComposite(Ceed ceed, CeedOperator *op);
/// Makes *op_copy another reference; what it held is dropped, so it is a live handle or NULL.
CEED_EXTERN int CeedOperatorReferenceCopy(CeedOperator op, CeedOperator *op_copy);
/// Gives the field of the QFunction a restriction `rstr` (CEED_ELEMRESTRICTION_NONE for weights), a `basis`
/// (CEED_BASIS_NONE for mode NONE) and a vector `vec` (CEED_VECTOR_ACTIVE, CEED_VECTOR_NONE for weights, or a passive
/// one, as long as the L-vector of the restriction). All are counted. Each field is set once; only fields stored at
/// points (a restriction at points) may be set again, when points have moved.
CEED_EXTERN int CeedOperatorSetField(CeedOperator op, const char *field_name, CeedElemRestriction rstr,
                                     CeedBasis basis, CeedVector vec);
/// The fields, `num_input_fields` of them in *input_fields and `num_output_fields` in *output_fields, in the order of
/// the QFunction. The operator, which is single and complete, keeps the lists and the fields. Any pointer may be NULL.
CEED_EXTERN int CeedOperatorGetFields(CeedOperator op, CeedInt *num_input_fields, CeedOperatorField **input_fields,
                                      CeedInt *num_output_fields, CeedOperatorField **output_fields);
/// Restriction `rstr_points` (at points, dim components) and L-vector `point_coords` of the points' reference
/// coordinates, which lie in [-1,1]^dim; both are counted. May be called again with other points of as many elements
/// when points have moved; nothing is compiled again. If their number in some element has changed, the fields stored at
/// points are set again too, before the next use.
CEED_EXTERN int CeedOperatorAtPointsSetPoints(CeedOperator op, CeedElemRestriction rstr_points,
                                              CeedVector point_coords);
/// Both of them as counted references, `rstr_points` and `point_coords`; NULL where none are set. Either pointer may be
/// NULL.
CEED_EXTERN int CeedOperatorAtPointsGetPoints(CeedOperator op, CeedElemRestriction *rstr_points,
                                              CeedVector *point_coords);
/// Whether it was made by CeedOperatorCreateAtPoints().
CEED_EXTERN int CeedOperatorIsAtPoints(CeedOperator op, bool *is_at_points);
/// Adds `sub_op`, which is counted, to `composite_op`. It may be composite itself, but not contain `composite_op`.
CEED_EXTERN int CeedOperatorCompositeAddSub(CeedOperator composite_op, CeedOperator sub_op);
/// Number of operators that were added.
CEED_EXTERN int CeedOperatorCompositeGetNumSub(CeedOperator op, CeedInt *num_suboperators);
/// The list belongs to the composite operator; its entries are not counted.
CEED_EXTERN int CeedOperatorCompositeGetSubList(CeedOperator op, CeedOperator **sub_operators);
/// The first sub-operator with the name `op_name`, not counted; NULL where there is none.
CEED_EXTERN int CeedOperatorCompositeGetSubByName(CeedOperator op, const char *op_name, CeedOperator *sub_op);
/// Says whether sub-operators must run one after the other in the order in which they were added (`is_sequential`).
CEED_EXTERN int CeedOperatorCompositeSetSequential(CeedOperator op, bool is_sequential);
/// What CeedOperatorCompositeSetSequential() said; false for a new operator.
CEED_EXTERN int CeedOperatorCompositeIsSequential(CeedOperator op, bool *is_sequential);
/// mult_i = number of sub-operators, those with the num_skip_indices indices in skip_indices left out, that read entry
/// i of the active input in any of their elements. A sub-operator that is itself composite counts once. `mult`: as long
/// as the active input.
CEED_EXTERN int CeedOperatorCompositeGetMultiplicity(CeedOperator op, CeedInt num_skip_indices, CeedInt *skip_indices,
                                                     CeedVector mult);
/// Whether all fields are set and fit together; done by the first use.
CEED_EXTERN int CeedOperatorCheckReady(CeedOperator op);
/// L-vector sizes of the active input and output, `input_size` and `output_size`, -1 where there is none; either
/// pointer may be NULL.
CEED_EXTERN int CeedOperatorGetActiveVectorLengths(CeedOperator op, CeedSize *input_size, CeedSize *output_size);
/// Says whether an assembled QFunction is kept for later assemblies until it is said to need an update
/// (`reuse_assembly_data`); for composites, of all parts.
CEED_EXTERN int CeedOperatorSetQFunctionAssemblyReuse(CeedOperator op, bool reuse_assembly_data);
/// Says whether what is kept is out of date (`needs_data_update`), as after passive inputs have changed. Setting fields
/// of the context or points says so by itself.
CEED_EXTERN int CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(CeedOperator op, bool needs_data_update);
/// The linear QFunction as a matrix at each point: with n_in and n_out active values a point, `assembled` is an
/// L-vector of `rstr` with n_in*n_out components, component i*n_out + o the derivative of output o by input i.
/// The caller destroys both, whose old handles are not looked at.
CEED_EXTERN int CeedOperatorLinearAssembleQFunction(CeedOperator op, CeedVector *assembled, CeedElemRestriction *rstr,
                                                    CeedRequest *request);
/// The same, once for all calls: `assembled` and `rstr` come out as counted references to what the operator keeps, made
/// anew where it does not fit, else brought up to date. Handles that are not NULL are dropped.
CEED_EXTERN int CeedOperatorLinearAssembleQFunctionBuildOrUpdate(CeedOperator op, CeedVector *assembled,
                                                                 CeedElemRestriction *rstr, CeedRequest *request);
/// Diagonal of a linear operator, active input and output of one length, which is that of `assembled`.
CEED_EXTERN int CeedOperatorLinearAssembleDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *request);
/// assembled += the diagonal.
CEED_EXTERN int CeedOperatorLinearAssembleAddDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *request);
/// Point-block diagonal: for each node the num_comp by num_comp matrix that couples its components, row-major, row by
/// output. All active fields have num_comp components, equally far apart. `assembled` has num_comp times the length of
/// the active vectors; where components are N = length/num_comp entries apart, or 1, the blocks follow each other node
/// by node. In all cases the symbolic form says which row and column each entry belongs to; an entry that belongs to no
/// node is 0, and has row and column 0.
CEED_EXTERN int CeedOperatorLinearAssemblePointBlockDiagonal(CeedOperator op, CeedVector assembled,
                                                             CeedRequest *request);
/// assembled += the point-block diagonal.
CEED_EXTERN int CeedOperatorLinearAssembleAddPointBlockDiagonal(CeedOperator op, CeedVector assembled,
                                                                CeedRequest *request);
/// Rows and columns, *num_entries of them, of the values of the point-block diagonal. The caller frees rows and cols
/// with free().
CEED_EXTERN int CeedOperatorLinearAssemblePointBlockDiagonalSymbolic(CeedOperator op, CeedSize *num_entries,
                                                                     CeedInt **rows, CeedInt **cols);
/// Rows and columns of all *num_entries element entries in coordinate form; several entries may meet. The caller frees
/// `rows` and `cols` with free().
CEED_EXTERN int CeedOperatorLinearAssembleSymbolic(CeedOperator op, CeedSize *num_entries, CeedInt **rows,
                                                   CeedInt **cols);
/// Number of element entries, of all elements and parts; no memory is needed to ask.
CEED_EXTERN int CeedOperatorLinearAssembleGetNumEntries(CeedOperator op, CeedSize *num_entries);
/// `values`, as many as there are entries, in the order of CeedOperatorLinearAssembleSymbolic().
CEED_EXTERN int CeedOperatorLinearAssemble(CeedOperator op, CeedVector values);
/// A level of p-multigrid below `op_fine`, on `rstr_coarse` and `basis_coarse`: `op_coarse` is the operator with the
/// space of all active fields that have a basis replaced by the coarse one (other fields, the QFunction and the points
/// are shared), `op_prolong` takes a coarse L-vector to a fine one, and `op_restrict` is its transpose. Fine and coarse
/// space have the same elements, and bases at the same quadrature points; at points, the coarse basis is evaluated
/// where the points of `op_fine` are now. Prolongation interpolates in each element and scales by 1/(m p_mult_fine),
/// entry by entry, where m is the number of nodes of elements that are that entry: with p_mult_fine = 1, or on many
/// processes the number of those that share the entry, a fine entry becomes the mean of what its elements propose. An
/// entry of p_mult_fine that is 0 stays 0. In a composite operator all sub-operators have the same active restriction
/// and basis. For sub-operators on different elements, make a level of each with p_mult_fine of
/// CeedOperatorCompositeGetMultiplicity(), and compose those. Each of the three handles may be NULL, and is then not
/// made; p_mult_fine may be NULL without prolongation and restriction. The caller destroys the operators. The
/// interpolation from coarse to fine nodes is here the projection of CeedBasisCreateProjection().
CEED_EXTERN int CeedOperatorMultigridLevelCreate(CeedOperator op_fine, CeedVector p_mult_fine,
                                                 CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                                                 CeedOperator *op_coarse, CeedOperator *op_prolong,
                                                 CeedOperator *op_restrict);
/// The same with an interpolation in one dimension, `interp_c_to_f` (fine P_1d by coarse P_1d, row-major), which is
/// copied; both bases are tensor products. The other arguments, `p_mult_fine`, `rstr_coarse`, `basis_coarse`,
/// `op_coarse`, `op_prolong` and `op_restrict`, are those of CeedOperatorMultigridLevelCreate().
CEED_EXTERN int CeedOperatorMultigridLevelCreateTensorH1(CeedOperator op_fine, CeedVector p_mult_fine,
                                                         CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                                                         const CeedScalar *interp_c_to_f, CeedOperator *op_coarse,
                                                         CeedOperator *op_prolong, CeedOperator *op_restrict);
/// The same with an interpolation of all nodes, `interp_c_to_f` (fine by coarse, row-major), which is copied. The other
/// arguments, `p_mult_fine`, `rstr_coarse`, `basis_coarse`, `op_coarse`, `op_prolong` and `op_restrict`, are those of
/// CeedOperatorMultigridLevelCreate().
CEED_EXTERN int CeedOperatorMultigridLevelCreateH1(CeedOperator op_fine, CeedVector p_mult_fine,
                                                   CeedElemRestriction rstr_coarse, CeedBasis basis_coarse,
                                                   const CeedScalar *interp_c_to_f, CeedOperator *op_coarse,
                                                   CeedOperator *op_prolong, CeedOperator *op_restrict);
/// Inverse of each element of a single linear operator by fast diagonalisation, F = Σ_e R_e^T A_e^-1 R_e, for a
/// preconditioner. The active input and output have one tensor-product basis. A_e^-1 is exact for constant coefficients
/// of the mass and of the derivatives in each direction on elements that are boxes; else it is that of an operator with
/// the means of the diagonal of the assembled QFunction, positive definite where they are. Eigenvalues that vanish (to
/// 1e-12 of the element's largest), as that of the constants without mass, count as 1e-5 of the largest; an element on
/// which the operator vanishes gives zeros. The caller destroys *fdm_inv.
CEED_EXTERN int CeedOperatorCreateFDMElementInverse(CeedOperator op, CeedOperator *fdm_inv, CeedRequest *request);
/// Gives the operator a `name`, which is copied: View prints it, messages show it, and a composite is asked for its
/// part by it. NULL takes it away.
CEED_EXTERN int CeedOperatorSetName(CeedOperator op, const char *name);
/// The name that was set; without one that of the operator's QFunction, and "" for a composite.
CEED_EXTERN int CeedOperatorGetName(CeedOperator op, const char **name);
/// CeedObjectSetNumViewTabs() of an operator.
CEED_EXTERN int CeedOperatorSetNumViewTabs(CeedOperator op, CeedInt num_tabs);
/// CeedObjectGetNumViewTabs() of an operator.
CEED_EXTERN int CeedOperatorGetNumViewTabs(CeedOperator op, CeedInt *num_tabs);
/// Prints the name, the sizes and the fields.
CEED_EXTERN int CeedOperatorView(CeedOperator op, FILE *stream);
/// Prints the names, of the parts too, without fields.
CEED_EXTERN int CeedOperatorViewTerse(CeedOperator op, FILE *stream);
/// CeedObjectGetCeed() of an operator.
CEED_EXTERN int CeedOperatorGetCeed(CeedOperator op, Ceed *ceed);
/// CeedObjectReturnCeed() of an operator: not counted.
CEED_EXTERN Ceed CeedOperatorReturnCeed(CeedOperator op);
/// Number of elements of a single operator; 0 before a field has told it.
CEED_EXTERN int CeedOperatorGetNumElements(CeedOperator op, CeedInt *num_elem);
/// Quadrature points of an element of a single operator; at points the largest number of points of an element.
CEED_EXTERN int CeedOperatorGetNumQuadraturePoints(CeedOperator op, CeedInt *num_qpts);
/// Floating point operations of one application, as counted from the sizes of restrictions and bases and the
/// estimates given for the QFunctions. Error CEED_ERROR_INCOMPLETE: a QFunction has none.
CEED_EXTERN int CeedOperatorGetFlopsEstimate(CeedOperator op, CeedSize *flops);
/// Context of the QFunction of a single operator, counted; *ctx is NULL where it has none.
CEED_EXTERN int CeedOperatorGetContext(CeedOperator op, CeedQFunctionContext *ctx);
/// Label of a registered context field, for a composite operator of that field in all its sub-operators, which register
/// it alike when it is used; *field_label is NULL where there is none. It lives as long as what it is of.
CEED_EXTERN int CeedOperatorGetContextFieldLabel(CeedOperator op, const char *field_name,
                                                 CeedContextFieldLabel *field_label);
/// Sets a field of double to as many `values` as are registered; they are copied. For a composite, into all parts that
/// have the field.
CEED_EXTERN int CeedOperatorSetContextDouble(CeedOperator op, CeedContextFieldLabel field_label, double *values);
/// Read access to the `num_values` values in *values (double), until they are restored: they belong to the context, of
/// a composite to that of its first part with the field. num_values may be NULL.
CEED_EXTERN int CeedOperatorGetContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                 size_t *num_values, const double **values);
/// Ends the access, and sets *values to NULL; `values` may be NULL.
CEED_EXTERN int CeedOperatorRestoreContextDoubleRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                     const double **values);
/// Sets a field of int32_t to as many `values` as are registered; they are copied. For a composite, into all parts that
/// have the field.
CEED_EXTERN int CeedOperatorSetContextInt32(CeedOperator op, CeedContextFieldLabel field_label, int32_t *values);
/// Read access to the `num_values` values in *values (int32_t), until they are restored: they belong to the context, of
/// a composite to that of its first part with the field. num_values may be NULL.
CEED_EXTERN int CeedOperatorGetContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label,
                                                size_t *num_values, const int32_t **values);
/// Ends the access, and sets *values to NULL; `values` may be NULL.
CEED_EXTERN int CeedOperatorRestoreContextInt32Read(CeedOperator op, CeedContextFieldLabel field_label,
                                                    const int32_t **values);
/// Sets a field of bool to as many `values` as are registered; they are copied. For a composite, into all parts that
/// have the field.
CEED_EXTERN int CeedOperatorSetContextBoolean(CeedOperator op, CeedContextFieldLabel field_label, bool *values);
/// Read access to the `num_values` values in *values (bool), until they are restored: they belong to the context, of a
/// composite to that of its first part with the field. num_values may be NULL.
CEED_EXTERN int CeedOperatorGetContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                  size_t *num_values, const bool **values);
/// Ends the access, and sets *values to NULL; `values` may be NULL.
CEED_EXTERN int CeedOperatorRestoreContextBooleanRead(CeedOperator op, CeedContextFieldLabel field_label,
                                                      const bool **values);
/// out = A in. Passive outputs are written. CEED_ERROR_BACKEND: the QFunction returned another code than 0.
CEED_EXTERN int CeedOperatorApply(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *request);
/// out += A in; passive outputs are added to as well.
CEED_EXTERN int CeedOperatorApplyAdd(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *request);
/// out += A in; passive outputs are written.
CEED_EXTERN int CeedOperatorApplyAddActive(CeedOperator op, CeedVector in, CeedVector out, CeedRequest *request);
/// Frees what assemblies have kept; handles to it stay good.
CEED_EXTERN int CeedOperatorAssemblyDataStrip(CeedOperator op);
/// Drops one reference and sets *op to NULL; a NULL handle is fine.
CEED_EXTERN int CeedOperatorDestroy(CeedOperator *op);
/// The field, which the operator keeps; *op_field is NULL where there is none of this name.
CEED_EXTERN int CeedOperatorGetFieldByName(CeedOperator op, const char *field_name, CeedOperatorField *op_field);
/// Name of a field. Functions of a field fail where that is NULL, with CEED_ERROR_INCOMPLETE.
CEED_EXTERN int CeedOperatorFieldGetName(CeedOperatorField op_field, const char **field_name);
/// Restriction of a field, counted; NULL before it is set.
CEED_EXTERN int CeedOperatorFieldGetElemRestriction(CeedOperatorField op_field, CeedElemRestriction *rstr);
/// Basis of a field, counted, or CEED_BASIS_NONE; NULL before it is set.
CEED_EXTERN int CeedOperatorFieldGetBasis(CeedOperatorField op_field, CeedBasis *basis);
/// Vector of a field, counted, or CEED_VECTOR_ACTIVE or CEED_VECTOR_NONE; NULL before it is set.
CEED_EXTERN int CeedOperatorFieldGetVector(CeedOperatorField op_field, CeedVector *vec);
/// All four at once: `field_name`, `rstr`, `basis` and `vec` may be NULL; handles are counted.
CEED_EXTERN int CeedOperatorFieldGetData(CeedOperatorField op_field, const char **field_name,
                                         CeedElemRestriction *rstr, CeedBasis *basis, CeedVector *vec);
/// @}

/// base to the power of `power` >= 0
static inline CeedInt CeedIntPow(CeedInt base, CeedInt power) {
  CeedInt product = 1;
  for (CeedInt i = 0; i < power; i++) product *= base;
  return product;
}
/// The smaller of two numbers.
static inline CeedInt CeedIntMin(CeedInt a, CeedInt b) { return b < a ? b : a; }
/// The larger of two numbers.
static inline CeedInt CeedIntMax(CeedInt a, CeedInt b) { return a < b ? b : a; }

#include "deprecated.h"

#endif
