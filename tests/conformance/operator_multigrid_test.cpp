// Levels of p-multigrid: exact prolongation, restriction as its transpose, coarse operators as Galerkin products.
#include <cmath>
#include <deque>

#include "backends.hpp"
#include "oracle/blend_operator.hpp"
#include "oracle/box.hpp"

namespace {

using namespace hg::test;

/// The operators of a level.
struct Level {
  Operator coarse, prolong, restrict;
};

/// Ways to say how coarse nodes are interpolated to fine ones.
enum class Way { from_bases, from_1d, from_full };

/// A field on the nodes of a box, with the degree of its mesh.
struct Space {
  Space(Ceed ceed, const Box &mesh, CeedInt num_comp, CeedInt Q_1d) : rstr(mesh.restriction(ceed, num_comp)) {
    ok(CeedBasisCreateTensorH1Lagrange(ceed, mesh.dim, num_comp, mesh.P_1d, Q_1d, CEED_GAUSS, basis.out()));
  }
  Restriction rstr;
  Basis basis;
};

class MultigridTest : public BackendTest {
 protected:
  /// All values and derivatives of one space, coupled by random coefficients that differ from point to point; at
  /// `num_points` random points of each element, or at quadrature points if there are none.
  Operator make_operator(const Space &space, const Box &mesh, CeedInt num_comp, CeedInt Q_1d, CeedInt num_points) {
    const CeedInt Q = num_points > 0 ? num_points : CeedIntPow(Q_1d, mesh.dim), total = mesh.num_elem * Q;
    vectors.push_back(make_vector(ceed, random.reals(total)));
    const CeedVector coefficient = vectors.back();
    Restriction &stored = restrictions.emplace_back();
    BlendPoints points;
    if (num_points > 0) {
      std::vector<CeedInt> list;
      for (CeedInt e = 0; e <= mesh.num_elem; e++) list.push_back(mesh.num_elem + 1 + e * Q);
      for (CeedInt i = 0; i < total; i++) list.push_back(i);
      const auto at_points = [&](CeedInt size, Restriction &rstr) {
        ok(CeedElemRestrictionCreateAtPoints(ceed, mesh.num_elem, total, size, total * size, CEED_MEM_HOST,
                                             CEED_COPY_VALUES, list.data(), rstr.out()));
      };
      at_points(1, stored);
      at_points(mesh.dim, restrictions.emplace_back());
      vectors.push_back(make_vector(ceed, random.reals(total * mesh.dim)));
      points = {restrictions.back(), vectors.back()};
    } else {
      const CeedInt strides[3] = {1, Q, Q};
      ok(CeedElemRestrictionCreateStrided(ceed, mesh.num_elem, Q, 1, total, strides, stored.out()));
    }
    const std::vector<BlendField> active = {
        {CEED_EVAL_INTERP, num_comp, space.rstr, space.basis, CEED_VECTOR_ACTIVE},
        {CEED_EVAL_GRAD, num_comp * mesh.dim, space.rstr, space.basis, CEED_VECTOR_ACTIVE}};
    std::vector<BlendField> inputs = active;
    inputs.push_back({CEED_EVAL_NONE, 1, stored, CEED_BASIS_NONE, coefficient});
    return make_blend(ceed, random.integer(0, 1000), inputs, active, points);
  }

