/// @file
/// An error handler that keeps what it was told without allocating, and the end of a scenario.
#pragma once

#include <cstdio>

#include "failure_scenarios.hpp"

namespace hg::test {

/// What the handler was told last.
struct Told {
  int count = 0;
  int code = CEED_ERROR_SUCCESS;
  char message[512] = "";
};
inline Told told;

inline int keep_told(Ceed, const char *, int, const char *, int code, const char *format, va_list *args) {
  told.count++;
  told.code = code;
  va_list again;
  va_copy(again, *args);
  std::vsnprintf(told.message, sizeof told.message, format, again);
  va_end(again);
  return code;
}

/// How a scenario ended.
struct Ended {
  int code = CEED_ERROR_SUCCESS;
  const char *wrong = nullptr;  ///< a wrong result
};

inline Ended run_to_end(const Scenario &scenario, Ceed ceed) {
  told = {};
  try {
    scenario.run(ceed);
    return {};
  } catch (const Refused &refused) {
    return {refused.code, nullptr};
  } catch (const Wrong &wrong) {
    return {CEED_ERROR_SUCCESS, wrong.what};
  }
}

}  // namespace hg::test
