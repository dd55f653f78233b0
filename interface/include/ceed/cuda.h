/// @file
/// What a program that brings its own CUDA kernels says to the interface. It compiles without the CUDA toolkit too,
/// which it includes where it is found.
#ifndef CEED_CUDA_H
#define CEED_CUDA_H

#include <ceed.h>

#ifdef __has_include
#if __has_include(<cuda.h>)
#include <cuda.h>
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// The handle of a kernel, a CUfunction, points to one of these.
struct CUfunc_st;

/// Gives a QFunction that has no text (`source` NULL or "") the loaded kernel `f` (a CUfunction), which CUDA's backends
/// launch as f(void *context, CeedInt Q, fields) with Q threads or more, in blocks of 256. The context is on the device;
/// `fields` is a struct of 16 pointers to inputs and 16 to outputs, passed by value: value c of point i of a field is its
/// entry c*Q + i, as for the C function. CeedQFunctionApply() calls it, and operators do in stages, for the points of
/// several elements up to 2^20 at a time. What it writes to its context is not seen on the host. Backends that work
/// elsewhere pass over it; assembly, and QFunctions with more fields, call the C function on the host. The caller keeps the
/// kernel's module as long as the QFunction lives. Error CEED_ERROR_INCOMPATIBLE: CEED_QFUNCTION_NONE.
CEED_EXTERN int CeedQFunctionSetCUDAUserFunction(CeedQFunction qf, struct CUfunc_st *f);

#ifdef __cplusplus
}
#endif

#endif