  Level make_level(CeedOperator fine, CeedVector p_mult, const Space &coarse, const Box &fine_mesh,
                   const Box &coarse_mesh, Way way) {
    Level level;
    Basis nodes;
    const CeedScalar *interp = nullptr;
    // Fine nodes are the Gauss-Lobatto points.
    ok(CeedBasisCreateTensorH1Lagrange(ceed, fine_mesh.dim, 1, coarse_mesh.P_1d, fine_mesh.P_1d, CEED_GAUSS_LOBATTO,
                                       nodes.out()));
    switch (way) {
      case Way::from_bases:
        ok(CeedOperatorMultigridLevelCreate(fine, p_mult, coarse.rstr, coarse.basis, level.coarse.out(),
                                            level.prolong.out(), level.restrict.out()));
        break;
      case Way::from_1d:
        ok(CeedBasisGetInterp1D(nodes, &interp));
        ok(CeedOperatorMultigridLevelCreateTensorH1(fine, p_mult, coarse.rstr, coarse.basis, interp, level.coarse.out(),
                                                    level.prolong.out(), level.restrict.out()));
        break;
      case Way::from_full:
        ok(CeedBasisGetInterp(nodes, &interp));
        ok(CeedOperatorMultigridLevelCreateH1(fine, p_mult, coarse.rstr, coarse.basis, interp, level.coarse.out(),
                                              level.prolong.out(), level.restrict.out()));
    }
    return level;
  }

  /// Expects coarse = Pᵀ fine P.
  void expect_galerkin(CeedOperator fine, const Level &level, CeedSize num_terms) {
    const Values a = dense_by_unit_vectors(ceed, fine), p = dense_by_unit_vectors(ceed, level.prolong),
                 got = dense_by_unit_vectors(ceed, level.coarse);
    CeedSize n = 0, m = 0;
    ok(CeedOperatorGetActiveVectorLengths(level.prolong, &m, &n));
    Values ap(n * m, 0), want(m * m, 0);
    for (CeedSize i = 0; i < n; i++) {
      for (CeedSize k = 0; k < n; k++) {
        for (CeedSize j = 0; j < m; j++) ap[i * m + j] += a[i * n + k] * p[k * m + j];
      }
    }
    for (CeedSize k = 0; k < n; k++) {
      for (CeedSize i = 0; i < m; i++) {
        for (CeedSize j = 0; j < m; j++) want[i * m + j] += p[k * m + i] * ap[k * m + j];
      }
    }
    expect_close(got, want, tolerance(num_terms), "coarse operator and Galerkin product", max_norm(a));
  }

  Random random{4711};
  std::deque<Vector> vectors;
  std::deque<Restriction> restrictions;
};

/// A polynomial of degree `degree` in each direction, different for each component, at the nodes of a box.
Values polynomial(const Box &mesh, CeedInt num_comp, CeedInt degree) {
  Values values;
  for (CeedInt c = 0; c < num_comp; c++) {
    for (CeedInt i = 0; i < mesh.num_nodes; i++) {
      CeedScalar product = 1;
      for (CeedInt d = 0; d < mesh.dim; d++) {
        product *= 1 + c + std::pow(mesh.coordinates[d * mesh.num_nodes + i] - 0.3 * d, degree);
      }
      values.push_back(product);
    }
  }
  return values;
}

TEST_P(MultigridTest, ProlongsPolynomialsExactly) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (CeedInt num_comp = 1; num_comp <= 3; num_comp++) {
      for (const Way way : {Way::from_bases, Way::from_1d, Way::from_full}) {
        for (const CeedInt num_points : {0, 3}) {
          const CeedInt P_coarse = 2 + num_comp % 2, P_fine = P_coarse + 1 + dim % 2, Q_1d = P_fine + 1;
          const Box coarse_mesh(dim, 2, P_coarse), fine_mesh(dim, 2, P_fine);
          const Space coarse(ceed, coarse_mesh, num_comp, Q_1d), fine(ceed, fine_mesh, num_comp, Q_1d);
          const Operator op = make_operator(fine, fine_mesh, num_comp, Q_1d, num_points);
          const Vector ones = make_vector(ceed, fine_mesh.num_nodes * num_comp, 1);
          const Level level = make_level(op, ones, coarse, fine_mesh, coarse_mesh, way);
          const Vector u = make_vector(ceed, polynomial(coarse_mesh, num_comp, P_coarse - 1)),
                       v = make_vector(ceed, fine_mesh.num_nodes * num_comp, 1e30);
          ok(CeedOperatorApply(level.prolong, u, v, CEED_REQUEST_IMMEDIATE));
          expect_close(values_of(v), polynomial(fine_mesh, num_comp, P_coarse - 1), tolerance(500), "polynomial");
        }
      }
    }
  }
}

