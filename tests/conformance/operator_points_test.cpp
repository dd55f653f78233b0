// Operators at points: where points are quadrature points they are quadrature operators; points move; materials are
// updated at points.
#include <cmath>
#include <numeric>

#include "backends.hpp"
#include "oracle/affine_operator.hpp"
#include "oracle/instance.hpp"
#include "qfunctions/mass_at_points.h"
#include "qfunctions/update_state.h"

namespace {

using namespace hg::test;

class PointsTest : public BackendTest {};

/// Starts and numbers of points, numbered element by element: what CeedElemRestrictionCreateAtPoints takes.
std::vector<CeedInt> point_list(const std::vector<CeedInt> &counts) {
  std::vector<CeedInt> list(1, static_cast<CeedInt>(counts.size()) + 1);
  for (const CeedInt count : counts) list.push_back(list.back() + count);
  const CeedInt total = std::accumulate(counts.begin(), counts.end(), 0);
  for (CeedInt i = 0; i < total; i++) list.push_back(i);
  return list;
}

Restriction at_points(Ceed ceed, const std::vector<CeedInt> &counts, CeedInt num_comp) {
  const std::vector<CeedInt> list = point_list(counts);
  const CeedInt total = std::accumulate(counts.begin(), counts.end(), 0);
  Restriction rstr;
  ok(CeedElemRestrictionCreateAtPoints(ceed, static_cast<CeedInt>(counts.size()), total, num_comp,
                                       static_cast<CeedSize>(total) * num_comp, CEED_MEM_HOST, CEED_COPY_VALUES,
                                       list.data(), rstr.out()));
  return rstr;
}

/// The mass operator v = q u with stored q at points.
struct MassAtPoints {
  MassAtPoints(Ceed ceed_, const Box &mesh, CeedInt num_comp, CeedInt Q_1d, const std::vector<CeedInt> &counts,
               const Values &x, const Values &q)
      : ceed(ceed_), num_comp_(num_comp), dim(mesh.dim) {
    rstr = mesh.restriction(ceed, num_comp);
    ok(CeedBasisCreateTensorH1Lagrange(ceed, dim, num_comp, mesh.P_1d, Q_1d, CEED_GAUSS, basis.out()));
    ok(CeedQFunctionCreateInterior(ceed, 1, mass_at_points, mass_at_points_loc, qf.out()));
    ok(CeedQFunctionAddInput(qf, "u", num_comp, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf, "q", 1, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "v", num_comp, CEED_EVAL_INTERP));
    ok(CeedQFunctionContextCreate(ceed, context.out()));
    ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof num_comp_, &num_comp_));
    ok(CeedQFunctionSetContext(qf, context));
    ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
    ok(CeedOperatorSetField(op, "u", rstr, basis, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op, "v", rstr, basis, CEED_VECTOR_ACTIVE));
    move_to(counts, x, q);
  }
  /// New points, perhaps others than before.
  void move_to(const std::vector<CeedInt> &counts, const Values &x, const Values &q) {
    rstr_x = at_points(ceed, counts, dim);
    rstr_q = at_points(ceed, counts, 1);
    coordinates = make_vector(ceed, x);
    stored = make_vector(ceed, q);
    ok(CeedOperatorAtPointsSetPoints(op, rstr_x, coordinates));
    ok(CeedOperatorSetField(op, "q", rstr_q, CEED_BASIS_NONE, stored));
  }
  Ceed ceed;
  CeedInt num_comp_, dim;
  Restriction rstr, rstr_x, rstr_q;
  Basis basis;
  Vector coordinates, stored;
  Context context;
  QFunction qf;
  Operator op;
};

/// Gauss points of the reference element, x fastest: coordinates (direction fastest) and weights.
void gauss_points(CeedInt dim, CeedInt Q_1d, Values &x, Values &w) {
  Values x_1d(Q_1d), w_1d(Q_1d);
  ok(CeedGaussQuadrature(Q_1d, x_1d.data(), w_1d.data()));
  for (CeedInt q = 0; q < CeedIntPow(Q_1d, dim); q++) {
    CeedScalar product = 1;
    for (CeedInt d = 0, rest = q; d < dim; d++, rest /= Q_1d) {
      x.push_back(x_1d[rest % Q_1d]);
      product *= w_1d[rest % Q_1d];
    }
    w.push_back(product);
  }
}

