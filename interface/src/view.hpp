/// @file
/// Lines of the View functions: each is indented by two spaces a step, num_view_tabs steps for the object itself.
#pragma once

#include <cstdarg>
#include <cstdio>

namespace hg {

class Lines {
 public:
  Lines(std::FILE *stream, int tabs) : stream_(stream), tabs_(tabs) {}

  /// Prints one line, `depth` steps further in than the object.
  [[gnu::format(printf, 3, 4)]] void operator()(int depth, const char *format, ...) const {
    std::fprintf(stream_, "%*s", 2 * (tabs_ + depth), "");
    va_list args;
    va_start(args, format);
    std::vfprintf(stream_, format, args);
    va_end(args);
    std::fputc('\n', stream_);
  }

 private:
  std::FILE *stream_;
  int tabs_;
};

/// "s" for two or more; "" for none too, as those who read the output expect.
inline const char *plural(std::size_t count) {
  return count > 1 ? "s" : "";
}

}  // namespace hg
