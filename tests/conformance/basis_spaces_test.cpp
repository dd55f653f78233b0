// Bases without tensor product: in H^1, H(div) and H(curl), on elements of every shape.
#include <gtest/gtest.h>

#include <cmath>

#include "backends.hpp"
#include "basis_cases.hpp"
#include "oracle/tabulated.hpp"

namespace hg::test {
namespace {

class BasisSpaces : public BackendTest {};
INSTANTIATE_TEST_SUITE_P(Backends, BasisSpaces, testing::ValuesIn(usable_backends()), backend_name);

constexpr CeedElemTopology topologies[] = {CEED_TOPOLOGY_LINE, CEED_TOPOLOGY_TRIANGLE, CEED_TOPOLOGY_QUAD,
                                           CEED_TOPOLOGY_TET,  CEED_TOPOLOGY_PYRAMID,  CEED_TOPOLOGY_PRISM,
                                           CEED_TOPOLOGY_HEX};

/// A basis with random matrices of random sizes.
Tabulated random_element(Random &random) {
  Tabulated element;
  element.topology = topologies[random.integer(0, 6)];
  ok(CeedBasisGetTopologyDimension(element.topology, &element.dim));
  element.space = static_cast<CeedFESpace>(random.integer(CEED_FE_SPACE_H1, CEED_FE_SPACE_HCURL));
  element.P = random.integer(1, 20);
  element.Q = random.integer(1, 30);
  const auto size = static_cast<CeedSize>(element.Q) * element.P;
  element.interp = random.reals(element.q_comp(CEED_EVAL_INTERP) * size);
  element.derivative = random.reals(element.q_comp(element.derivative_mode()) * size);
  element.q_ref = random.reals(static_cast<CeedSize>(element.dim) * element.Q);
  element.q_weights = random.reals(element.Q);
  return element;
}

// The interpolation of a field in the space is the field, and so is its derivative, at all quadrature points.
TEST_P(BasisSpaces, EvaluatesFieldsOfTheSpaceExactly) {
  Random random(1);
  for (const Tabulated &element : tabulated_elements(3)) {
    SCOPED_TRACE(element.name);
    const CeedInt num_comp = random.integer(1, 9);
    const Basis basis = element.make(ceed, num_comp);
    std::vector<PolynomialField> fields;  // a random one for each component
    Values u;
    for (CeedInt c = 0; c < num_comp; c++) {
      PolynomialField field(element.shapes[0].size());
      for (const PolynomialField &shape : element.shapes) {
        const CeedScalar factor = random.real();
        for (std::size_t d = 0; d < field.size(); d++) field[d].add(factor, shape[d]);
      }
      const Values dofs = element.interpolate(field);
      u.insert(u.end(), dofs.begin(), dofs.end());
      fields.push_back(std::move(field));
    }
    for (const CeedEvalMode mode : {CEED_EVAL_INTERP, element.derivative_mode()}) {
      const CeedInt q_comp = element.q_comp(mode);
      Values want(static_cast<std::size_t>(element.Q) * num_comp * q_comp);
      for (CeedInt c = 0; c < num_comp; c++) {
        for (CeedInt q = 0; q < element.Q; q++) {
          const Values values = element.evaluate(fields[c], mode, element.point(q).data());
          for (CeedInt g = 0; g < q_comp; g++) want[(g * num_comp + c) * element.Q + q] = values[g];
        }
      }
      expect_close(apply(ceed, basis, 1, CEED_NOTRANSPOSE, mode, u, static_cast<CeedSize>(want.size())), want,
                   100 * tolerance(element.P), CeedEvalModes[mode], 1);
    }
  }
}

// Gauss: the integral of the divergence is the sum of the fluxes out of the faces, which are the degrees of freedom.
TEST_P(BasisSpaces, DivergenceTheorem) {
  Random random(2);
  for (const Tabulated &element : tabulated_elements(2)) {
    if (element.space != CEED_FE_SPACE_HDIV) continue;
    SCOPED_TRACE(element.name);
    const Basis basis = element.make(ceed, 1);
    const Values u = random.reals(element.P);
    const Values weights = apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, {0}, element.Q);
    const Values integral = {dot(weights, apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_DIV, u, element.Q))};
    const Values out = {dot(u, Values(u.size(), 1))};
    expect_close(integral, out, 1e-13, "flux", 1);
  }
}

