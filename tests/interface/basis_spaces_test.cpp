// What bases without tensor product tell about themselves, and what creation refuses.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <utility>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace hg::test {
namespace {

class BasisSpacesInterface : public testing::Test {
 protected:
  CeedHandle ceed{open(reference_resource)};
};

struct Space {
  CeedFESpace space;
  CeedEvalMode derivative;
  decltype(&CeedBasisCreateH1) create;
  decltype(&CeedBasisGetGrad) get_derivative;
};

constexpr Space spaces[] = {{CEED_FE_SPACE_H1, CEED_EVAL_GRAD, CeedBasisCreateH1, CeedBasisGetGrad},
                            {CEED_FE_SPACE_HDIV, CEED_EVAL_DIV, CeedBasisCreateHdiv, CeedBasisGetDiv},
                            {CEED_FE_SPACE_HCURL, CEED_EVAL_CURL, CeedBasisCreateHcurl, CeedBasisGetCurl}};

/// Values at a point for one component, written out.
CeedInt q_comp(CeedFESpace space, CeedInt dim, CeedEvalMode mode) {
  if (mode == CEED_EVAL_INTERP) return space == CEED_FE_SPACE_H1 ? 1 : dim;
  if (mode == CEED_EVAL_GRAD) return dim;
  return mode == CEED_EVAL_CURL && dim == 3 ? 3 : 1;
}

struct Shape {
  CeedElemTopology topology;
  CeedInt dim;
};
constexpr Shape shapes[] = {{CEED_TOPOLOGY_LINE, 1}, {CEED_TOPOLOGY_TRIANGLE, 2}, {CEED_TOPOLOGY_QUAD, 2},
                            {CEED_TOPOLOGY_TET, 3},  {CEED_TOPOLOGY_PYRAMID, 3},  {CEED_TOPOLOGY_PRISM, 3},
                            {CEED_TOPOLOGY_HEX, 3}};

TEST_F(BasisSpacesInterface, TellTheirSizesAndMatrices) {
  Random random(1);
  const CeedInt P = 5, Q = 7, num_comp = 2;
  for (const Space &s : spaces) {
    for (const Shape &shape : shapes) {
      SCOPED_TRACE(testing::Message() << CeedFESpaces[s.space] << ", " << CeedElemTopologies[shape.topology]);
      const Values interp = random.reals(q_comp(s.space, shape.dim, CEED_EVAL_INTERP) * P * Q),
                   derivative = random.reals(q_comp(s.space, shape.dim, s.derivative) * P * Q),
                   q_ref = random.reals(shape.dim * Q), q_weights = random.reals(Q);
      Basis basis;
      ok(s.create(ceed, shape.topology, num_comp, P, Q, interp.data(), derivative.data(), q_ref.data(),
                  q_weights.data(), basis.out()));
      CeedInt got = 0;
      CeedElemTopology topology;
      CeedFESpace space;
      CeedEvalMode mode;
      bool answer = true;
      ok(CeedBasisGetDimension(basis, &got));
      EXPECT_EQ(got, shape.dim);
      ok(CeedBasisGetNumComponents(basis, &got));
      EXPECT_EQ(got, num_comp);
      ok(CeedBasisGetNumNodes(basis, &got));
      EXPECT_EQ(got, P);
      ok(CeedBasisGetNumQuadraturePoints(basis, &got));
      EXPECT_EQ(got, Q);
      ok(CeedBasisGetTopology(basis, &topology));
      EXPECT_EQ(topology, shape.topology);
      ok(CeedBasisGetFESpace(basis, &space));
      EXPECT_EQ(space, s.space);
      ok(CeedBasisGetDerivativeMode(basis, &mode));
      EXPECT_EQ(mode, s.derivative);
      ok(CeedBasisIsTensor(basis, &answer));
      EXPECT_FALSE(answer);
      ok(CeedBasisIsCollocated(basis, &answer));
      EXPECT_FALSE(answer);
      const CeedScalar *matrix = nullptr, *pointer = nullptr, identity = 1;
      const auto expect_matrix = [&](const Values &want) { EXPECT_EQ(Values(matrix, matrix + want.size()), want); };
      ok(CeedBasisGetInterp(basis, &matrix));
      expect_matrix(interp);
      ok(CeedOperatorGetBasisPointer(basis, CEED_EVAL_INTERP, &identity, &pointer));
      EXPECT_EQ(pointer, matrix);
      ok(s.get_derivative(basis, &matrix));
      expect_matrix(derivative);
      ok(CeedOperatorGetBasisPointer(basis, s.derivative, nullptr, &pointer));
      EXPECT_EQ(pointer, matrix);
      ok(CeedOperatorGetBasisPointer(basis, CEED_EVAL_NONE, &identity, &pointer));
      EXPECT_EQ(pointer, &identity);
      ok(CeedBasisGetQRef(basis, &matrix));
      expect_matrix(q_ref);
      ok(CeedBasisGetQWeights(basis, &matrix));
      expect_matrix(q_weights);
      for (const CeedEvalMode each :
           {CEED_EVAL_NONE, CEED_EVAL_INTERP, CEED_EVAL_GRAD, CEED_EVAL_DIV, CEED_EVAL_CURL, CEED_EVAL_WEIGHT}) {
        const bool is_derivative = each == CEED_EVAL_GRAD || each == CEED_EVAL_DIV || each == CEED_EVAL_CURL;
        if (is_derivative && each != s.derivative) {
          expect_error(CeedBasisGetNumQuadratureComponents(basis, each, &got), CEED_ERROR_UNSUPPORTED,
                       {CeedFESpaces[s.space], "evaluation mode is " + std::to_string(each)});
          expect_error(CeedOperatorGetBasisPointer(basis, each, &identity, &pointer), CEED_ERROR_UNSUPPORTED,
                       {CeedFESpaces[s.space]});
        } else {
          ok(CeedBasisGetNumQuadratureComponents(basis, each, &got));
          const bool is_one = each == CEED_EVAL_NONE || each == CEED_EVAL_WEIGHT;
          EXPECT_EQ(got, is_one ? 1 : q_comp(s.space, shape.dim, each)) << CeedEvalModes[each];
          CeedSize flops = -1;
          ok(CeedBasisGetFlopsEstimate(basis, CEED_NOTRANSPOSE, each, false, 0, &flops));
          EXPECT_EQ(flops, is_one ? 0 : 2 * num_comp * got * P * Q);
        }
      }
      // What only tensor products have.
      const CeedScalar *table = nullptr;
      Values work(1000);
      for (const int code :
           {CeedBasisGetNumNodes1D(basis, &got), CeedBasisGetNumQuadraturePoints1D(basis, &got),
            CeedBasisGetInterp1D(basis, &table), CeedBasisGetGrad1D(basis, &table),
            CeedBasisGetCollocatedGrad(basis, work.data()), CeedBasisGetChebyshevInterp1D(basis, work.data())}) {
        expect_error(code, CEED_ERROR_MINOR, {"without tensor product"});
      }
      ok(CeedBasisGetChebyshevCoefficients1D(basis, &got, &table));
      EXPECT_EQ(got, 0);
      EXPECT_EQ(table, nullptr);
      expect_error(CeedBasisEvaluateAtPoint(basis, q_ref.data(), work.data(), nullptr), CEED_ERROR_UNSUPPORTED,
                   {"no tensor product"});
    }
  }
}

TEST_F(BasisSpacesInterface, PointsWeightsAndDerivativesMayBeMissing) {
  const Values interp = {1, 0, 0, 1};
  Basis basis;
  ok(CeedBasisCreateH1(ceed, CEED_TOPOLOGY_TRIANGLE, 1, 2, 2, interp.data(), nullptr, nullptr, nullptr, basis.out()));
  const CeedScalar *array = nullptr;
  bool is_collocated = false;
  CeedEvalMode mode;
  ok(CeedBasisGetQRef(basis, &array));
  EXPECT_EQ(Values(array, array + 4), Values(4, 0.0));
  ok(CeedBasisGetQWeights(basis, &array));
  EXPECT_EQ(Values(array, array + 2), Values(2, 0.0));
  ok(CeedBasisIsCollocated(basis, &is_collocated));
  EXPECT_TRUE(is_collocated);
  ok(CeedBasisGetDerivativeMode(basis, &mode));
  EXPECT_EQ(mode, CEED_EVAL_NONE);
  expect_error(CeedBasisGetGrad(basis, &array), CEED_ERROR_UNSUPPORTED, {"made without a matrix"});
}

TEST_F(BasisSpacesInterface, TensorProductsHaveAGradient) {
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 2, 1, 3, 4, CEED_GAUSS, basis.out()));
  CeedEvalMode mode;
  const CeedScalar *array = nullptr, *grad = nullptr;
  ok(CeedBasisGetDerivativeMode(basis, &mode));
  EXPECT_EQ(mode, CEED_EVAL_GRAD);
  ok(CeedBasisGetGrad(basis, &grad));
  ok(CeedOperatorGetBasisPointer(basis, CEED_EVAL_GRAD, nullptr, &array));
  EXPECT_EQ(array, grad);
  expect_error(CeedBasisGetDiv(basis, &array), CEED_ERROR_UNSUPPORTED, {"H^1 space", "CEED_EVAL_GRAD"});
  expect_error(CeedBasisGetCurl(basis, &array), CEED_ERROR_UNSUPPORTED, {"H^1 space"});
  expect_error(CeedOperatorGetBasisPointer(basis, CEED_EVAL_NONE, nullptr, &array), CEED_ERROR_INCOMPLETE,
               {"identity"});
  expect_error(CeedOperatorGetBasisPointer(basis, CEED_EVAL_WEIGHT, nullptr, &array), CEED_ERROR_UNSUPPORTED, {"16"});
}

