// Arrays of the VTU files that we write.
#pragma once
#include <gtest/gtest.h>

#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "options/error.hpp"
#include "xml.hpp"

namespace hg::test {

inline std::vector<unsigned char> decode(const std::string &text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> out;
  unsigned bits = 0, have = 0;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) || c == '=') continue;
    const std::size_t d = digits.find(c);
    if (d == std::string::npos) fail("not base64: %c", c);
    bits = bits << 6 | static_cast<unsigned>(d);
    have += 6;
    if (have >= 8) {
      have -= 8;
      out.push_back(static_cast<unsigned char>(bits >> have & 255));
    }
  }
  return out;
}

template <class T>
std::vector<T> values(const Xml &array) {
  EXPECT_EQ(array.at("format"), "binary");
  const std::vector<unsigned char> bytes = decode(array.text);
  std::uint64_t length;
  std::memcpy(&length, bytes.data(), 8);
  EXPECT_EQ(bytes.size(), length + 8);
  std::vector<T> v(length / sizeof(T));
  std::memcpy(v.data(), bytes.data() + 8, length);
  return v;
}

}  // namespace hg::test
