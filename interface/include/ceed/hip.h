/// @file
/// What a program that brings its own HIP kernels says to the interface. It compiles without the HIP headers too, which
/// it includes where they are found.
#ifndef CEED_HIP_H
#define CEED_HIP_H

#include <ceed.h>

#ifdef __has_include
#if __has_include(<hip/hip_runtime.h>)
#include <hip/hip_runtime.h>
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// The handle of a kernel, a hipFunction_t, points to one of these.
struct ihipModuleSymbol_t;

/// Gives a QFunction that has no text the loaded kernel `f` (a hipFunction_t) for HIP's backends, in everything as
/// CeedQFunctionSetCUDAUserFunction() of ceed/cuda.h does for CUDA's. Error CEED_ERROR_INCOMPATIBLE:
/// CEED_QFUNCTION_NONE.
CEED_EXTERN int CeedQFunctionSetHIPUserFunction(CeedQFunction qf, struct ihipModuleSymbol_t *f);

#ifdef __cplusplus
}
#endif

#endif
