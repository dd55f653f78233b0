// The backend that catches misuse of arrays: each kind of misuse is committed, and told. What is used well passes the
// conformance suite.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

class Memcheck : public testing::Test {
 protected:
  CeedHandle ceed{open("/cpu/self/memcheck/serial")};
  Vector x = make_vector(ceed, Values{1, 2, 3, 4});
};

TEST_F(Memcheck, IsNotChosenUnasked) {
  const CeedHandle any(open("/cpu/self")), blocked(open("/cpu/self/memcheck/blocked"));
  const char *resource = nullptr;
  ok(CeedGetResource(any, &resource));
  EXPECT_STRNE(resource, "/cpu/self/memcheck/serial");
  ok(CeedGetResource(blocked, &resource));
  EXPECT_STREQ(resource, "/cpu/self/memcheck/serial");
}

TEST_F(Memcheck, ArraysForReadingMayNotBeWritten) {
  const CeedScalar *array = nullptr;
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &array));
  const_cast<CeedScalar *>(array)[2] = 30;
  expect_error(CeedVectorRestoreArrayRead(x, &array), CEED_ERROR_BACKEND,
               {"changed while accessed in read-only mode", "entry 2 of 4", "was 3 and is 30"});
  EXPECT_EQ(values_of(x), (Values{1, 2, 3, 4})) << "the vector keeps its values, and is free again";
}

/// Several readers have one array; the last one is told.
TEST_F(Memcheck, TheLastReaderIsTold) {
  const CeedScalar *first = nullptr, *second = nullptr;
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &first));
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &second));
  EXPECT_EQ(first, second);
  const_cast<CeedScalar *>(second)[0] = -1;
  ok(CeedVectorRestoreArrayRead(x, &second));
  expect_error(CeedVectorRestoreArrayRead(x, &first), CEED_ERROR_BACKEND, {"read-only mode", "entry 0 of 4"});
}

TEST_F(Memcheck, ArraysForWritingMustBeWritten) {
  CeedScalar *array = nullptr;
  ok(CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &array));
  for (int i = 0; i < 4; i++) EXPECT_TRUE(std::isnan(array[i])) << "what was there before is not to be read";
  array[0] = 5;
  array[3] = 8;
  expect_error(CeedVectorRestoreArray(x, &array), CEED_ERROR_BACKEND,
               {"CeedVectorGetArrayWrite", "2 of 4 entries unwritten", "the first is entry 1"});
  EXPECT_EQ(values_of(x), (Values{5, 2, 3, 8}));
  ok(CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &array));
  for (int i = 0; i < 4; i++) array[i] = i;
  ok(CeedVectorRestoreArray(x, &array));
  EXPECT_EQ(values_of(x), (Values{0, 1, 2, 3}));
}

TEST_F(Memcheck, NotANumberMayBeWritten) {
  CeedScalar *array = nullptr;
  ok(CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &array));
  for (int i = 0; i < 4; i++) array[i] = NAN;
  EXPECT_EQ(CeedVectorRestoreArray(x, &array), CEED_ERROR_SUCCESS);
  for (const CeedScalar value : values_of(x)) EXPECT_TRUE(std::isnan(value));
}

TEST_F(Memcheck, ValuesThatNeverWereAreNotNumbers) {
  Vector fresh;
  ok(CeedVectorCreate(ceed, 3, fresh.out()));
  CeedScalar *array = nullptr;
  ok(CeedVectorGetArrayWrite(fresh, CEED_MEM_HOST, &array));
  array[1] = 1;
  expect_error(CeedVectorRestoreArray(fresh, &array), CEED_ERROR_BACKEND, {"2 of 3 entries unwritten"});
  const Values values = values_of(fresh);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], 1);
  EXPECT_TRUE(std::isnan(values[2]));
}