TEST_P(MultigridTest, RestrictsByTheTranspose) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const CeedInt num_comp = dim;
    const Box coarse_mesh(dim, 2, 2), fine_mesh(dim, 2, 4);
    const Space coarse(ceed, coarse_mesh, num_comp, 5), fine(ceed, fine_mesh, num_comp, 5);
    const Operator op = make_operator(fine, fine_mesh, num_comp, 5, 0);
    // Any multiplicities, other ones for each component.
    const CeedSize n = fine_mesh.num_nodes * num_comp, m = coarse_mesh.num_nodes * num_comp;
    const Vector p_mult = make_vector(ceed, random.reals(n, 1, 4));
    const Level level = make_level(op, p_mult, coarse, fine_mesh, coarse_mesh, Way::from_bases);
    const auto apply = [&](CeedOperator which, CeedSize size) {
      return [this, which, size](const Values &in) {
        const Vector u = make_vector(ceed, in), v = make_vector(ceed, size, 1e30);
        ok(CeedOperatorApply(which, u, v, CEED_REQUEST_IMMEDIATE));
        return values_of(v);
      };
    };
    expect_adjoint(apply(level.prolong, n), apply(level.restrict, m), m, n, random, tolerance(1000), "restriction");
  }
}

/// The scale is that of each entry by itself; what is not shared by anyone stays zero.
TEST_P(MultigridTest, DividesByTheMultiplicity) {
  const CeedInt num_comp = 2;
  const Box coarse_mesh(2, 2, 2), fine_mesh(2, 2, 3);
  const Space coarse(ceed, coarse_mesh, num_comp, 4), fine(ceed, fine_mesh, num_comp, 4);
  const Operator op = make_operator(fine, fine_mesh, num_comp, 4, 0);
  Values multiplicity, want = polynomial(fine_mesh, num_comp, 1);
  for (std::size_t i = 0; i < want.size(); i++) {
    multiplicity.push_back(static_cast<CeedScalar>(i % 4));
    want[i] = i % 4 == 0 ? 0 : want[i] / static_cast<CeedScalar>(i % 4);
  }
  const Vector p_mult = make_vector(ceed, multiplicity);
  const Level level = make_level(op, p_mult, coarse, fine_mesh, coarse_mesh, Way::from_bases);
  const Vector u = make_vector(ceed, polynomial(coarse_mesh, num_comp, 1)), v = make_vector(ceed, want.size(), 1e30);
  ok(CeedOperatorApply(level.prolong, u, v, CEED_REQUEST_IMMEDIATE));
  expect_close(values_of(v), want, tolerance(100), "scaled prolongation");
  EXPECT_EQ(values_of(p_mult), multiplicity) << "the multiplicity is the caller's";
}

/// The coarse operator is Pᵀ A P, with any quadrature, as long as the fine space holds the coarse one.
TEST_P(MultigridTest, CoarseOperatorsAreGalerkinProducts) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (const CeedInt num_points : {0, 1, 5}) {
      for (const CeedInt num_comp : {1, 2}) {
        const CeedInt P_fine = dim == 3 ? 3 : 4, Q_1d = num_points > 0 ? P_fine : P_fine - 1 + num_comp;
        const Box coarse_mesh(dim, dim == 3 ? 1 : 2, 2, bent), fine_mesh(dim, dim == 3 ? 1 : 2, P_fine, bent);
        const Space coarse(ceed, coarse_mesh, num_comp, Q_1d), fine(ceed, fine_mesh, num_comp, Q_1d);
        const Operator op = make_operator(fine, fine_mesh, num_comp, Q_1d, num_points);
        const Vector ones = make_vector(ceed, fine_mesh.num_nodes * num_comp, 1);
        expect_galerkin(op, make_level(op, ones, coarse, fine_mesh, coarse_mesh, Way::from_bases), 4000);
      }
    }
  }
}

