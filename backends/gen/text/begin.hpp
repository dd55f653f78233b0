/// @file
/// First in a text that is compiled at run time: what a QFunction may use, and its kernels.
#pragma once

#define CEED_RUNNING_JIT_PASS 1
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A QFunction and all that it calls become part of the loops around it.
#define CEED_QFUNCTION_ATTR
#define CEED_QFUNCTION(name) __attribute__((always_inline)) static inline int name
#define CEED_QFUNCTION_HELPER_ATTR __attribute__((always_inline))
#define CEED_QFUNCTION_HELPER __attribute__((always_inline)) static inline
#define restrict __restrict__
// Loops over points are for SIMD, short ones as well, whose iterations GCC would write out before it comes to that.
#if defined(__GNUC__) && !defined(__clang__)
#define CeedPragmaSIMD _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#endif
#include <ceed/types.h>

// The C library has these functions for numbers side by side, but tells compilers so only where they may be careless of
// special values. (GNU C library 2.35 and later, libmvec; errors up to 4 units in the last place.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__GLIBC_PREREQ)
#if __GLIBC_PREREQ(2, 35)
#define HG_SIMD extern "C" __attribute__((__simd__("notinbranch")))
HG_SIMD double acos(double) noexcept;
HG_SIMD double acosh(double) noexcept;
HG_SIMD double asin(double) noexcept;
HG_SIMD double asinh(double) noexcept;
HG_SIMD double atan(double) noexcept;
HG_SIMD double atan2(double, double) noexcept;
HG_SIMD double atanh(double) noexcept;
HG_SIMD double cbrt(double) noexcept;
HG_SIMD double cos(double) noexcept;
HG_SIMD double cosh(double) noexcept;
HG_SIMD double erf(double) noexcept;
HG_SIMD double erfc(double) noexcept;
HG_SIMD double exp(double) noexcept;
HG_SIMD double exp2(double) noexcept;
HG_SIMD double expm1(double) noexcept;
HG_SIMD double hypot(double, double) noexcept;
HG_SIMD double log(double) noexcept;
HG_SIMD double log10(double) noexcept;
HG_SIMD double log1p(double) noexcept;
HG_SIMD double log2(double) noexcept;
HG_SIMD double pow(double, double) noexcept;
HG_SIMD double sin(double) noexcept;
HG_SIMD double sinh(double) noexcept;
HG_SIMD double tan(double) noexcept;
HG_SIMD double tanh(double) noexcept;
#undef HG_SIMD
#endif
#endif

#include "block_copy.hpp"
#include "contract.hpp"
#include "job.hpp"
#include "pack.hpp"
#include "points.hpp"