// The format is part of the interface: scripts read it.
TEST_F(BasisSpacesInterface, ViewHasTheFieldsFormat) {
  const Values m = {1, -0.5, 0.25, 2, 3, -4};
  const auto view = [&](const Space &s, CeedElemTopology topology, CeedInt P, CeedInt Q, CeedInt tabs) {
    Basis basis;
    ok(s.create(ceed, topology, 1, P, Q, m.data(), m.data(), m.data(), m.data() + 1, basis.out()));
    ok(CeedBasisSetNumViewTabs(basis, tabs));
    return printed([&](FILE *stream) { ok(CeedBasisView(basis, stream)); });
  };
  EXPECT_EQ(view(spaces[0], CEED_TOPOLOGY_TRIANGLE, 3, 1, 0),
            "CeedBasis in a H^1 space on a triangle element\n"
            "  P: 3\n"
            "  Q: 1\n"
            "  dimension: 2\n"
            "  field components: 1\n"
            "  qref:     \t  1.00000000\t -0.50000000\n"
            "  qweight:  \t -0.50000000\n"
            "  interp:   \t  1.00000000\t -0.50000000\t  0.25000000\n"
            "  grad:\n"
            "    [0]\t  1.00000000\t -0.50000000\t  0.25000000\n"
            "    [1]\t  2.00000000\t  3.00000000\t -4.00000000\n");
  EXPECT_EQ(view(spaces[1], CEED_TOPOLOGY_TET, 1, 2, 1),
            "  CeedBasis in a H(div) space on a tetrahedron element\n"
            "    P: 1\n"
            "    Q: 2\n"
            "    dimension: 3\n"
            "    field components: 1\n"
            "    qref:     \t  1.00000000\t -0.50000000\t  0.25000000\t  2.00000000\t  3.00000000\t -4.00000000\n"
            "    qweight:  \t -0.50000000\t  0.25000000\n"
            "    interp:\n"
            "      [0]\t  1.00000000\n"
            "      [1]\t -0.50000000\n"
            "      [2]\t  0.25000000\n"
            "      [3]\t  2.00000000\n"
            "      [4]\t  3.00000000\n"
            "      [5]\t -4.00000000\n"
            "    div:\n"
            "      [0]\t  1.00000000\n"
            "      [1]\t -0.50000000\n");
  EXPECT_EQ(view(spaces[2], CEED_TOPOLOGY_QUAD, 3, 1, 0),
            "CeedBasis in a H(curl) space on a quadrilateral element\n"
            "  P: 3\n"
            "  Q: 1\n"
            "  dimension: 2\n"
            "  field components: 1\n"
            "  qref:     \t  1.00000000\t -0.50000000\n"
            "  qweight:  \t -0.50000000\n"
            "  interp:\n"
            "    [0]\t  1.00000000\t -0.50000000\t  0.25000000\n"
            "    [1]\t  2.00000000\t  3.00000000\t -4.00000000\n"
            "  curl:     \t  1.00000000\t -0.50000000\t  0.25000000\n");
}