TEST_F(Memcheck, ArraysMayNotBeWrittenAfterTheyWereRestored) {
  CeedScalar *array = nullptr, *kept = nullptr;
  ok(CeedVectorGetArray(x, CEED_MEM_HOST, &array));
  kept = array;
  kept[1] = 7;
  ok(CeedVectorRestoreArray(x, &array));
  EXPECT_EQ(array, nullptr);
  EXPECT_TRUE(std::isnan(kept[1])) << "what is read there now is no value";
  kept[1] = 9;
  CeedScalar norm = 0;
  expect_error(CeedVectorNorm(x, CEED_NORM_MAX, &norm), CEED_ERROR_BACKEND,
               {"was written after it was restored", "entry 1 of 4"});
  EXPECT_EQ(values_of(x), (Values{1, 7, 3, 4})) << "told once; the vector did not notice the write";
}

TEST_F(Memcheck, ArraysForReadingMayNotBeWrittenAfterTheyWereRestored) {
  const CeedScalar *array = nullptr, *kept = nullptr;
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &array));
  kept = array;
  ok(CeedVectorRestoreArrayRead(x, &array));
  const_cast<CeedScalar *>(kept)[3] = 9;
  Values other{5, 6, 7, 8};
  expect_error(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, other.data()), CEED_ERROR_BACKEND,
               {"was written after it was restored", "entry 3 of 4"});
}

TEST_F(Memcheck, ArraysMayNotBeWrittenOutsideOfTheirBounds) {
  for (const int place : {-1, 4, 5}) {
    CeedScalar *array = nullptr;
    ok(CeedVectorGetArray(x, CEED_MEM_HOST, &array));
    volatile CeedScalar *beside = array;
    beside[place] = 0;
    expect_error(CeedVectorRestoreArray(x, &array), CEED_ERROR_BACKEND, {"outside of its bounds", "entry 3"});
    const CeedScalar *read = nullptr;
    ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &read));
    beside = const_cast<CeedScalar *>(read);
    beside[place] = 0;
    expect_error(CeedVectorRestoreArrayRead(x, &read), CEED_ERROR_BACKEND, {"outside of its bounds"});
  }
  EXPECT_EQ(values_of(x), (Values{1, 2, 3, 4}));
}

TEST_F(Memcheck, LentArraysHoldTheValues) {
  Values lent{1, 2, 3};
  Vector v;
  ok(CeedVectorCreate(ceed, 3, v.out()));
  ok(CeedVectorSetArray(v, CEED_MEM_HOST, CEED_USE_POINTER, lent.data()));
  ok(CeedVectorScale(v, 2));
  ok(CeedVectorSyncArray(v, CEED_MEM_HOST));
  EXPECT_EQ(lent, (Values{2, 4, 6}));
  CeedScalar *taken = nullptr;
  ok(CeedVectorTakeArray(v, CEED_MEM_HOST, &taken));
  EXPECT_EQ(taken, lent.data());
}

TEST_F(Memcheck, ContextsForReadingMayNotBeWritten) {
  Context ctx;
  double data[2] = {1, 2}, *read = nullptr;
  ok(CeedQFunctionContextCreate(ceed, ctx.out()));
  ok(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof data, data));
  ok(CeedQFunctionContextGetDataRead(ctx, CEED_MEM_HOST, &read));
  read[1] = 3;
  expect_error(CeedQFunctionContextRestoreDataRead(ctx, &read), CEED_ERROR_BACKEND,
               {"Context data changed while accessed in read-only mode"});
  ok(CeedQFunctionContextGetDataRead(ctx, CEED_MEM_HOST, &read));
  EXPECT_EQ(read[1], 2) << "the context keeps its data, and is free again";
  ok(CeedQFunctionContextRestoreDataRead(ctx, &read));

  CeedContextFieldLabel label = nullptr;
  ok(CeedQFunctionContextRegisterDouble(ctx, "first", 0, 1, ""));
  ok(CeedQFunctionContextGetFieldLabel(ctx, "first", &label));
  const double *values = nullptr;
  std::size_t count = 0;
  ok(CeedQFunctionContextGetDoubleRead(ctx, label, &count, &values));
  const_cast<double *>(values)[0] = 9;
  expect_error(CeedQFunctionContextRestoreDoubleRead(ctx, label, &values), CEED_ERROR_BACKEND, {"read-only mode"});
}

