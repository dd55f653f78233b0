// No limits on fields, sub-operators and counts; operators without elements; what assembly refuses.
#include <cstdlib>
#include <deque>
#include <memory>

#include "backends.hpp"
#include "conformance/qfunctions/blend.h"
#include "oracle/box.hpp"
#include "oracle/instance.hpp"
#include "oracle/random_operator.hpp"

namespace {

using namespace hg::test;

class AssemblyLimits : public BackendTest {
 protected:
  /// Rows and columns of a symbolic form, freed with the object.
  struct Indices {
    CeedSize count = -1;
    std::unique_ptr<CeedInt, decltype(&std::free)> rows{nullptr, &std::free}, cols{nullptr, &std::free};
  };
  using Symbolic = int (*)(CeedOperator, CeedSize *, CeedInt **, CeedInt **);
  Indices indices(Symbolic symbolic, CeedOperator op) {
    Indices result;
    CeedInt *rows = nullptr, *cols = nullptr;
    ok(symbolic(op, &result.count, &rows, &cols));
    result.rows.reset(rows);
    result.cols.reset(cols);
    return result;
  }

  Random random{31415};
};

constexpr CeedInt num_fields = 40;

/// Forty inputs, half of them passive, and forty outputs, all stored at the points: what the operator does is what the
/// QFunction does.
TEST_P(AssemblyLimits, TakesFortyFieldsOnEachSide) {
  const CeedInt num_elem = 3, Q = 5, size = num_elem * Q;
  std::deque<Restriction> restrictions;
  std::deque<Vector> vectors;
  std::vector<BlendField> inputs, outputs;
  // Active field i stands in its own part of the L-vector.
  const auto make_rstr = [&](CeedInt part, CeedInt num_parts) -> CeedElemRestriction {
    std::vector<CeedInt> offsets;
    for (CeedInt i = 0; i < size; i++) offsets.push_back(part * size + i);
    Restriction &rstr = restrictions.emplace_back();
    ok(CeedElemRestrictionCreate(ceed, num_elem, Q, 1, 1, num_parts * size, CEED_MEM_HOST, CEED_COPY_VALUES,
                                 offsets.data(), rstr.out()));
    return rstr;
  };
  const Values u = random.reals(num_fields / 2 * size);
  std::vector<Values> in;
  for (CeedInt i = 0; i < num_fields; i++) {
    if (i % 2 == 0) {
      inputs.push_back({CEED_EVAL_NONE, 1, make_rstr(i / 2, num_fields / 2), CEED_BASIS_NONE, CEED_VECTOR_ACTIVE});
      in.emplace_back(u.begin() + i / 2 * size, u.begin() + (i / 2 + 1) * size);
    } else {
      in.push_back(random.reals(size, 0, 0.1));
      vectors.push_back(make_vector(ceed, in.back()));
      inputs.push_back({CEED_EVAL_NONE, 1, make_rstr(0, 1), CEED_BASIS_NONE, vectors.back()});
    }
    outputs.push_back({CEED_EVAL_NONE, 1, make_rstr(i, num_fields), CEED_BASIS_NONE, CEED_VECTOR_ACTIVE});
  }
  const Operator op = make_blend(ceed, 11, inputs, outputs);

  BlendContext blend_ctx{num_fields, num_fields, 11, {}, {}, {}};
  std::vector<const CeedScalar *> in_arrays;
  std::vector<CeedScalar *> out_arrays;
  Values want(num_fields * size);
  for (CeedInt i = 0; i < num_fields; i++) {
    blend_ctx.in_size[i] = blend_ctx.out_size[i] = 1;
    blend_ctx.in_is_active[i] = i % 2 == 0;
    in_arrays.push_back(in[i].data());
    out_arrays.push_back(want.data() + i * size);
  }
  ASSERT_EQ(blend(&blend_ctx, size, in_arrays.data(), out_arrays.data()), 0);
  const Vector input = make_vector(ceed, u), output = make_vector(ceed, want.size(), 1e30);
  ok(CeedOperatorApply(op, input, output, CEED_REQUEST_IMMEDIATE));
  expect_close(values_of(output), want, tolerance(num_fields), "application");
  const CeedSize num_rows = num_fields * size, num_cols = num_fields / 2 * size;
  const Values dense = dense_from_coordinates(op, ceed, num_rows, num_cols);
  Values product(num_rows, 0);
  for (CeedSize i = 0; i < num_rows; i++) {
    for (CeedSize j = 0; j < num_cols; j++) product[i] += dense[i * num_cols + j] * u[j];
  }
  expect_close(product, want, tolerance(num_fields), "assembled matrix");
}

/// Forty active fields with bases, each on a space of its own.
TEST_P(AssemblyLimits, TakesFortyActiveSpaces) {
  const CeedInt num_elem = 2, Q_1d = 4, num_nodes = 12;
  std::deque<Restriction> restrictions;
  std::deque<Basis> bases;
  std::vector<BlendField> fields;
  for (CeedInt i = 0; i < num_fields; i++) {
    const CeedInt P = 2 + i % 3;
    std::vector<CeedInt> offsets;
    for (CeedInt e = 0; e < num_elem; e++) {
      for (const CeedInt node : random.distinct(P, num_nodes)) offsets.push_back(node);
    }
    ok(CeedElemRestrictionCreate(ceed, num_elem, P, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(),
                                 restrictions.emplace_back().out()));
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, P, Q_1d, CEED_GAUSS, bases.emplace_back().out()));
    fields.push_back(
        {i % 2 == 0 ? CEED_EVAL_INTERP : CEED_EVAL_GRAD, 1, restrictions.back(), bases.back(), CEED_VECTOR_ACTIVE});
  }
  const Operator op = make_blend(ceed, 12, fields, fields);
  const Values want = dense_by_unit_vectors(ceed, op);
  expect_close(dense_from_coordinates(op, ceed, num_nodes, num_nodes), want, tolerance(40000), "matrix");
  const Vector diagonal = make_vector(ceed, num_nodes, 1e30);
  ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
  const Values got = values_of(diagonal);
  for (CeedInt i = 0; i < num_nodes; i++) {
    EXPECT_NEAR(got[i], want[i * num_nodes + i], tolerance(40000) * max_norm(want)) << "entry " << i;
  }
}