// Stokes: in the plane the integral of the curl is the circulation along the edges; in space the curl of a gradient
// vanishes.
TEST_P(BasisSpaces, StokesTheorem) {
  Random random(3);
  for (const Tabulated &element : tabulated_elements(2)) {
    if (element.space != CEED_FE_SPACE_HCURL) continue;
    SCOPED_TRACE(element.name);
    const Basis basis = element.make(ceed, 1);
    const CeedSize size = static_cast<CeedSize>(element.Q) * element.q_comp(CEED_EVAL_CURL);
    if (element.dim == 2) {
      const Values u = random.reals(element.P);
      const Values weights = apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, {0}, element.Q);
      const Values integral = {dot(weights, apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_CURL, u, size))};
      const Values round = {dot(u, Values(u.size(), 1))};
      expect_close(integral, round, 1e-13, "circulation", 1);
    } else {
      PolynomialField gradient;  // of a linear function
      for (int d = 0; d < 3; d++) gradient.push_back({random.real(), {0, 0, 0}});
      const Values u = element.interpolate(gradient);
      expect_close(apply(ceed, basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_CURL, u, size),
                   Values(static_cast<std::size_t>(size), 0), 1e-12, "curl of a gradient", 1);
    }
  }
}

// Weights integrate polynomials, here 1: they sum up to the volumes of the reference shapes.
TEST_P(BasisSpaces, WeightsIntegrateTheElement) {
  for (const Tabulated &element : tabulated_elements(3)) {
    SCOPED_TRACE(element.name);
    const Basis basis = element.make(ceed, 2);
    const CeedInt num_elem = 3;
    const Values weights = apply(ceed, basis, num_elem, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, {0},
                                 num_elem * static_cast<CeedSize>(element.Q));
    Values volume(static_cast<std::size_t>(num_elem), 0), want;
    for (CeedInt e = 0; e < num_elem; e++) {
      for (CeedInt q = 0; q < element.Q; q++) volume[e] += weights[e * element.Q + q];
    }
    switch (element.topology) {
      case CEED_TOPOLOGY_TRIANGLE:
        want.assign(3, 0.5);
        break;
      case CEED_TOPOLOGY_TET:
        want.assign(3, 1.0 / 6);
        break;
      case CEED_TOPOLOGY_PRISM:
        want.assign(3, 1);
        break;
      default:
        want.assign(3, CeedIntPow(2, element.dim));
    }
    expect_close(volume, want, 1e-14, "volume");
  }
}

// Random matrices, sizes, shapes, components and numbers of elements against the plain definition; adding as well.
TEST_P(BasisSpaces, IsItsMatrix) {
  Random random(4);
  for (int round = 0; round < 60; round++) {
    const Tabulated element = random_element(random);
    const CeedInt num_comp = random.integer(1, 9),
                  num_elem = round % 4 == 0 ? random.integer(0, 1) : random.integer(2, 20);
    SCOPED_TRACE(testing::Message() << CeedFESpaces[element.space] << " on a " << CeedElemTopologies[element.topology]
                                    << ", P " << element.P << ", Q " << element.Q << ", components " << num_comp
                                    << ", elements " << num_elem);
    const Basis basis = element.make(ceed, num_comp);
    for (const CeedEvalMode mode : {CEED_EVAL_INTERP, element.derivative_mode()}) {
      const CeedInt q_comp = element.q_comp(mode);
      const CeedSize at_nodes = static_cast<CeedSize>(num_elem) * element.P * num_comp,
                     at_points = static_cast<CeedSize>(num_elem) * element.Q * num_comp * q_comp;
      const auto dense = [&](CeedTransposeMode t_mode, const Values &u) {
        return dense_apply(element.matrix(mode), q_comp, element.Q, element.P, num_comp, num_elem, t_mode, u);
      };
      const auto act = [&](CeedTransposeMode t_mode, const Values &u, CeedSize length) {
        // A vector has entries; without elements one that is not looked at.
        Values result =
            apply(ceed, basis, num_elem, t_mode, mode, u.empty() ? Values{0} : u, std::max<CeedSize>(length, 1));
        if (length == 0) result.clear();
        return result;
      };
      const Values u = random.reals(at_nodes), v = random.reals(at_points);
      const CeedScalar tol = tolerance(static_cast<CeedSize>(element.Q) * q_comp + element.P);
      expect_close(act(CEED_NOTRANSPOSE, u, at_points), dense(CEED_NOTRANSPOSE, u), tol, CeedEvalModes[mode], 1);
      const Values back = dense(CEED_TRANSPOSE, v);
      expect_close(act(CEED_TRANSPOSE, v, at_nodes), back, tol, CeedEvalModes[mode], 1);
      if (num_elem == 0) continue;
      expect_adjoint([&](const Values &x) { return act(CEED_NOTRANSPOSE, x, at_points); },
                     [&](const Values &y) { return act(CEED_TRANSPOSE, y, at_nodes); }, at_nodes, at_points, random,
                     tol, CeedEvalModes[mode]);
      const Values start = random.reals(at_nodes);
      const Vector in = make_vector(ceed, v), out = make_vector(ceed, start);
      ok(CeedBasisApplyAdd(basis, num_elem, CEED_TRANSPOSE, mode, in, out));
      Values want = start;
      for (std::size_t i = 0; i < want.size(); i++) want[i] += back[i];
      expect_close(values_of(out), want, tol, "added", 1);
    }
    Values weights;
    for (CeedInt e = 0; e < num_elem; e++) {
      weights.insert(weights.end(), element.q_weights.begin(), element.q_weights.end());
    }
    const CeedSize count = static_cast<CeedSize>(weights.size());
    Values got = apply(ceed, basis, num_elem, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, {0}, std::max<CeedSize>(count, 1));
    got.resize(weights.size());
    EXPECT_EQ(got, weights);
  }
}

