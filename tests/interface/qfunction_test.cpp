// QFunctions by themselves: the gallery against its formulas, and what a QFunction says of itself.
#include <ceed/backend.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace {

using namespace hg::test;

constexpr CeedInt Q = 7;

class QFunctionTest : public testing::Test {
 protected:
  QFunction named(const std::string &name) {
    QFunction qf;
    ok(CeedQFunctionCreateInteriorByName(ceed, name.c_str(), qf.out()));
    return qf;
  }
  /// The outputs of a QFunction of one output at Q points.
  Values apply(CeedQFunction qf, const std::vector<Values> &in, CeedInt out_size) {
    std::vector<Vector> held;
    std::vector<CeedVector> u;
    for (const Values &values : in) {
      held.push_back(make_vector(ceed, values));
      u.push_back(held.back());
    }
    const Vector out = make_vector(ceed, Q * out_size, 1e30);
    CeedVector v[] = {out};
    ok(CeedQFunctionApply(qf, Q, u.data(), v));
    return values_of(out);
  }

  const CeedHandle ceed{open(reference_resource)};
  Random random{31};
};

/// J_cd = ∂x_c/∂X_d at point q.
Values jacobian(const Values &dx, CeedInt dim, CeedInt q) {
  Values J(dim * dim);
  for (CeedInt c = 0; c < dim; c++) {
    for (CeedInt d = 0; d < dim; d++) J[c * dim + d] = dx[(d * dim + c) * Q + q];
  }
  return J;
}

/// det and inverse by Gauss-Jordan elimination.
CeedScalar invert(Values J, CeedInt n, Values &inverse) {
  inverse.assign(n * n, 0);
  for (CeedInt i = 0; i < n; i++) inverse[i * n + i] = 1;
  CeedScalar det = 1;
  for (CeedInt k = 0; k < n; k++) {
    CeedInt p = k;
    for (CeedInt i = k + 1; i < n; i++) p = std::abs(J[i * n + k]) > std::abs(J[p * n + k]) ? i : p;
    if (p != k) {
      det = -det;
      for (CeedInt j = 0; j < n; j++)
        std::swap(J[p * n + j], J[k * n + j]), std::swap(inverse[p * n + j], inverse[k * n + j]);
    }
    const CeedScalar pivot = J[k * n + k];
    det *= pivot;
    for (CeedInt j = 0; j < n; j++) J[k * n + j] /= pivot, inverse[k * n + j] /= pivot;
    for (CeedInt i = 0; i < n; i++) {
      if (i == k) continue;
      const CeedScalar factor = J[i * n + k];
      for (CeedInt j = 0; j < n; j++)
        J[i * n + j] -= factor * J[k * n + j], inverse[i * n + j] -= factor * inverse[k * n + j];
    }
  }
  return det;
}

/// Jacobians near the identity, so that none is singular.
Values jacobians(Random &random, CeedInt dim) {
  Values dx = random.reals(Q * dim * dim, -0.3, 0.3);
  for (CeedInt d = 0; d < dim; d++) {
    for (CeedInt q = 0; q < Q; q++) dx[(d * dim + d) * Q + q] += 1;
  }
  return dx;
}

/// Place of entry (d, e) of a packed symmetric matrix: the diagonal, then 01 in 2D, and 12, 02, 01 in 3D.
CeedInt packed(CeedInt dim, CeedInt d, CeedInt e) {
  if (d == e) return d;
  return dim == 2 ? 2 : 6 - d - e;
}

/// w det J.
TEST_F(QFunctionTest, MassBuild) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const Values dx = jacobians(random, dim), w = random.reals(Q, 0.1, 1);
    Values want, inverse;
    for (CeedInt q = 0; q < Q; q++) want.push_back(w[q] * invert(jacobian(dx, dim, q), dim, inverse));
    const QFunction qf = named("Mass" + std::to_string(dim) + "DBuild");
    expect_close(apply(qf, {dx, w}, 1), want, tolerance(20), "w det J");
  }
}