/// Points that are the quadrature points, with the weights stored: the same numbers as the quadrature operator, 1e-12.
TEST_P(PointsTest, AtQuadraturePointsIsTheQuadratureOperator) {
  Random random(21);
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (CeedInt P_1d = 2; P_1d <= (dim == 3 ? 4 : 6); P_1d++) {
      for (const CeedInt num_comp : {1, 3}) {
        SCOPED_TRACE(std::to_string(dim) + "D, P_1d " + std::to_string(P_1d) + ", " + std::to_string(num_comp) +
                     " components");
        const Box mesh(dim, 2, P_1d);
        const CeedInt Q_1d = P_1d + 1, Q = CeedIntPow(Q_1d, dim);
        Values x_element, w_element, x, w;
        gauss_points(dim, Q_1d, x_element, w_element);
        for (CeedInt e = 0; e < mesh.num_elem; e++) {
          x.insert(x.end(), x_element.begin(), x_element.end());
          w.insert(w.end(), w_element.begin(), w_element.end());
        }
        const MassAtPoints op(ceed, mesh, num_comp, Q_1d, std::vector<CeedInt>(mesh.num_elem, Q), x, w);

        // The same by quadrature.
        Restriction rstr_q;
        Operator quadrature;
        const Vector stored = make_vector(ceed, w);
        ok(CeedElemRestrictionCreateStrided(ceed, mesh.num_elem, Q, 1, static_cast<CeedSize>(mesh.num_elem) * Q,
                                            std::vector<CeedInt>{1, Q, Q}.data(), rstr_q.out()));
        ok(CeedOperatorCreate(ceed, op.qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, quadrature.out()));
        ok(CeedOperatorSetField(quadrature, "u", op.rstr, op.basis, CEED_VECTOR_ACTIVE));
        ok(CeedOperatorSetField(quadrature, "q", rstr_q, CEED_BASIS_NONE, stored));
        ok(CeedOperatorSetField(quadrature, "v", op.rstr, op.basis, CEED_VECTOR_ACTIVE));

        const CeedSize n = static_cast<CeedSize>(mesh.num_nodes) * num_comp;
        const Values u = random.reals(n);
        expect_close(apply_to(ceed, op.op, u), apply_to(ceed, quadrature, u), 1e-12, "action");
        const Vector a = make_vector(ceed, n, 0), b = make_vector(ceed, n, 0);
        ok(CeedOperatorLinearAssembleDiagonal(op.op, a, CEED_REQUEST_IMMEDIATE));
        ok(CeedOperatorLinearAssembleDiagonal(quadrature, b, CEED_REQUEST_IMMEDIATE));
        expect_close(values_of(a), values_of(b), 1e-12, "diagonal");
        if (n > 200) continue;
        expect_close(dense_from_coordinates(op.op, ceed, n, n), dense_from_coordinates(quadrature, ceed, n, n), 1e-12,
                     "matrix");
      }
    }
  }
}

/// Σ_p m_p u(x_p) for a polynomial u of the space, wherever the points are.
TEST_P(PointsTest, SumsPolynomialsExactly) {
  Random random(22);
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const CeedInt P_1d = 4;
    const Box mesh(dim, 1, P_1d, [](const Values &unit) {
      Values x = unit;
      for (CeedScalar &value : x) value = 2 * value - 1;  // the reference element itself
      return x;
    });
    const CeedInt count = 13;
    const Values x = random.reals(count * dim), mass = random.reals(count, 0, 1);
    const MassAtPoints op(ceed, mesh, 1, P_1d, {count}, x, mass);
    const auto polynomial = [&](const CeedScalar *point) {
      CeedScalar value = 1;
      for (CeedInt d = 0; d < dim; d++) value *= 1 + point[d] - 2 * std::pow(point[d], P_1d - 1) * (d + 1);
      return value;
    };
    Values u(mesh.num_nodes);
    for (CeedInt i = 0; i < mesh.num_nodes; i++) {
      Values node(dim);
      for (CeedInt d = 0; d < dim; d++) node[d] = mesh.coordinates[d * mesh.num_nodes + i];
      u[i] = polynomial(node.data());
    }
    CeedScalar want = 0;
    for (CeedInt p = 0; p < count; p++) want += mass[p] * polynomial(&x[p * dim]);
    const Values ones(mesh.num_nodes, 1);
    const Values got = {dot(ones, apply_to(ceed, op.op, u))}, expected = {want};
    expect_close(got, expected, 1e-12, "sum over points", 10);
  }
}