// What QFunctions do wrong. in: u (2 components); out: v (1), w (2).
using Arrays = CeedScalar *const *;
int good(void *, CeedInt Q, const CeedScalar *const *in, Arrays out) {
  for (CeedInt i = 0; i < Q; i++) {
    out[0][i] = in[0][i] + in[0][Q + i];
    out[1][i] = in[0][i];
    out[1][Q + i] = 0;
  }
  return 0;
}
int writes_input(void *ctx, CeedInt Q, const CeedScalar *const *in, Arrays out) {
  good(ctx, Q, in, out);
  const_cast<CeedScalar *>(in[0])[Q + 1] = 0.125;
  return 0;
}
int forgets_output(void *ctx, CeedInt Q, const CeedScalar *const *in, Arrays out) {
  const CeedScalar before = out[1][Q];
  good(ctx, Q, in, out);
  out[1][Q] = before;
  return 0;
}
int writes_beside_output(void *ctx, CeedInt Q, const CeedScalar *const *in, Arrays out) {
  good(ctx, Q, in, out);
  volatile CeedScalar *beside = out[0];
  beside[Q] = 1;
  return 0;
}
int writes_context(void *ctx, CeedInt Q, const CeedScalar *const *in, Arrays out) {
  good(ctx, Q, in, out);
  if (ctx != nullptr) *static_cast<double *>(ctx) += 1;
  return 0;
}
int fails(void *, CeedInt, const CeedScalar *const *, Arrays) {
  return 17;
}

/// A QFunction by itself and in an operator of two elements with three points each.
class MemcheckQFunction : public Memcheck {
 protected:
  static constexpr CeedInt Q = 3, num_elem = 2;

  QFunction make(CeedQFunctionUser function, const char *source) {
    QFunction qf;
    ok(CeedQFunctionCreateInterior(ceed, 1, function, source, qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 2, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "w", 2, CEED_EVAL_NONE));
    return qf;
  }

  int apply(CeedQFunction qf) {
    const CeedVector in[] = {u}, out[] = {v, w};
    return CeedQFunctionApply(qf, Q, const_cast<CeedVector *>(in), const_cast<CeedVector *>(out));
  }