/// w det J J⁻¹ J⁻ᵀ.
TEST_F(QFunctionTest, PoissonBuild) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    const CeedInt size = dim * (dim + 1) / 2;
    const Values dx = jacobians(random, dim), w = random.reals(Q, 0.1, 1);
    Values want(Q * size), inverse;
    for (CeedInt q = 0; q < Q; q++) {
      const CeedScalar det = invert(jacobian(dx, dim, q), dim, inverse);
      for (CeedInt d = 0; d < dim; d++) {
        for (CeedInt e = d; e < dim; e++) {
          CeedScalar sum = 0;
          for (CeedInt k = 0; k < dim; k++) sum += inverse[d * dim + k] * inverse[e * dim + k];
          want[packed(dim, d, e) * Q + q] = w[q] * det * sum;
        }
      }
    }
    const QFunction qf = named("Poisson" + std::to_string(dim) + "DBuild");
    expect_close(apply(qf, {dx, w}, size), want, tolerance(100), "w det J J⁻¹ J⁻ᵀ");
  }
}

TEST_F(QFunctionTest, MassApply) {
  for (const CeedInt num_comp : {1, 3}) {
    const Values u = random.reals(Q * num_comp), stored = random.reals(Q);
    Values want(u.size());
    for (CeedInt i = 0; i < Q * num_comp; i++) want[i] = stored[i % Q] * u[i];
    expect_close(apply(named(num_comp == 1 ? "MassApply" : "Vector3MassApply"), {u, stored}, num_comp), want,
                 tolerance(1), "q u");
  }
}

TEST_F(QFunctionTest, PoissonApply) {
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (const CeedInt num_comp : {1, 3}) {
      const Values du = random.reals(Q * num_comp * dim), stored = random.reals(Q * dim * (dim + 1) / 2);
      Values want(du.size(), 0);
      for (CeedInt q = 0; q < Q; q++) {
        for (CeedInt c = 0; c < num_comp; c++) {
          for (CeedInt d = 0; d < dim; d++) {
            for (CeedInt e = 0; e < dim; e++) {
              want[(d * num_comp + c) * Q + q] += stored[packed(dim, d, e) * Q + q] * du[(e * num_comp + c) * Q + q];
            }
          }
        }
      }
      const std::string name = (num_comp == 3 ? "Vector3Poisson" : "Poisson") + std::to_string(dim) + "DApply";
      expect_close(apply(named(name), {du, stored}, num_comp * dim), want, tolerance(6), name);
    }
  }
}

/// The fields of those without fixed ones are the caller's, and their size is counted.
TEST_F(QFunctionTest, IdentityAndScaleOfAnySize) {
  const CeedInt n = 5;
  const Values u = random.reals(Q * n), s = random.reals(Q * n), t = random.reals(Q);
  const auto with_fields = [&](const char *name, CeedInt scale_size, CeedInt out_size) {
    QFunction qf = named(name);
    ok(CeedQFunctionAddInput(qf, "input", n, CEED_EVAL_NONE));
    if (scale_size > 0) ok(CeedQFunctionAddInput(qf, "scale", scale_size, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf, "output", out_size, CEED_EVAL_NONE));
    return qf;
  };
  Values scaled(u.size()), scaled_by_one(u.size());
  for (CeedInt i = 0; i < Q * n; i++) scaled[i] = s[i] * u[i], scaled_by_one[i] = t[i % Q] * u[i];
  expect_close(apply(with_fields("Identity", 0, n), {u}, n), u, 0, "identity");
  expect_close(apply(with_fields("Identity to scalar", 0, 1), {u}, 1), Values(u.begin(), u.begin() + Q), 0, "first");
  expect_close(apply(with_fields("Scale", n, n), {u, s}, n), scaled, tolerance(1), "scale");
  expect_close(apply(with_fields("Scale (scalar)", 1, n), {u, t}, n), scaled_by_one, tolerance(1), "scalar scale");
}

