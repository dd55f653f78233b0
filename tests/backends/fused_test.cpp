// Whole operators on a device, here the emulator: what the conformance suite cannot see.
#include <ceed.h>
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bakeoff_operator.hpp"
#include "qfunctions/by_factor.h"
#include "qfunctions/coupled.h"
#include "qfunctions/refuse.h"
#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/program.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

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

/// Nothing goes to the host and back.
TEST_P(FusedTest, AssemblesQFunctionsOnTheDevice) {
  ok(CeedOperatorPrepare(op));
  CeedTransfers before, after;
  ok(CeedGetTransfers(ceed, &before));
  Vector assembled;
  Restriction rstr;
  ok(CeedOperatorLinearAssembleQFunction(op, assembled.out(), rstr.out(), CEED_REQUEST_IMMEDIATE));
  ok(CeedGetTransfers(ceed, &after));
  EXPECT_EQ(after.num_to_host, before.num_to_host);
  CeedScalar norm = 0;
  ok(CeedVectorNorm(assembled, CEED_NORM_MAX, &norm));
  EXPECT_EQ(norm, 1);  // what is stored at the points is 1
}

/// Several active fields: their diagonals, one after another; not where a cell meets an entry in two of them.
TEST(SeveralFields, HaveTheirDiagonals) {
  const CeedHandle ceed{open("/gpu/emu/gen")}, host{open("/cpu/self/ref/serial")};
  // Two cells of a line; the scalar's places come after the vector's, or one is the vector's last one.
  for (const CeedInt overlap : {0, 1}) {
    const auto diagonal_of = [&](Ceed on, bool *is_done) {
      const std::array<CeedInt, 6> places_u{0, 3, 6, 6, 9, 12};
      const std::array<CeedInt, 4> places_p{17, 16, 16, 15 - overlap};
      Restriction rstr_u, rstr_p;
      ok(CeedElemRestrictionCreate(on, 2, 3, 3, 1, 18, CEED_MEM_HOST, CEED_COPY_VALUES, places_u.data(), rstr_u.out()));
      ok(CeedElemRestrictionCreate(on, 2, 2, 1, 1, 18, CEED_MEM_HOST, CEED_COPY_VALUES, places_p.data(), rstr_p.out()));
      Basis basis_u, basis_p;
      ok(CeedBasisCreateTensorH1Lagrange(on, 1, 3, 3, 3, CEED_GAUSS, basis_u.out()));
      ok(CeedBasisCreateTensorH1Lagrange(on, 1, 1, 2, 3, CEED_GAUSS, basis_p.out()));
      QFunction qf;
      ok(CeedQFunctionCreateInterior(on, 1, coupled, coupled_loc, qf.out()));
      ok(CeedQFunctionAddInput(qf, "u", 3, CEED_EVAL_INTERP));
      ok(CeedQFunctionAddInput(qf, "p", 1, CEED_EVAL_INTERP));
      ok(CeedQFunctionAddOutput(qf, "v", 3, CEED_EVAL_INTERP));
      ok(CeedQFunctionAddOutput(qf, "q", 1, CEED_EVAL_INTERP));
      Operator op;
      ok(CeedOperatorCreate(on, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
      for (const char *name : {"u", "v"}) ok(CeedOperatorSetField(op, name, rstr_u, basis_u, CEED_VECTOR_ACTIVE));
      for (const char *name : {"p", "q"}) ok(CeedOperatorSetField(op, name, rstr_p, basis_p, CEED_VECTOR_ACTIVE));
      const Vector diagonal = make_vector(on, 18, 0);
      if (is_done != nullptr) {
        const CeedBackendOps *ops = nullptr;
        const CeedProgram *program = nullptr;
        ok(CeedGetBackendOps(on, &ops));
        ok(CeedOperatorGetProgram(op, &program));
        ok(ops->op.linear_assemble(op, program, CEED_ASSEMBLE_DIAGONAL, 0, diagonal, is_done));
      }
      ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
      return values_of(diagonal);
    };
    bool is_done = false;
    const Values got = diagonal_of(ceed, &is_done);
    EXPECT_EQ(is_done, overlap == 0);
    expect_close(got, diagonal_of(host, nullptr), 1e-13, "diagonal");
  }
}

/// The parts of a composite are launched as one, with what they were last time; their sum is that of one by one.
TEST(Composites, AreTheSumOfTheirParts) {
  const CeedHandle ceed{open("/gpu/emu/gen:order=shuffled")};
  const BakeoffOperator at_quadrature(ceed, true, 3, 3, 4, 0), at_points(ceed, true, 3, 3, 4, 27);
  Operator both;
  ok(CeedOperatorCreateComposite(ceed, both.out()));
  for (CeedOperator part : {CeedOperator(at_quadrature), CeedOperator(at_points), CeedOperator(at_quadrature)}) {
    ok(CeedOperatorCompositeAddSub(both, part));
  }
  CeedSize length = 0;
  ok(CeedOperatorGetActiveVectorLengths(both, &length, nullptr));
  Random random(7);
  for (int turn = 0; turn < 2; turn++) {
    const Vector in = make_vector(ceed, random.reals(length)), out = make_vector(ceed, length, 3);
    const Vector part = make_vector(ceed, length, 0), want = make_vector(ceed, length, 0);
    ok(CeedOperatorApply(both, in, out, CEED_REQUEST_IMMEDIATE));
    ok(CeedOperatorApply(at_quadrature, in, part, CEED_REQUEST_IMMEDIATE));
    ok(CeedOperatorApply(at_points, in, want, CEED_REQUEST_IMMEDIATE));
    ok(CeedVectorAXPY(want, 2, part));
    expect_close(values_of(out), values_of(want), 1e-13, "sum");
  }
}

/// Who wants to know is told where an operator is not one kernel.
TEST(Fallbacks, AreToldToWhoDebugs) {
  const auto told = [] {
    const CeedHandle ceed{open("/gpu/emu/gen")};
    const std::array<CeedInt, 4> places{0, 1, 1, 2};
    const std::array<bool, 4> flips{false, true, false, false};
    Restriction rstr;
    Basis basis;
    QFunction qf;
    Operator op;
    ok(CeedElemRestrictionCreateOriented(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, places.data(),
                                         flips.data(), rstr.out()));
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 2, CEED_GAUSS, basis.out()));
    ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_INTERP, CEED_EVAL_INTERP, qf.out()));
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetName(op, "turned"));
    for (const char *name : {"input", "output"}) ok(CeedOperatorSetField(op, name, rstr, basis, CEED_VECTOR_ACTIVE));
    const Vector in = make_vector(ceed, 3, 1), out = make_vector(ceed, 3, 0);
    testing::internal::CaptureStderr();
    ok(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
    return testing::internal::GetCapturedStderr();
  };
  for (const char *variable : {"CEED_DEBUG", "DEBUG"}) ::unsetenv(variable);
  EXPECT_EQ(told().find("one kernel"), std::string::npos);
  ::setenv("CEED_DEBUG", "1", 1);
  const std::string text = told();
  ::unsetenv("CEED_DEBUG");
  EXPECT_NE(text.find("'turned' is not one kernel: it runs in stages"), std::string::npos) << text;
}