/// Points may be given again, with other places and other counts, and the operator is that of the new points.
TEST_P(PointsTest, FollowsMovingPoints) {
  Random random(23);
  const Box mesh(2, 2, 3);
  std::vector<std::vector<CeedInt>> counts = {{3, 1, 4, 2}, {3, 1, 4, 2}, {0, 9, 0, 1}, {1, 1, 1, 1}, {12, 0, 7, 5}};
  const auto sample = [&](const std::vector<CeedInt> &c, CeedInt comp) {
    return random.reals(static_cast<CeedSize>(std::accumulate(c.begin(), c.end(), 0)) * comp);
  };
  MassAtPoints moving(ceed, mesh, 2, 3, counts[0], sample(counts[0], 2), sample(counts[0], 1));
  const CeedSize n = static_cast<CeedSize>(mesh.num_nodes) * 2;
  for (std::size_t step = 0; step < counts.size(); step++) {
    SCOPED_TRACE("step " + std::to_string(step));
    const Values x = sample(counts[step], 2), q = sample(counts[step], 1), u = random.reals(n);
    moving.move_to(counts[step], x, q);
    const MassAtPoints fresh(ceed, mesh, 2, 3, counts[step], x, q);
    const CeedScalar tol = tolerance(200);
    expect_close(apply_to(ceed, moving.op, u), apply_to(ceed, fresh.op, u), tol, "action");
    const Vector a = make_vector(ceed, n, 0), b = make_vector(ceed, n, 0);
    ok(CeedOperatorLinearAssembleDiagonal(moving.op, a, CEED_REQUEST_IMMEDIATE));
    ok(CeedOperatorLinearAssembleDiagonal(fresh.op, b, CEED_REQUEST_IMMEDIATE));
    expect_close(values_of(a), values_of(b), tol, "diagonal");
    expect_close(dense_from_coordinates(moving.op, ceed, n, n), dense_from_coordinates(fresh.op, ceed, n, n), tol,
                 "matrix");
    CeedInt most = 0;
    ok(CeedOperatorGetNumQuadraturePoints(moving.op, &most));
    EXPECT_EQ(most, *std::max_element(counts[step].begin(), counts[step].end()));
  }
}

/// New coordinates in the vector that the operator already has count as well.
TEST_P(PointsTest, ReadsTheCoordinatesAtEachApplication) {
  Random random(24);
  const Box mesh(2, 2, 3);
  const std::vector<CeedInt> counts = {2, 3, 0, 5};
  const Values q = random.reals(10), u = random.reals(mesh.num_nodes), old_x = random.reals(20);
  const MassAtPoints op(ceed, mesh, 1, 3, counts, old_x, q);
  const Values before = apply_to(ceed, op.op, u);
  const Values x = random.reals(20);
  set_values(op.coordinates, x);
  const MassAtPoints fresh(ceed, mesh, 1, 3, counts, x, q);
  const Values after = apply_to(ceed, op.op, u);
  expect_close(after, apply_to(ceed, fresh.op, u), tolerance(100), "action");
  EXPECT_GT(max_difference(after, before), 1e-3);
}