TEST_F(QFunctionTest, IdentityIsKnownAsSuch) {
  QFunction qf;
  ok(CeedQFunctionCreateIdentity(ceed, 3, CEED_EVAL_INTERP, CEED_EVAL_NONE, qf.out()));
  bool is_identity = false;
  ok(CeedQFunctionIsIdentity(qf, &is_identity));
  EXPECT_TRUE(is_identity);
  CeedInt num_in = 0, num_out = 0, size = 0;
  CeedQFunctionField *in = nullptr, *out = nullptr;
  ok(CeedQFunctionGetFields(qf, &num_in, &in, &num_out, &out));
  ASSERT_EQ(num_in, 1);
  ASSERT_EQ(num_out, 1);
  const char *name = nullptr;
  CeedEvalMode mode;
  ok(CeedQFunctionFieldGetData(in[0], &name, &size, &mode));
  EXPECT_STREQ(name, "input");
  EXPECT_EQ(size, 3);
  EXPECT_EQ(mode, CEED_EVAL_INTERP);
  ok(CeedQFunctionFieldGetEvalMode(out[0], &mode));
  EXPECT_EQ(mode, CEED_EVAL_NONE);
  ok(CeedQFunctionIsIdentity(named("MassApply"), &is_identity));
  EXPECT_FALSE(is_identity);
}

/// All names of the interface are there, each with its fields.
TEST_F(QFunctionTest, GalleryIsComplete) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> gallery = {
      {"Mass1DBuild", {"dx", "weights", "qdata"}},
      {"Mass2DBuild", {"dx", "weights", "qdata"}},
      {"Mass3DBuild", {"dx", "weights", "qdata"}},
      {"MassApply", {"u", "qdata", "v"}},
      {"Vector3MassApply", {"u", "qdata", "v"}},
      {"Poisson1DBuild", {"dx", "weights", "qdata"}},
      {"Poisson2DBuild", {"dx", "weights", "qdata"}},
      {"Poisson3DBuild", {"dx", "weights", "qdata"}},
      {"Poisson1DApply", {"du", "qdata", "dv"}},
      {"Poisson2DApply", {"du", "qdata", "dv"}},
      {"Poisson3DApply", {"du", "qdata", "dv"}},
      {"Vector3Poisson1DApply", {"du", "qdata", "dv"}},
      {"Vector3Poisson2DApply", {"du", "qdata", "dv"}},
      {"Vector3Poisson3DApply", {"du", "qdata", "dv"}},
      {"Identity", {}},
      {"Identity to scalar", {}},
      {"Scale", {}},
      {"Scale (scalar)", {}},
  };
  for (const auto &[name, fields] : gallery) {
    const QFunction qf = named(name);
    CeedInt num_in = 0, num_out = 0;
    CeedQFunctionField *in = nullptr, *out = nullptr;
    ok(CeedQFunctionGetFields(qf, &num_in, &in, &num_out, &out));
    std::vector<std::string> got;
    const char *text = nullptr;
    for (CeedInt i = 0; i < num_in; i++) ok(CeedQFunctionFieldGetName(in[i], &text)), got.emplace_back(text);
    for (CeedInt i = 0; i < num_out; i++) ok(CeedQFunctionFieldGetName(out[i], &text)), got.emplace_back(text);
    EXPECT_EQ(got, fields) << name;
    ok(CeedQFunctionGetName(qf, &text));
    EXPECT_EQ(text, name);
  }
}

int doubled(void *ctx, const CeedInt num_points, const CeedScalar *const *in, CeedScalar *const *out) {
  CeedInt *calls = static_cast<CeedInt *>(ctx);
  if (calls != nullptr) ++*calls;
  for (CeedInt q = 0; q < num_points; q++) out[0][q] = 2 * in[0][q];
  return 0;
}

