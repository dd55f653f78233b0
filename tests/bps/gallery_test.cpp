/// @file
/// The gallery QFunctions, asked for by name, against their formulas on random input.
#include <ceed.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace hg::test {
namespace {

constexpr CeedInt Q = 24;

struct FieldFacts {
  std::string name;
  CeedInt size;
  CeedEvalMode mode;
  bool operator==(const FieldFacts &) const = default;
};

/// Values of all inputs at one point, in; of the output at that point, out.
using Formula = std::function<std::vector<double>(const std::vector<std::vector<double>> &)>;

struct GalleryCase {
  std::string name;
  std::vector<FieldFacts> inputs;
  FieldFacts output;
  Formula formula;
  CeedInt num_comp = 0;  ///< not 0: a QFunction whose fields the caller adds, with this as its context

  friend void PrintTo(const GalleryCase &which, std::ostream *stream) { *stream << which.name; }
};

using Matrix = std::array<std::array<double, 3>, 3>;

/// J_cd = ∂x_c/∂X_d, padded with the identity to 3×3: its determinant and inverse are those of the block.
Matrix jacobian(const std::vector<double> &dx, int dim) {
  Matrix J{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int d = 0; d < dim; d++)
    for (int c = 0; c < dim; c++) J[c][d] = dx[c + dim * d];
  return J;
}

double determinant(const Matrix &J) {
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum += J[0][i] * (J[1][j] * J[2][k] - J[1][k] * J[2][j]);
  }
  return sum;
}

/// By Cramer's rule, entry by entry: column c of J replaced by the unit vector.
Matrix inverse(const Matrix &J) {
  Matrix result{};
  const double det = determinant(J);
  for (int d = 0; d < 3; d++)
    for (int c = 0; c < 3; c++) {
      Matrix replaced = J;
      for (int row = 0; row < 3; row++) replaced[row][d] = row == c;
      result[d][c] = determinant(replaced) / det;
    }
  return result;
}

