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

/// Gives a QFunction the loaded kernel `f` (a hipFunction_t), for backends that launch it in place of the text of its source
/// path. Those of this library do not: on devices they compile the text, and all others call the QFunction's C function.
/// The caller keeps the module that the kernel is in as long as the QFunction lives. Error CEED_ERROR_INCOMPATIBLE:
/// CEED_QFUNCTION_NONE.
CEED_EXTERN int CeedQFunctionSetHIPUserFunction(CeedQFunction qf, struct ihipModuleSymbol_t *f);

#ifdef __cplusplus
}
#endif

#endif
