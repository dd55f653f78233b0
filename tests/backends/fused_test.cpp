// Whole operators on a device, here the emulator: what the conformance suite cannot see.
#include <ceed.h>
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <utility>

#include "bakeoff_operator.hpp"
#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/program.hpp"

namespace {

using namespace hg::test;

/// Points in a cell; 0: quadrature points.
class FusedTest : public testing::TestWithParam<CeedInt> {
 protected:
  const CeedHandle ceed{open("/gpu/emu/gen")};
  const BakeoffOperator op{ceed, true, 3, 3, 4, GetParam()};
};

/// No part of the work is left to the host.
TEST_P(FusedTest, TakesAssemblies) {
  const CeedBackendOps *ops = nullptr;
  const CeedProgram *program = nullptr;
  ok(CeedGetBackendOps(ceed, &ops));
  ok(CeedOperatorGetProgram(op, &program));
  CeedSize length = 0, num_entries = 0;
  ok(CeedOperatorGetActiveVectorLengths(op, &length, nullptr));
  ok(CeedOperatorLinearAssembleGetNumEntries(op, &num_entries));
  for (const auto &[kind, size] :
       {std::pair(CEED_ASSEMBLE_MATRIX, num_entries), std::pair(CEED_ASSEMBLE_DIAGONAL, length),
        std::pair(CEED_ASSEMBLE_POINT_BLOCKS, 3 * length)}) {
    Vector values;
    ok(CeedVectorCreate(ceed, size, values.out()));
    ok(CeedVectorSetValue(values, 0));
    bool is_done = false;
    ok(ops->op.linear_assemble(op, program, kind, 0, values, &is_done));
    EXPECT_TRUE(is_done) << kind;
    CeedScalar norm = 0;
    ok(CeedVectorNorm(values, CEED_NORM_MAX, &norm));
    EXPECT_GT(norm, 0) << kind;
  }
}

/// Timings of applications hide no compilation.
TEST_P(FusedTest, IsCompiledAheadOfTime) {
  const EmptyCache cache;
  ok(CeedOperatorPrepare(op));
  const std::size_t prepared = cache.num_files();
  EXPECT_GT(prepared, 0U);
  CeedSize length = 0;
  ok(CeedOperatorGetActiveVectorLengths(op, &length, nullptr));
  Vector in, out;
  ok(CeedVectorCreate(ceed, length, in.out()));
  ok(CeedVectorCreate(ceed, length, out.out()));
  ok(CeedVectorSetValue(in, 1));
  ok(CeedVectorSetValue(out, 0));
  const std::size_t before = cache.num_files();  // vectors have kernels of the library
  ok(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(cache.num_files(), before);
}

INSTANTIATE_TEST_SUITE_P(Points, FusedTest, testing::Values(0, 27),
                         [](const auto &info) { return info.param > 0 ? "Own" : "Quadrature"; });

}  // namespace