TEST_F(BasisSpacesInterface, RefuseBadSizesAndMissingMatrices) {
  const Values m(100, 1.0);
  for (const Space &s : spaces) {
    Basis basis;
    const auto create = [&](int topology, CeedInt num_comp, CeedInt P, CeedInt Q, const CeedScalar *interp) {
      return s.create(ceed, static_cast<CeedElemTopology>(topology), num_comp, P, Q, interp, m.data(), m.data(),
                      m.data(), basis.out());
    };
    expect_error(create(7, 1, 2, 2, m.data()), CEED_ERROR_DIMENSION, {"topology is 7"});
    expect_error(create(CEED_TOPOLOGY_TET, 0, 2, 2, m.data()), CEED_ERROR_DIMENSION, {"num_comp is 0"});
    expect_error(create(CEED_TOPOLOGY_TET, 1, 0, 2, m.data()), CEED_ERROR_DIMENSION, {"number of nodes is 0"});
    expect_error(create(CEED_TOPOLOGY_TET, 1, 2, -1, m.data()), CEED_ERROR_DIMENSION,
                 {"number of quadrature points is -1"});
    expect_error(create(CEED_TOPOLOGY_TET, 1, 2, 2, nullptr), CEED_ERROR_INCOMPLETE, {"interp"});
    expect_error(s.create(ceed, CEED_TOPOLOGY_TET, 1, 2, 2, m.data(), m.data(), m.data(), m.data(), nullptr),
                 CEED_ERROR_INCOMPLETE, {"basis"});
    EXPECT_EQ(s.create(nullptr, CEED_TOPOLOGY_TET, 1, 2, 2, m.data(), m.data(), m.data(), m.data(), basis.out()),
              CEED_ERROR_INCOMPLETE);
    EXPECT_EQ(basis.get(), nullptr);
  }
}

}  // namespace
}  // namespace hg::test
