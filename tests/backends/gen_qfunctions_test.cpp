// QFunctions that are compiled: what they may be written in, what becomes of their loops, and which points they see.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <sstream>

#include "gen_workshop.hpp"
#include "qfunctions/soften.h"

namespace {

using namespace hg::test;

class GenQFunctions : public Workshop {
 protected:
  static constexpr const char *resource = compiled_resource;

  bool is_gcc() const { return run(real_compiler() + " --version").out.find("clang") == std::string::npos; }
};

const Values soft{1.2, 0.5};

Results softened(const char *on) {
  const CeedHandle ceed{open(on)};
  Results results;
  for (const CeedInt dim : {1, 2, 3}) {
    for (const bool at_points : {false, true}) {
      Model model(ceed, {.dim = dim, .num_elem = 13, .at_points = at_points}, {soften, soften_loc}, soft);
      Random random(7900);
      if (at_points) model.place_points({3, 0, 8, 16, 1, 17, 5, 9, 24, 2, 0, 0, 7}, random);
      results.push_back(model.apply());
    }
  }
  return results;
}

/// Branches, functions of the C library, functions in another file, a context.
TEST_F(GenQFunctions, MayBranchAndCallFunctions) {
  const Results want = softened(reference_resource);
  const Ran ran = in_process(environment({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}), [] { return softened(resource); });
  ASSERT_EQ(ran.failure, "");
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(num_made(), 6);
  ASSERT_EQ(ran.results.size(), want.size());
  for (std::size_t i = 0; i < want.size(); i++) expect_close(ran.results[i], want[i], 1e-12, "result");
  // Both branches are taken: without the limit, and with nothing but it, other numbers come out.
  for (const CeedScalar limit : {1e-3, 1e3}) {
    const CeedHandle ceed{open(reference_resource)};
    const Model model(ceed, {.dim = 2, .num_elem = 13}, {soften, soften_loc}, {limit, 0.5});
    EXPECT_GT(max_difference(model.apply(), want[2]), 1e-3);
  }
}

/// Whether a library calls log() for one number, where it could for several.
bool calls_scalar_log(const std::filesystem::path &library) {
  const Finished symbols = run("nm -D --undefined-only " + quoted(library));
  EXPECT_EQ(symbols.code, 0) << symbols.err;
  return symbols.out.find(" log@") != std::string::npos || symbols.out.find(" log\n") != std::string::npos;
}

#if defined(__x86_64__) && defined(__GLIBC_PREREQ)
#if __GLIBC_PREREQ(2, 35)
/// At points all of a QFunction's work is SIMD, however few points are left, and whatever functions it calls.
TEST_F(GenQFunctions, CallSimdFunctionsAtPoints) {
  if (!is_gcc()) GTEST_SKIP() << real_compiler() << " is not GCC";
  for (const char *isa : {"portable", "avx2", "avx512"}) {
    const std::filesystem::path cache = folder() / isa;
    const Environment own = environment({{"CEED_HOST_ISA", isa}, {"CEED_GEN_FLAGS", ""}, {"CEED_CACHE_DIR", cache}});
    const Ran ran = in_process(own, [&] {
      Ceed ceed = nullptr;
      ::setenv("CEED_ERROR_HANDLER", "return", 1);
      if (CeedInit(resource, &ceed) != CEED_ERROR_SUCCESS) return Results{};  // not on this machine
      const CeedHandle owner{ceed};
      Model model(ceed, {.dim = 3, .at_points = true}, {soften, soften_loc}, soft);
      Random random(7905);
      model.place_points({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 40}, random);
      return Results{model.apply()};
    });
    ASSERT_EQ(ran.failure, "");
    if (ran.results.empty()) {
      std::cout << "not on this machine: " << isa << '\n';
      continue;
    }
    int count = 0;
    for (const auto &found : std::filesystem::directory_iterator(cache)) {
      if (found.path().extension() != ".so") continue;
      count++;
      EXPECT_FALSE(calls_scalar_log(found.path())) << isa;
    }
    EXPECT_EQ(count, 1);
  }
}
#endif
#endif

/// The report leads to the loop in the user's file.
TEST_F(GenQFunctions, HaveTheirLoopsReported) {
  if (!is_gcc()) GTEST_SKIP() << real_compiler() << " is not GCC, whose words are expected here";
  const std::string location = soften_loc, file = location.substr(0, location.rfind(':'));
  std::istringstream lines(read_text(file));
  int line_of_loop = 0;
  std::string line;
  do line_of_loop++;
  while (std::getline(lines, line) && line.find("// the loop over points") == std::string::npos);
  const std::string place = file + ":" + std::to_string(line_of_loop) + ":";

  for (const bool at_points : {false, true}) {
    const auto work = [&] {
      const CeedHandle ceed{open(resource)};
      Model model(ceed, {.dim = 3, .at_points = at_points}, {soften, soften_loc}, soft);
      Random random(7901);
      if (at_points) model.place_points(std::vector<CeedInt>(11, 9), random);
      return Results{model.apply()};
    };
    const Environment reporting = environment({{"CEED_GEN_REPORT", "1"}, {"CEED_GEN_FLAGS", ""}});
    const Ran ran = in_process(reporting, work);
    ASSERT_EQ(ran.failure, "");
    EXPECT_NE(ran.err.find("'soften'"), std::string::npos) << ran.err;
    const auto at = ran.err.find(place);
    ASSERT_NE(at, std::string::npos) << place << " is not told of: " << ran.err;
    bool is_vectorized = false;
    std::istringstream said(ran.err);
    while (std::getline(said, line)) {
      is_vectorized = is_vectorized || (line.find(place) != std::string::npos &&
                                        line.find("optimized: loop vectorized") != std::string::npos);
    }
    EXPECT_TRUE(is_vectorized) << ran.err;
    // A second process has the same to tell, and compiles nothing for that.
    const int count = num_made();
    const Ran again = in_process(reporting, work);
    EXPECT_EQ(again.failure, "");
    EXPECT_EQ(again.err, ran.err);
    EXPECT_EQ(num_made(), count);
  }
}

/// What C allows: conversions of void pointers, restrict, arrays of variable length, designated initializers.
TEST_F(GenQFunctions, MayBeWrittenInC) {
  if (!is_gcc()) GTEST_SKIP() << real_compiler() << " converts no void pointers in C++";
  const Function function = write("plain.h", "plain", R"(#include <ceed.h>
#include <stdlib.h>

typedef struct {
  CeedScalar factor;
} PlainContext;

static inline CeedScalar times(const CeedScalar *restrict a, const CeedScalar b) { return *a * b; }

CEED_QFUNCTION(plain)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const PlainContext *context = ctx;
  const PlainContext copy = {.factor = context->factor};
  const CeedScalar(*u)[CEED_Q_VLA] = (const CeedScalar(*)[CEED_Q_VLA])in[0];
  const CeedScalar *restrict c = in[1];
  const CeedScalar *restrict w = in[2];
  CeedScalar *restrict v = out[0];
  CeedPragmaSIMD for (CeedInt i = 0; i < Q; i++) v[i] = w[i] * times(&copy.factor, u[0][i] * c[i]);
  return CEED_ERROR_SUCCESS;
}
)",
                                  scale<7>);
  const Values factor{-1.25};
  const auto work = [&](const char *on, const Function &of) {
    const CeedHandle ceed{open(on)};
    Model at_points(ceed, {.at_points = true}, of, factor);
    Random random(7902);
    at_points.place_points({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, random);
    return Results{Model(ceed, {}, of, factor).apply(), at_points.apply()};
  };
  const Results want = work(reference_resource, {scale<0>, ""});
  const Ran ran =
      in_process(environment({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}), [&] { return work(resource, function); });
  ASSERT_EQ(ran.failure, "");
  ASSERT_EQ(ran.results.size(), want.size());
  for (std::size_t i = 0; i < want.size(); i++) expect_close(ran.results[i], want[i], 1e-13, "result");
  EXPECT_EQ(num_made(), 2);
}

