/// @file
/// Scalar and index types, enumerations, and the macros with which QFunctions are written.
///
/// QFunction sources include this header alone. It is also read by run-time compilers that have no standard library:
/// they define `CEED_RUNNING_JIT_PASS` and provide `bool` and the fixed-width integers themselves.
#ifndef CEED_TYPES_H
#define CEED_TYPES_H

#ifndef CEED_RUNNING_JIT_PASS
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#endif

/// Attribute of a QFunction: everything it calls is inlined into it, so that its loop over points vectorises.
#ifndef CEED_QFUNCTION_ATTR
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__NO_INLINE__)
#define CEED_QFUNCTION_ATTR __attribute__((flatten))
#else
#define CEED_QFUNCTION_ATTR
#endif
#endif

/// Attribute of a function that QFunctions call at each point.
#ifndef CEED_QFUNCTION_HELPER_ATTR
#if defined(__GNUC__) || defined(__clang__)
#define CEED_QFUNCTION_HELPER_ATTR CEED_QFUNCTION_ATTR __attribute__((always_inline))
#else
#define CEED_QFUNCTION_HELPER_ATTR CEED_QFUNCTION_ATTR
#endif
#endif

/// Opens the definition of a QFunction and makes the string `name_loc` = "file:name", which tells run-time compiling
/// backends where the source is: `CEED_QFUNCTION(f)(void *ctx, const CeedInt Q, const CeedScalar *const *in,
/// CeedScalar *const *out) { ... }`.
#ifndef CEED_QFUNCTION
#define CEED_QFUNCTION(name)                           \
  static const char name##_loc[] = __FILE__ ":" #name; \
  CEED_QFUNCTION_ATTR static int name
#endif

/// Opens the definition of a function that QFunctions call.
#ifndef CEED_QFUNCTION_HELPER
#define CEED_QFUNCTION_HELPER CEED_QFUNCTION_HELPER_ATTR static inline
#endif

/// Length of the fastest dimension when a QFunction views its arrays as variable-length arrays, `[n][CEED_Q_VLA]`.
#ifndef CEED_Q_VLA
#define CEED_Q_VLA Q
#endif

/// Put before a loop over points: its iterations are independent.
#ifndef CeedPragmaSIMD
#if defined(__clang__)
#define CeedPragmaSIMD _Pragma("clang loop vectorize(enable)")
#elif defined(__GNUC__)
#define CeedPragmaSIMD _Pragma("GCC ivdep")
#else
#define CeedPragmaSIMD
#endif
#endif

/// Index of an element, node, point or component.
typedef int32_t CeedInt;
/// For printf(), after the percent sign.
#define CeedInt_FMT "d"
/// Length of an array; 64 bits wide where the machine is.
typedef ptrdiff_t CeedSize;
/// For printf(), after the percent sign.
#define CeedSize_FMT "td"
/// Entry of a curl-orientation.
typedef signed char CeedInt8;
/// For printf(), after the percent sign.
#define CeedInt8_FMT "d"

/// Precision of CeedScalar.
typedef enum {
  CEED_SCALAR_FP32 = 0,
  CEED_SCALAR_FP64 = 1,
} CeedScalarType;

#include "ceed-f64.h"

/// What a function returns. Positive: the call was refused and its object is unchanged. Negative: the object can no
/// longer be used.
typedef enum {
  CEED_ERROR_SUCCESS = 0,       ///< done
  CEED_ERROR_MINOR = 1,         ///< refused, for no class of reasons below
  CEED_ERROR_DIMENSION = 2,     ///< sizes do not fit
  CEED_ERROR_INCOMPLETE = 3,    ///< something must be set first
  CEED_ERROR_INCOMPATIBLE = 4,  ///< the objects do not belong together
  CEED_ERROR_ACCESS = 5,        ///< an access lock forbids it
  CEED_ERROR_MAJOR = -1,        ///< failed, for no class of reasons below
  CEED_ERROR_BACKEND = -2,      ///< the backend failed
  CEED_ERROR_UNSUPPORTED = -3,  ///< the backend does not do this
} CeedErrorType;

/// Where an array lives.
typedef enum {
  CEED_MEM_HOST = 0,
  CEED_MEM_DEVICE = 1,
} CeedMemType;

/// What happens with an array that is handed over.
typedef enum {
  CEED_COPY_VALUES = 0,  ///< its values are copied; the caller keeps it
  CEED_USE_POINTER = 1,  ///< it is used; the caller keeps it alive and frees it
  CEED_OWN_POINTER = 2,  ///< it is used and freed with free()
} CeedCopyMode;

/// Norm of a vector.
typedef enum {
  CEED_NORM_1 = 0,
  CEED_NORM_2 = 1,
  CEED_NORM_MAX = 2,
} CeedNormType;

/// Whether an action or its transpose is applied.
typedef enum {
  CEED_NOTRANSPOSE = 0,
  CEED_TRANSPOSE = 1,
} CeedTransposeMode;

/// How a field is evaluated at points. Values are bits.
typedef enum {
  CEED_EVAL_NONE = 0,    ///< as it is stored: one value a point and component
  CEED_EVAL_INTERP = 1,  ///< interpolated values
  CEED_EVAL_GRAD = 2,    ///< derivatives with respect to the reference coordinates
  CEED_EVAL_DIV = 4,     ///< divergence
  CEED_EVAL_CURL = 8,    ///< curl
  CEED_EVAL_WEIGHT = 16, ///< quadrature weights
} CeedEvalMode;

/// Family of one-dimensional quadrature points.
typedef enum {
  CEED_GAUSS = 0,
  CEED_GAUSS_LOBATTO = 1,
} CeedQuadMode;

/// Shape of an element: the dimension in the upper 16 bits, a number in the lower.
typedef enum {
  CEED_TOPOLOGY_LINE = 0x10000,
  CEED_TOPOLOGY_TRIANGLE = 0x20001,
  CEED_TOPOLOGY_QUAD = 0x20002,
  CEED_TOPOLOGY_TET = 0x30003,
  CEED_TOPOLOGY_PYRAMID = 0x30004,
  CEED_TOPOLOGY_PRISM = 0x30005,
  CEED_TOPOLOGY_HEX = 0x30006,
} CeedElemTopology;

/// Type of a registered field of a QFunction context.
typedef enum {
  CEED_CONTEXT_FIELD_DOUBLE = 1,
  CEED_CONTEXT_FIELD_INT32 = 2,
  CEED_CONTEXT_FIELD_BOOL = 3,
} CeedContextFieldType;

#endif