/// A sum of a hundred operators, four of each of 25 kinds.
TEST_P(AssemblyLimits, TakesAHundredSubOperators) {
  OperatorWishes wishes;
  wishes.has_point_blocks = true;
  wishes.max_comp = 2;
  const Layout layout = random_layout(random, wishes);
  Operator sum;
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  Values want(layout.in * layout.in, 0);
  CeedSize num_entries = 0;
  for (CeedInt i = 0; i < 100; i++) {
    const CeedInt kind = i % 25;
    Random of_kind(27182 + kind);
    wishes.dim = 1 + kind % 2;
    wishes.at_points = kind % 3 == 0;
    const RandomOperator part(ceed, of_kind, wishes, layout);
    ok(CeedOperatorCompositeAddSub(sum, part));
    const Values dense = dense_by_unit_vectors(ceed, part);
    for (std::size_t k = 0; k < want.size(); k++) want[k] += dense[k];
    CeedSize of_part = 0;
    ok(CeedOperatorLinearAssembleGetNumEntries(part, &of_part));
    num_entries += of_part;
  }
  CeedInt num_sub = 0;
  ok(CeedOperatorCompositeGetNumSub(sum, &num_sub));
  EXPECT_EQ(num_sub, 100);
  const CeedScalar tol = tolerance(100000);
  expect_close(dense_by_unit_vectors(ceed, sum), want, tol, "application");
  expect_close(dense_from_coordinates(sum, ceed, layout.in, layout.in), want, tol, "matrix");
  CeedSize count = 0;
  ok(CeedOperatorLinearAssembleGetNumEntries(sum, &count));
  EXPECT_EQ(count, num_entries);
  const Indices blocks = indices(CeedOperatorLinearAssemblePointBlockDiagonalSymbolic, sum);
  const Vector values = make_vector(ceed, blocks.count, 1e30);
  ok(CeedOperatorLinearAssemblePointBlockDiagonal(sum, values, CEED_REQUEST_IMMEDIATE));
  const Values got = values_of(values);
  for (CeedSize i = 0; i < blocks.count; i++) {
    const CeedInt row = blocks.rows.get()[i], col = blocks.cols.get()[i];
    if (row == 0 && col == 0 && i > 0) continue;  // belongs to no node
    EXPECT_NEAR(got[i], want[row * layout.in + col], tol * max_norm(want)) << "(" << row << ", " << col << ")";
  }
}

