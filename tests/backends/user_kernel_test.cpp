// Kernels that a program has loaded itself, for QFunctions without text. The emulator takes a function of the host.
#include <ceed.h>
#include <ceed/cuda.h>
#include <ceed/hip.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

/// What such a kernel gets, by libCEED's interface.
struct Fields {
  const CeedScalar *inputs[16];
  CeedScalar *outputs[16];
};
using Kernel = void (*)(void *context, CeedInt Q, Fields fields);

/// v_c = factor a_0 u_c + c a_1 for three components, w = u_0 + u_1 + u_2
void combine(CeedScalar factor, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *a = in[1];
  CeedScalar *v = out[0], *w = out[1];
  for (CeedInt q = 0; q < Q; q++) {
    w[q] = u[q] + u[q + Q] + u[q + 2 * Q];
    for (CeedInt c = 0; c < 3; c++) v[q + c * Q] = factor * a[q] * u[q + c * Q] + c * a[q + Q];
  }
}
int on_host(void *context, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  combine(*static_cast<const CeedScalar *>(context), Q, in, out);
  return CEED_ERROR_SUCCESS;
}
int never(void *, CeedInt, const CeedScalar *const *, CeedScalar *const *) {
  return 1;
}
void kernel(void *context, CeedInt Q, Fields fields) {
  combine(*static_cast<const CeedScalar *>(context), Q, fields.inputs, fields.outputs);
}
void tenfold(void *context, CeedInt Q, Fields fields) {
  combine(10 * *static_cast<const CeedScalar *>(context), Q, fields.inputs, fields.outputs);
}
CUfunc_st *handle_of(Kernel function) {
  return reinterpret_cast<CUfunc_st *>(function);
}

/// An operator on a line, at quadrature points or at points, of which one element has none.
class Line {
 public:
  Line(Ceed ceed, bool at_points, CeedQFunctionUser function, CeedInt num_elem = 4)
      : ceed_(ceed), num_nodes_(2 * num_elem + 1) {
    std::vector<CeedInt> counts(num_elem, 4);
    if (at_points) counts = {3, 0, 5, 1};
    num_points_ = std::accumulate(counts.begin(), counts.end(), CeedInt{0});
    std::vector<CeedInt> places, ids;
    for (CeedInt e = 0; e < num_elem; e++) {
      for (CeedInt n = 0; n < 3; n++) places.push_back(3 * (2 * e + n));
    }
    CeedInt start = num_elem + 1;
    for (CeedInt count : counts) ids.push_back(std::exchange(start, start + count));
    ids.push_back(start);
    for (CeedInt i = 0; i < num_points_; i++) ids.push_back(i);
    ok(CeedElemRestrictionCreate(ceed, num_elem, 3, 3, 1, 3 * num_nodes_, CEED_MEM_HOST, CEED_COPY_VALUES,
                                 places.data(), nodes_.out()));
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 1, 3, 3, 4, CEED_GAUSS, basis_.out()));
    const auto stored = [&](CeedInt size, Restriction &rstr) {
      if (at_points) {
        ok(CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points_, size, num_points_ * size, CEED_MEM_HOST,
                                             CEED_COPY_VALUES, ids.data(), rstr.out()));
      } else {
        ok(CeedElemRestrictionCreateStrided(ceed, num_elem, 4, size, num_points_ * size, CEED_STRIDES_BACKEND,
                                            rstr.out()));
      }
    };
    stored(2, stored_);
    stored(1, sums_at_);
    Random random(3);
    data_ = make_vector(ceed, random.reals(2 * num_points_));
    sums_ = make_vector(ceed, num_points_, -1);
    Context context;
    ok(CeedQFunctionContextCreate(ceed, context.out()));
    CeedScalar factor = 2;
    ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof factor, &factor));
    ok(CeedQFunctionCreateInterior(ceed, 1, function, "", qf_.out()));
    ok(CeedQFunctionSetContext(qf_, context));
    ok(CeedQFunctionAddInput(qf_, "u", 3, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddInput(qf_, "a", 2, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf_, "v", 3, CEED_EVAL_INTERP));
    ok(CeedQFunctionAddOutput(qf_, "w", 1, CEED_EVAL_NONE));
    ok((at_points ? CeedOperatorCreateAtPoints : CeedOperatorCreate)(ceed, qf_, CEED_QFUNCTION_NONE,
                                                                     CEED_QFUNCTION_NONE, op_.out()));
    ok(CeedOperatorSetField(op_, "u", nodes_, basis_, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op_, "a", stored_, CEED_BASIS_NONE, data_));
    ok(CeedOperatorSetField(op_, "v", nodes_, basis_, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op_, "w", sums_at_, CEED_BASIS_NONE, sums_));
    if (!at_points) return;
    Values x = random.reals(num_points_);
    x_ = make_vector(ceed, x);
    ok(CeedOperatorAtPointsSetPoints(op_, sums_at_, x_));
  }
  CeedQFunction qf() const { return qf_; }
  /// What the active output is, and then the passive one.
  Values apply() const {
    Random random(4);
    const Vector in = make_vector(ceed_, random.reals(3 * num_nodes_)), out = make_vector(ceed_, 3 * num_nodes_, 1e30);
    ok(CeedOperatorApply(op_, in, out, CEED_REQUEST_IMMEDIATE));
    Values all = values_of(out);
    for (CeedScalar sum : values_of(sums_)) all.push_back(sum);
    return all;
  }

 private:
  Ceed ceed_;
  CeedInt num_nodes_, num_points_ = 0;
  Restriction nodes_, stored_, sums_at_;
  Basis basis_;
  Vector data_, sums_, x_;
  QFunction qf_;
  Operator op_;
};

