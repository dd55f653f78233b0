// Misuse of operators and QFunctions: the right code, a message that names the object, the value and what was expected,
// and an object that still works where the code is positive.
#include "backends.hpp"
#include "oracle/affine_operator.hpp"
#include "qfunctions/affine.h"
#include "qfunctions/mass_at_points.h"

namespace {

using namespace hg::test;

/// The parts of an operator on a 1D mesh of 3 elements, 3 nodes and 4 points each, that is not yet put together.
class OperatorErrorsTest : public BackendTest {
 protected:
  void SetUp() override {
    BackendTest::SetUp();
    rstr = mesh.restriction(ceed, 1);
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 4, CEED_GAUSS, basis.out()));
    ok(CeedQFunctionContextCreate(ceed, context.out()));
    AffineContext values{1, 0, 0, false};
    ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof values, &values));
    ok(CeedQFunctionCreateInterior(ceed, 1, affine, affine_loc, qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf, "w", 1, CEED_EVAL_WEIGHT));
    ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
    ok(CeedQFunctionSetContext(qf, context));
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetName(op, "the operator"));
  }
  int set(const char *field, CeedElemRestriction r, CeedBasis b, CeedVector v) {
    return CeedOperatorSetField(op, field, r, b, v);
  }
  void set_u() { ok(set("u", rstr, basis, CEED_VECTOR_ACTIVE)); }
  void set_w() { ok(set("w", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE)); }
  void set_v() { ok(set("v", rstr, basis, CEED_VECTOR_ACTIVE)); }
  void set_all() { set_u(), set_w(), set_v(); }
  /// The operator, all its fields set, still does its work.
  void expect_works(SourceLocation where = SourceLocation::current()) {
    const Values ones(mesh.num_nodes, 1);
    const Values got = {dot(ones, apply_to(ceed, op, ones))}, want = {6};
    expect_close(got, want, tolerance(100), "integral of the operator that was misused", 0, where);
  }
  Restriction strided(CeedInt num_elem, CeedInt size, CeedInt num_comp) {
    Restriction r;
    ok(CeedElemRestrictionCreateStrided(ceed, num_elem, size, num_comp,
                                        static_cast<CeedSize>(num_elem) * size * num_comp, CEED_STRIDES_BACKEND,
                                        r.out()));
    return r;
  }

  const Box mesh{1, 3, 3};
  Restriction rstr;
  Basis basis;
  Context context;
  QFunction qf;
  Operator op;
};

TEST_P(OperatorErrorsTest, MissingField) {
  set_u();
  set_w();
  const Vector u = make_vector(ceed, 7, 1), v = make_vector(ceed, 7, 0);
  expect_error(CeedOperatorCheckReady(op), CEED_ERROR_INCOMPLETE, {"the operator", "'v'", "not set"});
  expect_error(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE), CEED_ERROR_INCOMPLETE, {"the operator", "'v'"});
  set_v();
  expect_works();
}

TEST_P(OperatorErrorsTest, UnknownField) {
  expect_error(set("velocity", rstr, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPLETE,
               {"the operator", "velocity", "affine"});
  set_all();
  expect_works();
}

TEST_P(OperatorErrorsTest, FieldSetTwice) {
  set_u();
  expect_error(set("u", rstr, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_MINOR, {"the operator", "'u'", "already"});
  set_w();
  set_v();
  expect_works();
}

TEST_P(OperatorErrorsTest, NullHandles) {
  EXPECT_GT(set("u", nullptr, basis, CEED_VECTOR_ACTIVE), 0);
  EXPECT_GT(set("u", rstr, nullptr, CEED_VECTOR_ACTIVE), 0);
  EXPECT_GT(set("u", rstr, basis, nullptr), 0);
  EXPECT_GT(set(nullptr, rstr, basis, CEED_VECTOR_ACTIVE), 0);
  set_all();
  expect_works();
}

TEST_P(OperatorErrorsTest, NodesOfRestrictionAndBasisDiffer) {
  Basis other;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 5, 4, CEED_GAUSS, other.out()));
  expect_error(set("u", rstr, other, CEED_VECTOR_ACTIVE), CEED_ERROR_DIMENSION, {"the operator", "'u'", "3", "5"});
  set_all();
  expect_works();
}

