/// @file
/// The wall between C++ and C: inside, errors are exceptions; every entry point is `return guard(ceed, [&] { ... });`.
#pragma once

#include <ceed/backend.h>

#include <exception>
#include <new>
#include <source_location>
#include <string>
#include <string_view>
#include <utility>

namespace hg {

/// An error on its way to the user: a CeedErrorType and a message, with the place that noticed it.
class Error : public std::exception {
 public:
  Error(int code, std::string message, std::source_location where = std::source_location::current())
      : code_(code), message_(std::move(message)), where_(where) {}
  const char *what() const noexcept override { return message_.c_str(); }
  int code() const noexcept { return code_; }
  const std::source_location &where() const noexcept { return where_; }

 private:
  int code_;
  std::string message_;
  std::source_location where_;
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
                    std::source_location where = std::source_location::current()) {
  if (condition) [[likely]]
    return;
  if constexpr (std::is_invocable_v<Message>) {
    throw Error(code, message(), where);
  } else {
    throw Error(code, std::string(std::forward<Message>(message)), where);
  }
}

/// Throws unless a C function succeeded; it has reported its error itself.
inline void check(int code) {
  if (code != CEED_ERROR_SUCCESS) throw Reported{code};
}

/// Calls the handler of `ceed` (of the process if NULL) with the error. Never throws.
int report(Ceed ceed, const Error &error) noexcept;

/// Runs `f`; what it throws becomes a code after the handler of `ceed` has seen it.
template <typename F>
int guard(Ceed ceed, F &&f) noexcept {
  try {
    std::forward<F>(f)();
    return CEED_ERROR_SUCCESS;
  } catch (const Reported &reported) {
    return reported.code;
  } catch (const Error &error) {
    return report(ceed, error);
  } catch (const std::bad_alloc &) {
    return report(ceed, Error(CEED_ERROR_MAJOR, "Out of memory"));
  } catch (const std::exception &error) {
    return report(ceed, Error(CEED_ERROR_MAJOR, error.what()));
  }
}

}  // namespace hg
