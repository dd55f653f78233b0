// Projections: from the degrees of freedom of one basis to those of another that shares its quadrature points.
#include <gtest/gtest.h>

#include "backends.hpp"
#include "basis_cases.hpp"
#include "oracle/tabulated.hpp"

namespace hg::test {
namespace {

class BasisProjection : public BackendTest {};
INSTANTIATE_TEST_SUITE_P(Backends, BasisProjection, testing::ValuesIn(usable_backends()), backend_name);

Basis project(CeedBasis from, CeedBasis to) {
  Basis projection;
  ok(CeedBasisCreateProjection(from, to, projection.out()));
  return projection;
}

/// Both ways of having a basis.
struct Pair {
  Basis tensor, full;
  CeedBasis get(bool is_tensor) const { return is_tensor ? tensor : full; }
};

Pair make_pair(Ceed ceed, const BasisCase &c) {
  Pair pair{make_basis(ceed, c), {}};
  pair.full = without_tensor(ceed, pair.tensor, c);
  return pair;
}

constexpr bool yes_no[] = {true, false};

// A polynomial in both spaces: its values and derivatives at the nodes of the target, whichever way the two are given.
TEST_P(BasisProjection, ReproducesPolynomials) {
  Random random(1);
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (CeedInt P_from = 2; P_from <= 4; P_from++) {
      for (CeedInt P_to = 2; P_to <= 5; P_to++) {
        const CeedInt Q = std::max(P_from, P_to) + random.integer(0, 1), num_comp = random.integer(1, 4);
        const BasisCase from{dim, num_comp, P_from, Q, CEED_GAUSS}, to{dim, 2, P_to, Q, CEED_GAUSS};
        const Pair from_bases = make_pair(ceed, from), to_bases = make_pair(ceed, to);
        const Polynomial polynomial(dim, num_comp, std::min(P_from, P_to) - 1, random);
        const Values u = polynomial.at_points(tensor_grid(dim, nodes_1d(P_from)), false);
        const Values x_to = tensor_grid(dim, nodes_1d(P_to));
        for (const bool tensor_from : yes_no) {
          for (const bool tensor_to : yes_no) {
            SCOPED_TRACE(testing::Message() << "from " << from << (tensor_from ? " (tensor)" : "") << " to " << to
                                            << (tensor_to ? " (tensor)" : ""));
            const Basis projection = project(from_bases.get(tensor_from), to_bases.get(tensor_to));
            bool is_tensor = false;
            ok(CeedBasisIsTensor(projection, &is_tensor));
            EXPECT_EQ(is_tensor, tensor_from && tensor_to);
            for (const CeedEvalMode mode : {CEED_EVAL_INTERP, CEED_EVAL_GRAD}) {
              const Values want = polynomial.at_points(x_to, mode == CEED_EVAL_GRAD);
              expect_close(apply(ceed, projection, 1, CEED_NOTRANSPOSE, mode, u, static_cast<CeedSize>(want.size())),
                           want, 1e-12, CeedEvalModes[mode], 1);
            }
          }
        }
      }
    }
  }
}

// Sizes of the result: nodes of the source, points that are the nodes of the target, components of the source.
TEST_P(BasisProjection, HasTheSizesOfBoth) {
  const BasisCase from{2, 3, 2, 4, CEED_GAUSS}, to{2, 5, 4, 4, CEED_GAUSS};
  const Pair from_bases = make_pair(ceed, from), to_bases = make_pair(ceed, to);
  for (const bool is_tensor : yes_no) {
    const Basis projection = project(from_bases.get(is_tensor), to_bases.get(is_tensor));
    CeedInt P, Q, num_comp, dim;
    CeedElemTopology topology;
    CeedFESpace space;
    const CeedScalar *q_ref, *q_weights;
    ok(CeedBasisGetNumNodes(projection, &P));
    ok(CeedBasisGetNumQuadraturePoints(projection, &Q));
    ok(CeedBasisGetNumComponents(projection, &num_comp));
    ok(CeedBasisGetDimension(projection, &dim));
    ok(CeedBasisGetTopology(projection, &topology));
    ok(CeedBasisGetFESpace(projection, &space));
    ok(CeedBasisGetQRef(projection, &q_ref));
    ok(CeedBasisGetQWeights(projection, &q_weights));
    EXPECT_EQ(P, 4);
    EXPECT_EQ(Q, 16);
    EXPECT_EQ(num_comp, 3);
    EXPECT_EQ(dim, 2);
    EXPECT_EQ(topology, CEED_TOPOLOGY_QUAD);
    EXPECT_EQ(space, CEED_FE_SPACE_H1);
    EXPECT_EQ(Values(q_ref, q_ref + (is_tensor ? 4 : 32)), Values(is_tensor ? 4 : 32, 0.0));
    EXPECT_EQ(Values(q_weights, q_weights + (is_tensor ? 4 : 16)), Values(is_tensor ? 4 : 16, 0.0));
  }
}

// From a space into a larger one and back is the identity; back and forth is a projector: once is as good as twice.
TEST_P(BasisProjection, ThereAndBackIsTheIdentity) {
  Random random(2);
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const BasisCase coarse{dim, 2, 3, 5, CEED_GAUSS}, fine{dim, 2, 5, 5, CEED_GAUSS};
    const Pair coarse_bases = make_pair(ceed, coarse), fine_bases = make_pair(ceed, fine);
    for (const bool is_tensor : yes_no) {
      SCOPED_TRACE(testing::Message() << coarse << (is_tensor ? " (tensor)" : ""));
      const Basis up = project(coarse_bases.get(is_tensor), fine_bases.get(is_tensor)),
                  down = project(fine_bases.get(is_tensor), coarse_bases.get(is_tensor));
      const CeedSize n_coarse = 2 * coarse.num_nodes(), n_fine = 2 * fine.num_nodes();
      const auto go_up = [&](const Values &u) {
        return apply(ceed, up, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, n_fine);
      };
      const auto go_down = [&](const Values &u) {
        return apply(ceed, down, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, n_coarse);
      };
      const Values u = random.reals(n_coarse), v = random.reals(n_fine);
      expect_close(go_down(go_up(u)), u, 1e-12, "down up", 1);
      const Values once = go_up(go_down(v));
      expect_close(go_up(go_down(once)), once, 1e-12, "projector", 1);
      // What is lost is orthogonal to the coarse space at the quadrature points.
      const CeedSize at_points = 2 * coarse.num_qpts();
      Values lost = v;
      for (std::size_t i = 0; i < lost.size(); i++) lost[i] -= once[i];
      const Values at_q = apply(ceed, fine_bases.tensor, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, lost, at_points);
      expect_close(apply(ceed, coarse_bases.tensor, 1, CEED_TRANSPOSE, CEED_EVAL_INTERP, at_q, n_coarse),
                   Values(static_cast<std::size_t>(n_coarse), 0), 1e-11, "orthogonality", 1);
      expect_adjoint(
          go_up, [&](const Values &y) { return apply(ceed, up, 1, CEED_TRANSPOSE, CEED_EVAL_INTERP, y, n_coarse); },
          n_coarse, n_fine, random, 1e-12, "transpose");
    }
  }
}