// A tensor-product basis given by its full matrices is the same basis.
TEST_P(BasisSpaces, FullMatricesOfATensorProductAreTheSameBasis) {
  Random random(5);
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const BasisCase c = {dim, 3, 3, 4, CEED_GAUSS};
    const Basis tensor = make_basis(ceed, c);
    const Basis full = without_tensor(ceed, tensor, c);
    const Values u = random.reals(2 * static_cast<CeedSize>(c.num_nodes()) * c.num_comp);
    for (const CeedEvalMode mode : {CEED_EVAL_INTERP, CEED_EVAL_GRAD}) {
      const CeedSize length = 2 * static_cast<CeedSize>(c.num_qpts()) * c.num_comp * q_comp(c, mode);
      expect_close(apply(ceed, full, 2, CEED_NOTRANSPOSE, mode, u, length),
                   apply(ceed, tensor, 2, CEED_NOTRANSPOSE, mode, u, length), basis_tolerance(c), CeedEvalModes[mode],
                   1);
    }
  }
}

TEST_P(BasisSpaces, RefusesModesThatTheSpaceDoesNotHave) {
  for (const Tabulated &element : tabulated_elements(2)) {
    SCOPED_TRACE(element.name);
    const Basis basis = element.make(ceed, 1);
    const Vector nodes = make_vector(ceed, 100, 1), points = make_vector(ceed, 1000, 1);
    for (const CeedEvalMode mode : {CEED_EVAL_NONE, CEED_EVAL_GRAD, CEED_EVAL_DIV, CEED_EVAL_CURL}) {
      if (mode == element.derivative_mode()) continue;
      expect_error(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, mode, nodes, points), CEED_ERROR_UNSUPPORTED,
                   {"evaluation mode is " + std::to_string(mode)});
    }
    for (const CeedTransposeMode t_mode : {CEED_NOTRANSPOSE, CEED_TRANSPOSE}) {
      const CeedInt one = 1;
      expect_error(CeedBasisApplyAtPoints(basis, 1, &one, t_mode, CEED_EVAL_INTERP, points, nodes, points),
                   CEED_ERROR_UNSUPPORTED, {"no tensor product", CeedFESpaces[element.space]});
    }
    expect_error(CeedBasisApply(basis, 1, CEED_TRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, points),
                 CEED_ERROR_UNSUPPORTED, {"CEED_EVAL_WEIGHT"});
    expect_error(CeedBasisApplyAdd(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, points), CEED_ERROR_UNSUPPORTED,
                 {"CEED_TRANSPOSE"});
    const Vector too_few = make_vector(ceed, element.Q * element.q_comp(CEED_EVAL_INTERP) - 1, 1);
    expect_error(CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, too_few), CEED_ERROR_DIMENSION,
                 {"Input/output vectors too short for basis and evaluation mode"});
    Basis no_derivative;
    const auto create = element.space == CEED_FE_SPACE_H1     ? CeedBasisCreateH1
                        : element.space == CEED_FE_SPACE_HDIV ? CeedBasisCreateHdiv
                                                              : CeedBasisCreateHcurl;
    ok(create(ceed, element.topology, 1, element.P, element.Q, element.interp.data(), nullptr, nullptr, nullptr,
              no_derivative.out()));
    ok(CeedBasisApply(no_derivative, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, nodes, points));
    expect_error(CeedBasisApply(no_derivative, 1, CEED_NOTRANSPOSE, element.derivative_mode(), nodes, points),
                 CEED_ERROR_UNSUPPORTED, {"made without a matrix", CeedEvalModes[element.derivative_mode()]});
  }
}

}  // namespace
}  // namespace hg::test