TEST_P(OperatorErrorsTest, ComponentsOfRestrictionAndBasisDiffer) {
  const Restriction two = mesh.restriction(ceed, 2);
  expect_error(set("u", two, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_DIMENSION, {"the operator", "'u'", "2", "1"});
  set_all();
  expect_works();
}

TEST_P(OperatorErrorsTest, SizeOfQFunctionFieldAndBasisDiffer) {
  const Restriction two = mesh.restriction(ceed, 2);
  Basis two_comp;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 2, 3, 4, CEED_GAUSS, two_comp.out()));
  expect_error(set("u", two, two_comp, CEED_VECTOR_ACTIVE), CEED_ERROR_DIMENSION, {"the operator", "'u'", "1", "2"});
  set_all();
  expect_works();
}

TEST_P(OperatorErrorsTest, NumbersOfElementsDiffer) {
  const Box other(1, 5, 3);
  const Restriction five = other.restriction(ceed, 1);
  set_u();
  expect_error(set("v", five, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_DIMENSION, {"the operator", "'v'", "3", "5"});
  set_w();
  set_v();
  expect_works();
}

TEST_P(OperatorErrorsTest, NumbersOfPointsDiffer) {
  Basis other;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 6, CEED_GAUSS, other.out()));
  set_u();
  expect_error(set("v", rstr, other, CEED_VECTOR_ACTIVE), CEED_ERROR_DIMENSION, {"the operator", "'v'", "4", "6"});
  set_w();
  set_v();
  expect_works();
}

TEST_P(OperatorErrorsTest, PassiveVectorTooShort) {
  const Vector five = make_vector(ceed, 5, 1);
  expect_error(set("u", rstr, basis, five), CEED_ERROR_DIMENSION, {"the operator", "'u'", "5", "7"});
  set_all();
  expect_works();
}

TEST_P(OperatorErrorsTest, FieldsThatDoNotFitTheirMode) {
  expect_error(set("u", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPATIBLE,
               {"the operator", "'u'", "basis"});
  expect_error(set("u", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPATIBLE,
               {"the operator", "'u'", "restriction"});
  expect_error(set("w", rstr, basis, CEED_VECTOR_NONE), CEED_ERROR_INCOMPATIBLE,
               {"the operator", "'w'", "CEED_ELEMRESTRICTION_NONE"});
  expect_error(set("w", CEED_ELEMRESTRICTION_NONE, CEED_BASIS_NONE, CEED_VECTOR_NONE), CEED_ERROR_INCOMPATIBLE,
               {"the operator", "'w'", "basis"});
  set_all();
  expect_works();
}

TEST_P(OperatorErrorsTest, InputAndOutputTooShort) {
  set_all();
  const Vector right = make_vector(ceed, 7, 1), other_right = make_vector(ceed, 7, 1), wrong = make_vector(ceed, 6, 1);
  expect_error(CeedOperatorApply(op, wrong, right, CEED_REQUEST_IMMEDIATE), CEED_ERROR_DIMENSION,
               {"the operator", "input", "6", "7"});
  expect_error(CeedOperatorApply(op, right, wrong, CEED_REQUEST_IMMEDIATE), CEED_ERROR_DIMENSION,
               {"the operator", "output", "6", "7"});
  expect_error(CeedOperatorApplyAdd(op, wrong, right, CEED_REQUEST_IMMEDIATE), CEED_ERROR_DIMENSION, {"the operator"});
  EXPECT_GT(CeedOperatorApply(op, CEED_VECTOR_NONE, right, CEED_REQUEST_IMMEDIATE), 0);
  EXPECT_GT(CeedOperatorApply(op, right, CEED_VECTOR_NONE, CEED_REQUEST_IMMEDIATE), 0);
  EXPECT_GT(CeedOperatorApply(op, right, right, CEED_REQUEST_IMMEDIATE), 0);
  EXPECT_EQ(values_of(right), values_of(other_right)) << "a refused application changed its vectors";
  expect_works();
}

/// What an operator reads it cannot write at once; it stays as it was.
TEST_P(OperatorErrorsTest, VectorThatIsAPassiveInput) {
  const Vector passive = make_vector(ceed, 7, 3), right = make_vector(ceed, 7, 1);
  ok(set("u", rstr, basis, passive));
  set_w(), set_v();
  for (const auto apply : {CeedOperatorApply, CeedOperatorApplyAdd, CeedOperatorApplyAddActive}) {
    expect_error(apply(op, CEED_VECTOR_NONE, passive, CEED_REQUEST_IMMEDIATE), CEED_ERROR_INCOMPATIBLE,
                 {"the operator", "'u'", "output"});
  }
  EXPECT_EQ(values_of(passive), Values(7, 3));
  ok(CeedOperatorApply(op, CEED_VECTOR_NONE, right, CEED_REQUEST_IMMEDIATE));
  EXPECT_NE(max_norm(values_of(right)), 0);
}

/// A vector that the caller still holds.
TEST_P(OperatorErrorsTest, VectorThatIsInUse) {
  set_all();
  const Vector u = make_vector(ceed, 7, 1), v = make_vector(ceed, 7, 0);
  CeedScalar *array = nullptr;
  ok(CeedVectorGetArray(u, CEED_MEM_HOST, &array));
  EXPECT_NE(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE), 0);
  EXPECT_NE(last_report().message.find("Cannot grant CeedVector"), std::string::npos) << last_report().message;
  ok(CeedVectorRestoreArray(u, &array));
  expect_works();
}

/// An input that was never set.
TEST_P(OperatorErrorsTest, InputWithoutValues) {
  set_all();
  Vector u;
  ok(CeedVectorCreate(ceed, 7, u.out()));
  const Vector v = make_vector(ceed, 7, 0);
  EXPECT_NE(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE), 0);
  EXPECT_NE(last_report().message.find("no values"), std::string::npos) << last_report().message;
}