/// Objects on one device are of no use on another.
TEST(Devices, DoNotMix) {
  const CeedHandle first{open("/gpu/emu/gen")}, second{open("/gpu/emu/gen:device_id=1")};
  Vector of_first, of_second;
  ok(CeedVectorCreate(first, 5, of_first.out()));
  ok(CeedVectorCreate(second, 5, of_second.out()));
  ok(CeedVectorSetValue(of_first, 2));
  ok(CeedVectorSetValue(of_second, 1));
  CeedTransfers before, after;
  ok(CeedGetTransfers(second, &before));
  ok(CeedVectorAXPY(of_second, 3, of_first));  // by way of the host
  ok(CeedGetTransfers(second, &after));
  EXPECT_GT(after.num_to_host, before.num_to_host);
  CeedScalar norm = 0;
  ok(CeedVectorNorm(of_second, CEED_NORM_MAX, &norm));
  EXPECT_EQ(norm, 7);

  QFunction qf;
  Operator op;
  Restriction rstr;
  const std::array<CeedInt, 3> strides{1, 5, 5};
  ok(CeedQFunctionCreateIdentity(second, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, qf.out()));
  ok(CeedOperatorCreate(second, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedElemRestrictionCreateStrided(first, 1, 5, 1, 5, strides.data(), rstr.out()));
  ok(CeedSetErrorHandler(second, CeedErrorStore));
  EXPECT_EQ(CeedOperatorSetField(op, "input", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPATIBLE);
  const char *message = nullptr;
  ok(CeedGetErrorMessage(second, &message));
  EXPECT_NE(std::string(message).find("on device 1"), std::string::npos) << message;
}

/// Operators that are made anew for points that have moved are those that were compiled before.
TEST(Layouts, AreKeptWhilePointsMove) {
  const EmptyCache cache;
  const CeedHandle ceed{open("/gpu/emu/gen")};
  std::size_t compiled = 0;
  for (const CeedInt per_cell : {27, 20, 9, 64, 28, 8}) {
    const BakeoffOperator op(ceed, true, 3, 3, 4, per_cell);
    ok(CeedOperatorPrepare(op));
    if (compiled == 0) compiled = cache.num_files();
    ASSERT_GT(compiled, 0U);
    EXPECT_EQ(cache.num_files(), compiled) << per_cell << " points in a cell";
  }
}

/// Another layout is taken where that is better by far, and what is compiled once is found again.
TEST(Layouts, AreFoundAgain) {
  const EmptyCache cache;
  const CeedHandle ceed{open("/gpu/emu/gen")};
  std::vector<std::size_t> compiled;
  for (const CeedInt per_cell : {27, 1, 27, 1}) {
    const BakeoffOperator op(ceed, true, 3, 3, 4, per_cell);
    ok(CeedOperatorPrepare(op));
    compiled.push_back(cache.num_files());
  }
  EXPECT_GT(compiled[1], compiled[0]);
  EXPECT_EQ(compiled[2], compiled[1]);
  EXPECT_EQ(compiled[3], compiled[1]);
}

/// What vectors do, they do where they are.
TEST(Vectors, StayOnTheDevice) {
  const CeedHandle ceed{open("/gpu/emu/gen")};
  constexpr CeedSize length = 1000;
  Vector x, y, z;
  for (Vector *vec : {&x, &y, &z}) ok(CeedVectorCreate(ceed, length, vec->out()));
  CeedTransfers before, after;
  ok(CeedGetTransfers(ceed, &before));
  ok(CeedVectorSetValue(x, 2));
  ok(CeedVectorSetValue(y, 3));
  ok(CeedVectorCopy(x, z));
  ok(CeedVectorScale(z, 2));             // 4
  ok(CeedVectorAXPY(z, 2, y));           // 10
  ok(CeedVectorAXPBY(z, 1, 0.5, x));     // 7
  ok(CeedVectorPointwiseMult(z, x, y));  // 6
  ok(CeedVectorReciprocal(z));           // 1/6
  ok(CeedVectorSetValueStrided(z, 0, length, 2, 5));
  ok(CeedVectorCopyStrided(y, 1, length, 2, z));  // every second one: 3
  ok(CeedGetTransfers(ceed, &after));
  EXPECT_EQ(after.num_to_host, before.num_to_host);
  EXPECT_EQ(after.bytes_to_device, before.bytes_to_device);
  for (const auto &[type, want] :
       {std::pair(CEED_NORM_1, 4000.), std::pair(CEED_NORM_2, std::sqrt(17000.)), std::pair(CEED_NORM_MAX, 5.)}) {
    CeedScalar norm = 0;
    ok(CeedGetTransfers(ceed, &before));
    ok(CeedVectorNorm(z, type, &norm));
    ok(CeedGetTransfers(ceed, &after));
    EXPECT_NEAR(norm, want, 1e-12 * want);
    EXPECT_LT(after.bytes_to_host - before.bytes_to_host, length * static_cast<CeedSize>(sizeof(CeedScalar)));
  }
}

/// A QFunction of u and v in one operator, on 12 values in three elements.
class Stored {
 public:
  Stored(Ceed ceed, CeedQFunctionUser function, const char *source) : ceed_(ceed) {
    const std::array<CeedInt, 3> strides{1, 4, 4};
    Restriction rstr;
    QFunction qf;
    ok(CeedElemRestrictionCreateStrided(ceed, 3, 4, 1, 12, strides.data(), rstr.out()));
    ok(CeedQFunctionCreateInterior(ceed, 1, function, source, qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_NONE));
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op_.out()));
    for (const char *name : {"u", "v"}) ok(CeedOperatorSetField(op_, name, rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    out_ = make_vector(ceed, 12, 0);
  }
  int apply(const Values &u) { return CeedOperatorApply(op_, make_vector(ceed_, u), out_, CEED_REQUEST_IMMEDIATE); }
  Values result() const { return values_of(out_); }

 private:
  Ceed ceed_;
  Operator op_;
  Vector out_;
};

/// What a QFunction returns is not lost, wherever its text says it.
class FailingFunction : public testing::TestWithParam<std::string> {};

TEST_P(FailingFunction, IsAnError) {
  const CeedHandle ceed{open(GetParam())};
  Stored op(ceed, refuse, refuse_loc);
  const Values small(12, 0.5);
  Values large = small;
  large[9] = 2;
  ok(CeedSetErrorHandler(ceed, CeedErrorStore));
  for (int turn = 0; turn < 2; turn++) {  // a failure is told once
    ok(op.apply(small));
    EXPECT_EQ(op.apply(large), CEED_ERROR_BACKEND);
    const char *message = nullptr;
    ok(CeedGetErrorMessage(ceed, &message));
    EXPECT_NE(std::string(message).find("'refuse' returned 7"), std::string::npos) << message;
  }
}

/// A QFunction that says where its text is, and it is not there.
TEST(MissingText, IsAnErrorThatNamesTheQFunction) {
  for (const char *resource : {"/gpu/emu/ref", "/gpu/emu/gen"}) {
    const CeedHandle ceed{open(resource)};
    Stored op(ceed, refuse, "/nowhere/refuse.h:refuse");
    ok(CeedSetErrorHandler(ceed, CeedErrorStore));
    EXPECT_EQ(op.apply(Values(12, 0.5)), CEED_ERROR_BACKEND);
    const char *message = nullptr;
    ok(CeedGetErrorMessage(ceed, &message));
    EXPECT_NE(std::string(message).find(
                  "the QFunction 'refuse' is not compiled: its source '/nowhere/refuse.h' is not there"),
              std::string::npos)
        << message;
  }
}

/// What a program defines for its QFunctions reaches them on devices, in each form.
class DefinesTest : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(DefinesTest, ReachQFunctions) {
  const auto &[resource, define] = GetParam();
  const CeedHandle ceed{open(resource)};
  ok(CeedAddJitDefine(ceed, define.c_str()));
  Stored op(ceed, by_factor, by_factor_loc);
  ok(op.apply(Values(12, 0.5)));
  EXPECT_EQ(op.result(), Values(12, 3.5));
}

INSTANTIATE_TEST_SUITE_P(Backends, DefinesTest,
                         testing::Combine(testing::Values("/gpu/emu/ref", "/gpu/emu/gen"),
                                          testing::Values("HG_TEST_FACTOR=7", "-DHG_TEST_FACTOR=7")),
                         [](const auto &info) { return "Case" + std::to_string(info.index); });
INSTANTIATE_TEST_SUITE_P(Backends, FailingFunction,
                         testing::Values("/cpu/self/ref/serial", "/gpu/emu/ref", "/gpu/emu/gen"),
                         [](const auto &info) { return info.param.substr(5, 3) + std::to_string(info.index); });

/// A backend, and points in a cell.
class PreparedTest : public testing::TestWithParam<std::tuple<std::string, CeedInt>> {
 protected:
  const CeedHandle ceed{open(std::get<0>(GetParam()))};
  const BakeoffOperator op{ceed, true, 3, 3, 4, std::get<1>(GetParam())};
};

/// Timings of applications hide no compilation, and no copy but that of their own vectors.
TEST_P(PreparedTest, HasAllOfItsFirstApplication) {
  const EmptyCache cache;
  ok(CeedOperatorPrepare(op));
  const std::size_t prepared = cache.num_files();
  EXPECT_GT(prepared, 0U);
  CeedSize length = 0;
  ok(CeedOperatorGetActiveVectorLengths(op, &length, nullptr));
  Vector in, out;
  std::vector<CeedScalar> ones(length, 1);
  ok(CeedVectorCreate(ceed, length, in.out()));
  ok(CeedVectorCreate(ceed, length, out.out()));
  ok(CeedVectorSetArray(in, CEED_MEM_HOST, CEED_USE_POINTER, ones.data()));
  CeedTransfers before, after;
  ok(CeedGetTransfers(ceed, &before));
  ok(CeedOperatorApply(op, in, out, CEED_REQUEST_IMMEDIATE));
  ok(CeedGetTransfers(ceed, &after));
  EXPECT_EQ(cache.num_files(), prepared);
  // Stages have the addresses of the QFunction's fields there, too.
  const CeedSize most = ones.size() * sizeof(CeedScalar) + 3 * sizeof(void *);
  EXPECT_LE(after.bytes_to_device - before.bytes_to_device, most);
  EXPECT_EQ(after.num_to_host, before.num_to_host);
}

/// A backend that compiles for assemblies, and points in a cell.
class PreparedAssemblyTest : public PreparedTest {
 protected:
  void assemble(CeedOperatorUse use) const {
    CeedSize length = 0, num_entries = 0;
    ok(CeedOperatorGetActiveVectorLengths(op, &length, nullptr));
    ok(CeedOperatorLinearAssembleGetNumEntries(op, &num_entries));
    Vector values, diagonal, blocks;
    Restriction rstr;
    switch (use) {
      case CEED_USE_APPLY:
        FAIL() << "that is no assembly";
      case CEED_USE_ASSEMBLE_QFUNCTION:
        return ok(CeedOperatorLinearAssembleQFunction(op, values.out(), rstr.out(), CEED_REQUEST_IMMEDIATE));
      case CEED_USE_ASSEMBLE:
        ok(CeedVectorCreate(ceed, num_entries, values.out()));
        return ok(CeedOperatorLinearAssemble(op, values));
      case CEED_USE_ASSEMBLE_DIAGONAL:
        ok(CeedVectorCreate(ceed, length, values.out()));
        return ok(CeedOperatorLinearAssembleDiagonal(op, values, CEED_REQUEST_IMMEDIATE));
      case CEED_USE_ASSEMBLE_POINT_BLOCKS:
        ok(CeedVectorCreate(ceed, 3 * length, values.out()));
        return ok(CeedOperatorLinearAssemblePointBlockDiagonal(op, values, CEED_REQUEST_IMMEDIATE));
    }
  }
};

/// Nor do those of assemblies, each of which is prepared by itself.
TEST_P(PreparedAssemblyTest, HasAllOfItsFirstAssembly) {
  for (const CeedOperatorUse use :
       {CEED_USE_ASSEMBLE_QFUNCTION, CEED_USE_ASSEMBLE, CEED_USE_ASSEMBLE_DIAGONAL, CEED_USE_ASSEMBLE_POINT_BLOCKS}) {
    SCOPED_TRACE(use);
    const EmptyCache cache;
    ok(CeedOperatorPrepareFor(op, use));
    const std::size_t prepared = cache.num_files();
    CeedTransfers before, after;
    ok(CeedGetTransfers(ceed, &before));
    assemble(use);
    ok(CeedGetTransfers(ceed, &after));
    EXPECT_EQ(cache.num_files(), prepared);
    EXPECT_EQ(after.bytes_to_device, before.bytes_to_device);
    EXPECT_EQ(after.num_to_host, before.num_to_host);
  }
}

/// What is assembled from an assembled QFunction that is kept needs that one alone.
TEST(KeptAssembly, IsWhatIsPrepared) {
  const CeedHandle ceed{open("/gpu/emu/gen")};
  const auto num_compiled = [&](CeedOperatorUse use, bool is_kept) {
    const BakeoffOperator op(ceed, true, 3, 3, 4, 0);
    const EmptyCache cache;
    ok(CeedOperatorSetQFunctionAssemblyReuse(op, is_kept));
    ok(CeedOperatorPrepareFor(op, CEED_USE_ASSEMBLE_QFUNCTION));
    const std::size_t of_qfunction = cache.num_files();
    ok(CeedOperatorPrepareFor(op, use));
    return cache.num_files() - of_qfunction;
  };
  EXPECT_EQ(num_compiled(CEED_USE_ASSEMBLE, true), 0U);
  EXPECT_GT(num_compiled(CEED_USE_ASSEMBLE, false), 0U);
}

INSTANTIATE_TEST_SUITE_P(Backends, PreparedAssemblyTest,
                         testing::Combine(testing::Values("/gpu/emu/gen", "/cpu/self/gen"), testing::Values(0, 27)),
                         [](const auto &info) {
                           const std::string where = std::get<0>(info.param).substr(1, 3);
                           return where + (std::get<1>(info.param) > 0 ? "Own" : "Quadrature");
                         });
INSTANTIATE_TEST_SUITE_P(Backends, PreparedTest,
                         testing::Combine(testing::Values("/gpu/emu/ref", "/gpu/emu/gen"), testing::Values(0, 27)),
                         [](const auto &info) {
                           const std::string tier = std::get<0>(info.param).substr(9);
                           return tier + (std::get<1>(info.param) > 0 ? "Own" : "Quadrature");
                         });
INSTANTIATE_TEST_SUITE_P(Points, FusedTest, testing::Values(0, 27),
                         [](const auto &info) { return info.param > 0 ? "Own" : "Quadrature"; });

}  // namespace