TEST_P(PointsTest, WorksWithoutAnyPoint) {
  const Box mesh(2, 2, 2);
  const MassAtPoints op(ceed, mesh, 1, 3, {0, 0, 0, 0}, {}, {});
  const Values u(mesh.num_nodes, 1), zeros(mesh.num_nodes, 0);
  EXPECT_EQ(apply_to(ceed, op.op, u), zeros);
  const Vector v = make_vector(ceed, mesh.num_nodes, 1);
  ok(CeedOperatorLinearAssembleDiagonal(op.op, v, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(v), zeros);
}

/// One point in one of many elements.
TEST_P(PointsTest, WorksWithOnePoint) {
  const Box mesh(1, 3, 2);
  const MassAtPoints op(ceed, mesh, 1, 2, {0, 1, 0}, {0.5}, {2});
  // N = (1/4, 3/4) at x = 1/2, in the second element.
  const Values u = {0, 1, 2, 0}, want = {0, 2 * 0.25 * 1.75, 2 * 0.75 * 1.75, 0};
  expect_close(apply_to(ceed, op.op, u), want, tolerance(4), "action");
}

/// An operator is the sum of those of its elements, whatever the numbers of points side by side: even and uneven ones,
/// elements without points between them, and more elements than a block has.
TEST_P(PointsTest, AddsUpOverElements) {
  Random random(27);
  const Box mesh(2, 5, 3);
  const auto counts_by = [&](auto count) {
    std::vector<CeedInt> counts;
    for (CeedInt e = 0; e < mesh.num_elem; e++) counts.push_back(count(e));
    return counts;
  };
  const std::vector<std::vector<CeedInt>> all = {
      counts_by([](CeedInt) { return 1; }),
      counts_by([](CeedInt) { return 8; }),
      counts_by([](CeedInt) { return 27; }),
      counts_by([](CeedInt e) { return 6 + e % 3; }),
      counts_by([](CeedInt e) { return e % 5 == 0 ? 0 : 9 + e % 2; }),
      counts_by([](CeedInt e) { return e % 7 == 3 ? 70 : e % 4; }),
  };
  const CeedInt num_comp = 2;
  const CeedSize n = static_cast<CeedSize>(mesh.num_nodes) * num_comp;
  MassAtPoints moving(ceed, mesh, num_comp, 3, counts_by([](CeedInt) { return 0; }), {}, {});
  for (const auto &counts : all) {
    SCOPED_TRACE("counts " + std::to_string(counts[0]) + ", " + std::to_string(counts[1]) + ", ...");
    const CeedInt total = std::accumulate(counts.begin(), counts.end(), 0);
    const Values x = random.reals(2 * total), q = random.reals(total), u = random.reals(n);
    Values sum(n, 0);
    for (CeedInt e = 0, first = 0; e < mesh.num_elem; first += counts[e++]) {
      std::vector<CeedInt> alone(counts.size(), 0);
      alone[e] = counts[e];
      const auto part = [&](const Values &values, CeedInt comp) {
        return Values(values.begin() + first * comp, values.begin() + (first + counts[e]) * comp);
      };
      moving.move_to(alone, part(x, 2), part(q, 1));
      const Values of_element = apply_to(ceed, moving.op, u);
      for (CeedSize i = 0; i < n; i++) sum[i] += of_element[i];
    }
    moving.move_to(counts, x, q);
    expect_close(apply_to(ceed, moving.op, u), sum, tolerance(400), "action");
  }
}

/// The state of points, NONE to NONE, with a gradient from the mesh: as a material is updated. The passive output may
/// be read by the next operator.
void expect_updated_state(Ceed ceed, CeedInt num_elem_1d, const std::vector<CeedInt> &counts) {
  Random random(25);
  const CeedInt dim = 2;
  const Box mesh(dim, num_elem_1d, 3);
  const CeedInt total = std::accumulate(counts.begin(), counts.end(), 0);
  const Values x = random.reals(total * dim), state = random.reals(total * 4);
  const Restriction rstr_u = mesh.restriction(ceed, dim), rstr_x = at_points(ceed, counts, dim);
  const Restriction rstr_state = at_points(ceed, counts, 4), rstr_trace = at_points(ceed, counts, 1);
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, dim, dim, mesh.P_1d, 4, CEED_GAUSS, basis.out()));
  const Vector points = make_vector(ceed, x), old_state = make_vector(ceed, state);
  const Vector new_state = make_vector(ceed, total * 4, 1e30), trace = make_vector(ceed, total, 1e30);
  QFunction qf;
  ok(CeedQFunctionCreateInterior(ceed, 1, update_state, update_state_loc, qf.out()));
  ok(CeedQFunctionAddInput(qf, "du", dim * dim, CEED_EVAL_GRAD));
  ok(CeedQFunctionAddInput(qf, "F", 4, CEED_EVAL_NONE));
  ok(CeedQFunctionAddOutput(qf, "F new", 4, CEED_EVAL_NONE));
  ok(CeedQFunctionAddOutput(qf, "trace", 1, CEED_EVAL_NONE));
  Operator op;
  ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "du", rstr_u, basis, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "F", rstr_state, CEED_BASIS_NONE, old_state));
  ok(CeedOperatorSetField(op, "F new", rstr_state, CEED_BASIS_NONE, new_state));
  ok(CeedOperatorSetField(op, "trace", rstr_trace, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorAtPointsSetPoints(op, rstr_x, points));

  // u = A X in each element's own reference coordinates is no function of the mesh; take u_c = Σ_d A_cd X_d with X the
  // mesh coordinates, whose gradient in reference coordinates is A h / 2 everywhere.
  const Values A = random.reals(4);
  Values u(static_cast<std::size_t>(mesh.num_nodes) * dim, 0);
  for (CeedInt c = 0; c < dim; c++) {
    for (CeedInt d = 0; d < dim; d++) {
      for (CeedInt i = 0; i < mesh.num_nodes; i++) {
        u[c * mesh.num_nodes + i] += A[c * dim + d] * mesh.coordinates[d * mesh.num_nodes + i];
      }
    }
  }
  const CeedScalar half_h = 0.5 / num_elem_1d;
  const Vector in = make_vector(ceed, u);
  for (int repeat = 0; repeat < 2; repeat++) {
    ok(CeedOperatorApply(op, in, trace, CEED_REQUEST_IMMEDIATE));
    Values want, want_trace;
    for (CeedInt p = 0; p < total; p++) {
      CeedScalar sum = 0;
      for (CeedInt c = 0; c < dim; c++) {
        for (CeedInt d = 0; d < dim; d++) {
          // F_new = (1 + ∇u) F
          CeedScalar value = state[p * 4 + c * dim + d];
          for (CeedInt k = 0; k < dim; k++) value += half_h * A[c * dim + k] * state[p * 4 + k * dim + d];
          want.push_back(value);
          if (c == d) sum += value;
        }
      }
      want_trace.push_back(sum);
    }
    expect_close(values_of(new_state), want, tolerance(20), "new state");
    expect_close(values_of(trace), want_trace, tolerance(20), "trace");
    expect_close(values_of(old_state), state, 0, "old state");
  }
}