/// Several levels: the coarse operator of a level is the fine one of the next.
TEST_P(MultigridTest, LevelsFollowEachOther) {
  const CeedInt Q_1d = 5;
  Operator op;
  std::deque<Space> spaces;
  for (CeedInt P = 5; P >= 3; P--) {
    const Box fine_mesh(2, 2, P), coarse_mesh(2, 2, P - 1);
    if (spaces.empty()) {
      spaces.emplace_back(ceed, fine_mesh, 2, Q_1d);
      op = make_operator(spaces.back(), fine_mesh, 2, Q_1d, 0);
    }
    spaces.emplace_back(ceed, coarse_mesh, 2, Q_1d);
    const Vector ones = make_vector(ceed, fine_mesh.num_nodes * 2, 1);
    Level level = make_level(op, ones, spaces.back(), fine_mesh, coarse_mesh, Way::from_bases);
    expect_galerkin(op, level, 4000);
    op = std::move(level.coarse);
  }
}

TEST_P(MultigridTest, TakesCompositesOfOneSpace) {
  const CeedInt Q_1d = 4;
  const Box coarse_mesh(2, 2, 2), fine_mesh(2, 2, 4);
  const Space coarse(ceed, coarse_mesh, 1, Q_1d), fine(ceed, fine_mesh, 1, Q_1d);
  Operator sum, inner;
  ok(CeedOperatorCreateComposite(ceed, sum.out()));
  ok(CeedOperatorCreateComposite(ceed, inner.out()));
  ok(CeedOperatorSetName(sum, "sum"));
  const Operator a = make_operator(fine, fine_mesh, 1, Q_1d, 0), b = make_operator(fine, fine_mesh, 1, Q_1d, 4),
                 c = make_operator(fine, fine_mesh, 1, Q_1d, 0);
  ok(CeedOperatorCompositeAddSub(sum, a));
  ok(CeedOperatorCompositeAddSub(inner, b));
  ok(CeedOperatorCompositeAddSub(inner, c));
  ok(CeedOperatorCompositeAddSub(sum, inner));
  const Vector ones = make_vector(ceed, fine_mesh.num_nodes, 1);
  const Level level = make_level(sum, ones, coarse, fine_mesh, coarse_mesh, Way::from_1d);
  expect_galerkin(sum, level, 4000);
  bool is_composite = false;
  ok(CeedOperatorIsComposite(level.coarse, &is_composite));
  EXPECT_TRUE(is_composite);
  const char *name = nullptr;
  ok(CeedOperatorGetName(level.prolong, &name));
  EXPECT_STREQ(name, "prolongation for sum");
}

