// Context fields through operators and composites.
#include "backends.hpp"
#include "oracle/affine_operator.hpp"

namespace {

using namespace hg::test;

class OperatorContextTest : public BackendTest {};

constexpr AffineContext start{2, 0, 0, false};

CeedContextFieldLabel label_of(CeedOperator op, const char *name) {
  CeedContextFieldLabel label = nullptr;
  ok(CeedOperatorGetContextFieldLabel(op, name, &label));
  return label;
}

double read_double(CeedOperator op, CeedContextFieldLabel label) {
  std::size_t count = 0;
  const double *values = nullptr;
  ok(CeedOperatorGetContextDoubleRead(op, label, &count, &values));
  EXPECT_EQ(count, 1u);
  const double value = values[0];
  ok(CeedOperatorRestoreContextDoubleRead(op, label, &values));
  return value;
}

TEST_P(OperatorContextTest, SetsFieldsOfEachType) {
  const Box mesh(1, 3, 3);
  const AffineOperator op(ceed, mesh, 4, 1, start);
  const Values ones(mesh.num_nodes, 1);
  const auto total = [&] { return dot(ones, apply_to(ceed, op.op, ones)); };
  const CeedScalar length = 2.0 * mesh.num_elem, tol = 100 * tolerance(mesh.num_nodes);
  EXPECT_NEAR(total(), 2 * length, tol);

  const CeedContextFieldLabel factor = label_of(op.op, "factor"), shift = label_of(op.op, "shift");
  const CeedContextFieldLabel multiple = label_of(op.op, "multiple"), negative = label_of(op.op, "is negative");
  ASSERT_NE(factor, nullptr);
  ASSERT_NE(shift, nullptr);
  ASSERT_NE(multiple, nullptr);
  ASSERT_NE(negative, nullptr);
  EXPECT_EQ(label_of(op.op, "nothing of the kind"), nullptr);
  EXPECT_EQ(label_of(op.op, "factor"), factor);

  double value = 5;
  ok(CeedOperatorSetContextDouble(op.op, factor, &value));
  EXPECT_NEAR(total(), 5 * length, tol);
  value = 0.5;
  ok(CeedOperatorSetContextDouble(op.op, shift, &value));
  EXPECT_NEAR(total(), 7.5 * length, tol);
  EXPECT_EQ(read_double(op.op, factor), 5);
  EXPECT_EQ(read_double(op.op, shift), 0.5);

  bool flag = true;
  ok(CeedOperatorSetContextBoolean(op.op, negative, &flag));
  EXPECT_NEAR(total(), -7.5 * length, tol);
  std::size_t count = 0;
  const bool *flags = nullptr;
  ok(CeedOperatorGetContextBooleanRead(op.op, negative, &count, &flags));
  EXPECT_EQ(count, 1u);
  EXPECT_TRUE(flags[0]);
  ok(CeedOperatorRestoreContextBooleanRead(op.op, negative, &flags));

  std::int32_t number = 7;
  ok(CeedOperatorSetContextInt32(op.op, multiple, &number));
  const std::int32_t *numbers = nullptr;
  ok(CeedOperatorGetContextInt32Read(op.op, multiple, &count, &numbers));
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(numbers[0], 7);
  ok(CeedOperatorRestoreContextInt32Read(op.op, multiple, &numbers));
  // The function saw it too: 4 points are no multiple of 7.
  const Vector u = make_vector(ceed, ones), v = make_vector(ceed, ones);
  EXPECT_NE(CeedOperatorApply(op.op, u, v, CEED_REQUEST_IMMEDIATE), 0);
}

TEST_P(OperatorContextTest, DescribesItsFields) {
  const Box mesh(1, 1, 2);
  const AffineOperator op(ceed, mesh, 2, 1, start);
  const char *name = nullptr, *description = nullptr;
  std::size_t offset = 0, count = 0;
  CeedContextFieldType type;
  ok(CeedContextFieldLabelGetDescription(label_of(op.op, "shift"), &name, &offset, &count, &description, &type));
  EXPECT_STREQ(name, "shift");
  EXPECT_STREQ(description, "added to u");
  EXPECT_EQ(offset, offsetof(AffineContext, shift));
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(type, CEED_CONTEXT_FIELD_DOUBLE);
  ok(CeedContextFieldLabelGetDescription(label_of(op.op, "is negative"), nullptr, nullptr, nullptr, nullptr, &type));
  EXPECT_EQ(type, CEED_CONTEXT_FIELD_BOOL);
  CeedQFunctionContext context = nullptr;
  ok(CeedOperatorGetContext(op.op, &context));
  const Context held(context);
  EXPECT_EQ(context, op.context.get());
}

TEST_P(OperatorContextTest, RefusesAnotherType) {
  const Box mesh(1, 1, 2);
  const AffineOperator op(ceed, mesh, 2, 1, start);
  double value = 1;
  EXPECT_NE(CeedOperatorSetContextDouble(op.op, label_of(op.op, "multiple"), &value), 0);
  EXPECT_NE(last_report().message.find("multiple"), std::string::npos) << last_report().message;
  EXPECT_NE(CeedOperatorSetContextDouble(op.op, nullptr, &value), 0);
}

/// A field of a composite is the field of all sub-operators that have it.
TEST_P(OperatorContextTest, ReachesAllSubOperators) {
  const Box mesh(1, 3, 3);
  const AffineOperator first(ceed, mesh, 4, 1, {1, 0, 0, false}), second(ceed, mesh, 4, 1, {10, 0, 0, false});
  QFunction plain_qf;  // without a context
  ok(CeedQFunctionCreateInteriorByName(ceed, "Identity", plain_qf.out()));
  ok(CeedQFunctionAddInput(plain_qf, "u", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddOutput(plain_qf, "v", 1, CEED_EVAL_INTERP));
  Operator plain, all;
  ok(CeedOperatorCreate(ceed, plain_qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, plain.out()));
  ok(CeedOperatorSetField(plain, "u", first.rstr, first.basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(plain, "v", first.rstr, first.basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  for (const CeedOperator sub : {first.op.get(), plain.get(), second.op.get()})
    ok(CeedOperatorCompositeAddSub(all, sub));

  const Values u = Random(3).reals(mesh.num_nodes);
  const auto sum = [&] {
    Values total(u.size(), 0);
    for (const CeedOperator sub : {first.op.get(), plain.get(), second.op.get()}) {
      const Values part = apply_to(ceed, sub, u);
      for (std::size_t i = 0; i < part.size(); i++) total[i] += part[i];
    }
    return total;
  };
  const CeedScalar tol = 4 * tolerance(mesh.num_nodes);
  expect_close(apply_to(ceed, all, u), sum(), tol, "before");
  const CeedContextFieldLabel factor = label_of(all, "factor");
  ASSERT_NE(factor, nullptr);
  double value = -4;
  ok(CeedOperatorSetContextDouble(all, factor, &value));
  EXPECT_EQ(read_double(first.op, label_of(first.op, "factor")), -4);
  EXPECT_EQ(read_double(second.op, label_of(second.op, "factor")), -4);
  EXPECT_EQ(read_double(all, factor), -4);
  expect_close(apply_to(ceed, all, u), sum(), tol, "after");
  bool flag = true;
  ok(CeedOperatorSetContextBoolean(all, label_of(all, "is negative"), &flag));
  expect_close(apply_to(ceed, all, u), sum(), tol, "after the flag");
  EXPECT_EQ(label_of(all, "nothing of the kind"), nullptr);
}

/// A label of a composite is that of the sub-operators which have the field when it is used.
TEST_P(OperatorContextTest, ReachesFieldsThatWereRegisteredLater) {
  const Box mesh(1, 2, 2);
  const AffineOperator first(ceed, mesh, 3, 1, {1, 0, 0, false}), second(ceed, mesh, 3, 1, {10, 0, 0, false}),
      third(ceed, mesh, 3, 1, {100, 0, 0, false});
  Operator inner, all;
  ok(CeedOperatorCreateComposite(ceed, inner.out()));
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(inner, second.op));
  ok(CeedOperatorCompositeAddSub(all, first.op));
  ok(CeedOperatorCompositeAddSub(all, inner));
  EXPECT_EQ(label_of(all, "late"), nullptr);
  const auto register_late = [](const AffineOperator &op) {
    ok(CeedQFunctionContextRegisterDouble(op.context, "late", offsetof(AffineContext, shift), 1, "registered late"));
  };
  const auto shift_of = [](const AffineOperator &op) { return read_double(op.op, label_of(op.op, "shift")); };
  register_late(first);
  const CeedContextFieldLabel late = label_of(all, "late");
  ASSERT_NE(late, nullptr);
  double value = 3;
  ok(CeedOperatorSetContextDouble(all, late, &value));
  EXPECT_EQ(shift_of(first), 3);
  EXPECT_EQ(shift_of(second), 0);

  register_late(second);
  ok(CeedOperatorCompositeAddSub(inner, third.op));
  register_late(third);
  value = 4;
  ok(CeedOperatorSetContextDouble(all, late, &value));
  EXPECT_EQ(shift_of(first), 4);
  EXPECT_EQ(shift_of(second), 4);
  EXPECT_EQ(shift_of(third), 4);
  EXPECT_EQ(label_of(all, "late"), late);
  EXPECT_EQ(read_double(all, late), 4);
}

/// A label of another operator, and a field that the parts do not agree on.
TEST_P(OperatorContextTest, RefusesLabelsOfOthers) {
  const Box mesh(1, 2, 2);
  const AffineOperator first(ceed, mesh, 3, 1, start), second(ceed, mesh, 3, 1, start);
  Operator all, other;
  for (Operator *op : {&all, &other}) {
    ok(CeedOperatorCreateComposite(ceed, op->out()));
    ok(CeedOperatorCompositeAddSub(*op, first.op));
  }
  double value = 3;
  expect_error(CeedOperatorSetContextDouble(all, label_of(other, "factor"), &value), CEED_ERROR_UNSUPPORTED,
               {"factor"});
  EXPECT_EQ(last_report().function, "CeedOperatorSetContextDouble");
  expect_error(CeedOperatorSetContextDouble(all, label_of(first.op, "factor"), &value), CEED_ERROR_UNSUPPORTED,
               {"factor"});
  std::size_t count = 0;
  const double *values = nullptr;
  expect_error(CeedOperatorGetContextDoubleRead(all, nullptr, &count, &values), CEED_ERROR_UNSUPPORTED, {"NULL"});
  EXPECT_EQ(last_report().function, "CeedOperatorGetContextDoubleRead");

  ok(CeedQFunctionContextRegisterDouble(first.context, "odd", offsetof(AffineContext, shift), 1, ""));
  const CeedContextFieldLabel odd = label_of(all, "odd");
  ok(CeedOperatorCompositeAddSub(all, second.op));
  ok(CeedQFunctionContextRegisterInt32(second.context, "odd", offsetof(AffineContext, multiple), 1, ""));
  expect_error(CeedOperatorSetContextDouble(all, odd, &value), CEED_ERROR_INCOMPATIBLE, {"odd", "different types"});
}

INSTANTIATE_TEST_SUITE_P(Backends, OperatorContextTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