TEST_P(OperatorErrorsTest, FieldsAddedToAQFunctionInUse) {
  expect_error(CeedQFunctionAddInput(qf, "more", 1, CEED_EVAL_NONE), CEED_ERROR_MAJOR, {"affine", "more"});
  expect_error(CeedQFunctionAddOutput(qf, "more", 1, CEED_EVAL_NONE), CEED_ERROR_MAJOR, {"affine", "more"});
}

TEST_P(OperatorErrorsTest, QFunctionFieldsThatCannotBe) {
  QFunction fresh;
  ok(CeedQFunctionCreateInterior(ceed, 1, affine, affine_loc, fresh.out()));
  ok(CeedQFunctionAddInput(fresh, "u", 2, CEED_EVAL_INTERP));
  expect_error(CeedQFunctionAddInput(fresh, "u", 1, CEED_EVAL_NONE), CEED_ERROR_MINOR, {"'u'", "already"});
  expect_error(CeedQFunctionAddOutput(fresh, "u", 1, CEED_EVAL_NONE), CEED_ERROR_MINOR, {"'u'", "already"});
  expect_error(CeedQFunctionAddInput(fresh, "w", 3, CEED_EVAL_WEIGHT), CEED_ERROR_DIMENSION, {"'w'", "3", "1"});
  expect_error(CeedQFunctionAddOutput(fresh, "w", 1, CEED_EVAL_WEIGHT), CEED_ERROR_DIMENSION, {"'w'", "WEIGHT"});
  EXPECT_GT(CeedQFunctionAddInput(fresh, "empty", 0, CEED_EVAL_NONE), 0);
  EXPECT_GT(CeedQFunctionAddInput(fresh, "odd", 1, static_cast<CeedEvalMode>(3)), 0);
  EXPECT_GT(CeedQFunctionAddInput(fresh, nullptr, 1, CEED_EVAL_NONE), 0);
  CeedInt num_in = 0, num_out = 0;
  ok(CeedQFunctionGetFields(fresh, &num_in, nullptr, &num_out, nullptr));
  EXPECT_EQ(num_in, 1) << "a refused field was added";
  EXPECT_EQ(num_out, 0) << "a refused field was added";
}

TEST_P(OperatorErrorsTest, UnknownGalleryName) {
  CeedQFunction unknown = nullptr;
  expect_error(CeedQFunctionCreateInteriorByName(ceed, "Mass4DBuild", &unknown), CEED_ERROR_UNSUPPORTED,
               {"Mass4DBuild", "Mass3DBuild"});
  EXPECT_EQ(unknown, nullptr);
}