/// Sub-operators on parts of a mesh: levels of each, with the multiplicity of the composite, are composed.
TEST_P(MultigridTest, ComposesLevelsOfParts) {
  const CeedInt Q_1d = 4, num_comp = 2;
  const Box coarse_mesh(2, 3, 2), fine_mesh(2, 3, 3);
  const std::vector<std::pair<CeedInt, CeedInt>> parts = {{0, 4}, {4, 9}};
  std::deque<Restriction> fine_parts, coarse_parts;
  Basis fine_basis, coarse_basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 2, num_comp, 3, Q_1d, CEED_GAUSS, fine_basis.out()));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 2, num_comp, 2, Q_1d, CEED_GAUSS, coarse_basis.out()));
  Operator sum, coarse, prolong, restrict;
  for (Operator *op : {&sum, &coarse, &prolong, &restrict}) ok(CeedOperatorCreateComposite(ceed, op->out()));
  for (const auto &[first, last] : parts) {
    const auto part_of = [&, first = first, last = last](const Box &mesh, Restriction &rstr) {
      ok(CeedElemRestrictionCreate(ceed, last - first, mesh.elem_size, num_comp, mesh.num_nodes,
                                   static_cast<CeedSize>(mesh.num_nodes) * num_comp, CEED_MEM_HOST, CEED_COPY_VALUES,
                                   mesh.offsets.data() + first * mesh.elem_size, rstr.out()));
    };
    part_of(fine_mesh, fine_parts.emplace_back());
    part_of(coarse_mesh, coarse_parts.emplace_back());
    const std::vector<BlendField> active = {
        {CEED_EVAL_GRAD, 2 * num_comp, fine_parts.back(), fine_basis, CEED_VECTOR_ACTIVE}};
    ok(CeedOperatorCompositeAddSub(sum, make_blend(ceed, first, active, active)));
  }
  const Vector mult = make_vector(ceed, fine_mesh.num_nodes * num_comp, 0);
  ok(CeedOperatorCompositeGetMultiplicity(sum, 0, nullptr, mult));
  CeedOperator *subs = nullptr;
  ok(CeedOperatorCompositeGetSubList(sum, &subs));
  for (std::size_t i = 0; i < parts.size(); i++) {
    Level level;
    ok(CeedOperatorMultigridLevelCreate(subs[i], mult, coarse_parts[i], coarse_basis, level.coarse.out(),
                                        level.prolong.out(), level.restrict.out()));
    ok(CeedOperatorCompositeAddSub(coarse, level.coarse));
    ok(CeedOperatorCompositeAddSub(prolong, level.prolong));
    ok(CeedOperatorCompositeAddSub(restrict, level.restrict));
  }
  const Vector u = make_vector(ceed, polynomial(coarse_mesh, num_comp, 1)),
               v = make_vector(ceed, fine_mesh.num_nodes * num_comp, 1e30);
  ok(CeedOperatorApply(prolong, u, v, CEED_REQUEST_IMMEDIATE));
  expect_close(values_of(v), polynomial(fine_mesh, num_comp, 1), tolerance(100), "polynomial");
  const Values p = dense_by_unit_vectors(ceed, prolong), r = dense_by_unit_vectors(ceed, restrict);
  const CeedSize n = fine_mesh.num_nodes * num_comp, m = coarse_mesh.num_nodes * num_comp;
  Values transposed(p.size());
  for (CeedSize i = 0; i < n; i++) {
    for (CeedSize j = 0; j < m; j++) transposed[j * n + i] = p[i * m + j];
  }
  expect_close(r, transposed, tolerance(100), "transpose");
  // A composite as a whole has several active restrictions.
  CeedOperator none = nullptr;
  expect_error(CeedOperatorMultigridLevelCreate(sum, mult, coarse_parts[0], coarse_basis, &none, nullptr, nullptr),
               CEED_ERROR_INCOMPATIBLE, {"CeedOperatorCompositeGetMultiplicity"});
  EXPECT_EQ(none, nullptr);
}

