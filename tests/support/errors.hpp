/// @file
/// Errors of the C interface in tests: ok() for calls that must succeed, expect_error() for calls that must not.
#pragma once

#include <ceed.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "source_location.hpp"

namespace hg::test {

/// What an error handler was told.
struct Report {
  int code = 0;
  std::string message, function, file;
  int line = 0;
};

/// Makes `ceed` record its errors instead of ending the process.
void record_errors(Ceed ceed);
/// The last error recorded in this thread, and how many there have been.
const Report &last_report();
int num_reports();
void forget_reports();

/// Throws, with what was reported, unless `code` is 0: the test fails there and ends.
void ok(int code, SourceLocation where = SourceLocation::current());

/// Expects that a call failed with the code `want` and that its message holds all fragments.
void expect_error(int got, int want, std::initializer_list<std::string_view> fragments,
                  SourceLocation where = SourceLocation::current());

/// Opens a backend whose errors are recorded. The process' own handler (for errors before there is a Ceed) is set to
/// return.
Ceed open(const std::string &resource);

}  // namespace hg::test
