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

/// Gives a QFunction the loaded kernel `f` (a CUfunction), for backends that launch it in place of the text of its source
/// path. Those of this library do not: on devices they compile the text, and all others call the QFunction's C function.
/// The caller keeps the module that the kernel is in as long as the QFunction lives. Error CEED_ERROR_INCOMPATIBLE:
/// CEED_QFUNCTION_NONE.
CEED_EXTERN int CeedQFunctionSetCUDAUserFunction(CeedQFunction qf, struct CUfunc_st *f);

#ifdef __cplusplus
}
#endif

#endif
