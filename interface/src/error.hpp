/// @file
/// The wall between C++ and C: inside, errors are exceptions; every entry point is `return guard(ceed, [&] { ... });`.
#pragma once

#include <ceed/backend.h>

#include <exception>
#include <mutex>
#include <new>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace hg {

/// A place in the source. (std::source_location needs a built-in that clang 14 lacks.)
struct Where {
  const char *file = "";
  int line = 0;

  static constexpr Where current(const char *file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
};

/// An error on its way to the user: a CeedErrorType and a message, with the place that noticed it.
class Error : public std::exception {
 public:
  Error(int code, std::string message, Where where = Where::current())
      : code_(code), message_(std::move(message)), where_(where) {}
  const char *what() const noexcept override { return message_.c_str(); }
  int code() const noexcept { return code_; }
  const Where &where() const noexcept { return where_; }

 private:
  int code_;
  std::string message_;
  Where where_;
};

/// An error that a C function has already reported to the handler: only its code travels on.
struct Reported {
  int code;
};

/// printf-style text.
[[gnu::format(printf, 1, 2)]] std::string text(const char *format, ...);

/// Throws an Error unless `condition` holds. The message must say which object, which value, and what was expected;
/// build it with text(). The lambda form `require(cond, code, [&] { return text(...); })` costs nothing when true.
template <typename Message>
inline void require(bool condition, int code, Message &&message,
                    Where where = Where::current()) {
  if (condition) [[likely]]
    return;
  if constexpr (std::is_invocable_v<Message>) {
    throw Error(code, message(), where);
  } else {
    throw Error(code, std::string(std::forward<Message>(message)), where);
  }
}

/// Throws if a pointer argument is NULL; `what` names it and says what it should be.
template <typename T>
void require_argument(T *argument, const char *what, Where where = Where::current()) {
  require(
      argument != nullptr, CEED_ERROR_INCOMPLETE, [&] { return text("Argument is NULL; expected %s", what); }, where);
}

/// Where a result goes; throws if the argument `name` is NULL.
template <typename T>
T &result(T *argument, const char *name, Where where = Where::current()) {
  require(
      argument != nullptr, CEED_ERROR_INCOMPLETE,
      [&] { return text("Argument '%s' is NULL; expected where its value goes", name); }, where);
  return *argument;
}

/// Throws unless a C function succeeded; it has reported its error itself.
inline void check(int code) {
  if (code != CEED_ERROR_SUCCESS) throw Reported{code};
}

/// Calls the handler of `ceed` (of the process if NULL) with an error; `function` is the entry point that the user
/// called. Never throws and allocates nothing: memory may be what has run out.
int report(Ceed ceed, int code, const char *message, const Where &where, const char *function) noexcept;

/// What CeedErrorStore() keeps: the last message, of whichever thread. What has been handed out stays where it is until
/// it is forgotten, so a thread may read it while another one fails.
class ErrorStore {
 public:
  void keep(std::string message);
  const char *get();
  void forget();

 private:
  std::mutex mutex_;
  std::string message_;
  std::set<std::string> handed_out_;
};

/// Runs `f`; what it throws becomes a code after the handler of `ceed` has seen it.
template <typename F>
int guard(Ceed ceed, F &&f, const char *function = __builtin_FUNCTION()) noexcept {
  try {
    std::forward<F>(f)();
    return CEED_ERROR_SUCCESS;
  } catch (const Reported &reported) {
    return reported.code;
  } catch (const Error &error) {
    return report(ceed, error.code(), error.what(), error.where(), function);
  } catch (const std::bad_alloc &) {
    return report(ceed, CEED_ERROR_MAJOR, "Out of memory", Where::current(), function);
  } catch (const std::exception &error) {
    return report(ceed, CEED_ERROR_MAJOR, error.what(), Where::current(), function);
  } catch (...) {
    return report(ceed, CEED_ERROR_MAJOR, "An exception of unknown type was thrown", Where::current(), function);
  }
}

}  // namespace hg
