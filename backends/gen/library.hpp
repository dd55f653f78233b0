/// @file
/// From a printed text to functions.
#pragma once

#include <ceed/plugin.h>

#include "../host/kernels.hpp"
#include "../jit/source.hpp"
#include "print.hpp"
#include "text/job.hpp"

namespace hg::gen {

using jit::Source;

/// What was compiled; valid as long as the process.
struct Library {
  CeedQFunctionUser function;  ///< the QFunction; NULL where the operator does all by itself
  Apply apply;                 ///< the operator; NULL where none was printed
};

/// Compiles a QFunction with the loop that was printed for it, or takes both from the cache. Throws NotCompiled. With
/// CEED_GEN_REPORT it is told on standard error which of the QFunction's loops became SIMD, and why others did not.
Library compile(const host::Kernels &kernels, const Source &source, const Printed &printed);

}  // namespace hg::gen