// A basis on itself: the identity, and the derivatives of the basis functions at the nodes.
TEST_P(BasisProjection, OntoItselfIsTheIdentity) {
  Random random(3);
  for (const Tabulated &element : tabulated_elements(3)) {
    SCOPED_TRACE(element.name);
    const Basis basis = element.make(ceed, 2), projection = project(basis, basis);
    const Values u = random.reals(2 * element.P);
    expect_close(apply(ceed, projection, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, 2 * element.P), u, 1e-12, "", 1);
    CeedFESpace space;
    ok(CeedBasisGetFESpace(projection, &space));
    EXPECT_EQ(space, CEED_FE_SPACE_H1);
    const Vector nodes = make_vector(ceed, u), points = make_vector(ceed, 2 * element.P * element.dim, 0);
    if (element.space == CEED_FE_SPACE_H1) {
      ok(CeedBasisApply(projection, 1, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, nodes, points));
    } else {
      expect_error(CeedBasisApply(projection, 1, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, nodes, points),
                   CEED_ERROR_UNSUPPORTED, {"made without a matrix"});
    }
  }
}

// P1 is in P2: coefficients of one become those of the other.
TEST_P(BasisProjection, FollowsInclusions) {
  Random random(4);
  for (const char *shape : {"triangle", "tetrahedron"}) {
    const Tabulated p1 = tabulated(std::string("P1 ") + shape, 3), p2 = tabulated(std::string("P2 ") + shape, 3);
    const Basis projection = project(p1.make(ceed, 1), p2.make(ceed, 1));
    PolynomialField linear = {{0, {0, 0, 0}}};
    for (const PolynomialField &function : p1.shapes) linear[0].add(random.real(), function[0]);
    expect_close(apply(ceed, projection, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, p1.interpolate(linear), p2.P),
                 p2.interpolate(linear), 1e-13, "values at the nodes of P2", 1);
    // Its gradient is one and the same everywhere.
    const Values gradient = p1.evaluate(linear, CEED_EVAL_GRAD, Values(3, 0).data());
    Values want;
    for (const CeedScalar g : gradient) want.insert(want.end(), static_cast<std::size_t>(p2.P), g);
    expect_close(apply(ceed, projection, 1, CEED_NOTRANSPOSE, CEED_EVAL_GRAD, p1.interpolate(linear),
                       static_cast<CeedSize>(want.size())),
                 want, 1e-12, "gradient at the nodes of P2", 1);
  }
}

