// Assembled matrices of random operators against their action on unit vectors.
#include <cstdlib>
#include <memory>

#include "backends.hpp"
#include "oracle/instance.hpp"
#include "oracle/random_operator.hpp"

namespace {

using namespace hg::test;

/// Rounded terms in an entry: nodes by points by values.
constexpr CeedSize num_terms = 4000;

/// The seeds of the operators: each names one for ever.
const int num_seeds = num_cases(60);

class RandomAssembly : public BackendTest {
 protected:
  Layout layout;  ///< of the operator at hand

  /// Calls check(operator, matrix) for operators in one to three dimensions, at quadrature points and at points, alone
  /// and as sums.
  template <typename F>
  void for_operators(OperatorWishes wishes, F &&check) {
    for (int seed = 0; seed < num_seeds && !HasFailure(); seed++) {
      Random random(7000 + static_cast<std::uint64_t>(seed));
      wishes.dim = 1 + seed % 3;
      wishes.at_points = seed / 3 % 2 == 1;
      layout = random_layout(random, wishes);
      std::string description = "seed " + std::to_string(seed) + ", " + std::to_string(wishes.dim) + "D";
      std::deque<RandomOperator> parts;
      const CeedInt num_parts = random.chance(0.3) ? random.integer(2, 3) : 1;
      for (CeedInt i = 0; i < num_parts; i++) {
        // Operators at points and at quadrature points may stand in one sum.
        if (i > 0 && random.chance(0.5)) wishes.at_points = !wishes.at_points;
        description += wishes.at_points ? "; at points" : "; at quadrature points";
        description += parts.emplace_back(ceed, random, wishes, layout).description();
      }
      SCOPED_TRACE(description);
      if (num_parts == 1) {
        check(parts[0], dense_by_unit_vectors(ceed, parts[0]));
        continue;
      }
      Operator sum;
      ok(CeedOperatorCreateComposite(ceed, sum.out()));
      for (const RandomOperator &part : parts) ok(CeedOperatorCompositeAddSub(sum, part));
      check(sum, dense_by_unit_vectors(ceed, sum));
    }
  }
};

TEST_P(RandomAssembly, GivesTheMatrix) {
  for_operators({}, [&](CeedOperator op, const Values &want) {
    CeedSize in = 0, out = 0;
    ok(CeedOperatorGetActiveVectorLengths(op, &in, &out));
    expect_close(dense_from_coordinates(op, ceed, out, in), want, tolerance(num_terms), "matrix");
  });
}

TEST_P(RandomAssembly, GivesTheDiagonal) {
  for_operators({.is_square = true}, [&](CeedOperator op, const Values &matrix) {
    CeedSize n = 0;
    ok(CeedOperatorGetActiveVectorLengths(op, &n, nullptr));
    Values want(n);
    for (CeedSize i = 0; i < n; i++) want[i] = matrix[i * n + i];
    const Vector diagonal = make_vector(ceed, n, 1e30);
    ok(CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
    expect_close(values_of(diagonal), want, tolerance(num_terms), "diagonal", max_norm(matrix));
    ok(CeedOperatorLinearAssembleAddDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE));
    for (CeedScalar &value : want) value *= 2;
    expect_close(values_of(diagonal), want, tolerance(num_terms), "added diagonal", max_norm(matrix));
  });
}

/// Node by node, row-major.
TEST_P(RandomAssembly, GivesThePointBlockDiagonal) {
  for_operators({.has_point_blocks = true}, [&](CeedOperator op, const Values &matrix) {
    CeedSize n = 0, num_entries = 0;
    ok(CeedOperatorGetActiveVectorLengths(op, &n, nullptr));
    CeedInt *rows = nullptr, *cols = nullptr;
    ok(CeedOperatorLinearAssemblePointBlockDiagonalSymbolic(op, &num_entries, &rows, &cols));
    const std::unique_ptr<CeedInt, decltype(&std::free)> own_rows(rows, std::free), own_cols(cols, std::free);
    const auto num_comp = static_cast<CeedInt>(num_entries / n);
    ASSERT_EQ(num_comp, layout.num_comp);
    ASSERT_EQ(num_entries, n * num_comp);
    Values want(num_entries);
    CeedSize num_used = 0;
    for (CeedSize i = 0; i < num_entries; i++) {
      const CeedSize node = i / (num_comp * num_comp);
      const auto place = [&](CeedSize c) {
        return layout.comp_stride == 1 ? node * num_comp + c : node + c * n / num_comp;
      };
      const CeedSize row = place(i / num_comp % num_comp), col = place(i % num_comp);
      want[i] = matrix[row * n + col];
      const bool is_unused = rows[i] == 0 && cols[i] == 0;
      if (!is_unused) {
        EXPECT_EQ(rows[i], row) << "entry " << i;
        EXPECT_EQ(cols[i], col) << "entry " << i;
        num_used++;
      } else if (row != 0 || col != 0) {
        EXPECT_EQ(want[i], 0) << "entry " << i;
      }
    }
    EXPECT_GT(num_used, 0);
    const Vector blocks = make_vector(ceed, num_entries, 1e30);
    ok(CeedOperatorLinearAssemblePointBlockDiagonal(op, blocks, CEED_REQUEST_IMMEDIATE));
    expect_close(values_of(blocks), want, tolerance(num_terms), "point blocks", max_norm(matrix));
    ok(CeedOperatorLinearAssembleAddPointBlockDiagonal(op, blocks, CEED_REQUEST_IMMEDIATE));
    for (CeedScalar &value : want) value *= 2;
    expect_close(values_of(blocks), want, tolerance(num_terms), "added point blocks", max_norm(matrix));
  });
}

INSTANTIATE_TEST_SUITE_P(Backends, RandomAssembly, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