/// All elements share their nodes, so that nothing but the count is large.
TEST_P(AssemblyLimits, CountsEntriesBeyond32Bits) {
  const CeedInt num_elem = 2147483647, num_comp = 3, P_1d = 5, P = 125;
  const CeedInt strides[3] = {1, P, 0};
  Restriction rstr;
  ok(CeedElemRestrictionCreateStrided(ceed, num_elem, P, num_comp, P * num_comp, strides, rstr.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 3, num_comp, P_1d, 2, CEED_GAUSS, basis.out()));
  const std::vector<BlendField> active = {{CEED_EVAL_INTERP, num_comp, rstr, basis, CEED_VECTOR_ACTIVE}};
  const Operator op = make_blend(ceed, 1, active, active);
  const CeedSize want = CeedSize{num_elem} * (P * num_comp) * (P * num_comp);
  CeedSize count = 0;
  ok(CeedOperatorLinearAssembleGetNumEntries(op, &count));
  EXPECT_EQ(count, want);
  Operator sum;
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  ok(CeedOperatorCompositeAddSub(sum, op));
  ok(CeedOperatorCompositeAddSub(sum, op));
  ok(CeedOperatorLinearAssembleGetNumEntries(sum, &count));
  EXPECT_EQ(count, 2 * want);
  // No machine has memory for a petabyte of indices: the message says how many there are, all digits of it.
  CeedInt *rows = nullptr, *cols = nullptr;
  expect_error(CeedOperatorLinearAssembleSymbolic(op, &count, &rows, &cols), CEED_ERROR_MAJOR, {std::to_string(want)});
  EXPECT_EQ(rows, nullptr);
  EXPECT_EQ(cols, nullptr);
  const Vector few = make_vector(ceed, 5, 0);
  expect_error(CeedOperatorLinearAssemble(op, few), CEED_ERROR_DIMENSION, {std::to_string(want)});
}

/// Point blocks of an L-vector whose length times the components is past 2³¹: the count alone.
TEST_P(AssemblyLimits, NamesBlocksBeyond32Bits) {
  const CeedInt num_comp = 9, strides[3] = {1, 2, 0};
  const CeedSize l_size = 2147483647;
  Restriction rstr;
  ok(CeedElemRestrictionCreateStrided(ceed, 1, 2, num_comp, l_size, strides, rstr.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, num_comp, 2, 2, CEED_GAUSS, basis.out()));
  const std::vector<BlendField> active = {{CEED_EVAL_INTERP, num_comp, rstr, basis, CEED_VECTOR_ACTIVE}};
  const Operator op = make_blend(ceed, 1, active, active);
  const Vector few = make_vector(ceed, 5, 0);
  expect_error(CeedOperatorLinearAssemblePointBlockDiagonal(op, few, CEED_REQUEST_IMMEDIATE), CEED_ERROR_DIMENSION,
               {std::to_string(l_size * num_comp)});
}

