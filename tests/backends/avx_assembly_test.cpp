// What the SIMD backends assemble, against the reference: sizes that the conformance suite is too small for.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "../conformance/oracle/blend_operator.hpp"
#include "isa.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

/// Elements that share no nodes, all nodes in one L-vector; values and derivatives in, values and derivatives out.
struct Problem {
  CeedInt dim, P_1d, Q_1d, num_comp;
  std::vector<CeedInt> num_points;  ///< of each element, at points of their own
  CeedInt num_elem;                 ///< at quadrature points
  bool at_points() const { return !num_points.empty(); }
};

struct Assembled {
  Values matrix, diagonal, blocks;
};

Assembled assemble(CeedOperator op, Ceed ceed, CeedSize num_dofs, CeedInt num_comp) {
  CeedSize num_entries = 0;
  ok(CeedOperatorLinearAssembleGetNumEntries(op, &num_entries));
  const Vector matrix = make_vector(ceed, num_entries, 1e30), diagonal = make_vector(ceed, num_dofs, 1e30),
               blocks = make_vector(ceed, num_dofs * num_comp, 1e30);
  ok(CeedOperatorLinearAssemble(op, matrix));
  ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
  ok(CeedOperatorLinearAssemblePointBlockDiagonal(op, blocks, CEED_REQUEST_IMMEDIATE));
  return {values_of(matrix), values_of(diagonal), values_of(blocks)};
}

Assembled assemble(Ceed ceed, const Problem &p) {
  const CeedInt num_elem = p.at_points() ? static_cast<CeedInt>(p.num_points.size()) : p.num_elem;
  const CeedInt elem_size = CeedIntPow(p.P_1d, p.dim);
  const CeedSize num_dofs = CeedSize{num_elem} * elem_size * p.num_comp;
  Random random(8100);
  Restriction rstr, at_points;
  Vector x;
  Basis basis;
  std::vector<CeedInt> nodes;
  for (CeedInt i = 0; i < num_elem * elem_size; i++) nodes.push_back(p.num_comp * i);
  ok(CeedElemRestrictionCreate(ceed, num_elem, elem_size, p.num_comp, 1, num_dofs, CEED_MEM_HOST, CEED_COPY_VALUES,
                               nodes.data(), rstr.out()));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, p.dim, p.num_comp, p.P_1d, p.Q_1d, CEED_GAUSS, basis.out()));
  if (p.at_points()) {
    std::vector<CeedInt> points{num_elem + 1};
    for (const CeedInt count : p.num_points) points.push_back(points.back() + count);
    const CeedInt num_points = points.back() - num_elem - 1;
    for (CeedInt i = 0; i < num_points; i++) points.push_back(i);
    ok(CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, p.dim, CeedSize{num_points} * p.dim, CEED_MEM_HOST,
                                         CEED_COPY_VALUES, points.data(), at_points.out()));
    x = make_vector(ceed, random.reals(CeedSize{num_points} * p.dim));
  }
  const std::vector<BlendField> active = {{CEED_EVAL_INTERP, p.num_comp, rstr, basis, CEED_VECTOR_ACTIVE},
                                          {CEED_EVAL_GRAD, p.num_comp * p.dim, rstr, basis, CEED_VECTOR_ACTIVE}};
  const Operator op = make_blend(ceed, 5, active, active, p.at_points() ? BlendPoints{at_points, x} : BlendPoints{});
  return assemble(op, ceed, num_dofs, p.num_comp);
}

/// On both backends, with every instruction set that the machine has.
void expect_as_reference(const std::function<Assembled(Ceed)> &assembled_on) {
  const CeedHandle reference{open(reference_resource)};
  const Assembled want = assembled_on(reference);
  int num_isas = 0;
  for (const char *name : {"portable", "avx2", "avx512"}) {
    const Isa isa(name);
    if (resource_of("/cpu/self") != blocked) continue;
    num_isas++;
    for (const char *resource : {blocked, "/cpu/self/avx/serial"}) {
      SCOPED_TRACE(std::string(resource) + " on " + name);
      const CeedHandle ceed{open(resource)};
      const Assembled got = assembled_on(ceed);
      const CeedScalar scale = max_norm(want.matrix);
      expect_close(got.matrix, want.matrix, 1e-12, "matrix", scale);
      expect_close(got.diagonal, want.diagonal, 1e-12, "diagonal", scale);
      expect_close(got.blocks, want.blocks, 1e-12, "point blocks", scale);
    }
  }
  EXPECT_GE(num_isas, 1);
}

TEST(AvxAssembly, IsThatOfTheReferenceAtQuadraturePoints) {
  for (const Problem &p : {Problem{1, 9, 11, 2, {}, 19}, Problem{2, 6, 7, 2, {}, 11}, Problem{3, 3, 4, 3, {}, 9},
                           Problem{3, 5, 5, 1, {}, 3}}) {
    SCOPED_TRACE(std::to_string(p.dim) + "D, P = " + std::to_string(p.P_1d));
    expect_as_reference([&](Ceed ceed) { return assemble(ceed, p); });
  }
}

/// More products of functions than go side by side.
TEST(AvxAssembly, TakesElementsThatFillTheCaches) {
  expect_as_reference([&](Ceed ceed) { return assemble(ceed, {3, 7, 2, 1, {}, 2}); });
}

/// More points in an element than are worked on at once, and none.
TEST(AvxAssembly, IsThatOfTheReferenceAtPoints) {
  for (const Problem &p : {Problem{1, 9, 9, 2, {300, 0, 1, 17}, 0}, Problem{2, 5, 5, 2, {0, 129, 128, 3, 40}, 0},
                           Problem{3, 6, 6, 1, {150, 7}, 0}, Problem{3, 3, 3, 3, {27, 0, 64, 5, 270, 1, 0, 8, 9}, 0}}) {
    SCOPED_TRACE(std::to_string(p.dim) + "D, P = " + std::to_string(p.P_1d));
    expect_as_reference([&](Ceed ceed) { return assemble(ceed, p); });
  }
}

/// Tables of products that are too large are left to the core: tensor products of many coefficients at points, and
/// bases without directions.
TEST(AvxAssembly, IsThatOfTheReferenceWhereItIsNotTaken) {
  expect_as_reference([&](Ceed ceed) { return assemble(ceed, {1, 12, 12, 2, {30, 2}, 0}); });
  constexpr CeedInt P = 45, Q = 150, num_elem = 3;
  expect_as_reference([&](Ceed ceed) {
    Random random(8200);
    const Values interp = random.reals(P * Q), grad = random.reals(2 * P * Q), x = random.reals(2 * Q),
                 w = random.reals(Q);
    std::vector<CeedInt> nodes(num_elem * P);
    std::iota(nodes.begin(), nodes.end(), 0);
    Basis basis;
    Restriction rstr;
    ok(CeedBasisCreateH1(ceed, CEED_TOPOLOGY_TRIANGLE, 1, P, Q, interp.data(), grad.data(), x.data(), w.data(),
                         basis.out()));
    ok(CeedElemRestrictionCreate(ceed, num_elem, P, 1, 1, num_elem * P, CEED_MEM_HOST, CEED_COPY_VALUES, nodes.data(),
                                 rstr.out()));
    const std::vector<BlendField> active = {{CEED_EVAL_GRAD, 2, rstr, basis, CEED_VECTOR_ACTIVE}};
    return assemble(make_blend(ceed, 6, active, active), ceed, num_elem * P, 1);
  });
}

}  // namespace