  Operator make_operator(CeedQFunction qf) {
    Operator op;
    Restriction one, two;
    const CeedInt n = num_elem * Q;
    ok(CeedElemRestrictionCreateStrided(ceed, num_elem, Q, 1, n, CEED_STRIDES_BACKEND, one.out()));
    ok(CeedElemRestrictionCreateStrided(ceed, num_elem, Q, 2, 2 * n, CEED_STRIDES_BACKEND, two.out()));
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "u", two, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "v", one, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "w", two, CEED_BASIS_NONE, passive));
    return op;
  }

  /// Both ways give this error, and what follows works as before.
  void expect_misuse(CeedQFunctionUser function, const char *source, std::initializer_list<std::string_view> fragments) {
    const QFunction qf = make(function, source);
    expect_error(apply(qf), CEED_ERROR_BACKEND, fragments);
    const Operator op = make_operator(qf);
    const Vector out = make_vector(ceed, num_elem * Q, 0);
    expect_error(CeedOperatorApply(op, long_u, out, CEED_REQUEST_IMMEDIATE), CEED_ERROR_BACKEND, fragments);
    const QFunction right = make(good, "memcheck_test.cpp:good");
    ok(apply(right));
    ok(CeedOperatorApply(make_operator(right), long_u, out, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(values_of(u), (Values{1, 2, 3, 4, 5, 6}));
  }

  Vector u = make_vector(ceed, Values{1, 2, 3, 4, 5, 6}), v = make_vector(ceed, Q, 0), w = make_vector(ceed, 2 * Q, 0);
  Vector long_u = make_vector(ceed, 2 * num_elem * Q, 1.5), passive = make_vector(ceed, 2 * num_elem * Q, 0);
};

TEST_F(MemcheckQFunction, ThatIsRightIsLeftAlone) {
  const QFunction qf = make(good, "memcheck_test.cpp:good");
  ok(apply(qf));
  EXPECT_EQ(values_of(v), (Values{5, 7, 9}));
  EXPECT_EQ(values_of(w), (Values{1, 2, 3, 0, 0, 0}));
  const Operator op = make_operator(qf);
  const Vector out = make_vector(ceed, num_elem * Q, 0);
  ok(CeedOperatorApply(op, long_u, out, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(out), Values(num_elem * Q, 3.0));
}

TEST_F(MemcheckQFunction, MayNotWriteItsInputs) {
  expect_misuse(writes_input, "memcheck_test.cpp:writes_input",
                {"QFunction 'writes_input'", "changed its input 'u'", "component 1 at point 1 of 3"});
}

TEST_F(MemcheckQFunction, MustWriteItsOutputs) {
  expect_misuse(forgets_output, "memcheck_test.cpp:forgets_output",
                {"QFunction 'forgets_output'", "left its output 'w' unwritten", "component 1 at point 0 of 3"});
}

TEST_F(MemcheckQFunction, MayNotWriteBesideItsOutputs) {
  expect_misuse(writes_beside_output, "memcheck_test.cpp:writes_beside_output",
                {"QFunction 'writes_beside_output'", "wrote beside its output 'v'"});
}

TEST_F(MemcheckQFunction, MayWriteItsContextOnlyWherePromised) {
  double number = 4;
  Context ctx;
  ok(CeedQFunctionContextCreate(ceed, ctx.out()));
  ok(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_USE_POINTER, sizeof number, &number));
  const QFunction qf = make(writes_context, "memcheck_test.cpp:writes_context");
  ok(CeedQFunctionSetContext(qf, ctx));
  ok(CeedQFunctionSetContextWritable(qf, false));
  const Operator op = make_operator(qf);
  const Vector out = make_vector(ceed, num_elem * Q, 0);
  expect_error(apply(qf), CEED_ERROR_BACKEND,
               {"QFunction 'writes_context'", "Context data changed while accessed in read-only mode"});
  expect_error(CeedOperatorApply(op, long_u, out, CEED_REQUEST_IMMEDIATE), CEED_ERROR_BACKEND,
               {"Context data changed while accessed in read-only mode"});
  EXPECT_EQ(number, 4);
  ok(CeedQFunctionSetContextWritable(qf, true));
  ok(apply(qf));
  EXPECT_EQ(number, 5);
}

TEST_F(MemcheckQFunction, ThatFailsIsTold) {
  const QFunction qf = make(fails, "memcheck_test.cpp:fails");
  expect_error(apply(qf), CEED_ERROR_BACKEND, {"QFunction 'fails' returned 17"});
}

TEST_F(Memcheck, OffsetsMayNotChange) {
  CeedInt offsets[] = {0, 1, 1, 2};
  Restriction rstr;
  ok(CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_USE_POINTER, offsets, rstr.out()));
  const Vector l = make_vector(ceed, Values{1, 2, 3}), e = make_vector(ceed, 4, 0);
  ok(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(e), (Values{1, 2, 2, 3}));
  const CeedInt *read = nullptr;
  ok(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &read));
  const_cast<CeedInt *>(read)[3] = 0;
  ok(CeedElemRestrictionRestoreOffsets(rstr, &read));
  expect_error(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE), CEED_ERROR_BACKEND,
               {"CeedElemRestriction offsets", "changed since it was created"});
  offsets[3] = 2;
  ok(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
}

/// Misuse in one thread's objects does not touch those of another vector.
TEST_F(Memcheck, VectorsAreWatchedOneByOne) {
  const Vector y = make_vector(ceed, Values{5, 6});
  const CeedScalar *x_array = nullptr, *y_array = nullptr;
  ok(CeedVectorGetArrayRead(x, CEED_MEM_HOST, &x_array));
  ok(CeedVectorGetArrayRead(y, CEED_MEM_HOST, &y_array));
  const_cast<CeedScalar *>(y_array)[0] = 0;
  ok(CeedVectorRestoreArrayRead(x, &x_array));
  expect_error(CeedVectorRestoreArrayRead(y, &y_array), CEED_ERROR_BACKEND, {"entry 0 of 2"});
}

}  // namespace