TEST_P(AssemblyLimits, TakesOperatorsWithoutElements) {
  const CeedInt nothing[1] = {0}, no_points[1] = {1};
  for (const bool at_points : {false, true}) {
    Restriction rstr, points_rstr;
    ok(CeedElemRestrictionCreate(ceed, 0, 4, 2, 1, 10, CEED_MEM_HOST, CEED_COPY_VALUES, nothing, rstr.out()));
    ok(CeedElemRestrictionCreateAtPoints(ceed, 0, 0, 2, 0, CEED_MEM_HOST, CEED_COPY_VALUES, no_points,
                                         points_rstr.out()));
    Basis basis;
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 2, 2, 2, 3, CEED_GAUSS, basis.out()));
    const Vector coordinates = make_vector(ceed, 0, 0);
    const std::vector<BlendField> active = {{CEED_EVAL_INTERP, 2, rstr, basis, CEED_VECTOR_ACTIVE}};
    const Operator op =
        make_blend(ceed, 1, active, active, at_points ? BlendPoints{points_rstr, coordinates} : BlendPoints{});
    const Vector diagonal = make_vector(ceed, 10, 1e30), blocks = make_vector(ceed, 20, 1e30),
                 entries = make_vector(ceed, 0, 0);
    ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(values_of(diagonal), Values(10, 0));
    ok(CeedOperatorLinearAssemblePointBlockDiagonal(op, blocks, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(values_of(blocks), Values(20, 0));
    EXPECT_EQ(indices(CeedOperatorLinearAssemblePointBlockDiagonalSymbolic, op).count, 20);
    EXPECT_EQ(indices(CeedOperatorLinearAssembleSymbolic, op).count, 0);
    ok(CeedOperatorLinearAssemble(op, entries));
  }
  Operator sum;
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  const Vector any = make_vector(ceed, 4, 1e30);
  ok(CeedOperatorLinearAssemblePointBlockDiagonal(sum, any, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(any), Values(4, 0));
  EXPECT_EQ(indices(CeedOperatorLinearAssemblePointBlockDiagonalSymbolic, sum).count, 0);
  EXPECT_EQ(indices(CeedOperatorLinearAssembleSymbolic, sum).count, 0);
}

TEST_P(AssemblyLimits, RefusesPointBlocksWithoutNodesOfOneKind) {
  const Box mesh(2, 2, 2);
  const CeedInt n = mesh.num_nodes;
  Basis one, two;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 2, 1, 2, 3, CEED_GAUSS, one.out()));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 2, 2, 2, 3, CEED_GAUSS, two.out()));
  const auto make_rstr = [&](CeedInt num_comp, CeedInt comp_stride, CeedSize l_size, Restriction &rstr) {
    ok(CeedElemRestrictionCreate(ceed, mesh.num_elem, 4, num_comp, comp_stride, l_size, CEED_MEM_HOST, CEED_COPY_VALUES,
                                 mesh.offsets.data(), rstr.out()));
  };
  Restriction scalar, stacked, overlapping, longer;
  make_rstr(1, 1, 2 * n, scalar);
  make_rstr(2, n, 2 * n, stacked);
  make_rstr(2, 1, 2 * n, overlapping);
  make_rstr(2, n, 2 * n + 1, longer);
  const BlendField in{CEED_EVAL_INTERP, 2, stacked, two, CEED_VECTOR_ACTIVE};
  const Vector blocks = make_vector(ceed, 4 * n, 7), wrong = make_vector(ceed, 2 * n, 7);
  const auto assemble = [&](CeedOperator op, CeedVector into) {
    return CeedOperatorLinearAssemblePointBlockDiagonal(op, into, CEED_REQUEST_IMMEDIATE);
  };
  const Operator good = make_blend(ceed, 1, {in}, {in});
  expect_error(assemble(good, wrong), CEED_ERROR_DIMENSION, {std::to_string(2 * n), std::to_string(4 * n)});
  EXPECT_EQ(values_of(wrong), Values(2 * n, 7)) << "a vector that is refused stays as it was";
  const Operator mixed = make_blend(ceed, 1, {in}, {in, {CEED_EVAL_INTERP, 1, scalar, one, CEED_VECTOR_ACTIVE}});
  expect_error(assemble(mixed, blocks), CEED_ERROR_INCOMPATIBLE, {"1 components", "2"});
  const BlendField other{CEED_EVAL_INTERP, 2, overlapping, two, CEED_VECTOR_ACTIVE};
  expect_error(assemble(make_blend(ceed, 1, {in}, {other}), blocks), CEED_ERROR_INCOMPATIBLE, {"apart"});
  const Operator rectangular = make_blend(ceed, 1, {in}, {{CEED_EVAL_INTERP, 2, longer, two, CEED_VECTOR_ACTIVE}});
  expect_error(assemble(rectangular, blocks), CEED_ERROR_DIMENSION, {"square"});
  EXPECT_EQ(values_of(blocks), Values(4 * n, 7));
  // Nodes at 0 and 1 with components next to each other share the entry 1.
  CeedSize count = 0;
  CeedInt *rows = nullptr, *cols = nullptr;
  expect_error(
      CeedOperatorLinearAssemblePointBlockDiagonalSymbolic(make_blend(ceed, 1, {other}, {other}), &count, &rows, &cols),
      CEED_ERROR_INCOMPATIBLE, {"node", "shares"});
  EXPECT_EQ(rows, nullptr);
}

INSTANTIATE_TEST_SUITE_P(Backends, AssemblyLimits, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
