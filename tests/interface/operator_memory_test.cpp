// What operators say that they hold: each array once.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

int nothing(void *, const CeedInt, const CeedScalar *const *, CeedScalar *const *) {
  return 0;
}

CeedOperatorMemory memory_of(CeedOperator op) {
  CeedOperatorMemory memory{};
  ok(CeedOperatorGetMemory(op, &memory));
  EXPECT_EQ(memory.total,
            memory.program + memory.restrictions + memory.bases + memory.vectors + memory.assembly + memory.backend);
  return memory;
}

/// Quadratic elements of a line: u in the nodes, one number at each of 4 quadrature points of an element.
class OperatorMemoryTest : public testing::Test {
 protected:
  static constexpr CeedInt num_elem = 2, P_1d = 3, Q_1d = 4, num_nodes = 5;
  static constexpr CeedSize offset_bytes = num_elem * P_1d * sizeof(CeedInt),
                            stored_bytes = num_elem * Q_1d * sizeof(CeedScalar);

  void SetUp() override {
    ok(CeedElemRestrictionCreate(ceed, num_elem, P_1d, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, offsets,
                                 nodes.out()));
    ok(CeedElemRestrictionCreateStrided(ceed, num_elem, Q_1d, 1, num_elem * Q_1d, CEED_STRIDES_BACKEND, strided.out()));
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, P_1d, Q_1d, CEED_GAUSS, basis.out()));
    ok(CeedVectorCreate(ceed, num_elem * Q_1d, stored.out()));
    ok(CeedVectorSetValue(stored, 1.0));
    ok(CeedQFunctionCreateInterior(ceed, 1, nothing, "nowhere.h:nothing", qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf, "data", 1, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
  }
  Operator make(CeedElemRestriction of_nodes) {
    Operator op;
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "u", of_nodes, basis, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "data", strided, CEED_BASIS_NONE, stored));
    ok(CeedOperatorSetField(op, "v", of_nodes, basis, CEED_VECTOR_ACTIVE));
    return op;
  }

  const CeedInt offsets[6] = {0, 1, 2, 2, 3, 4};
  const CeedHandle ceed{open(reference_resource)};
  Restriction nodes, strided;
  Basis basis;
  Vector stored;
  QFunction qf;
};

TEST_F(OperatorMemoryTest, CountsWhatFieldsShareOnce) {
  const Operator op = make(nodes);
  const CeedOperatorMemory memory = memory_of(op);
  EXPECT_EQ(memory.restrictions, offset_bytes);
  EXPECT_EQ(memory.vectors, stored_bytes);
  // Values and derivatives at 4 points of 3 functions, points, weights, and the functions as 3 by 3 coefficients.
  EXPECT_EQ(memory.bases, static_cast<CeedSize>((2 * Q_1d * P_1d + 2 * Q_1d + P_1d * P_1d) * sizeof(CeedScalar)));
  EXPECT_GT(memory.program, 0);
  EXPECT_EQ(memory.assembly, 0);
  EXPECT_EQ(memory.backend, 0);  // the reference keeps nothing between applications
}

TEST_F(OperatorMemoryTest, CountsWhatPartsShareOnce) {
  const Operator first = make(nodes), second = make(nodes);
  Operator sum, empty;
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  for (const CeedOperator part : {first.get(), second.get(), first.get()}) ok(CeedOperatorCompositeAddSub(sum, part));
  const CeedOperatorMemory one = memory_of(first), all = memory_of(sum);
  EXPECT_EQ(all.restrictions, one.restrictions);
  EXPECT_EQ(all.bases, one.bases);
  EXPECT_EQ(all.vectors, one.vectors);
  EXPECT_EQ(all.program, 2 * one.program);
  ok(CeedOperatorCreateComposite(ceed, empty.out()));
  EXPECT_EQ(memory_of(empty).total, 0);
}

TEST_F(OperatorMemoryTest, CountsOrientationsAndLentOffsets) {
  const bool flipped[6] = {true, false, true, false, true, false};
  Restriction oriented, copy;
  ok(CeedElemRestrictionCreateOriented(ceed, num_elem, P_1d, 1, 1, num_nodes, CEED_MEM_HOST, CEED_USE_POINTER, offsets,
                                       flipped, oriented.out()));
  const CeedSize bytes = offset_bytes + num_elem * P_1d * static_cast<CeedSize>(sizeof(bool) + sizeof(CeedInt8));
  EXPECT_EQ(memory_of(make(oriented)).restrictions, bytes);
  // A copy reads the tables of the restriction that it is a copy of.
  ok(CeedElemRestrictionCreateUnsignedCopy(oriented, copy.out()));
  Operator sum;
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  for (const CeedElemRestriction rstr : {oriented.get(), copy.get()}) ok(CeedOperatorCompositeAddSub(sum, make(rstr)));
  EXPECT_EQ(memory_of(sum).restrictions, bytes);
}

TEST_F(OperatorMemoryTest, CountsTheContext) {
  const Operator without = make(nodes);
  const CeedSize before = memory_of(without).program;
  std::vector<double> data(100, 1.0);
  Context context;
  ok(CeedQFunctionContextCreate(ceed, context.out()));
  ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, data.size() * sizeof(double), data.data()));
  ok(CeedQFunctionSetContext(qf, context));
  EXPECT_EQ(memory_of(make(nodes)).program, before + 800);
}

TEST_F(OperatorMemoryTest, CountsTheAssembledQFunctionThatIsKept) {
  const Operator op = make(nodes);
  ok(CeedOperatorSetQFunctionAssemblyReuse(op, true));
  Vector assembled;
  Restriction of_assembled;
  ok(CeedOperatorLinearAssembleQFunctionBuildOrUpdate(op, assembled.out(), of_assembled.out(), CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(memory_of(op).assembly, stored_bytes);  // a number for each point
}

TEST_F(OperatorMemoryTest, CountsPoints) {
  const CeedInt list[] = {3, 5, 6, 0, 1, 2};
  Restriction of_points, of_coordinates;
  Vector coordinates, values;
  for (Restriction *rstr : {&of_points, &of_coordinates}) {
    ok(CeedElemRestrictionCreateAtPoints(ceed, num_elem, 3, 1, 3, CEED_MEM_HOST, CEED_USE_POINTER, list, rstr->out()));
  }
  ok(CeedElemRestrictionCreateVector(of_points, coordinates.out(), nullptr));
  ok(CeedElemRestrictionCreateVector(of_points, values.out(), nullptr));
  ok(CeedVectorSetValue(coordinates, 0.25));
  ok(CeedVectorSetValue(values, 1.0));
  Operator op;
  ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "u", nodes, basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "data", of_points, CEED_BASIS_NONE, values));
  ok(CeedOperatorSetField(op, "v", nodes, basis, CEED_VECTOR_ACTIVE));
  // Both restrictions read the one list that they were lent.
  ok(CeedOperatorAtPointsSetPoints(op, of_coordinates, coordinates));
  const CeedOperatorMemory memory = memory_of(op);
  EXPECT_EQ(memory.restrictions, offset_bytes + static_cast<CeedSize>(sizeof list));
  EXPECT_EQ(memory.vectors, static_cast<CeedSize>(2 * 3 * sizeof(CeedScalar)));
}

TEST_F(OperatorMemoryTest, WantsAReadyOperator) {
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  CeedOperatorMemory memory{};
  expect_error(CeedOperatorGetMemory(op, &memory), CEED_ERROR_INCOMPLETE, {"'u'"});
}

}  // namespace
