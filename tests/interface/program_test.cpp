// Lowering: what an operator becomes before a backend sees it.
#include <ceed/plugin.h>
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

class ProgramTest : public testing::Test {
 protected:
  static constexpr CeedInt num_elem = 2, P_1d = 3, Q_1d = 4, num_nodes = 5;

  Restriction nodes(CeedInt num_comp) {
    const CeedInt offsets[] = {0, 1, 2, 2, 3, 4};
    Restriction rstr;
    ok(CeedElemRestrictionCreate(ceed, num_elem, P_1d, num_comp, num_nodes, num_nodes * num_comp, CEED_MEM_HOST,
                                 CEED_COPY_VALUES, offsets, rstr.out()));
    return rstr;
  }
  Restriction stored(CeedInt num_comp) {
    Restriction rstr;
    ok(CeedElemRestrictionCreateStrided(ceed, num_elem, Q_1d, num_comp, num_elem * Q_1d * num_comp,
                                        CEED_STRIDES_BACKEND, rstr.out()));
    return rstr;
  }
  Restriction at_points(const std::vector<CeedInt> &list, CeedInt num_comp) {
    const CeedInt num_points = static_cast<CeedInt>(list.size()) - num_elem - 1;
    Restriction rstr;
    ok(CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, num_comp, num_points * num_comp, CEED_MEM_HOST,
                                         CEED_COPY_VALUES, list.data(), rstr.out()));
    return rstr;
  }
  Basis basis(CeedInt num_comp, CeedInt Q = Q_1d) {
    Basis result;
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, num_comp, P_1d, Q, CEED_GAUSS, result.out()));
    return result;
  }
  QFunction qfunction() {
    QFunction qf;
    ok(CeedQFunctionCreateInterior(ceed, 1, nothing, "nowhere.h:nothing", qf.out()));
    return qf;
  }
  Operator make(CeedQFunction qf, bool is_at_points = false) {
    Operator op;
    ok(is_at_points ? CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out())
                    : CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    return op;
  }
  const CeedProgram &program(CeedOperator op) {
    const CeedProgram *result = nullptr;
    ok(CeedOperatorGetProgram(op, &result));
    return *result;
  }

  const CeedHandle ceed{open(reference_resource)};
};

