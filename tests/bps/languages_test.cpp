/// @file
/// The QFunctions are C text for host and device: compiled as C11 and as C++20 they compute the same.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "qfunctions_in_c.h"
#include "support/random.hpp"

namespace {

TEST(QFunctions, AreTheSameInCAndInCxx) {
  constexpr CeedInt Q = 20;
  hg::test::Random random(7);
  std::vector<std::vector<CeedScalar>> inputs;
  std::vector<const CeedScalar *> in;
  for (int i = 0; i < 5; i++) inputs.push_back(random.reals(9 * Q, 0.1, 2));
  for (const auto &input : inputs) in.push_back(input.data());
  BPSolution solution{0.5, 3};
  CeedInt num_comp = 3;
  const NamedQFunction *in_c = qfunctions_in_c();
  int count = 0;
  for (; all_qfunctions[count].name; count++) {
    const NamedQFunction &ours = all_qfunctions[count], &theirs = in_c[count];
    ASSERT_STREQ(ours.name, theirs.name);
    ASSERT_NE(ours.function, theirs.function) << "one of the two languages was not compiled";
    void *context = ours.takes_solution ? static_cast<void *>(&solution) : &num_comp;
    std::vector<CeedScalar> v(9 * Q, -1), w(9 * Q, -1);
    CeedScalar *const out_v[] = {v.data()}, *const out_w[] = {w.data()};
    EXPECT_EQ(ours.function(context, Q, in.data(), out_v), 0);
    EXPECT_EQ(theirs.function(context, Q, in.data(), out_w), 0);
    EXPECT_NE(v, std::vector<CeedScalar>(9 * Q, -1)) << ours.name << " writes nothing";
    // Compilers may order and fuse differently.
    for (std::size_t i = 0; i < v.size(); i++) ASSERT_NEAR(v[i], w[i], 1e-12 * (1 + std::abs(v[i]))) << ours.name;
  }
  EXPECT_EQ(in_c[count].name, nullptr);
  EXPECT_EQ(count, 28);
}

}  // namespace
