// Several threads on one Ceed: each makes, applies, assembles and destroys operators of its own, on objects of its own or on
// shared ones. What is wrong here is seen best under the thread sanitizer.
#include <future>
#include <optional>

#include "backends.hpp"
#include "oracle/instance.hpp"

namespace {

using namespace hg::test;

constexpr int num_threads = 4;

class ThreadsTest : public BackendTest {
 protected:
  /// Calls `work(t)` in `num_threads` threads at once; what one throws is thrown here.
  template <typename F>
  static void in_threads(F &&work) {
    std::vector<std::future<void>> running;
    for (int t = 0; t < num_threads; t++) running.push_back(std::async(std::launch::async, work, t));
    for (std::future<void> &thread : running) thread.get();
  }

  /// One operator through its life.
  static void use(const Instance &instance, const Case &c, Random &random) {
    const CeedScalar tol = tolerance(num_terms(c));
    const Values in = random.reals(c.input_size());
    expect_close(apply(instance, c, in), apply(c, in).active, tol, "active output");
    const Values want = matrix(c);
    expect_close(dense_from_coordinates(instance.op, instance.ceed, c.output_size(), c.input_size()), want, tol,
                 "assembled matrix");
    Values diagonal;
    for (CeedSize i = 0; i < c.input_size(); i++) diagonal.push_back(want[i * c.input_size() + i]);
    const Vector assembled = make_vector(instance.ceed, c.input_size(), 1e30);
    ok(CeedOperatorLinearAssembleDiagonal(instance.op, assembled, CEED_REQUEST_IMMEDIATE));
    expect_close(values_of(assembled), diagonal, tol, "assembled diagonal", max_norm(want));
  }

  static std::vector<CaseWishes> kinds() {
    return {{.is_square = true, .max_comp = 2},
            {.at_points = true, .is_square = true, .max_comp = 2},
            {.is_square = true, .max_comp = 2, .mixes_spaces = true}};
  }
};

TEST_P(ThreadsTest, HaveOperatorsOfTheirOwn) {
  in_threads([&](int t) {
    const int pair = t / 2;  // two threads want the same compiled at the same time, and others something else
    for (int seed = 0; seed < num_cases(8); seed++) {
      for (const CaseWishes &wishes : kinds()) {
        Random random(7000 + static_cast<std::uint64_t>(100 * seed + pair));
        const Case c = random_case(random, wishes);
        use(Instance(ceed, c), c, random);
      }
    }
  });
}

TEST_P(ThreadsTest, MayShareWhatOperatorsOnlyRead) {
  for (int seed = 0; seed < num_cases(8); seed++) {
    for (const CaseWishes &wishes : kinds()) {
      Random random(8000 + static_cast<std::uint64_t>(seed));
      const Case c = random_case(random, wishes);
      SCOPED_TRACE(describe(c));
      const Instance first(ceed, c);
      in_threads([&](int t) {
        Random mine(9000 + static_cast<std::uint64_t>(100 * seed + t));
        use(Instance(first, c), c, mine);
      });
      use(first, c, random);
    }
  }
}

/// The last reference may be dropped by any thread.
TEST_P(ThreadsTest, MayDestroyWhatOthersMade) {
  Random random(9999);
  const Case c = random_case(random, {.is_square = true, .max_comp = 2});
  std::vector<std::optional<Instance>> instances(num_threads);
  instances[0].emplace(ceed, c);
  for (int t = 1; t < num_threads; t++) instances[t].emplace(*instances[0], c);
  in_threads([&](int t) {
    Random mine(10 + static_cast<std::uint64_t>(t));
    use(*instances[t], c, mine);
    instances[t].reset();
  });
}

INSTANTIATE_TEST_SUITE_P(Backends, ThreadsTest, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