TEST_P(OperatorErrorsTest, QFunctionAppliedToWrongSizes) {
  const Vector u = make_vector(ceed, 4, 1), w = make_vector(ceed, 4, 1), v = make_vector(ceed, 3, 0);
  CeedVector in[] = {u, w}, out[] = {v};
  expect_error(CeedQFunctionApply(qf, 4, in, out), CEED_ERROR_DIMENSION, {"affine", "'v'", "3", "4"});
  QFunction by_eight;
  ok(CeedQFunctionCreateInterior(ceed, 8, affine, affine_loc, by_eight.out()));
  expect_error(CeedQFunctionApply(by_eight, 12, in, out), CEED_ERROR_DIMENSION, {"12", "8"});
}

TEST_P(OperatorErrorsTest, OperatorWithoutAQFunction) {
  CeedOperator none = nullptr;
  EXPECT_GT(CeedOperatorCreate(ceed, nullptr, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &none), 0);
  EXPECT_GT(CeedOperatorCreate(ceed, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &none), 0);
  EXPECT_EQ(none, nullptr);
}

/// Assembly asks for an active input and output, and for a space to itself where there is a diagonal.
TEST_P(OperatorErrorsTest, AssemblyOfWhatCannotBe) {
  const Vector passive = make_vector(ceed, 7, 1), v = make_vector(ceed, 7, 5);
  ok(set("u", rstr, basis, passive));
  set_w();
  set_v();
  CeedVector assembled = nullptr;
  CeedElemRestriction assembled_rstr = nullptr;
  EXPECT_GT(CeedOperatorLinearAssembleQFunction(op, &assembled, &assembled_rstr, CEED_REQUEST_IMMEDIATE), 0);
  EXPECT_NE(last_report().message.find("active input"), std::string::npos) << last_report().message;
  EXPECT_EQ(assembled, nullptr);
  EXPECT_EQ(assembled_rstr, nullptr);
  EXPECT_GT(CeedOperatorLinearAssembleDiagonal(op, v, CEED_REQUEST_IMMEDIATE), 0);
}

TEST_P(OperatorErrorsTest, AssemblyIntoVectorsTooShort) {
  set_all();
  const Vector wrong = make_vector(ceed, 6, 1);
  expect_error(CeedOperatorLinearAssembleDiagonal(op, wrong, CEED_REQUEST_IMMEDIATE), CEED_ERROR_DIMENSION,
               {"the operator", "6", "7"});
  expect_error(CeedOperatorLinearAssembleAddDiagonal(op, wrong, CEED_REQUEST_IMMEDIATE), CEED_ERROR_DIMENSION,
               {"the operator", "6", "7"});
  expect_error(CeedOperatorLinearAssemble(op, wrong), CEED_ERROR_DIMENSION, {"the operator", "6", "27"});
  EXPECT_EQ(values_of(wrong), Values(6, 1));
  expect_works();
}

/// Work vectors, for one, may be longer than asked for: what is beyond takes no part.
TEST_P(OperatorErrorsTest, VectorsMayBeLonger) {
  set_all();
  const auto begins_with = [](Values got, const Values &want) {
    ASSERT_GE(got.size(), want.size());
    got.resize(want.size());
    expect_close(got, want, tolerance(50), "what shorter vectors give");
  };
  const Vector u = make_vector(ceed, 7, 2), v = make_vector(ceed, 7, 0), diagonal = make_vector(ceed, 7, 0),
               entries = make_vector(ceed, 27, 0);
  ok(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE));
  ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
  ok(CeedOperatorLinearAssemble(op, entries));
  const Vector long_u = make_vector(ceed, 9, 2), long_v = make_vector(ceed, 12, 5);
  ok(CeedOperatorApply(op, long_u, long_v, CEED_REQUEST_IMMEDIATE));
  begins_with(values_of(long_v), values_of(v));
  EXPECT_EQ(values_of(long_u), Values(9, 2));
  ok(CeedOperatorLinearAssembleDiagonal(op, long_v, CEED_REQUEST_IMMEDIATE));
  begins_with(values_of(long_v), values_of(diagonal));
  const Vector long_entries = make_vector(ceed, 30, 5);
  ok(CeedOperatorLinearAssemble(op, long_entries));
  begins_with(values_of(long_entries), values_of(entries));

  set_values(long_v, Values(12, 5));
  ok(CeedOperatorApplyAdd(op, long_u, long_v, CEED_REQUEST_IMMEDIATE));
  Values sum = values_of(v);
  for (CeedScalar &entry : sum) entry += 5;
  sum.resize(12, 5);
  expect_close(values_of(long_v), sum, tolerance(50), "what was there and the action");
}