/// A context that is written to shows which points the QFunction saw: each once.
class GenCounts : public GenQFunctions {
 protected:
  void SetUp() override {
    function_ = write("count.h", "count", R"(#include <ceed/types.h>

CEED_QFUNCTION(count)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  CeedScalar *seen = (CeedScalar *)ctx;
  for (CeedInt q = 0; q < Q; q++) {
    seen[(int)in[3][q]] += 1;
    out[0][q] = in[2][q] * in[1][q] * in[0][q];
  }
  return 0;
}
)",
                      scale<7>);
  }
  Function function_{};
};

TEST_F(GenCounts, QuadraturePointsOnce) {
  constexpr CeedInt Q = 4, dim = 2, num_points = Q * Q;
  const auto work = [&] {
    const CeedHandle ceed{open(resource)};
    Results results;
    for (CeedInt num_elem = 1; num_elem <= 19; num_elem++) {
      const Model model(ceed, {.dim = dim, .num_elem = num_elem, .Q = Q}, function_,
                        Values(static_cast<std::size_t>(num_elem) * num_points, 0.0), true);
      for (int i = 0; i < 2; i++) results.push_back(model.apply());
      results.push_back(model.context_values());
    }
    return results;
  };
  const Ran ran = in_process(environment({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}), work);
  ASSERT_EQ(ran.failure, "");
  EXPECT_EQ(num_made(), 1);
  const CeedHandle ceed{open(reference_resource)};
  for (std::size_t i = 0; i < 19; i++) {
    const auto num_elem = static_cast<CeedInt>(i) + 1;
    SCOPED_TRACE(std::to_string(num_elem) + " elements");
    const Values want = Model(ceed, {.dim = dim, .num_elem = num_elem, .Q = Q}, {scale<1>, ""}).apply();
    expect_close(ran.results.at(3 * i), want, 1e-13, "result");
    EXPECT_EQ(ran.results.at(3 * i + 1), ran.results.at(3 * i));
    EXPECT_EQ(ran.results.at(3 * i + 2), Values(static_cast<std::size_t>(num_elem) * num_points, 2.0))
        << "applications";
  }
}

