/// @file
/// The one way in which the mechanics layer reports that it cannot go on.
///
/// Functions of namespace hg throw hg::Error. Calls into PETSc and into CEED go through petsc_check and ceed_check,
/// which turn an error code into an hg::Error that carries the library's own innermost message. A function that PETSc
/// calls back (SNES residual, MatShell product, monitor) has its body in guard, which turns an exception into an error
/// code. The program prints the message once and ends with a non-zero status.
#pragma once

#include <ceed.h>
#include <petscsys.h>

#include <stdexcept>
#include <string>

namespace hg {

/// Where a call stands in the source. (std::source_location needs a built-in function that clang 14 lacks.)
struct SourcePlace {
  const char *file = "";
  int line = 0;
  const char *function = "";

  /// As the default value of a parameter: the place of the call.
  static constexpr SourcePlace here(const char *file = __builtin_FILE(), int line = __builtin_LINE(),
                                    const char *function = __builtin_FUNCTION()) {
    return {file, line, function};
  }
};

/// A message for the user: names the object or option, the value found, and what was expected.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Error with a printf-style message. PetscInt needs PetscInt_FMT, CeedInt needs CeedInt_FMT.
[[noreturn]] void fail(const char *format, ...) __attribute__((format(printf, 1, 2)));

/// Installs the PETSc error handler that keeps the innermost message and prints nothing. Lasts until its destruction.
class PetscErrorScope {
 public:
  PetscErrorScope();
  ~PetscErrorScope();
  PetscErrorScope(const PetscErrorScope &) = delete;
  PetscErrorScope &operator=(const PetscErrorScope &) = delete;
};

/// Makes `ceed` keep its error messages for ceed_check instead of aborting.
void keep_ceed_errors(Ceed ceed);

[[noreturn]] void throw_petsc(int code, const SourcePlace &where);
[[noreturn]] void throw_ceed(int code, const SourcePlace &where);

/// Throws Error if a PETSc call failed: `petsc_check(VecSet(x, 0.));`
inline void petsc_check(PetscErrorCode code, const SourcePlace &where = SourcePlace::here()) {
  if (code) [[unlikely]]
    throw_petsc(static_cast<int>(code), where);
}

/// Throws Error if a CEED call failed: `ceed_check(CeedVectorSetValue(x, 0.));`
inline void ceed_check(int code, const SourcePlace &where = SourcePlace::here()) {
  if (code) [[unlikely]]
    throw_ceed(code, where);
}

/// Reports an exception's message to PETSc and returns a PETSc error code; for guard.
PetscErrorCode raise_in_petsc(const char *message, const SourcePlace &where);

/// Runs `body` where PETSc called us back; no exception passes through PETSc's frames.
template <class Body>
PetscErrorCode guard(Body &&body, const SourcePlace &where = SourcePlace::here()) {
  try {
    body();
    return static_cast<PetscErrorCode>(0);
  } catch (const std::exception &error) {
    return raise_in_petsc(error.what(), where);
  }
}

/// Prints `message` once as "honeyguide: error: ..." and ends every rank of the run with status 1.
[[noreturn]] void abort_run(const char *message);

}  // namespace hg
