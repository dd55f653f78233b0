#include "errors.hpp"

#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace hg::test {
namespace {

thread_local Report report;
thread_local int count = 0;

int record(Ceed, const char *file, int line, const char *function, int code, const char *format, va_list *args) {
  va_list again;
  va_copy(again, *args);
  const int length = std::vsnprintf(nullptr, 0, format, again);
  va_end(again);
  std::vector<char> buffer(static_cast<std::size_t>(length < 0 ? 0 : length) + 1);
  va_copy(again, *args);
  std::vsnprintf(buffer.data(), buffer.size(), format, again);
  va_end(again);
  report = {code, buffer.data(), function != nullptr ? function : "", file != nullptr ? file : "", line};
  count++;
  return code;
}

}  // namespace

void record_errors(Ceed ceed) {
  ok(CeedSetErrorHandler(ceed, record));
}

const Report &last_report() {
  return report;
}
int num_reports() {
  return count;
}

void forget_reports() {
  report = {};
  count = 0;
}

void ok(int code, SourceLocation where) {
  if (code == CEED_ERROR_SUCCESS) return;
  throw std::runtime_error(std::string(where.file_name()) + ":" + std::to_string(where.line()) + ": code " +
                           std::to_string(code) + " from " + report.function + "(): " + report.message);
}

void expect_error(int got, int want, std::initializer_list<std::string_view> fragments, SourceLocation where) {
  const auto line = where.line();
  if (got != want) {
    ADD_FAILURE_AT(where.file_name(), line)
        << "returned code " << got << ", expected " << want << "; last message: " << report.message;
  }
  if (got == CEED_ERROR_SUCCESS) return;
  if (report.code != got) {
    ADD_FAILURE_AT(where.file_name(), line) << "returned code " << got << " but the handler was told " << report.code;
  }
  for (const std::string_view fragment : fragments) {
    if (report.message.find(fragment) == std::string::npos) {
      ADD_FAILURE_AT(where.file_name(), line) << "message does not hold \"" << fragment << "\": " << report.message;
    }
  }
}

Ceed open(const std::string &resource) {
  ::setenv("CEED_ERROR_HANDLER", "return", 1);
  Ceed ceed = nullptr;
  if (const int code = CeedInit(resource.c_str(), &ceed)) {
    throw std::runtime_error("CeedInit(\"" + resource + "\") returned " + std::to_string(code));
  }
  record_errors(ceed);
  return ceed;
}

}  // namespace hg::test