TEST_F(QFunctionTest, TellsWhatItWasMadeFrom) {
  QFunction qf;
  ok(CeedQFunctionCreateInterior(ceed, 4, doubled, "/some/where/doubled.h:doubled", qf.out()));
  const char *text = nullptr;
  ok(CeedQFunctionGetKernelName(qf, &text));
  EXPECT_STREQ(text, "doubled");
  ok(CeedQFunctionGetSourcePath(qf, &text));
  EXPECT_STREQ(text, "/some/where/doubled.h");
  CeedInt vec_length = 0;
  ok(CeedQFunctionGetVectorLength(qf, &vec_length));
  EXPECT_EQ(vec_length, 4);
  CeedQFunctionUser function = nullptr;
  ok(CeedQFunctionGetUserFunction(qf, &function));
  EXPECT_EQ(function, doubled);
  bool is_immutable = true, is_writable = false;
  ok(CeedQFunctionIsImmutable(qf, &is_immutable));
  EXPECT_FALSE(is_immutable);
  ok(CeedQFunctionIsContextWritable(qf, &is_writable));
  EXPECT_TRUE(is_writable);
  CeedSize flops = 0;
  ok(CeedQFunctionSetUserFlopsEstimate(qf, 12));
  ok(CeedQFunctionGetFlopsEstimate(qf, &flops));
  EXPECT_EQ(flops, 12);
  EXPECT_GT(CeedQFunctionSetUserFlopsEstimate(qf, -1), 0);
  EXPECT_GT(CeedQFunctionCreateInterior(ceed, 0, doubled, "x:doubled", qf.out()), 0);
}

/// The context is lent to the function, to read or to write as was promised, and given back.
TEST_F(QFunctionTest, LendsItsContext) {
  QFunction qf;
  ok(CeedQFunctionCreateInterior(ceed, 1, doubled, "doubled.h:doubled", qf.out()));
  ok(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_NONE));
  ok(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_NONE));
  Context context;
  CeedInt calls = 0;
  ok(CeedQFunctionContextCreate(ceed, context.out()));
  ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_USE_POINTER, sizeof calls, &calls));
  ok(CeedQFunctionSetContext(qf, context));
  const Values u = random.reals(Q);
  Values want = u;
  for (CeedScalar &value : want) value *= 2;
  expect_close(apply(qf, {u}, 1), want, 0, "2 u");
  apply(qf, {u}, 1);
  CeedInt *data = nullptr;
  ok(CeedQFunctionContextGetData(context, CEED_MEM_HOST, &data));  // nobody holds it any more
  EXPECT_EQ(*data, 2);
  // While somebody does, the function cannot have it.
  const Vector in = make_vector(ceed, u), out = make_vector(ceed, u);
  CeedVector ins[] = {in}, outs[] = {out};
  EXPECT_NE(CeedQFunctionApply(qf, Q, ins, outs), 0);
  ok(CeedQFunctionContextRestoreData(context, &data));
  ok(CeedQFunctionApply(qf, Q, ins, outs));
  EXPECT_EQ(calls, 3);
}

TEST_F(QFunctionTest, PrintsItself) {
  const QFunction qf = named("MassApply");
  const std::string text = printed([&](FILE *stream) { ok(CeedQFunctionView(qf, stream)); });
  EXPECT_EQ(text,
            "Gallery CeedQFunction - MassApply\n"
            "  2 input fields:\n"
            "    Input field 0:\n"
            "      Name: \"u\"\n"
            "      Size: 1\n"
            "      EvalMode: \"interpolation\"\n"
            "    Input field 1:\n"
            "      Name: \"qdata\"\n"
            "      Size: 1\n"
            "      EvalMode: \"none\"\n"
            "  1 output field:\n"
            "    Output field 0:\n"
            "      Name: \"v\"\n"
            "      Size: 1\n"
            "      EvalMode: \"interpolation\"\n");
}

}  // namespace
