#include "error.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "ceed.hpp"

namespace hg {

namespace {

std::string format_v(const char *format, va_list args) {
  va_list again;
  va_copy(again, args);
  const int length = std::vsnprintf(nullptr, 0, format, again);
  va_end(again);
  if (length < 0) return format;
  std::string result(static_cast<std::size_t>(length), '\0');
  std::vsnprintf(result.data(), result.size() + 1, format, args);
  return result;
}

std::string located(const char *file, int line, const char *function, const std::string &message) {
  return text("%s:%d in %s(): ", file, line, function) + message;
}

CeedErrorHandler handler_from_environment() {
  const char *name = std::getenv("CEED_ERROR_HANDLER");
  if (name == nullptr) return CeedErrorAbort;
  if (std::strcmp(name, "return") == 0) return CeedErrorReturn;
  if (std::strcmp(name, "store") == 0) return CeedErrorStore;
  if (std::strcmp(name, "exit") == 0) return CeedErrorExit;
  return CeedErrorAbort;
}

/// Keeps messages where there is no Ceed to do so.
ErrorStore &store_of(Ceed ceed) {
  thread_local ErrorStore without_ceed;
  return ceed != nullptr ? ceed->errors : without_ceed;
}

constexpr const char *no_message = "No error message stored";

}  // namespace

void ErrorStore::keep(std::string message) {
  const std::scoped_lock lock(mutex_);
  message_ = std::move(message);
}

const char *ErrorStore::get() {
  const std::scoped_lock lock(mutex_);
  return message_.empty() ? no_message : handed_out_.insert(message_).first->c_str();
}

void ErrorStore::forget() {
  const std::scoped_lock lock(mutex_);
  message_.clear();
  handed_out_.clear();
}

void keep_without_ceed(ErrorStore &errors) {
  const char *message = errors.get();
  if (message != no_message) store_of(nullptr).keep(message);
}

CeedErrorHandler default_error_handler() { return handler_from_environment(); }

std::string text(const char *format, ...) {
  va_list args;
  va_start(args, format);
  std::string result = format_v(format, args);
  va_end(args);
  return result;
}

int report(Ceed ceed, int code, const char *message, const Where &where, const char *function) noexcept {
  return CeedErrorImpl(ceed, where.file, where.line, function, code, "%s", message);
}

}  // namespace hg

int CeedErrorImpl(Ceed ceed, const char *filename, int lineno, const char *func, int ecode, const char *format, ...) {
  // A caller in trouble gets its code whatever it says about itself.
  if (filename == nullptr) filename = "(no file)";
  if (func == nullptr) func = "(no function)";
  if (format == nullptr) format = "(no message)";
  va_list args;
  va_start(args, format);
  const CeedErrorHandler handler = ceed != nullptr ? ceed->error_handler.load() : hg::handler_from_environment();
  handler(ceed, filename, lineno, func, ecode, format, &args);
  va_end(args);
  return ecode;
}

int CeedErrorReturn(Ceed, const char *, int, const char *, int err_code, const char *, va_list *) { return err_code; }

int CeedErrorStore(Ceed ceed, const char *filename, int line_no, const char *func, int err_code, const char *format,
                   va_list *args) {
  try {
    hg::store_of(ceed).keep(hg::located(filename, line_no, func, hg::format_v(format, *args)));
  } catch (const std::exception &) {
    hg::store_of(ceed).keep({});
  }
  return err_code;
}

int CeedErrorAbort(Ceed, const char *filename, int line_no, const char *func, int, const char *format, va_list *args) {
  std::fprintf(stderr, "%s:%d in %s(): ", filename, line_no, func);
  std::vfprintf(stderr, format, *args);
  std::fputc('\n', stderr);
  std::abort();
}

int CeedErrorExit(Ceed, const char *filename, int line_no, const char *func, int err_code, const char *format,
                  va_list *args) {
  std::fprintf(stderr, "%s:%d in %s(): ", filename, line_no, func);
  std::vfprintf(stderr, format, *args);
  std::fputc('\n', stderr);
  std::exit(err_code);
}

int CeedSetErrorHandler(Ceed ceed, CeedErrorHandler handler) {
  return hg::guard(ceed, [&] {
    hg::require(handler != nullptr, CEED_ERROR_MINOR, "Error handler is NULL; expected a function");
    hg::deref(ceed, "Ceed").error_handler = handler;
  });
}

int CeedGetErrorMessage(Ceed ceed, const char **err_msg) {
  return hg::guard(ceed, [&] { hg::result(err_msg, "err_msg") = hg::store_of(ceed).get(); });
}

int CeedResetErrorMessage(Ceed ceed, const char **err_msg) {
  return hg::guard(ceed, [&] {
    hg::result(err_msg, "err_msg") = nullptr;
    hg::store_of(ceed).forget();
  });
}
