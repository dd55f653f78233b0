/// @file
/// A record of each case in a file, for programs that read what the suite found: ceed-info.
///
/// Lines of fields separated by tabs. A case has two: `start <area> <suite> <case>` before it runs, and
/// `passed|failed|skipped <area> <suite> <case> <milliseconds> <message>` after it; a case without the second one ended
/// the process. The area is the name of the test's file without _test.cpp.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace hg::test {

class Recorder : public testing::EmptyTestEventListener {
 public:
  /// Appends to the file. Throws std::runtime_error where it cannot be written.
  explicit Recorder(const std::string &file);
  void OnTestStart(const testing::TestInfo &info) override;
  void OnTestEnd(const testing::TestInfo &info) override;

 private:
  std::ofstream stream_;
};

/// A negative filter of GoogleTest for the cases that the file says were started ("" where there is no such file): a run
/// that was ended by a case goes on after it.
std::string filter_of_cases_in(const std::string &file);

}  // namespace hg::test