/// Bases without tensor product, in all spaces, on oriented elements: the coarse functions are combinations of the fine
/// ones.
TEST_P(MultigridTest, TakesAllSpacesAndOrientations) {
  const CeedInt num_elem = 3, Q = 12, P_fine = 6, P_coarse = 3, num_comp = 2, dim = 3;
  for (const CeedFESpace fe_space : {CEED_FE_SPACE_H1, CEED_FE_SPACE_HDIV, CEED_FE_SPACE_HCURL}) {
    for (int orientation = 0; orientation < 3; orientation++) {
      const CeedInt num_values = fe_space == CEED_FE_SPACE_H1 ? 1 : dim,
                    num_derivatives = fe_space == CEED_FE_SPACE_HDIV ? 1 : dim;
      const Values combination = random.reals(P_fine * P_coarse), interp = random.reals(num_values * Q * P_fine),
                   derivative = random.reals(num_derivatives * Q * P_fine), weights = random.reals(Q, 0.1, 1);
      const auto combine = [&](const Values &of_fine) {
        Values of_coarse;
        for (std::size_t row = 0; row < of_fine.size(); row += P_fine) {
          for (CeedInt j = 0; j < P_coarse; j++) {
            of_coarse.push_back(0);
            for (CeedInt i = 0; i < P_fine; i++) of_coarse.back() += of_fine[row + i] * combination[i * P_coarse + j];
          }
        }
        return of_coarse;
      };
      const auto make_basis = [&](CeedInt P, const Values &values, const Values &derivatives, Basis &basis) {
        const auto create = fe_space == CEED_FE_SPACE_H1     ? CeedBasisCreateH1
                            : fe_space == CEED_FE_SPACE_HDIV ? CeedBasisCreateHdiv
                                                             : CeedBasisCreateHcurl;
        ok(create(ceed, CEED_TOPOLOGY_TET, num_comp, P, Q, values.data(), derivatives.data(), nullptr, weights.data(),
                  basis.out()));
      };
      Basis fine_basis, coarse_basis;
      make_basis(P_fine, interp, derivative, fine_basis);
      make_basis(P_coarse, combine(interp), combine(derivative), coarse_basis);
      // Each element has nodes of its own, so that every coarse function is a fine one.
      const auto make_rstr = [&](CeedInt P, Restriction &rstr) {
        const CeedInt count = num_elem * P, l_size = count * num_comp;
        const std::vector<CeedInt> offsets = random.distinct(count, count);
        const auto signs = std::make_unique<bool[]>(count);
        std::vector<CeedInt8> bands(3 * count, 0);
        for (CeedInt i = 0; i < count; i++) signs[i] = random.chance(0.5);
        // Pairs of nodes are exchanged, with signs.
        for (CeedInt i = 0; i < count; i++) {
          const bool is_exchanged = i % P / 2 % 2 == 0 && (i % P < P - 1 || P % 2 == 0);
          const CeedInt band = !is_exchanged ? 1 : i % P % 2 == 0 ? 2 : 0;
          bands[3 * i + band] = signs[i] ? -1 : 1;
        }
        if (orientation == 0) {
          ok(CeedElemRestrictionCreate(ceed, num_elem, P, num_comp, count, l_size, CEED_MEM_HOST, CEED_COPY_VALUES,
                                       offsets.data(), rstr.out()));
        } else if (orientation == 1) {
          ok(CeedElemRestrictionCreateOriented(ceed, num_elem, P, num_comp, count, l_size, CEED_MEM_HOST,
                                               CEED_COPY_VALUES, offsets.data(), signs.get(), rstr.out()));
        } else {
          ok(CeedElemRestrictionCreateCurlOriented(ceed, num_elem, P, num_comp, count, l_size, CEED_MEM_HOST,
                                                   CEED_COPY_VALUES, offsets.data(), bands.data(), rstr.out()));
        }
      };
      Restriction fine_rstr, coarse_rstr;
      make_rstr(P_fine, fine_rstr);
      make_rstr(P_coarse, coarse_rstr);
      const CeedEvalMode mode = fe_space == CEED_FE_SPACE_H1     ? CEED_EVAL_GRAD
                                : fe_space == CEED_FE_SPACE_HDIV ? CEED_EVAL_DIV
                                                                 : CEED_EVAL_CURL;
      const std::vector<BlendField> active = {
          {CEED_EVAL_INTERP, num_comp * num_values, fine_rstr, fine_basis, CEED_VECTOR_ACTIVE},
          {mode, num_comp * num_derivatives, fine_rstr, fine_basis, CEED_VECTOR_ACTIVE}};
      SCOPED_TRACE(std::string(CeedFESpaces[fe_space]) + ", orientation " + std::to_string(orientation));
      const Operator op = make_blend(ceed, random.integer(0, 1000), active, active);
      const Vector ones = make_vector(ceed, num_elem * P_fine * num_comp, 1);
      Level level;
      ok(CeedOperatorMultigridLevelCreate(op, ones, coarse_rstr, coarse_basis, level.coarse.out(), level.prolong.out(),
                                          level.restrict.out()));
      expect_galerkin(op, level, 10000);
      ok(CeedOperatorMultigridLevelCreateH1(op, ones, coarse_rstr, coarse_basis, combination.data(), level.coarse.out(),
                                            level.prolong.out(), level.restrict.out()));
      expect_galerkin(op, level, 10000);
    }
  }
}

