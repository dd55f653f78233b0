// Calls that a confused program makes, each of which once did harm: found by the fuzz target and by forced failures.
#include <gtest/gtest.h>

#include <cstdio>

#include "support/errors.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

int copies(void *, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  for (CeedInt q = 0; q < Q; q++) out[0][q] = in[0][q];
  return 0;
}

class Misuse : public testing::Test {
 protected:
  CeedHandle ceed{open("/cpu/self/ref/serial")};

  QFunction make_qfunction(CeedEvalMode mode) {
    QFunction qf;
    ok(CeedQFunctionCreateInterior(ceed, 1, copies, "misuse.h:copies", qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 1, mode));
    ok(CeedQFunctionAddOutput(qf, "v", 1, mode));
    return qf;
  }
};

TEST_F(Misuse, CompositesDoNotHoldThemselves) {
  Operator outer, middle, inner;
  for (Operator *op : {&outer, &middle, &inner}) ok(CeedOperatorCreateComposite(ceed, op->out()));
  ok(CeedOperatorCompositeAddSub(outer, middle));
  ok(CeedOperatorCompositeAddSub(middle, inner));
  for (const CeedOperator sub : {outer.get(), middle.get(), inner.get()}) {
    expect_error(CeedOperatorCompositeAddSub(inner, sub), CEED_ERROR_MINOR, {"its own sub-operator"});
  }
  CeedInt num = -1;
  ok(CeedOperatorCompositeGetNumSub(inner, &num));
  EXPECT_EQ(num, 0);
}

TEST_F(Misuse, NamesAreNotNull) {
  const QFunction qf = make_qfunction(CEED_EVAL_INTERP);
  Operator op, sum;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  ok(CeedOperatorCompositeAddSub(sum, op));
  CeedOperator sub = nullptr;
  CeedOperatorField field = nullptr;
  CeedContextFieldLabel label = nullptr;
  expect_error(CeedOperatorCompositeGetSubByName(sum, nullptr, &sub), CEED_ERROR_MINOR, {"is NULL"});
  expect_error(CeedOperatorGetFieldByName(op, nullptr, &field), CEED_ERROR_MINOR, {"is NULL"});
  expect_error(CeedOperatorGetContextFieldLabel(op, nullptr, &label), CEED_ERROR_MINOR, {"is NULL"});
  expect_error(CeedOperatorGetContextFieldLabel(sum, nullptr, &label), CEED_ERROR_MINOR, {"is NULL"});
  expect_error(CeedOperatorView(op, nullptr), CEED_ERROR_MINOR, {"stream is NULL"});
  expect_error(CeedOperatorViewTerse(sum, nullptr), CEED_ERROR_MINOR, {"stream is NULL"});
}

TEST_F(Misuse, NoQFunctionIsNotChangedOrApplied) {
  CeedVector in[1] = {nullptr}, out[1] = {nullptr};
  ::setenv("CEED_ERROR_HANDLER", "return", 1);
  EXPECT_EQ(CeedQFunctionAddInput(CEED_QFUNCTION_NONE, "u", 1, CEED_EVAL_NONE), CEED_ERROR_INCOMPATIBLE);
  EXPECT_EQ(CeedQFunctionAddOutput(CEED_QFUNCTION_NONE, "v", 1, CEED_EVAL_NONE), CEED_ERROR_INCOMPATIBLE);
  EXPECT_EQ(CeedQFunctionApply(CEED_QFUNCTION_NONE, 1, in, out), CEED_ERROR_INCOMPATIBLE);
  CeedInt num_in = -1, num_out = -1;
  ok(CeedQFunctionGetNumArgs(CEED_QFUNCTION_NONE, &num_in, &num_out));
  EXPECT_EQ(num_in + num_out, 0);
}

TEST_F(Misuse, QFunctionsTakeVectorsWithArrays) {
  const QFunction qf = make_qfunction(CEED_EVAL_NONE);
  const Vector values = make_vector(ceed, 1, 1);
  for (const CeedVector nothing : {CEED_VECTOR_NONE, CEED_VECTOR_ACTIVE}) {
    CeedVector in[1] = {nothing}, out[1] = {values};
    expect_error(CeedQFunctionApply(qf, 1, in, out), CEED_ERROR_INCOMPATIBLE, {"has no array"});
    expect_error(CeedQFunctionApply(qf, 0, out, in), CEED_ERROR_INCOMPATIBLE, {"has no array"});
  }
}

TEST_F(Misuse, GalleryQFunctionsHaveTheFieldsThatTheyRead) {
  for (const char *name : {"Identity", "Identity to scalar", "Scale", "Scale (scalar)"}) {
    SCOPED_TRACE(name);
    QFunction qf;
    Operator op;
    ok(CeedQFunctionCreateInteriorByName(ceed, name, qf.out()));
    expect_error(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.address()),
                 CEED_ERROR_INCOMPLETE, {"input 0 was not added"});
    expect_error(CeedQFunctionApply(qf, 4, nullptr, nullptr), CEED_ERROR_INCOMPLETE, {name, "input 0 was not added"});
    ok(CeedQFunctionAddInput(qf, "u", 3, CEED_EVAL_NONE));
    if (name[0] == 'S') {
      expect_error(CeedQFunctionApply(qf, 4, nullptr, nullptr), CEED_ERROR_INCOMPLETE, {"input 1 was not added"});
      ok(CeedQFunctionAddInput(qf, "scale", std::string(name) == "Scale" ? 3 : 1, CEED_EVAL_NONE));
    }
    expect_error(CeedQFunctionApply(qf, 4, nullptr, nullptr), CEED_ERROR_INCOMPLETE, {"output 0 was not added"});
  }
  QFunction scale;
  ok(CeedQFunctionCreateInteriorByName(ceed, "Scale", scale.out()));
  ok(CeedQFunctionAddInput(scale, "u", 3, CEED_EVAL_NONE));
  ok(CeedQFunctionAddInput(scale, "scale", 2, CEED_EVAL_NONE));
  expect_error(CeedQFunctionApply(scale, 4, nullptr, nullptr), CEED_ERROR_INCOMPLETE, {"input 1 is too small"});
}