TEST_F(GenCounts, PointsOnce) {
  std::vector<CeedInt> counts(40);
  std::iota(counts.begin(), counts.end(), 0);
  const auto total = static_cast<std::size_t>(std::accumulate(counts.begin(), counts.end(), 0));
  const Model::Shape shape{.dim = 2, .num_elem = 40, .at_points = true};
  const auto work = [&](const char *on, const Function &of, const Values &context) {
    const CeedHandle ceed{open(on)};
    Model model(ceed, shape, of, context, !context.empty());
    Random random(7903);
    model.place_points(counts, random);
    Results results{model.apply(), model.apply()};
    if (!context.empty()) results.push_back(model.context_values());
    return results;
  };
  const Ran ran = in_process(environment({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}),
                             [&] { return work(resource, function_, Values(total, 0.0)); });
  ASSERT_EQ(ran.failure, "");
  EXPECT_EQ(num_made(), 1);
  expect_close(ran.results.at(0), work(reference_resource, {scale<1>, ""}, {})[0], 1e-13, "result");
  EXPECT_EQ(ran.results.at(1), ran.results.at(0));
  EXPECT_EQ(ran.results.at(2), Values(total, 2.0)) << "applications that saw a point";
}

/// What a QFunction returns stops the application, with the QFunction's name and the elements; the next one is right.
TEST_F(GenQFunctions, MayFail) {
  const Function function = write("fail.h", "fail", R"(#include <ceed/types.h>

CEED_QFUNCTION(fail)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar failing = *(const CeedScalar *)ctx;
  for (CeedInt q = 0; q < Q; q++) {
    if (in[3][q] == failing) return 5;
    out[0][q] = in[2][q] * in[1][q] * in[0][q];
  }
  return 0;
}
)",
                                  scale<7>);
  constexpr CeedInt num_elem = 21, per_elem = 16;
  const auto work = [&](bool at_points) {
    const CeedHandle ceed{open(resource)};
    Model model(ceed, {.num_elem = num_elem, .at_points = at_points}, function, {-1.0});
    Random random(7904);
    if (at_points) model.place_points(std::vector<CeedInt>(num_elem, per_elem), random);
    const Vector in = make_vector(ceed, model.some_input()), out = make_vector(ceed, model.size(), 0.0);
    Results results{model.apply()};
    for (CeedInt e = 0; e < num_elem; e++) {
      model.set_context({static_cast<CeedScalar>(e * per_elem + e % per_elem)});
      const int code = CeedOperatorApply(model.op(), in, out, CEED_REQUEST_IMMEDIATE);
      int first = -1, last = -1;
      const std::string &message = last_report().message;
      const auto at = message.find("QFunction 'fail' returned 5 in the elements ");
      if (at != std::string::npos) std::sscanf(message.c_str() + at, "%*[^0-9]5%*[^0-9]%d to %d", &first, &last);
      forget_reports();
      model.set_context({-1.0});
      results.push_back({static_cast<CeedScalar>(code), static_cast<CeedScalar>(first), static_cast<CeedScalar>(last)});
      results.push_back(model.apply());
    }
    return results;
  };
  for (const bool at_points : {false, true}) {
    const Ran ran = in_process(environment({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}), [&] { return work(at_points); });
    ASSERT_EQ(ran.failure, "");
    ASSERT_EQ(ran.results.size(), std::size_t{2 * num_elem + 1});
    for (CeedInt e = 0; e < num_elem; e++) {
      SCOPED_TRACE("element " + std::to_string(e));
      const Values &told = ran.results[2 * e + 1];
      EXPECT_EQ(told[0], CEED_ERROR_BACKEND);
      EXPECT_GE(told[1], 0);
      EXPECT_LE(told[1], e);
      EXPECT_GE(told[2], e);
      EXPECT_LT(told[2], num_elem);
      EXPECT_EQ(ran.results[2 * e + 2], ran.results[0]) << "afterwards";
    }
  }
}

}  // namespace