/// An active output that is stored at the points stays where it is.
TEST_P(MultigridTest, KeepsFieldsWithoutBasis) {
  const CeedInt Q_1d = 4, Q = Q_1d * Q_1d;
  const Box coarse_mesh(2, 2, 2), fine_mesh(2, 2, 3);
  const Space coarse(ceed, coarse_mesh, 1, Q_1d), fine(ceed, fine_mesh, 1, Q_1d);
  Restriction stored;
  const CeedInt strides[3] = {1, Q, 2 * Q};
  ok(CeedElemRestrictionCreateStrided(ceed, fine_mesh.num_elem, Q, 2, fine_mesh.num_elem * Q * 2, strides,
                                      stored.out()));
  const Operator op = make_blend(ceed, 3, {{CEED_EVAL_GRAD, 2, fine.rstr, fine.basis, CEED_VECTOR_ACTIVE}},
                                 {{CEED_EVAL_NONE, 2, stored, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE}});
  const Vector ones = make_vector(ceed, fine_mesh.num_nodes, 1);
  const Level level = make_level(op, ones, coarse, fine_mesh, coarse_mesh, Way::from_bases);
  const auto apply = [&](CeedOperator which, const Values &in, CeedSize size) {
    const Vector u = make_vector(ceed, in), v = make_vector(ceed, size, 1e30);
    ok(CeedOperatorApply(which, u, v, CEED_REQUEST_IMMEDIATE));
    return values_of(v);
  };
  const Values u = random.reals(coarse_mesh.num_nodes);
  const CeedSize size = fine_mesh.num_elem * Q * 2;
  expect_close(apply(level.coarse, u, size), apply(op, apply(level.prolong, u, fine_mesh.num_nodes), size),
               tolerance(200), "values at points");
}

TEST_P(MultigridTest, MakesWhatIsAskedFor) {
  const Box coarse_mesh(1, 2, 2), fine_mesh(1, 2, 3);
  const Space coarse(ceed, coarse_mesh, 1, 4), fine(ceed, fine_mesh, 1, 4);
  const Operator op = make_operator(fine, fine_mesh, 1, 4, 0);
  Level level;
  ok(CeedOperatorMultigridLevelCreate(op, nullptr, coarse.rstr, coarse.basis, level.coarse.out(), nullptr, nullptr));
  EXPECT_NE(level.coarse.get(), nullptr);
  const Vector ones = make_vector(ceed, fine_mesh.num_nodes, 1);
  ok(CeedOperatorMultigridLevelCreate(op, ones, coarse.rstr, coarse.basis, nullptr, level.prolong.out(), nullptr));
  EXPECT_NE(level.prolong.get(), nullptr);
  ok(CeedOperatorMultigridLevelCreate(op, ones, coarse.rstr, coarse.basis, nullptr, nullptr, level.restrict.out()));
  const char *name = nullptr;
  ok(CeedOperatorGetName(level.restrict, &name));
  EXPECT_STREQ(name, "restriction");
}