/// Positions of the packed entries of a symmetric tensor.
std::vector<std::array<int, 2>> packing(int dim) {
  if (dim == 1) return {{0, 0}};
  if (dim == 2) return {{0, 0}, {1, 1}, {0, 1}};
  return {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
}

GalleryCase mass_build(int dim) {
  return {"Mass" + std::to_string(dim) + "DBuild",
          {{"dx", dim * dim, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}},
          {"qdata", 1, CEED_EVAL_NONE},
          [dim](const auto &in) { return std::vector{in[1][0] * determinant(jacobian(in[0], dim))}; }};
}

GalleryCase mass_apply(int num_comp) {
  return {num_comp == 1 ? "MassApply" : "Vector3MassApply",
          {{"u", num_comp, CEED_EVAL_INTERP}, {"qdata", 1, CEED_EVAL_NONE}},
          {"v", num_comp, CEED_EVAL_INTERP},
          [](const auto &in) {
            std::vector<double> v;
            for (double u : in[0]) v.push_back(in[1][0] * u);
            return v;
          }};
}

/// K = w det J J⁻¹ J⁻ᵀ
GalleryCase poisson_build(int dim) {
  return {"Poisson" + std::to_string(dim) + "DBuild",
          {{"dx", dim * dim, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}},
          {"qdata", dim * (dim + 1) / 2, CEED_EVAL_NONE},
          [dim](const auto &in) {
            const Matrix J = jacobian(in[0], dim), dXdx = inverse(J);
            std::vector<double> packed;
            for (const auto &[d, e] : packing(dim)) {
              double sum = 0;
              for (int c = 0; c < dim; c++) sum += dXdx[d][c] * dXdx[e][c];
              packed.push_back(in[1][0] * determinant(J) * sum);
            }
            return packed;
          }};
}

GalleryCase poisson_apply(int dim, int num_comp) {
  return {std::string(num_comp == 1 ? "" : "Vector3") + "Poisson" + std::to_string(dim) + "DApply",
          {{"du", num_comp * dim, CEED_EVAL_GRAD}, {"qdata", dim * (dim + 1) / 2, CEED_EVAL_NONE}},
          {"dv", num_comp * dim, CEED_EVAL_GRAD},
          [dim, num_comp](const auto &in) {
            Matrix K{};
            const auto places = packing(dim);
            for (std::size_t i = 0; i < places.size(); i++) {
              const auto &[d, e] = places[i];
              K[d][e] = K[e][d] = in[1][i];
            }
            std::vector<double> dv(num_comp * dim);
            for (int d = 0; d < dim; d++)
              for (int e = 0; e < dim; e++)
                for (int c = 0; c < num_comp; c++) dv[c + num_comp * d] += K[d][e] * in[0][c + num_comp * e];
            return dv;
          }};
}

std::vector<GalleryCase> all_cases() {
  std::vector<GalleryCase> cases;
  for (int dim = 1; dim <= 3; dim++) {
    cases.push_back(mass_build(dim));
    cases.push_back(poisson_build(dim));
    cases.push_back(poisson_apply(dim, 1));
    cases.push_back(poisson_apply(dim, 3));
  }
  cases.push_back(mass_apply(1));
  cases.push_back(mass_apply(3));
  const FieldFacts u{"input", 3, CEED_EVAL_NONE}, v{"output", 3, CEED_EVAL_NONE};
  cases.push_back({"Identity", {u}, v, [](const auto &in) { return in[0]; }, 3});
  cases.push_back({"Identity to scalar",
                   {u},
                   {"output", 1, CEED_EVAL_NONE},
                   [](const auto &in) { return std::vector{in[0][0]}; },
                   3});
  cases.push_back({"Scale",
                   {u, {"scale", 3, CEED_EVAL_NONE}},
                   v,
                   [](const auto &in) {
                     return std::vector{in[0][0] * in[1][0], in[0][1] * in[1][1], in[0][2] * in[1][2]};
                   },
                   3});
  cases.push_back({"Scale (scalar)",
                   {u, {"scale", 1, CEED_EVAL_NONE}},
                   v,
                   [](const auto &in) {
                     return std::vector{in[0][0] * in[1][0], in[0][1] * in[1][0], in[0][2] * in[1][0]};
                   },
                   3});
  return cases;
}

class Gallery : public testing::TestWithParam<GalleryCase> {
 protected:
  void SetUp() override {
    ceed_ = CeedHandle(open(reference_resource));
    ok(CeedQFunctionCreateInteriorByName(ceed_, GetParam().name.c_str(), qfunction_.out()));
  }

  CeedHandle ceed_;
  QFunction qfunction_;
};

TEST_P(Gallery, HasTheFieldsOfTheInterface) {
  CeedInt num_inputs = 0, num_outputs = 0;
  CeedQFunctionField *inputs = nullptr, *outputs = nullptr;
  ok(CeedQFunctionGetFields(qfunction_, &num_inputs, &inputs, &num_outputs, &outputs));
  if (GetParam().num_comp > 0) {
    EXPECT_EQ(num_inputs + num_outputs, 0) << "its fields are the caller's";
    return;
  }
  const auto facts = [](CeedQFunctionField field) {
    const char *name = nullptr;
    FieldFacts result;
    ok(CeedQFunctionFieldGetData(field, &name, &result.size, &result.mode));
    result.name = name;
    return result;
  };
  ASSERT_EQ(num_inputs, static_cast<CeedInt>(GetParam().inputs.size()));
  ASSERT_EQ(num_outputs, 1);
  for (CeedInt i = 0; i < num_inputs; i++) EXPECT_EQ(facts(inputs[i]), GetParam().inputs[i]) << "input " << i;
  EXPECT_EQ(facts(outputs[0]), GetParam().output);
}

TEST_P(Gallery, ComputesItsFormula) {
  const GalleryCase &which = GetParam();
  if (which.num_comp > 0) {
    CeedInt num_comp = which.num_comp;
    Context context;
    ok(CeedQFunctionContextCreate(ceed_, context.out()));
    ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof num_comp, &num_comp));
    ok(CeedQFunctionSetContext(qfunction_, context));
    for (const auto &field : which.inputs)
      ok(CeedQFunctionAddInput(qfunction_, field.name.c_str(), field.size, field.mode));
    ok(CeedQFunctionAddOutput(qfunction_, which.output.name.c_str(), which.output.size, which.output.mode));
  }
  Random random(1);
  std::vector<Values> values;
  std::vector<Vector> vectors;
  std::vector<CeedVector> in(16), out(16);
  for (std::size_t i = 0; i < which.inputs.size(); i++) {
    values.push_back(random.reals(Q * which.inputs[i].size));
    // A Jacobian away from singular, of either orientation
    if (which.inputs[i].name == "dx") {
      const auto dim = static_cast<CeedInt>(std::lround(std::sqrt(which.inputs[i].size)));
      for (CeedInt d = 0; d < dim; d++)
        for (CeedInt q = 0; q < Q; q++) values[i][q + Q * d * (dim + 1)] += q % 2 == 0 ? 4 : -4;
    }
    vectors.push_back(make_vector(ceed_, values[i]));
    in[i] = vectors.back();
  }
  const Vector result = make_vector(ceed_, Q * which.output.size, 0.);
  out[0] = result;
  ok(CeedQFunctionApply(qfunction_, Q, in.data(), out.data()));

  Values want(Q * which.output.size);
  for (CeedInt q = 0; q < Q; q++) {
    std::vector<std::vector<double>> at_point(values.size());
    for (std::size_t i = 0; i < values.size(); i++)
      for (CeedInt c = 0; c < which.inputs[i].size; c++) at_point[i].push_back(values[i][q + Q * c]);
    const auto expected = which.formula(at_point);
    ASSERT_EQ(static_cast<CeedInt>(expected.size()), which.output.size);
    for (CeedInt c = 0; c < which.output.size; c++) want[q + Q * c] = expected[c];
  }
  EXPECT_GT(max_norm(want), 0.1);
  expect_close(values_of(result), want, tolerance(200), which.name);
}

INSTANTIATE_TEST_SUITE_P(AllNames, Gallery, testing::ValuesIn(all_cases()), [](const auto &info) {
  std::string name;
  for (char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
});

TEST(GalleryNames, AnUnknownNameIsAnError) {
  const CeedHandle ceed(open(reference_resource));
  QFunction qfunction;
  EXPECT_NE(CeedQFunctionCreateInteriorByName(ceed, "Mass4DBuild", qfunction.out()), CEED_ERROR_SUCCESS);
  EXPECT_NE(last_report().message.find("Mass4DBuild"), std::string::npos) << last_report().message;
}

}  // namespace
}  // namespace hg::test