TEST_P(OperatorErrorsTest, CompositesMisused) {
  set_all();
  Operator all;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorSetName(all, "the sum"));
  expect_error(CeedOperatorSetField(all, "u", rstr, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPATIBLE,
               {"the sum", "'u'", "composite"});
  EXPECT_GT(CeedOperatorCompositeAddSub(op, all), 0);
  EXPECT_NE(last_report().message.find("the operator"), std::string::npos) << last_report().message;
  EXPECT_GT(CeedOperatorCompositeAddSub(all, nullptr), 0);
  EXPECT_GT(CeedOperatorCompositeAddSub(all, all), 0);
  CeedInt count = -1;
  EXPECT_GT(CeedOperatorCompositeGetNumSub(op, &count), 0);
  EXPECT_GT(CeedOperatorGetNumElements(all, &count), 0);
  ok(CeedOperatorCompositeAddSub(all, op));
  const Values ones(mesh.num_nodes, 1);
  const Values got = {dot(ones, apply_to(ceed, all, ones))}, want = {6};
  expect_close(got, want, tolerance(100), "the composite that was misused");
}

TEST_P(OperatorErrorsTest, PartsOfDifferentLengths) {
  set_all();
  const Box other_mesh(1, 2, 2);
  const AffineOperator other(ceed, other_mesh, 4, 1, {1, 0, 0, false});
  Operator all;
  ok(CeedOperatorCreateComposite(ceed, all.out()));
  ok(CeedOperatorCompositeAddSub(all, op));
  const Vector u = make_vector(ceed, 7, 1), v = make_vector(ceed, 7, 1);
  // Refused when it is added or when it is used, at the latest.
  const int added = CeedOperatorCompositeAddSub(all, other.op);
  const int used = added ? added : CeedOperatorApply(all, u, v, CEED_REQUEST_IMMEDIATE);
  EXPECT_NE(used, 0);
  EXPECT_NE(last_report().message.find("3"), std::string::npos) << last_report().message;
  EXPECT_NE(last_report().message.find("7"), std::string::npos) << last_report().message;
}

/// Operators at points.
class PointsErrorsTest : public OperatorErrorsTest {
 protected:
  void SetUp() override {
    OperatorErrorsTest::SetUp();
    ok(CeedQFunctionContextCreate(ceed, one.out()));
    CeedInt num_comp = 1;
    ok(CeedQFunctionContextSetData(one, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof num_comp, &num_comp));
    ok(CeedQFunctionCreateInterior(ceed, 1, mass_at_points, mass_at_points_loc, qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf, "q", 1, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
    ok(CeedQFunctionSetContext(qf, one));
    ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetName(op, "the operator"));
    rstr_points = at_points({4, 6, 6, 9, 0, 1, 2, 3, 4}, 5, 1);
    x = make_vector(ceed, 5, 0.25);
    q = make_vector(ceed, 5, 2);
  }
  Restriction at_points(const std::vector<CeedInt> &list, CeedInt num_points, CeedInt num_comp) {
    Restriction r;
    ok(CeedElemRestrictionCreateAtPoints(ceed, list[0] - 1, num_points, num_comp,
                                         static_cast<CeedSize>(num_points) * num_comp, CEED_MEM_HOST, CEED_COPY_VALUES,
                                         list.data(), r.out()));
    return r;
  }
  void set_rest() {
    set_u();
    ok(set("q", rstr_points, CEED_BASIS_NONE, q));
    set_v();
  }
  void expect_works() {
    const Values ones(mesh.num_nodes, 1);
    const Values got = {dot(ones, apply_to(ceed, op, ones))}, want = {10};
    expect_close(got, want, tolerance(100), "sum of the operator that was misused");
  }
  Context one;
  Restriction rstr_points;
  Vector x, q;
};

TEST_P(PointsErrorsTest, PointsNotSet) {
  set_rest();
  const Vector u = make_vector(ceed, 7, 1), v = make_vector(ceed, 7, 1);
  expect_error(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE), CEED_ERROR_INCOMPLETE,
               {"the operator", "CeedOperatorAtPointsSetPoints"});
  ok(CeedOperatorAtPointsSetPoints(op, rstr_points, x));
  expect_works();
}

