// The SIMD backend: what it owes beyond the conformance suite, which knows no backend.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../conformance/oracle/instance.hpp"
#include "isa.hpp"
#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

/// Instruction sets with fused multiplications that this machine has, which round alike: 4 and 8 elements in a block.
std::vector<std::string> fused() {
  std::vector<std::string> found;
  for (const char *name : {"avx2", "avx512"}) {
    const Isa isa(name);
    if (resource_of("/cpu/self") == blocked) found.push_back(name);
  }
  return found;
}

Values applied(const std::string &isa_name, const Case &c, const Values &in) {
  const Isa isa(isa_name);
  const CeedHandle ceed{open(blocked)};
  const Instance instance(ceed, c);
  const Values first = apply(instance, c, in);
  EXPECT_EQ(apply(instance, c, in), first) << "a second application on " << isa_name;
  return first;
}

/// Elements in a block are added one after another, so that the number of them changes no bit.
TEST(Avx, DoesNotDependOnTheSizeOfBlocks) {
  const auto names = fused();
  if (names.size() < 2) GTEST_SKIP() << "this machine has one width of fused multiplications, or none";
  for (int seed = 0; seed < num_cases(40); seed++) {
    Random random(7000 + static_cast<std::uint64_t>(seed));
    const Case c =
        random_case(random, {.dim = 1 + seed % 3, .is_oriented = seed % 4 == 3, .has_many_elements = seed % 2 == 1});
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(c));
    const Values in = random.reals(c.input_size());
    EXPECT_EQ(applied(names[0], c, in), applied(names[1], c, in));
  }
}

/// Blocks, and one element at a time, against the oracle: more elements than a block has.
TEST(Avx, IsRightForManyElements) {
  for (const char *resource : {blocked, "/cpu/self/avx/serial"}) {
    const CeedHandle ceed{open(resource)};
    for (int seed = 0; seed < num_cases(40); seed++) {
      Random random(7200 + static_cast<std::uint64_t>(seed));
      const bool at_points = seed % 2 == 1;
      const Case c = random_case(random, {.dim = 1 + seed % 3,
                                          .at_points = at_points,
                                          .is_oriented = seed % 4 == 3,
                                          .mixes_spaces = !at_points && seed % 3 == 0,
                                          .has_many_elements = true});
      SCOPED_TRACE(std::string(resource) + ", seed " + std::to_string(seed) + ": " + describe(c));
      const Values in = random.reals(c.input_size());
      Case bare = c;  // orientations may add functions that cancel: rounding is relative to what cancelled
      for (Space &space : bare.spaces) space.orientation.clear();
      const Outcome want = hg::test::apply(c, in);
      expect_close(apply(Instance(ceed, c), c, in), want.active, tolerance(num_terms(c)), "active output",
                   max_norm(hg::test::apply(bare, in).active));
    }
  }
}

TEST(Avx, RepeatsItselfAtPoints) {
  for (int seed = 0; seed < num_cases(20); seed++) {
    Random random(7100 + static_cast<std::uint64_t>(seed));
    const Case c = random_case(random, {.dim = 1 + seed % 3, .at_points = true});
    applied("portable", c, random.reals(c.input_size()));
  }
}

/// Elements on a line, none of which touch, with 3 Gauss points each; v = B^T f(B u, w).
struct LineOperator {
  LineOperator(Ceed ceed, CeedInt num_elem, CeedInt vec_length, CeedQFunctionUser f)
      : u(make_vector(ceed, Values(2 * num_elem, 1.0))), v(make_vector(ceed, Values(2 * num_elem, 0.0))) {
    std::vector<CeedInt> offsets;
    for (CeedInt i = 0; i < 2 * num_elem; i++) offsets.push_back(i);
    ok(CeedQFunctionCreateInterior(ceed, vec_length, f, "nowhere.h:f", qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf, "w", 1, CEED_EVAL_WEIGHT));
    ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP));
    ok(CeedElemRestrictionCreate(ceed, num_elem, 2, 1, 1, 2 * num_elem, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(),
                                 rstr.out()));
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 3, CEED_GAUSS, basis.out()));
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "u", rstr, basis, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "w", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE));
    ok(CeedOperatorSetField(op, "v", rstr, basis, CEED_VECTOR_ACTIVE));
  }
  int apply() const { return CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE); }
  /// The mass of a function that is 1: each of an element's two basis functions has the integral 1 on [-1,1].
  void expect_mass() const {
    for (const CeedScalar value : values_of(v)) EXPECT_NEAR(value, 1.0, 1e-14);
  }

  QFunction qf;
  Restriction rstr;
  Basis basis;
  Operator op;
  Vector u, v;
};

std::vector<CeedInt> calls;   ///< points of each call
int calls_until_failure = 0;  ///< not positive: none fails
int weigh(void *, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  if (--calls_until_failure == 0) return 1;
  calls.push_back(Q);
  for (CeedInt q = 0; q < Q; q++) out[0][q] = in[0][q] * in[1][q];
  return 0;
}

