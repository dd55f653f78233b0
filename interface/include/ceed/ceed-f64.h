/// @file
/// CeedScalar in double precision.
#ifndef CEED_F64_H
#define CEED_F64_H

/// CeedScalar is a double.
#define CEED_SCALAR_IS_FP64
/// Precision of CeedScalar in these headers; CeedGetScalarType() tells that of the library.
#define CEED_SCALAR_TYPE CEED_SCALAR_FP64
/// A number: all arithmetic is done with it.
typedef double CeedScalar;
/// Below this a value counts as zero in the dense helpers.
#define CEED_EPSILON 1e-16

#endif