TEST_P(PointsTest, UpdatesTheStateOfPoints) {
  expect_updated_state(ceed, 2, {3, 0, 6, 1});
  expect_updated_state(ceed, 3, {7, 8, 8, 7, 0, 8, 6, 8, 5});
  expect_updated_state(ceed, 3, {31, 0, 0, 2, 40, 1, 0, 3, 5});
}

/// Diagonal and matrix against unit vectors, for an operator of several components and modes.
TEST_P(PointsTest, AssemblesWhatUnitVectorsGive) {
  for (int seed = 0; seed < 6; seed++) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(2600 + static_cast<std::uint64_t>(seed));
    const Case c = random_case(random, {.dim = 1 + seed % 3, .at_points = true, .is_square = true, .max_comp = 2});
    SCOPED_TRACE(describe(c));
    const Instance instance(ceed, c);
    const CeedSize n = c.input_size();
    Values columns(n * n), diagonal(n);
    for (CeedSize j = 0; j < n; j++) {
      Values unit(n, 0);
      unit[j] = 1;
      const Values column = apply_to(ceed, instance.op, unit);
      for (CeedSize i = 0; i < n; i++) columns[i * n + j] = column[i];
      diagonal[j] = column[j];
    }
    const CeedScalar tol = tolerance(num_terms(c));
    const Vector assembled = make_vector(ceed, n, 0);
    ok(CeedOperatorLinearAssembleDiagonal(instance.op, assembled, CEED_REQUEST_IMMEDIATE));
    expect_close(values_of(assembled), diagonal, tol, "diagonal", max_norm(columns));
    expect_close(dense_from_coordinates(instance.op, ceed, n, n), columns, tol, "matrix");
  }
}

TEST_P(PointsTest, GivesItsPointsBack) {
  const Box mesh(1, 2, 2);
  const MassAtPoints op(ceed, mesh, 1, 2, {1, 2}, {0, 0.5, -0.5}, {1, 1, 1});
  bool is_at_points = false;
  ok(CeedOperatorIsAtPoints(op.op, &is_at_points));
  EXPECT_TRUE(is_at_points);
  CeedElemRestriction rstr = nullptr;
  CeedVector points = nullptr;
  ok(CeedOperatorAtPointsGetPoints(op.op, &rstr, &points));
  const Restriction held_rstr(rstr);
  const Vector held_points(points);
  EXPECT_EQ(rstr, op.rstr_x.get());
  EXPECT_EQ(points, op.coordinates.get());
}

INSTANTIATE_TEST_SUITE_P(Backends, PointsTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