/// Whoever counts or sums in a QFunction sees each point once, whatever the number of elements.
TEST(Avx, CallsTheFunctionOnceForEachPoint) {
  const CeedHandle ceed{open(blocked)};
  for (const CeedInt vec_length : {1, 2}) {
    for (CeedInt num_elem = 1; num_elem <= 19; num_elem++) {
      SCOPED_TRACE(std::to_string(num_elem) + " elements, vec_length " + std::to_string(vec_length));
      const LineOperator line(ceed, num_elem, vec_length, weigh);
      calls.clear();
      calls_until_failure = 0;
      ok(line.apply());
      line.expect_mass();
      CeedInt total = 0;
      for (const CeedInt size : calls) {
        EXPECT_EQ(size % vec_length, 0);
        total += size;
      }
      EXPECT_EQ(total, (3 * num_elem + vec_length - 1) / vec_length * vec_length);
    }
  }
}

/// Arrays are those of a block: their size does not depend on the mesh.
TEST(Avx, KeepsNoMoreForALargerMesh) {
  for (const char *resource : {blocked, "/cpu/self/avx/serial"}) {
    const CeedHandle ceed{open(resource)};
    const LineOperator small(ceed, 19, 1, weigh), large(ceed, 1900, 1, weigh);
    CeedOperatorMemory of_small{}, of_large{};
    ok(CeedOperatorGetMemory(small.op, &of_small));
    ok(CeedOperatorGetMemory(large.op, &of_large));
    EXPECT_GT(of_small.backend, 0);
    EXPECT_EQ(of_large.backend, of_small.backend);
  }
}

/// A solver that gets an error tries again with a smaller step, on the same operator.
TEST(Avx, IsRightAfterAFunctionThatFailed) {
  const CeedHandle ceed{open(blocked)};
  for (const CeedInt num_elem : {3, 8, 19}) {
    SCOPED_TRACE(std::to_string(num_elem) + " elements");
    const LineOperator line(ceed, num_elem, 1, weigh);
    calls.clear();
    calls_until_failure = 0;
    ok(line.apply());
    const int num_calls = static_cast<int>(calls.size());
    for (int failing = 1; failing <= num_calls; failing++) {
      calls_until_failure = failing;
      EXPECT_EQ(line.apply(), CEED_ERROR_BACKEND) << "call " << failing;
      calls_until_failure = 0;
      ok(line.apply());
      line.expect_mass();
    }
  }
}

/// Memory for assembly does not grow with the mesh: it goes piece by piece, some of which have no points.
TEST(Avx, AssemblesPiecesOfUnevenMeshesAtPoints) {
  const CeedHandle ceed{open(blocked)}, other{open(reference_resource)};
  constexpr CeedInt num_elem = 6000, num_comp = 3, dim = 3, P_1d = 2, elem_size = 8;
  const auto count = [](CeedInt e) { return e % 16 >= 6 && e % 16 <= 9 ? 30 : 0; };
  const auto diagonal_on = [&](Ceed on) {
    std::vector<CeedInt> points{num_elem + 1}, nodes;
    for (CeedInt e = 0; e < num_elem; e++) points.push_back(points.back() + count(e));
    const CeedInt num_points = points.back() - num_elem - 1;
    for (CeedInt p = 0; p < num_points; p++) points.push_back(p);
    for (CeedInt i = 0; i < num_elem * elem_size; i++) nodes.push_back(num_comp * i);
    Restriction at_points, rstr;
    Basis basis;
    QFunction qf;
    Operator op;
    ok(CeedElemRestrictionCreateAtPoints(on, num_elem, num_points, dim, CeedSize{num_points} * dim, CEED_MEM_HOST,
                                         CEED_COPY_VALUES, points.data(), at_points.out()));
    ok(CeedElemRestrictionCreate(on, num_elem, elem_size, num_comp, 1, CeedSize{num_elem} * elem_size * num_comp,
                                 CEED_MEM_HOST, CEED_COPY_VALUES, nodes.data(), rstr.out()));
    ok(CeedBasisCreateTensorH1Lagrange(on, dim, num_comp, P_1d, 2, CEED_GAUSS, basis.out()));
    ok(CeedQFunctionCreateIdentity(on, num_comp * dim, CEED_EVAL_GRAD, CEED_EVAL_GRAD, qf.out()));
    ok(CeedOperatorCreateAtPoints(on, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "input", rstr, basis, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "output", rstr, basis, CEED_VECTOR_ACTIVE));
    Random random(7300);
    const Vector x = make_vector(on, random.reals(CeedSize{num_points} * dim));
    ok(CeedOperatorAtPointsSetPoints(op, at_points, x));
    const Vector diagonal = make_vector(on, CeedSize{num_elem} * elem_size * num_comp, 0.0);
    ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
    return values_of(diagonal);
  };
  const Values got = diagonal_on(ceed), want = diagonal_on(other);
  ASSERT_EQ(got.size(), want.size());
  expect_close(got, want, 1e-12, "diagonal");
}

/// A name that is none is told; the next backend serves who did not ask for this one.
TEST(Avx, SaysWhichInstructionSetItDoesNotKnow) {
  const Isa isa("mmx");
  EXPECT_EQ(resource_of("/cpu/self"), "/cpu/self/ref/serial");
}

}  // namespace