TEST_P(PointsErrorsTest, PointsThatCannotBe) {
  set_rest();
  expect_error(CeedOperatorAtPointsSetPoints(op, rstr, x), CEED_ERROR_INCOMPATIBLE, {"the operator", "points"});
  const Vector wrong = make_vector(ceed, 4, 0);
  expect_error(CeedOperatorAtPointsSetPoints(op, rstr_points, wrong), CEED_ERROR_DIMENSION, {"the operator", "4", "5"});
  const Restriction two_elements = at_points({3, 5, 8, 0, 1, 2, 3, 4}, 5, 1);
  expect_error(CeedOperatorAtPointsSetPoints(op, two_elements, x), CEED_ERROR_DIMENSION, {"the operator", "2", "3"});
  ok(CeedOperatorAtPointsSetPoints(op, rstr_points, x));
  expect_works();
}

/// Coordinates of as many components as the bases have dimensions.
TEST_P(PointsErrorsTest, CoordinatesOfAnotherDimension) {
  set_rest();
  const Restriction planar = at_points({4, 6, 6, 9, 0, 1, 2, 3, 4}, 5, 2);
  const Vector planar_x = make_vector(ceed, 10, 0), u = make_vector(ceed, 7, 1), v = make_vector(ceed, 7, 1);
  const int set_code = CeedOperatorAtPointsSetPoints(op, planar, planar_x);
  const int code = set_code ? set_code : CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE);
  EXPECT_GT(code, 0) << last_report().message;
  EXPECT_NE(last_report().message.find("2"), std::string::npos) << last_report().message;
  ok(CeedOperatorAtPointsSetPoints(op, rstr_points, x));
  expect_works();
}

/// Stored fields must live at the operator's points.
TEST_P(PointsErrorsTest, FieldsAtOtherPoints) {
  const Restriction other = at_points({4, 5, 6, 9, 0, 1, 2, 3, 4}, 5, 1);
  set_u();
  ok(set("q", other, CEED_BASIS_NONE, q));
  set_v();
  ok(CeedOperatorAtPointsSetPoints(op, rstr_points, x));
  const Vector u = make_vector(ceed, 7, 1), v = make_vector(ceed, 7, 1);
  expect_error(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE), CEED_ERROR_INCOMPATIBLE,
               {"the operator", "'q'", "other points"});
  ok(set("q", rstr_points, CEED_BASIS_NONE, q));  // stored fields may follow the points
  expect_works();
}

TEST_P(PointsErrorsTest, StoredFieldsOfAnotherKind) {
  const Restriction stored = strided(3, 4, 1);
  expect_error(set("q", stored, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPATIBLE,
               {"the operator", "'q'", "points"});
  expect_error(set("u", rstr_points, basis, CEED_VECTOR_ACTIVE), CEED_ERROR_INCOMPATIBLE, {"the operator", "'u'"});
  set_rest();
  ok(CeedOperatorAtPointsSetPoints(op, rstr_points, x));
  expect_works();
}

TEST_P(PointsErrorsTest, PointsForAQuadratureOperator) {
  const AffineOperator quadrature(ceed, mesh, 4, 1, {1, 0, 0, false});
  ok(CeedOperatorSetName(quadrature.op, "by quadrature"));
  expect_error(CeedOperatorAtPointsSetPoints(quadrature.op, rstr_points, x), CEED_ERROR_MINOR,
               {"by quadrature", "CeedOperatorCreateAtPoints"});
  const Values ones(mesh.num_nodes, 1);
  EXPECT_NEAR(dot(ones, apply_to(ceed, quadrature.op, ones)), 6, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Backends, OperatorErrorsTest, testing::ValuesIn(usable_backends()), backend_name);
INSTANTIATE_TEST_SUITE_P(Backends, PointsErrorsTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
