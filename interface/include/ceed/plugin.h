/// @file
/// What a backend is: tables of functions, the operator program they work from, and the symbol a plugin exports.
///
/// A backend fills the tables below. Its tables start as a copy of its parent's, so it names only what it does better.
/// Functions of one group share the `data` pointer of their object (CeedVectorSetData() and its like): a backend that
/// replaces `create` of a group replaces all of that group which read the data.
/// Every function returns a CeedErrorType and reports errors with CeedError(). Arguments have been checked by the core:
/// handles are valid and of one Ceed family, sizes fit, access locks are free. Functions marked "optional" may be NULL;
/// the core then does the work on the host.
#ifndef CEED_PLUGIN_H
#define CEED_PLUGIN_H

#include <ceed/backend.h>

/// Version of this file: it grows with every change of a struct or of what an entry means. A plugin of another version
/// is refused.
#define CEED_PLUGIN_API_VERSION 6u

#ifdef __cplusplus
extern "C" {
#endif

/// Memory and arithmetic of vectors. The core keeps the access locks and the state counter. Entries do what the
/// functions of vectors do that have their names, whose arguments they have.
typedef struct {
  int (*create)(CeedVector vec);   ///< of CeedVectorGetLength() entries, without values
  int (*destroy)(CeedVector vec);  ///< frees what the vector owns
  /// CeedVectorSetArray()
  int (*set_array)(CeedVector vec, CeedMemType mem_type, CeedCopyMode copy_mode, CeedScalar *array);
  int (*take_array)(CeedVector vec, CeedMemType mem_type, CeedScalar **array);  ///< one was lent in this memory
  int (*sync_array)(CeedVector vec, CeedMemType mem_type);                      ///< CeedVectorSyncArray()
  int (*get_array)(CeedVector vec, CeedMemType mem_type, CeedScalar **array);   ///< with the current values
  int (*get_array_read)(CeedVector vec, CeedMemType mem_type, const CeedScalar **array);  ///< the same, to read
  int (*get_array_write)(CeedVector vec, CeedMemType mem_type, CeedScalar **array);       ///< contents undefined
  int (*has_valid_array)(CeedVector vec, bool *has_valid_array);                          ///< values were set
  /// CeedVectorHasBorrowedArrayOfType()
  int (*has_borrowed_array)(CeedVector vec, CeedMemType mem_type, bool *has_borrowed_array);
  int (*restore_array)(CeedVector vec);                                         ///< optional; the access is over
  int (*restore_array_read)(CeedVector vec);                                    ///< optional; the last reader's
  int (*set_value)(CeedVector vec, CeedScalar value);                           ///< optional
  int (*norm)(CeedVector vec, CeedNormType type, CeedScalar *norm);             ///< optional
  int (*scale)(CeedVector x, CeedScalar alpha);                                 ///< optional
  int (*axpy)(CeedVector y, CeedScalar alpha, CeedVector x);                    ///< optional
  int (*axpby)(CeedVector y, CeedScalar alpha, CeedScalar beta, CeedVector x);  ///< optional
  int (*pointwise_mult)(CeedVector w, CeedVector x, CeedVector y);              ///< optional
  int (*reciprocal)(CeedVector vec);                                            ///< optional
  int (*filter)(CeedVector x, CeedScalar threshold);                            ///< optional
  int (*copy)(CeedVector vec, CeedVector vec_copy);                             ///< optional
  /// optional
  int (*copy_strided)(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step, CeedVector vec_copy);
  /// optional
  int (*set_value_strided)(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step, CeedScalar value);
} CeedVectorOps;

/// What a restriction does. Component c of element e of R u is T_e G_(e,c) u: G_(e,c) picks an entry of the L-vector
/// for each node, T_e, the orientation of the element, turns them; it is the same for all components. R^T adds G^T T^T.
///
/// Component c of node n of element e is this entry of the L-vector:
///   offsets[i] + c*comp_stride, i the place of n among the elem_size nodes of element e (see below);
///   n*strides[0] + c*strides[1] + e*strides[2] where `offsets` is NULL;
///   offsets[offsets[e] + n]*num_comp + c at points.
///
/// Elements come in blocks of B = block_size, 1 unless the restriction was made as a blocked one. Entry k of the s that
/// each element has in a table over elements, or in an E-vector that the backend has not laid out otherwise, is at
///   ((e/B)*s + k)*B + e%B,
/// and the last block repeats the last element until it is full; what repeats is written by R and not read by R^T.
/// At points an E-vector is ragged: (point, component), point fastest, for one element after another.
typedef struct {
  CeedRestrictionType type;  ///< its kind
  CeedInt num_elem;          ///< elements
  CeedInt elem_size;         ///< nodes of an element; at points the largest number of points of an element
  CeedInt num_comp;          ///< components
  CeedInt block_size;        ///< elements of a block
  CeedInt comp_stride;       ///< 0 for strided ones
  CeedInt strides[3];        ///< (node, component, element) of strided ones, also where the backend chose them
  CeedInt e_layout[3];       ///< (node, component, element) of whole E-vectors; {1, 0, 0} where they are ragged
  CeedSize l_size;           ///< entries of the L-vector
  CeedSize e_size;           ///< entries of the E-vector
  const CeedInt *offsets;    ///< see above; NULL for strided ones
  CeedInt num_bands;         ///< of T_e. 0: it is the identity; 1: it is diagonal, of signs; 3: it is tridiagonal
  const CeedInt8 *bands;     ///< num_bands*elem_size entries for each element: T_e(n, n + k - num_bands/2) is entry
                             ///< n*num_bands + k; what would lie outside of T_e may have any value
  bool is_copy;              ///< whether each entry of the L-vector is one entry of the E-vector, so that R^T may write
                             ///< where it would add to zeros; known at points, false elsewhere
} CeedElementMap;

/// Restrictions. The core keeps the tables on the host and has checked their range.
typedef struct {
  int (*create)(CeedElemRestriction rstr);   ///< optional; may set the layout of E-vectors, and L-vectors if strided
  int (*destroy)(CeedElemRestriction rstr);  ///< optional
  /// The blocks [first_block, first_block + num_block): all of them, or a single one. Without blocks, and at points,
  /// each element is a block. The E-vector of a single block holds nothing else, laid out as above whatever the layout
  /// of the whole. CEED_NOTRANSPOSE writes ru, CEED_TRANSPOSE adds to it; what of ru does not belong to the blocks
  /// stays.
  int (*apply)(CeedElemRestriction rstr, CeedInt first_block, CeedInt num_block, CeedTransposeMode t_mode, CeedVector u,
               CeedVector ru);
} CeedElemRestrictionOps;

/// Bases. The core keeps the matrices on the host: factors of one direction for tensor products (CeedBasisGetInterp1D()
/// and its like), else full ones (CeedOperatorGetBasisPointer()). The modes are CEED_EVAL_INTERP, CEED_EVAL_WEIGHT and
/// CeedBasisGetDerivativeMode(); at points they come for tensor products alone. `add`: v += ... (transpose only), else
/// v is overwritten.
typedef struct {
  int (*create)(CeedBasis basis);   ///< optional
  int (*destroy)(CeedBasis basis);  ///< optional
  /// CeedBasisApply(), and with `add` CeedBasisApplyAdd()
  int (*apply)(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector u,
               CeedVector v, bool add);
  /// CeedBasisApplyAtPoints(), and with `add` CeedBasisApplyAddAtPoints()
  int (*apply_at_points)(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode,
                         CeedEvalMode eval_mode, CeedVector x_ref, CeedVector u, CeedVector v, bool add);
} CeedBasisOps;

struct CUfunc_st;           // what a CUfunction points to
struct ihipModuleSymbol_t;  // what a hipFunction_t points to

/// QFunctions called by themselves.
typedef struct {
  int (*create)(CeedQFunction qf);   ///< optional
  int (*destroy)(CeedQFunction qf);  ///< optional
  /// CeedQFunctionApply()
  int (*apply)(CeedQFunction qf, CeedInt Q, const CeedVector *u, const CeedVector *v);
  int (*set_cuda_function)(CeedQFunction qf, struct CUfunc_st *f);          ///< optional; see ceed/cuda.h
  int (*set_hip_function)(CeedQFunction qf, struct ihipModuleSymbol_t *f);  ///< optional; see ceed/hip.h
} CeedQFunctionOps;

/// A distinct (restriction, vector) of a program: gathered or scattered once, however many fields use it.
typedef struct {
  CeedElemRestriction rstr;  ///< from or to the L-vector
  CeedVector vec;            ///< CEED_VECTOR_ACTIVE or a passive vector
  CeedInt num_comp;          ///< components of the restriction
  CeedInt elem_size;         ///< nodes of an element; for points (is_points) the largest number in an element
  bool is_active;            ///< the vector is CEED_VECTOR_ACTIVE
  bool is_points;            ///< the restriction is one at points
} CeedProgramSide;

/// One input or output of the QFunction.
typedef struct {
  const char *name;        ///< as the QFunction knows it
  CeedEvalMode eval_mode;  ///< how it is evaluated
  CeedInt size;            ///< values at a point
  CeedInt side;            ///< index in `sources` (inputs) or `sinks` (outputs); -1 for CEED_EVAL_WEIGHT
  CeedInt space;           ///< index in `spaces`; -1 for CEED_EVAL_NONE
  CeedInt first_value;     ///< active fields: number of active values before this one, the row or column of its first
                           ///< component in the assembled QFunction; -1 for passive ones
} CeedProgramField;

/// A distinct (restriction, basis): evaluated once, however many fields use it. For CEED_EVAL_WEIGHT the restriction is
/// CEED_ELEMRESTRICTION_NONE.
typedef struct {
  CeedElemRestriction rstr;  ///< whose nodes are evaluated
  CeedBasis basis;           ///< at these functions
} CeedProgramSpace;

/// A single operator, lowered when it is first used: what backends, assembly and code printers read.
/// All pointers belong to the operator; handles are not counted.
typedef struct {
  CeedQFunction qf;                 ///< what is computed at each point
  bool at_points;                   ///< at points of the elements' own, else at quadrature points
  CeedInt num_elem;                 ///< elements
  CeedInt num_qpts;                 ///< points of an element; at points the largest number
  CeedInt num_sources;              ///< number of `sources`
  CeedInt num_sinks;                ///< number of `sinks`
  CeedInt num_spaces;               ///< number of `spaces`
  CeedInt num_inputs;               ///< number of `inputs`
  CeedInt num_outputs;              ///< number of `outputs`
  const CeedProgramSide *sources;   ///< what is gathered
  const CeedProgramSide *sinks;     ///< what is scattered to
  const CeedProgramSpace *spaces;   ///< what is evaluated
  const CeedProgramField *inputs;   ///< of the QFunction, in its order
  const CeedProgramField *outputs;  ///< of the QFunction, in its order
  CeedInt num_active_in;            ///< active values of the inputs at a point: size of the assembled QFunction
  CeedInt num_active_out;           ///< active values of the outputs at a point
  CeedElemRestriction points_rstr;  ///< at points: restriction and L-vector of the reference coordinates
  CeedVector points;                ///< see points_rstr
  CeedSize
      points_epoch;  ///< grows when points or fields at points are set again. Then num_qpts, the points and the
                     ///< restrictions and vectors of sides at points may differ, the rest of the program is the same
} CeedProgram;

/// Which outputs an application adds to.
typedef enum {
  CEED_APPLY_ADD_ALL = 0,     ///< active and passive outputs are added to
  CEED_APPLY_ADD_ACTIVE = 1,  ///< the active output is added to, passive ones are written
} CeedApplyMode;

/// Entries of an element's matrix K for one active source, whose values are its columns (c,n), and one active sink,
/// whose values are its rows (r,m): component, then node.
typedef enum {
  CEED_ASSEMBLE_MATRIX = 0,        ///< all, row-major
  CEED_ASSEMBLE_DIAGONAL = 1,      ///< (c, n): K[(c,n),(c,n)]. Source and sink have the same restriction
  CEED_ASSEMBLE_POINT_BLOCKS = 2,  ///< (r, c, n): K[(r,n),(c,n)]. The same
} CeedAssembleKind;

/// Single operators; composites are the core's, but for apply_add_parts(). `program` is that of CeedOperatorGetProgram().
typedef struct {
  int (*create)(CeedOperator op, const CeedProgram *program);  ///< optional; after lowering
  int (*destroy)(CeedOperator op);  ///< optional; of a composite, where apply_add_parts() was called for it
  /// Optional: what takes time when the operator is first used so. Where an assembled QFunction is kept, the core asks
  /// for that one instead of what is assembled from it.
  int (*prepare)(CeedOperator op, const CeedProgram *program, CeedOperatorUse use);
  /// in, out: L-vectors, or CEED_VECTOR_NONE where the operator has no active input or output.
  int (*apply_add)(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode);
  /// Optional: apply_add() with CEED_APPLY_ADD_ALL of the num_parts single operators of a `composite` that is not
  /// sequential, in any order or at once: none reads what another one writes. They and the composite are of one Ceed,
  /// and parts[i] has programs[i] and is applied to in[i] and out[i]. CeedOperatorGetData() of the composite is NULL at
  /// first, and its destroy() and get_memory() are called once this was. Who replaces apply_add() replaces this one as
  /// well, if only by NULL, which stands for one after another.
  int (*apply_add_parts)(CeedOperator composite, CeedInt num_parts, const CeedOperator *parts,
                         const CeedProgram *const *programs, const CeedVector *in, const CeedVector *out);
  /// The QFunction's matrix at each point of the elements [first_elem, first_elem + num_elem): num_active_in *
  /// num_active_out components, component i*num_active_out + o. At quadrature points (point, component, element), point
  /// fastest; at points one element after another, component fastest. `values` may be longer than that.
  int (*linear_assemble_qfunction)(CeedOperator op, const CeedProgram *program, CeedInt first_elem, CeedInt num_elem,
                                   CeedVector values);
  /// All of an assembly, where the backend works. CEED_ASSEMBLE_MATRIX: the entries go to values[offset] and beyond,
  /// which are 0 before, in the order of CeedOperatorLinearAssembleSymbolic(); else they are added to the diagonal or
  /// the point-block diagonal `values`. Optional, and *is_done = false says that this one is not taken: the core
  /// assembles the QFunction and contracts, as it does where an assembled QFunction is kept.
  int (*linear_assemble)(CeedOperator op, const CeedProgram *program, CeedAssembleKind kind, CeedSize offset,
                         CeedVector values, bool *is_done);
  /// Contracts the QFunction's matrices `qfunction` of some elements, as linear_assemble_qfunction() gives them, with
  /// the bases: writes the wanted entries of one element after another. Optional, and *is_done = false says that this
  /// coupling is not taken: the core does it.
  int (*linear_assemble_elements)(CeedOperator op, const CeedProgram *program, CeedInt source, CeedInt sink,
                                  CeedAssembleKind kind, CeedInt first_elem, CeedInt num_elem,
                                  const CeedScalar *qfunction, CeedScalar *entries, bool *is_done);
  /// Bytes that the backend keeps for the operator between applications; optional: none. It reads what `create` made.
  int (*get_memory)(CeedOperator op, CeedSize *bytes);
} CeedOperatorOps;

/// Contexts, whose data the core keeps on the host. A backend may watch them; all entries are optional.
typedef struct {
  /// The first reader comes: `size` bytes at `data`, which nobody may change before the next call.
  int (*get_data_read)(CeedQFunctionContext ctx, size_t size, const void *data);
  /// The last reader has gone. What this returns is told to him.
  int (*restore_data_read)(CeedQFunctionContext ctx, size_t size, void *data);
} CeedQFunctionContextOps;

/// All that a backend does.
typedef struct {
  size_t size;                     ///< sizeof(CeedBackendOps) as the backend was compiled; set by the core for a copy
  uint32_t api_version;            ///< CEED_PLUGIN_API_VERSION
  CeedMemType preferred_mem_type;  ///< where it works
  bool is_deterministic;           ///< the same operator applied twice gives the same bits
  bool host_memory_only;           ///< CEED_MEM_DEVICE is refused before it reaches the tables
  int device_id;                   ///< of several devices the one in whose memory objects are; 0: there is one
  int (*ceed_destroy)(Ceed ceed);  ///< optional: frees CeedGetData()
  int (*ceed_set_stream)(Ceed ceed, void *handle);                 ///< optional
  int (*ceed_get_transfers)(Ceed ceed, CeedTransfers *transfers);  ///< optional: there are none
  CeedVectorOps vector;                                            ///< what it does with vectors,
  CeedElemRestrictionOps restriction;                              ///< restrictions,
  CeedBasisOps basis;                                              ///< bases,
  CeedQFunctionOps qfunction;                                      ///< QFunctions,
  CeedOperatorOps op;                                              ///< operators,
  CeedQFunctionContextOps context;                                 ///< and contexts
} CeedBackendOps;

/// One backend of a plugin.
typedef struct {
  const char *resource;        ///< full name, "/cpu/self/ref/serial"
  const char *parent;          ///< resource whose tables this one starts from; NULL: all entries are its own
  unsigned int priority;       ///< lower is preferred among equally long matches
  const char *const *aliases;  ///< further resources that lead here, ended by NULL; may be NULL
  /// How well this machine suits the backend; 0: not at all, and *reason says why. NULL counts as 1.
  int (*score)(const char **reason);
  /// Changes `ops` (a copy of the parent's) and sets up `ceed`; `options` is what follows the colon in the resource
  /// that was asked for, or "". One thread at a time is in here, so a backend may keep the parent's tables in a static
  /// variable when it first comes by.
  int (*init)(Ceed ceed, const char *options, CeedBackendOps *ops);
} CeedBackend;

/// What a plugin is.
typedef struct {
  size_t size;                  ///< sizeof(CeedPlugin)
  uint32_t api_version;         ///< CEED_PLUGIN_API_VERSION
  const char *name;             ///< for messages and lists; not NULL
  size_t num_backends;          ///< number of `backends`
  const CeedBackend *backends;  ///< as long as the process lives
} CeedPlugin;

/// The one symbol that a plugin library exports; what it returns lives as long as the process.
CEED_EXTERN const CeedPlugin *ceed_plugin_v1(void);
/// Type of ceed_plugin_v1().
typedef const CeedPlugin *(*CeedPluginEntry)(void);

/// Registers the backends of a `plugin` that is part of the program, and lives as long as the process. Errors:
/// CEED_ERROR_INCOMPATIBLE: it is of another API version, or has no name; CEED_ERROR_MINOR: a backend has no init, or a
/// resource that is there already or does not begin with a slash.
CEED_EXTERN int CeedPluginRegister(const CeedPlugin *plugin);
/// Loads a plugin library from the file `path`. Errors (CEED_ERROR_MINOR, CEED_ERROR_INCOMPATIBLE, CEED_ERROR_MAJOR:
/// missing file or symbol, another API version, wrong architecture, a file cut short, an exception) are returned and
/// named in CeedPluginLoadError(); no handler is called, and what was registered before stays. Beside this, plugins are
/// looked for once, at the first use of the library: files *.so in ceed-plugins/ beside the library, then in the
/// folders of CEED_PLUGIN_PATH (separated by colons; a file is loaded); one that is refused is named on standard error.
/// An exception from ceed_plugin_v1() does no harm; one from a static constructor leaves the dynamic loader locked by
/// the calling thread, so that dlopen() works in no other.
CEED_EXTERN int CeedPluginLoad(const char *path);
/// Message of this thread's last CeedPluginLoad(), or "" where it went well; valid until the next one.
CEED_EXTERN const char *CeedPluginLoadError(void);

/// What became of a plugin. All of it lives as long as the process.
typedef struct {
  const char *path;          ///< its file; "": part of the library or of the program
  const CeedPlugin *plugin;  ///< NULL: it was refused
  const char *error;         ///< why it was refused, or ""
} CeedPluginInfo;
/// All plugins that this process has met, refused ones too, in the order of loading: *num_plugins of them in *plugins.
/// The caller frees the list with free(). Error CEED_ERROR_MINOR: an address is NULL; or as CeedRegisterAll()
/// (CEED_ERROR_INCOMPATIBLE).
CEED_EXTERN int CeedPluginGetList(size_t *num_plugins, CeedPluginInfo **plugins);
/// The tables that `ceed` works with: its ancestors' and its own. They live as long as `ceed`.
CEED_EXTERN int CeedGetBackendOps(Ceed ceed, const CeedBackendOps **ops);
/// The map of a restriction; valid as long as the restriction lives. Error CEED_ERROR_INCOMPATIBLE:
/// CEED_ELEMRESTRICTION_NONE.
CEED_EXTERN int CeedElemRestrictionGetElementMap(CeedElemRestriction rstr, const CeedElementMap **map);
/// The lowered operator; valid until the operator is destroyed or its points are set again. Errors: CEED_ERROR_MINOR:
/// `op` is composite; else those of CeedOperatorCheckReady(), which is called where it was not (CEED_ERROR_INCOMPLETE,
/// CEED_ERROR_DIMENSION, CEED_ERROR_INCOMPATIBLE).
CEED_EXTERN int CeedOperatorGetProgram(CeedOperator op, const CeedProgram **program);

#ifdef __cplusplus
}
#endif

#endif