// A cell's basis at the quadrature points of its face: the trace at the nodes of the face, with all derivatives of the
// cell.
TEST_P(BasisProjection, TakesCellsToFaces) {
  Random random(5);
  const CeedInt Q_1d = 3;
  const BasisCase face_case{2, 1, 3, Q_1d, CEED_GAUSS}, cell_case{3, 1, 3, Q_1d, CEED_GAUSS};
  const Basis face = make_basis(ceed, face_case), cell = make_basis(ceed, cell_case);
  const Values q_1d = points_1d(Q_1d, CEED_GAUSS), grid = tensor_grid(2, q_1d);
  const CeedInt Q = face_case.num_qpts(), P = cell_case.num_nodes();
  Values interp(static_cast<std::size_t>(Q) * P), grad(interp.size() * 3);
  for (CeedInt q = 0; q < Q; q++) {
    const CeedScalar x[3] = {grid[q], grid[Q + q], -1};
    Values derivatives(static_cast<std::size_t>(3) * P);
    ok(CeedBasisEvaluateAtPoint(cell, x, &interp[static_cast<std::size_t>(q) * P], derivatives.data()));
    for (CeedInt g = 0; g < 3; g++) {
      std::copy_n(&derivatives[g * P], P, &grad[(static_cast<std::size_t>(g) * Q + q) * P]);
    }
  }
  Basis trace;
  ok(CeedBasisCreateH1(ceed, CEED_TOPOLOGY_HEX, 1, P, Q, interp.data(), grad.data(), nullptr, nullptr, trace.out()));
  const Basis projection = project(trace, face);
  const Polynomial polynomial(3, 1, 2, random);
  const Values u = polynomial.at_points(tensor_grid(3, nodes_1d(3)), false);
  Values x = tensor_grid(2, nodes_1d(3));
  x.insert(x.end(), static_cast<std::size_t>(face_case.num_nodes()), -1);
  for (const CeedEvalMode mode : {CEED_EVAL_INTERP, CEED_EVAL_GRAD}) {
    const Values want = polynomial.at_points(x, mode == CEED_EVAL_GRAD);
    expect_close(apply(ceed, projection, 1, CEED_NOTRANSPOSE, mode, u, static_cast<CeedSize>(want.size())), want, 1e-12,
                 CeedEvalModes[mode], 1);
  }
}

// The functions of a projection between tensor products are those of the source, also away from the nodes.
TEST_P(BasisProjection, EvaluatesAtPoints) {
  Random random(6);
  const BasisCase from{2, 2, 3, 4, CEED_GAUSS}, to{2, 1, 4, 4, CEED_GAUSS};
  const Basis source = make_basis(ceed, from), projection = project(source, make_basis(ceed, to));
  const Values u = random.reals(2 * 2 * from.num_nodes()), x = random.reals(2 * (3 + 5));
  for (const CeedEvalMode mode : {CEED_EVAL_INTERP, CEED_EVAL_GRAD}) {
    const CeedSize length = (3 + 5) * 2 * q_comp(from, mode);
    expect_close(apply_at_points(ceed, projection, {3, 5}, CEED_NOTRANSPOSE, mode, x, u, length),
                 apply_at_points(ceed, source, {3, 5}, CEED_NOTRANSPOSE, mode, x, u, length), basis_tolerance(from),
                 CeedEvalModes[mode], 1);
  }
}

TEST_P(BasisProjection, RefusesBasesThatDoNotBelongTogether) {
  const Basis q3 = make_basis(ceed, {2, 1, 2, 3, CEED_GAUSS}), q4 = make_basis(ceed, {2, 1, 2, 4, CEED_GAUSS});
  const Basis rt = tabulated("RT0 quadrilateral", 3).make(ceed, 1);
  const Basis large = make_basis(ceed, {2, 1, 4, 3, CEED_GAUSS});
  Basis projection;
  expect_error(CeedBasisCreateProjection(q3, q4, projection.out()), CEED_ERROR_DIMENSION,
               {"basis_from has 9", "basis_to has 16"});
  expect_error(CeedBasisCreateProjection(q3, rt, projection.out()), CEED_ERROR_INCOMPATIBLE,
               {"from a H^1 space to a H(div) space"});
  expect_error(CeedBasisCreateProjection(q3, large, projection.out()), CEED_ERROR_DIMENSION,
               {"basis_to", "3 rows", "4 columns"});
  expect_error(CeedBasisCreateProjection(q3, CEED_BASIS_NONE, projection.out()), CEED_ERROR_INCOMPATIBLE,
               {"CEED_BASIS_NONE"});
  expect_error(CeedBasisCreateProjection(q3, q3, nullptr), CEED_ERROR_INCOMPLETE, {"basis_project"});
  EXPECT_EQ(projection.get(), nullptr);
}

}  // namespace
}  // namespace hg::test