TEST_P(MultigridTest, RefusesSpacesThatDoNotFit) {
  const Box coarse_mesh(2, 2, 2), fine_mesh(2, 2, 3), other_mesh(2, 3, 2);
  const Space fine(ceed, fine_mesh, 2, 4), coarse(ceed, coarse_mesh, 2, 4), other(ceed, other_mesh, 2, 4),
      scalar(ceed, coarse_mesh, 1, 4), quadrature(ceed, coarse_mesh, 2, 3);
  const Operator op = make_operator(fine, fine_mesh, 2, 4, 0);
  const CeedSize n = fine_mesh.num_nodes * 2;
  const Vector ones = make_vector(ceed, n, 1), few = make_vector(ceed, n - 1, 1);
  CeedOperator a = nullptr, b = nullptr, c = nullptr;
  const auto create = [&](CeedOperator fine_op, CeedVector p_mult, const Space &space) {
    return CeedOperatorMultigridLevelCreate(fine_op, p_mult, space.rstr, space.basis, &a, &b, &c);
  };
  expect_error(create(op, ones, other), CEED_ERROR_DIMENSION, {"number of elements", "9", "4"});
  expect_error(create(op, ones, scalar), CEED_ERROR_DIMENSION, {"components", "1", "2"});
  expect_error(create(op, ones, quadrature), CEED_ERROR_DIMENSION, {"quadrature points", "9", "16"});
  expect_error(create(op, nullptr, coarse), CEED_ERROR_INCOMPLETE, {"multiplicity"});
  expect_error(create(op, few, coarse), CEED_ERROR_DIMENSION, {"multiplicity", std::to_string(n)});
  EXPECT_EQ(create(nullptr, ones, coarse), CEED_ERROR_INCOMPLETE);
  expect_error(CeedOperatorMultigridLevelCreateTensorH1(op, ones, coarse.rstr, coarse.basis, nullptr, &a, &b, &c),
               CEED_ERROR_INCOMPLETE, {"interp_c_to_f"});
  expect_error(CeedOperatorMultigridLevelCreateH1(op, ones, coarse.rstr, coarse.basis, nullptr, &a, &b, &c),
               CEED_ERROR_INCOMPLETE, {"interp_c_to_f"});
  // Two active spaces.
  const Operator mixed = make_blend(ceed, 1, {{CEED_EVAL_INTERP, 2, fine.rstr, fine.basis, CEED_VECTOR_ACTIVE}},
                                    {{CEED_EVAL_INTERP, 2, coarse.rstr, coarse.basis, CEED_VECTOR_ACTIVE}});
  expect_error(create(mixed, ones, coarse), CEED_ERROR_INCOMPATIBLE, {"out0", "one space"});
  EXPECT_EQ(a, nullptr);
  EXPECT_EQ(b, nullptr);
  EXPECT_EQ(c, nullptr);
}

/// An orientation that its transpose does not undo.
TEST_P(MultigridTest, RefusesToProlongBySkewOrientations) {
  const CeedInt offsets[4] = {0, 1, 2, 3};
  const CeedInt8 bands[12] = {0, 1, 1, 0, 1, 0, 0, 1, 0, 0, 1, 0};
  Restriction rstr;
  ok(CeedElemRestrictionCreateCurlOriented(ceed, 2, 2, 1, 1, 4, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, bands,
                                           rstr.out()));
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 3, CEED_GAUSS, basis.out()));
  const std::vector<BlendField> active = {{CEED_EVAL_INTERP, 1, rstr, basis, CEED_VECTOR_ACTIVE}};
  const Operator op = make_blend(ceed, 5, active, active);
  const Vector ones = make_vector(ceed, 4, 1);
  CeedOperator prolong = nullptr;
  expect_error(CeedOperatorMultigridLevelCreate(op, ones, rstr, basis, nullptr, &prolong, nullptr),
               CEED_ERROR_UNSUPPORTED, {"element 0", "orthogonal"});
}

INSTANTIATE_TEST_SUITE_P(Backends, MultigridTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
