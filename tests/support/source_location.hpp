/// @file
/// Where a check stands in a test. (SourceLocation needs a built-in that clang 14 lacks.)
#pragma once

namespace hg::test {

class SourceLocation {
 public:
  static constexpr SourceLocation current(const char *file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
  constexpr const char *file_name() const { return file_; }
  constexpr int line() const { return line_; }

 private:
  constexpr SourceLocation(const char *file, int line) : file_(file), line_(line) {}
  const char *file_;
  int line_;
};

}  // namespace hg::test
