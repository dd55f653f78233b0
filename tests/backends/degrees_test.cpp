// Degrees up to 8 on an emulated device, where other tests end at 2 or 3: derivatives along z in registers, planes
// one by one, functions and sums that no longer fit into registers, and what no longer fits into shared memory.
#include <ceed.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "bakeoff_operator.hpp"
#include "qfunctions/bps/mass.h"
#include "qfunctions/bps/poisson.h"
#include "support/handles.hpp"
#include "support/program.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

/// What the files have beside.
[[maybe_unused]] constexpr CeedQFunctionUser not_used_here[] = {BPMassSetup, BPPoissonSetup};

/// A device, nodes of an element in one direction, and points in a cell, 0: quadrature points.
class DegreesTest : public testing::TestWithParam<std::tuple<std::string, CeedInt, CeedInt>> {
 protected:
  static CeedQFunctionUser function(bool is_poisson, CeedInt num_comp) {
    if (num_comp > 1) return is_poisson ? BPPoissonApply3 : BPMassApply3;
    return is_poisson ? BPPoissonApply : BPMassApply;
  }
  /// Action on random input, and diagonal.
  Values results(Ceed on, bool is_poisson, CeedInt num_comp, CeedInt Q) const {
    const auto &[device, P, per_cell] = GetParam();
    BakeoffOperator op(on, is_poisson, num_comp, P, Q, per_cell, function(is_poisson, num_comp));
    Random random(static_cast<std::uint64_t>(P));
    op.shuffle(random);
    CeedSize length = 0;
    ok(CeedOperatorGetActiveVectorLengths(op, &length, nullptr));
    const Vector in = make_vector(on, random.reals(length)), out = make_vector(on, length, 0),
                 diagonal = make_vector(on, length, 0);
    ok(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
    ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
    Values all = values_of(out);
    const Values more = values_of(diagonal);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

TEST_P(DegreesTest, AgreeWithTheReference) {
  const auto &[device, P, per_cell] = GetParam();
  const EmptyCache cache;  // what is compiled here for vendors' devices is compiled in another test
  const CeedHandle emulated{open(device)}, host{open(reference_resource)};
  for (const bool is_poisson : {false, true}) {
    for (const CeedInt num_comp : {1, 3}) {
      for (const CeedInt Q : {P, P + 1}) {
        if (Q == P && (per_cell > 0 || !is_poisson)) continue;
        SCOPED_TRACE(std::string(is_poisson ? "Poisson" : "mass") + ", components: " + std::to_string(num_comp) +
                     ", quadrature points: " + std::to_string(Q));
        expect_close(results(emulated, is_poisson, num_comp, Q), results(host, is_poisson, num_comp, Q), 1e-11,
                     "action and diagonal");
      }
    }
  }
}

/// What fits differs from 64 KB of shared memory, AMD's, to 227 KB.
[[maybe_unused]] constexpr const char *small = "/gpu/emu/gen:order=shuffled";
constexpr const char *large = "/gpu/emu/gen:order=backward,shared=227";
std::string name_of(const testing::TestParamInfo<DegreesTest::ParamType> &info) {
  return "Degree" + std::to_string(std::get<1>(info.param) - 1) + (std::get<2>(info.param) > 0 ? "Own" : "Quadrature");
}
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // for which most compile for minutes
INSTANTIATE_TEST_SUITE_P(Large, DegreesTest,
                         testing::Combine(testing::Values(large), testing::Values(6), testing::Values(0, 27)), name_of);
#else
INSTANTIATE_TEST_SUITE_P(Large, DegreesTest,
                         testing::Combine(testing::Values(large), testing::Values(5, 9), testing::Values(0, 27)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Small, DegreesTest,
                         testing::Combine(testing::Values(small), testing::Values(4, 6, 7, 8, 9),
                                          testing::Values(0, 27)),
                         name_of);
#endif

}  // namespace
