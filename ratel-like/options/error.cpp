#include "options/error.hpp"

#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace hg {

namespace {

std::string formatted(const char *format, va_list args) {
  va_list copy;
  va_copy(copy, args);
  const int length = std::vsnprintf(nullptr, 0, format, copy);
  va_end(copy);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, args);
  return text;
}

// The innermost messages since the last throw. Kept by the handlers, which must not throw through C frames.
std::string petsc_message, ceed_message;

PetscErrorCode keep_petsc_error(MPI_Comm, int line, const char *function, const char *file, PetscErrorCode code,
                                PetscErrorType type, const char *message, void *) {
  if (type == PETSC_ERROR_INITIAL) {
    petsc_message = message && *message ? message : "";
    const char *text = nullptr;
    if (petsc_message.empty()) {
      PetscErrorMessage(code, &text, nullptr);
      petsc_message = text ? text : "unknown error";
    }
    if (std::getenv("HONEYGUIDE_TRACE")) std::fprintf(stderr, "%s:%d in %s\n", file, line, function);
  }
  return code;
}

int keep_ceed_error(Ceed, const char *, int, const char *function, int code, const char *format, va_list *args) {
  ceed_message = formatted(format, *args) + " [" + function + "]";
  return code;
}

std::string place(const SourcePlace &where) {
  return std::string(where.file) + ":" + std::to_string(where.line);
}

}  // namespace

void fail(const char *format, ...) {
  va_list args;
  va_start(args, format);
  std::string text = formatted(format, args);
  va_end(args);
  throw Error(text);
}

PetscErrorScope::PetscErrorScope() {
  petsc_check(PetscPushErrorHandler(keep_petsc_error, nullptr));
}
PetscErrorScope::~PetscErrorScope() {
  (void)PetscPopErrorHandler();
}

void keep_ceed_errors(Ceed ceed) {
  ceed_check(CeedSetErrorHandler(ceed, keep_ceed_error));
}

void throw_petsc(int code, const SourcePlace &where) {
  std::string message = std::exchange(petsc_message, {});
  if (message.empty()) message = "PETSc error " + std::to_string(code) + " (" + place(where) + ")";
  throw Error(message);
}

void throw_ceed(int code, const SourcePlace &where) {
  std::string message = std::exchange(ceed_message, {});
  if (message.empty()) message = "CEED error " + std::to_string(code) + " (" + place(where) + ")";
  throw Error(message);
}

PetscErrorCode raise_in_petsc(const char *message, const SourcePlace &where) {
  return PetscError(PETSC_COMM_SELF, static_cast<int>(where.line), where.function, where.file,
                    PETSC_ERR_USER, PETSC_ERROR_INITIAL, "%s", message);
}

void abort_run(const char *message) {
  int rank = 0, size = 1;
  int started = 0;
  MPI_Initialized(&started);
  if (started) {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
  }
  // An error that every rank meets is printed by rank 0 alone: it ends the run before the others wake up.
  if (rank != 0) usleep(300000);
  std::fflush(stdout);
  if (size > 1 && rank != 0) {
    std::fprintf(stderr, "honeyguide: error: [rank %d] %s\n", rank, message);
  } else {
    std::fprintf(stderr, "honeyguide: error: %s\n", message);
  }
  std::fflush(stderr);
  if (size > 1) MPI_Abort(MPI_COMM_WORLD, 1);
  std::_Exit(1);
}

}  // namespace hg
