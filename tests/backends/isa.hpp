/// @file
/// Which instruction set the SIMD backends take.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

#include "support/errors.hpp"
#include "support/handles.hpp"

namespace hg::test {

inline constexpr const char *blocked = "/cpu/self/avx/blocked";

/// Chooses the instruction set of operators that are made while it lives.
class Isa {
 public:
  explicit Isa(const std::string &name) {
    if (const char *set = std::getenv(variable)) before_ = set;
    ::setenv(variable, name.c_str(), 1);
  }
  ~Isa() {
    if (before_) {
      ::setenv(variable, before_->c_str(), 1);
    } else {
      ::unsetenv(variable);
    }
  }
  Isa(const Isa &) = delete;
  Isa &operator=(const Isa &) = delete;

 private:
  static constexpr const char *variable = "CEED_HOST_ISA";
  std::optional<std::string> before_;
};

/// What a request opens.
inline std::string resource_of(const char *request) {
  const CeedHandle ceed{open(request)};
  const char *resource = nullptr;
  ok(CeedGetResource(ceed, &resource));
  return resource;
}

}  // namespace hg::test