/// A backend, and whether it is at points.
class UserKernel : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  const CeedHandle ceed{open(std::get<0>(GetParam()))}, host{open("/cpu/self/ref/serial")};
  const bool at_points = std::get<1>(GetParam());
};

TEST_P(UserKernel, IsCalledForAllPoints) {
  const Line line(ceed, at_points, never);
  ok(CeedQFunctionSetCUDAUserFunction(line.qf(), handle_of(kernel)));
  const Values want = Line(host, at_points, on_host).apply();
  for (int turn = 0; turn < 2; turn++) expect_close(line.apply(), want, 1e-13, "output");
}

TEST_P(UserKernel, MayBeGivenLateAndChanged) {
  const Line line(ceed, at_points, on_host);
  const Values by_host = line.apply();
  ok(CeedQFunctionSetHIPUserFunction(line.qf(), reinterpret_cast<ihipModuleSymbol_t *>(tenfold)));
  const Values by_tenfold = line.apply();
  ok(CeedQFunctionSetCUDAUserFunction(line.qf(), handle_of(kernel)));
  expect_close(line.apply(), by_host, 1e-13, "output");
  EXPECT_GT(max_norm(by_tenfold), 2 * max_norm(by_host));
}

/// What is copied for it at a time has an end.
TEST(UserKernels, AreCalledForAMillionPointsAtMost) {
  static CeedInt num_calls = 0, most = 0;
  const CeedHandle ceed{open("/gpu/emu/ref")}, host{open("/cpu/self/ref/serial")};
  constexpr CeedInt num_elem = (1 << 18) + 3;
  const Line line(ceed, false, never, num_elem);
  ok(CeedQFunctionSetCUDAUserFunction(line.qf(), handle_of([](void *context, CeedInt Q, Fields fields) {
                                        num_calls++;
                                        most = std::max(most, Q);
                                        kernel(context, Q, fields);
                                      })));
  expect_close(line.apply(), Line(host, false, on_host, num_elem).apply(), 1e-13, "output");
  EXPECT_EQ(num_calls, 2);
  EXPECT_EQ(most, 1 << 20);
}

INSTANTIATE_TEST_SUITE_P(Backends, UserKernel,
                         testing::Combine(testing::Values("/gpu/emu/ref", "/gpu/emu/gen:order=shuffled"),
                                          testing::Bool()),
                         [](const auto &info) {
                           return std::get<0>(info.param).substr(9, 3) +
                                  (std::get<1>(info.param) ? "Own" : "Quadrature");
                         });

TEST(UserKernels, AreAppliedAsTheyAre) {
  const CeedHandle ceed{open("/gpu/emu/ref")};
  const Line line(ceed, false, never);
  ok(CeedQFunctionSetCUDAUserFunction(line.qf(), handle_of(kernel)));
  constexpr CeedInt Q = 7;
  Random random(5);
  const Values u = random.reals(3 * Q), a = random.reals(2 * Q);
  Values v(3 * Q), w(Q);
  const std::array<const CeedScalar *, 2> in{u.data(), a.data()};
  const std::array<CeedScalar *, 2> out{v.data(), w.data()};
  combine(2, Q, in.data(), out.data());
  const Vector u_vec = make_vector(ceed, u), a_vec = make_vector(ceed, a), v_vec = make_vector(ceed, 3 * Q, 0),
               w_vec = make_vector(ceed, Q, 0);
  std::array<CeedVector, 2> inputs{u_vec, a_vec}, outputs{v_vec, w_vec};
  ok(CeedQFunctionApply(line.qf(), Q, inputs.data(), outputs.data()));
  expect_close(values_of(v_vec), v, 1e-14, "v");
  expect_close(values_of(w_vec), w, 1e-14, "w");
}

/// More fields than such kernels take: the C function serves.
TEST(UserKernels, HaveSixteenInputsAtMost) {
  const CeedHandle ceed{open("/gpu/emu/ref")};
  constexpr CeedInt num_inputs = 17;
  const CeedQFunctionUser sum = [](void *, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
    for (CeedInt q = 0; q < Q; q++) {
      out[0][q] = 0;
      for (CeedInt i = 0; i < num_inputs; i++) out[0][q] += in[i][q];
    }
    return static_cast<int>(CEED_ERROR_SUCCESS);
  };
  QFunction qf;
  ok(CeedQFunctionCreateInterior(ceed, 1, sum, "", qf.out()));
  for (CeedInt i = 0; i < num_inputs; i++) {
    ok(CeedQFunctionAddInput(qf, ("in" + std::to_string(i)).c_str(), 1, CEED_EVAL_NONE));
  }
  ok(CeedQFunctionAddOutput(qf, "out", 1, CEED_EVAL_NONE));
  ok(CeedQFunctionSetCUDAUserFunction(qf,
                                      handle_of([](void *, CeedInt, Fields) { ADD_FAILURE() << "it was called"; })));
  const Vector in = make_vector(ceed, 5, 2), out = make_vector(ceed, 5, 0);
  std::vector<CeedVector> inputs(num_inputs, in);
  CeedVector output = out;
  ok(CeedQFunctionApply(qf, 5, inputs.data(), &output));
  expect_close(values_of(out), Values(5, 34), 1e-14, "sum");
}

}  // namespace
