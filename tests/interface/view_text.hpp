/// @file
/// What a View function prints, as a string.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

namespace hg::test {

/// Calls print(stream) and returns what it wrote.
template <typename Print>
std::string printed(Print &&print) {
  char *buffer = nullptr;
  std::size_t size = 0;
  FILE *stream = open_memstream(&buffer, &size);
  std::forward<Print>(print)(stream);
  std::fclose(stream);
  std::string result(buffer, size);
  std::free(buffer);
  return result;
}

}  // namespace hg::test
