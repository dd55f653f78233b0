/// @file
/// What programs do with each kind of object, for tests in which something fails on the way. They allocate nothing
/// themselves, hold every object by a handle that destroys it, and check results.
#pragma once

#include <ceed/backend.h>

#include <span>

namespace hg::test {

/// A call that did not succeed.
struct Refused {
  int code;
};

/// A result that is wrong though every call succeeded.
struct Wrong {
  const char *what;
};

struct Scenario {
  const char *name;
  void (*run)(Ceed ceed);  ///< throws Refused or Wrong
};

/// One or more for each object.
std::span<const Scenario> failure_scenarios();

}  // namespace hg::test
