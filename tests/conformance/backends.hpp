/// @file
/// The backends that tests run on: every resource that the library lists and that opens on this machine.
///
/// A suite of tests is written once and runs on all of them:
///
///   class VectorTest : public hg::test::BackendTest {};
///   TEST_P(VectorTest, KeepsItsLength) { ... ceed ... }
///   INSTANTIATE_TEST_SUITE_P(Backends, VectorTest, testing::ValuesIn(usable_backends()), backend_name);
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace hg::test {

/// A listed resource and whether it opens.
struct Backend {
  std::string resource;
  bool is_usable = false;
  std::string reason;  ///< why it is not used
  int num_tests = 0;   ///< tests that ran on it
};

/// The reason of a backend that is not used because it begins with one of what HG_TEST_WITHOUT lists, by commas.
inline const std::string left_out = "left out by HG_TEST_WITHOUT";

/// All listed resources, in the order of their names. Each is first opened in a process of its own, so that a backend
/// which ends the process is only one that does not open. The list is made by the first call.
std::vector<Backend> &backends();
/// Restricts the list to these; before the first call of backends().
void choose_backends(std::vector<std::string> resources);
bool are_chosen();

/// For INSTANTIATE_TEST_SUITE_P: the resources that open, and their names in test names.
std::vector<std::string> usable_backends();
std::string backend_name(const testing::TestParamInfo<std::string> &info);

/// A fixture with an open backend whose errors are recorded.
class BackendTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override;
  bool is_reference() const { return GetParam() == reference_resource; }

  CeedHandle ceed;
};

}  // namespace hg::test