/// Fields of one space and one vector are gathered once, and evaluated in one space.
TEST_F(ProgramTest, MergesEqualSpacesAndSources) {
  const QFunction qf = qfunction();
  ok(CeedQFunctionAddInput(qf, "u", 2, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "du", 2, CEED_EVAL_GRAD));
  ok(CeedQFunctionAddInput(qf, "c", 2, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "dc", 2, CEED_EVAL_GRAD));
  ok(CeedQFunctionAddInput(qf, "w", 1, CEED_EVAL_WEIGHT));
  ok(CeedQFunctionAddInput(qf, "q", 3, CEED_EVAL_NONE));
  ok(CeedQFunctionAddOutput(qf, "v", 2, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddOutput(qf, "dv", 2, CEED_EVAL_GRAD));
  ok(CeedQFunctionAddOutput(qf, "state", 3, CEED_EVAL_NONE));
  // Equal objects, made one by one, as programs do.
  const Restriction r1 = nodes(2), r2 = nodes(2), r3 = nodes(2), r4 = nodes(2), rq = stored(3), rs = stored(3);
  const Basis b1 = basis(2), b2 = basis(2), b3 = basis(2);
  const Vector c = make_vector(ceed, 10, 1), q = make_vector(ceed, 24, 1), state = make_vector(ceed, 24, 1);
  const Operator op = make(qf);
  ok(CeedOperatorSetField(op, "u", r1, b1, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "du", r2, b2, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "c", r3, b3, c));
  ok(CeedOperatorSetField(op, "dc", r1, b2, c));
  ok(CeedOperatorSetField(op, "w", CEED_ELEMRESTRICTION_NONE, b1, CEED_VECTOR_NONE));
  ok(CeedOperatorSetField(op, "q", rq, CEED_BASIS_NONE, q));
  ok(CeedOperatorSetField(op, "v", r4, b3, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "dv", r1, b1, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "state", rs, CEED_BASIS_NONE, state));

  const CeedProgram &p = program(op);
  EXPECT_EQ(p.num_elem, num_elem);
  EXPECT_EQ(p.num_qpts, Q_1d);
  EXPECT_FALSE(p.at_points);
  EXPECT_EQ(p.qf, qf.get());
  ASSERT_EQ(p.num_inputs, 6);
  ASSERT_EQ(p.num_outputs, 3);
  EXPECT_EQ(p.num_sources, 3);  // the active vector, c, q
  EXPECT_EQ(p.num_sinks, 2);    // the active vector, state
  EXPECT_EQ(p.num_spaces, 2);   // one for all fields with a basis, one for the weights

  EXPECT_EQ(p.inputs[0].side, p.inputs[1].side);
  EXPECT_EQ(p.inputs[2].side, p.inputs[3].side);
  EXPECT_NE(p.inputs[0].side, p.inputs[2].side);
  EXPECT_EQ(p.outputs[0].side, p.outputs[1].side);
  EXPECT_EQ(p.inputs[4].side, -1);
  EXPECT_EQ(p.inputs[5].space, -1);
  EXPECT_EQ(p.outputs[2].space, -1);
  for (const CeedProgramField *field : {&p.inputs[1], &p.inputs[2], &p.inputs[3], &p.outputs[0], &p.outputs[1]}) {
    EXPECT_EQ(field->space, p.inputs[0].space) << field->name;
  }
  EXPECT_NE(p.inputs[4].space, p.inputs[0].space);
  EXPECT_EQ(p.spaces[p.inputs[4].space].rstr, CEED_ELEMRESTRICTION_NONE);

  const CeedProgramSide &active = p.sources[p.inputs[0].side], &passive = p.sources[p.inputs[2].side];
  EXPECT_TRUE(active.is_active);
  EXPECT_EQ(active.vec, CEED_VECTOR_ACTIVE);
  EXPECT_EQ(active.num_comp, 2);
  EXPECT_EQ(active.elem_size, P_1d);
  EXPECT_FALSE(active.is_points);
  EXPECT_FALSE(passive.is_active);
  EXPECT_EQ(passive.vec, c.get());
}

/// Names, modes, sizes, and where active values stand in the assembled QFunction.
TEST_F(ProgramTest, NumbersActiveValues) {
  const QFunction qf = qfunction();
  ok(CeedQFunctionAddInput(qf, "u", 2, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "c", 2, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "du", 2, CEED_EVAL_GRAD));
  ok(CeedQFunctionAddOutput(qf, "state", 5, CEED_EVAL_NONE));
  ok(CeedQFunctionAddOutput(qf, "v", 2, CEED_EVAL_INTERP));
  const Restriction rstr = nodes(2), rs = stored(5);
  const Basis b = basis(2);
  const Vector c = make_vector(ceed, 10, 1), state = make_vector(ceed, 40, 1);
  const Operator op = make(qf);
  ok(CeedOperatorSetField(op, "u", rstr, b, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "c", rstr, b, c));
  ok(CeedOperatorSetField(op, "du", rstr, b, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "state", rs, CEED_BASIS_NONE, state));
  ok(CeedOperatorSetField(op, "v", rstr, b, CEED_VECTOR_ACTIVE));
  const CeedProgram &p = program(op);
  EXPECT_EQ(p.num_active_in, 4);
  EXPECT_EQ(p.num_active_out, 2);
  EXPECT_STREQ(p.inputs[0].name, "u");
  EXPECT_EQ(p.inputs[0].first_value, 0);
  EXPECT_EQ(p.inputs[1].first_value, -1);
  EXPECT_EQ(p.inputs[2].first_value, 2);
  EXPECT_EQ(p.inputs[2].eval_mode, CEED_EVAL_GRAD);
  EXPECT_EQ(p.inputs[2].size, 2);
  EXPECT_EQ(p.outputs[0].first_value, -1);
  EXPECT_EQ(p.outputs[1].first_value, 0);
}

/// What looks alike is kept apart where it differs.
TEST_F(ProgramTest, KeepsDifferentSpacesApart) {
  const QFunction qf = qfunction();
  ok(CeedQFunctionAddInput(qf, "a", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "b", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "c", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
  const Restriction rstr = nodes(1);
  Restriction permuted;
  const CeedInt offsets[] = {4, 3, 2, 2, 1, 0};
  ok(CeedElemRestrictionCreate(ceed, num_elem, P_1d, 1, num_nodes, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, offsets,
                               permuted.out()));
  const Basis gauss = basis(1);
  Basis lobatto;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, P_1d, Q_1d, CEED_GAUSS_LOBATTO, lobatto.out()));
  const Vector x = make_vector(ceed, num_nodes, 1), y = make_vector(ceed, num_nodes, 1);
  const Operator op = make(qf);
  ok(CeedOperatorSetField(op, "a", rstr, gauss, x));
  ok(CeedOperatorSetField(op, "b", permuted, gauss, x));
  ok(CeedOperatorSetField(op, "c", rstr, lobatto, y));
  ok(CeedOperatorSetField(op, "v", rstr, gauss, CEED_VECTOR_ACTIVE));
  const CeedProgram &p = program(op);
  EXPECT_EQ(p.num_sources, 3);
  EXPECT_EQ(p.num_spaces, 3);
  EXPECT_EQ(p.outputs[0].space, p.inputs[0].space);
}

/// Lowered once: the program stays the same until points move, and then only the points do.
TEST_F(ProgramTest, LivesAsLongAsThePoints) {
  const QFunction qf = qfunction();
  ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf, "q", 2, CEED_EVAL_NONE));
  ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
  const Restriction rstr = nodes(1);
  const Restriction x2 = at_points({3, 4, 6, 0, 1, 2}, 1), q2 = at_points({3, 4, 6, 0, 1, 2}, 2);
  const Restriction x5 = at_points({3, 8, 8, 0, 1, 2, 3, 4}, 1), q5 = at_points({3, 8, 8, 0, 1, 2, 3, 4}, 2);
  const Basis b = basis(1);
  const Vector x = make_vector(ceed, 3, 0), q = make_vector(ceed, 6, 1);
  const Vector new_x = make_vector(ceed, 5, 0), new_q = make_vector(ceed, 10, 1);
  const Operator op = make(qf, true);
  ok(CeedOperatorSetField(op, "u", rstr, b, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "q", q2, CEED_BASIS_NONE, q));
  ok(CeedOperatorSetField(op, "v", rstr, b, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorAtPointsSetPoints(op, x2, x));
  const CeedProgram first = program(op);
  EXPECT_TRUE(first.at_points);
  EXPECT_EQ(first.num_qpts, 2);
  EXPECT_EQ(first.points_rstr, x2.get());
  EXPECT_EQ(first.points, x.get());
  EXPECT_EQ(&program(op), &program(op));
  EXPECT_EQ(program(op).points_epoch, first.points_epoch);
  EXPECT_TRUE(first.sources[first.inputs[1].side].is_points);

  ok(CeedOperatorAtPointsSetPoints(op, x5, new_x));
  ok(CeedOperatorSetField(op, "q", q5, CEED_BASIS_NONE, new_q));
  const CeedProgram &second = program(op);
  EXPECT_GT(second.points_epoch, first.points_epoch);
  EXPECT_EQ(second.num_qpts, 5);
  EXPECT_EQ(second.points_rstr, x5.get());
  EXPECT_EQ(second.sources[second.inputs[1].side].vec, new_q.get());
  EXPECT_EQ(second.num_spaces, first.num_spaces);
  EXPECT_EQ(second.num_sources, first.num_sources);
}

TEST_F(ProgramTest, IsRefusedWhereThereIsNone) {
  const QFunction qf = qfunction();
  ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
  const Operator unset = make(qf);
  const CeedProgram *p = nullptr;
  expect_error(CeedOperatorGetProgram(unset, &p), CEED_ERROR_INCOMPLETE, {"'u'"});
  Operator composite;
  ok(CeedOperatorCreateComposite(ceed, composite.out()));
  EXPECT_GT(CeedOperatorGetProgram(composite, &p), 0);
  EXPECT_EQ(p, nullptr);
  // One vector to read from and to write to.
  const Restriction rstr = nodes(1);
  const Basis b = basis(1);
  const Vector x = make_vector(ceed, num_nodes, 1);
  ok(CeedOperatorSetField(unset, "u", rstr, b, x));
  ok(CeedOperatorSetField(unset, "v", rstr, b, x));
  EXPECT_GT(CeedOperatorGetProgram(unset, &p), 0);
}

}  // namespace