TEST_F(Misuse, ActiveObjectsAreHandedOutTogether) {
  const QFunction qf = make_qfunction(CEED_EVAL_INTERP);
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  Restriction rstr;
  constexpr CeedInt offsets[2] = {0, 1};
  ok(CeedElemRestrictionCreate(ceed, 1, 2, 1, 1, 2, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, rstr.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 2, CEED_GAUSS, basis.out()));
  ok(CeedOperatorSetField(op, "u", rstr, basis, CEED_VECTOR_ACTIVE));
  CeedBasis in_basis = nullptr, out_basis = nullptr;
  CeedElemRestriction in_rstr = nullptr, out_rstr = nullptr;
  expect_error(CeedOperatorGetActiveBases(op, &in_basis, &out_basis), CEED_ERROR_INCOMPLETE, {"no active basis"});
  expect_error(CeedOperatorGetActiveElemRestrictions(op, &in_rstr, &out_rstr), CEED_ERROR_INCOMPLETE, {"no active"});
  EXPECT_EQ(in_basis, nullptr);
  EXPECT_EQ(in_rstr, nullptr);
}

TEST_F(Misuse, OperatorsArePreparedForWhatTheyCanDo) {
  const QFunction qf = make_qfunction(CEED_EVAL_NONE);
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetName(op, "copy"));
  Restriction rstr;
  ok(CeedElemRestrictionCreateStrided(ceed, 1, 2, 1, 2, CEED_STRIDES_BACKEND, rstr.out()));
  const Vector u = make_vector(ceed, 2, 1);
  ok(CeedOperatorSetField(op, "u", rstr, CEED_BASIS_NONE, u));
  ok(CeedOperatorSetField(op, "v", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  expect_error(CeedOperatorPrepareFor(op, static_cast<CeedOperatorUse>(5)), CEED_ERROR_INCOMPATIBLE,
               {"'copy'", "5", "expected a CeedOperatorUse, 0 to 4"});
  expect_error(CeedOperatorPrepareFor(op, CEED_USE_ASSEMBLE), CEED_ERROR_INCOMPATIBLE, {"'copy'", "no active input"});
  ok(CeedOperatorPrepareFor(op, CEED_USE_APPLY));
}

TEST_F(Misuse, ACopyDoesNotReplaceWhatIsLentOut) {
  const Vector first = make_vector(ceed, 2, 1);
  Vector second = make_vector(ceed, 2, 2);
  const CeedVector before = second;
  CeedScalar *array = nullptr;
  ok(CeedVectorGetArray(second, CEED_MEM_HOST, &array));
  expect_error(CeedVectorReferenceCopy(first, second.address()), CEED_ERROR_ACCESS, {"Cannot destroy CeedVector"});
  EXPECT_EQ(second.get(), before);
  ok(CeedVectorRestoreArray(second, &array));
  ok(CeedVectorReferenceCopy(first, second.address()));
  EXPECT_EQ(second.get(), first.get());
}

/// An empty vector's array may be NULL.
TEST_F(Misuse, EmptyVectorsAreGivenBack) {
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 2, CEED_GAUSS, basis.out()));
  const Vector u = make_vector(ceed, 2, 1);
  Vector x, v;
  ok(CeedVectorCreate(ceed, 0, x.out()));
  ok(CeedVectorCreate(ceed, 0, v.out()));
  constexpr CeedInt num_points[1] = {0};
  ok(CeedBasisApplyAtPoints(basis, 1, num_points, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, x, u, v));
  ok(CeedBasisApplyAtPoints(basis, 1, num_points, CEED_TRANSPOSE, CEED_EVAL_INTERP, x, v, u));
  ok(CeedVectorDestroy(x.address()));
  ok(CeedVectorDestroy(v.address()));
}

TEST_F(Misuse, PointsAreOfTheOperatorsBackend) {
  const CeedHandle other(open("/cpu/self/memcheck/serial"));
  const QFunction qf = make_qfunction(CEED_EVAL_INTERP);
  Operator op;
  ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  constexpr CeedInt list[] = {2, 3, 0};
  Restriction rstr;
  ok(CeedElemRestrictionCreateAtPoints(other, 1, 1, 1, 1, CEED_MEM_HOST, CEED_COPY_VALUES, list, rstr.out()));
  expect_error(CeedOperatorAtPointsSetPoints(op, rstr, make_vector(ceed, 1, 0)), CEED_ERROR_INCOMPATIBLE, {"memcheck"});
}

}  // namespace
