// Operators that are compiled at run time: what they compute, and when they are compiled anew.
#include <gtest/gtest.h>

#include "../conformance/oracle/instance.hpp"
#include "gen_workshop.hpp"

namespace {

using namespace hg::test;

constexpr const char *resource = compiled_resource;

class Gen : public Workshop {
 protected:
  /// Results of work(resource, function) with the function that scales by 3.
  template <typename Work>
  void expect_what_the_reference_gives(Work &&work, double tolerance) {
    write_factor(3);
    const Function function = write_scale();
    const Results want = work(reference_resource, {scale<3>, function.location});
    const Ran ran = in_process(environment(), [&] { return work(resource, function); });
    ASSERT_EQ(ran.failure, "");
    EXPECT_EQ(ran.err, "");
    ASSERT_EQ(ran.results.size(), want.size());
    for (std::size_t i = 0; i < want.size(); i++) expect_close(ran.results[i], want[i], tolerance, "result");
  }
};

/// Elements in a row: fewer than a block has, a full block and some more, ...
constexpr CeedInt some_numbers[] = {1, 11, 16};

std::vector<CeedInt> ragged(CeedInt num_elem, CeedInt shift) {
  std::vector<CeedInt> counts;
  for (CeedInt e = 0; e < num_elem; e++) counts.push_back((e * 7 + shift) % 23);
  return counts;
}

Case some_case(int seed, Values &in) {
  Random random(7500 + static_cast<std::uint64_t>(seed));
  const bool at_points = seed % 2 == 1;
  const Case c = random_case(random, {.dim = 1 + seed / 2 % 3,
                                      .at_points = at_points,
                                      .is_oriented = seed % 6 == 2,
                                      .mixes_spaces = !at_points && seed % 4 == 0,
                                      .has_many_elements = true});
  in = random.reals(c.input_size());
  return c;
}

/// Against the oracle; two applications, and two operators, give the same bits.
TEST_F(Gen, ComputesWhatOperatorsAreByDefinition) {
  const int num = num_cases(12);
  const Ran ran = in_process(environment({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}), [&] {
    const CeedHandle ceed{open(resource)};
    Results results;
    for (int seed = 0; seed < num; seed++) {
      Values in;
      const Case c = some_case(seed, in);
      const Instance one(ceed, c), other(ceed, c);
      for (const Instance *instance : {&one, &one, &other}) results.push_back(apply(*instance, c, in));
    }
    return results;
  });
  ASSERT_EQ(ran.failure, "");
  ASSERT_EQ(ran.results.size(), static_cast<std::size_t>(3 * num));
  EXPECT_GE(num_made(), num / 2) << "little was compiled";
  for (int seed = 0; seed < num; seed++) {
    Values in;
    const Case c = some_case(seed, in);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(c));
    const Values &got = ran.results[3 * seed];
    EXPECT_EQ(ran.results[3 * seed + 1], got) << "a second application";
    EXPECT_EQ(ran.results[3 * seed + 2], got) << "another operator";
    Case bare = c;  // orientations may add functions that cancel: rounding is relative to what cancelled
    for (Space &space : bare.spaces) space.orientation.clear();
    expect_close(got, hg::test::apply(c, in).active, tolerance(num_terms(c)), "active output",
                 max_norm(hg::test::apply(bare, in).active));
  }
}

/// All that an application does to values and meshes, none of which the text of an operator depends on.
Results values_change(const char *on, const Function &function) {
  const CeedHandle ceed{open(on)};
  Results results;
  for (const CeedInt num_elem : some_numbers) {
    Model one(ceed, {.num_elem = num_elem}, function, {2.0}), other(ceed, {.num_elem = num_elem}, function, {2.0});
    results.push_back(one.apply());
    results.push_back(one.apply());
    results.push_back(other.apply());
    one.set_context({-3.5});
    results.push_back(one.apply());
    one.set_coefficient(one.some_input());
    results.push_back(one.apply());
    results.push_back(other.apply());
  }
  return results;
}
Results points_change(const char *on, const Function &function) {
  const CeedHandle ceed{open(on)};
  Results results;
  for (const CeedInt num_elem : some_numbers) {
    Random random(7600);
    Model one(ceed, {.num_elem = num_elem, .at_points = true}, function, {2.0});
    for (const CeedInt shift : {5, 5, 14, 0}) {  // other places, other counts, perhaps no points at all
      one.place_points(ragged(num_elem, shift), random);
      results.push_back(one.apply());
      results.push_back(one.apply());
    }
    one.set_context({-3.5});
    results.push_back(one.apply());
    one.set_coefficient(one.some_input());
    results.push_back(one.apply());
  }
  return results;
}

/// The compiler is started for the first operator (once for its name, and once to compile), and never again.
TEST_F(Gen, CompilesNothingWhenValuesMeshesOrPointsChange) {
  write_factor(3);
  const Function function = write_scale();
  int num_operators = 0;
  for (const auto work : {values_change, points_change}) {
    num_operators++;
    const Results want = work(reference_resource, {scale<3>, function.location});
    for (const char *process : {"first", "second"}) {
      SCOPED_TRACE(std::string(process) + " process");
      const Ran ran = in_process(environment(), [&] { return work(resource, function); });
      ASSERT_EQ(ran.failure, "");
      EXPECT_EQ(ran.err, "");
      ASSERT_EQ(ran.results.size(), want.size());
      for (std::size_t i = 0; i < want.size(); i++) expect_close(ran.results[i], want[i], 1e-13, "result");
      for (std::size_t i = 0; i + 1 < want.size(); i++) {
        if (want[i] != want[i + 1]) continue;
        EXPECT_EQ(ran.results[i], ran.results[i + 1]) << i << " and the next";
      }
      EXPECT_EQ(num_made(), num_operators);
      EXPECT_EQ(num_starts(), 2 * num_operators);
    }
  }
}

/// Eight points in a direction, where blocks are of half as many elements: what is beyond the last whole one is not
/// left out, nor done twice.
TEST_F(Gen, TakesElementsInHalfBlocks) {
  const auto work = [](const char *on, const Function &of) {
    const CeedHandle ceed{open(on)};
    Results results;
    for (const CeedInt num_elem : {1, 4, 7, 9, 13}) {
      results.push_back(Model(ceed, {.dim = 3, .num_elem = num_elem, .Q = 8}, of, {2.0}).apply());
    }
    return results;
  };
  expect_what_the_reference_gives(work, 1e-13);
}

/// Assembly calls the compiled QFunction; so does an application after it, with a loop that is compiled then.
TEST_F(Gen, AssemblesWithWhatIsCompiled) {
  const auto work = [](const char *on, const Function &of) {
    const CeedHandle ceed{open(on)};
    Results results;
    for (const bool at_points : {false, true}) {
      Model model(ceed, {.at_points = at_points}, of);
      Random random(7700);
      for (const CeedInt shift : {4, 12}) {
        if (at_points) model.place_points(ragged(11, shift), random);
        const Vector diagonal = make_vector(ceed, model.size(), 0.0);
        ok(CeedOperatorLinearAssembleDiagonal(model.op(), diagonal, CEED_REQUEST_IMMEDIATE));
        results.push_back(values_of(diagonal));
        results.push_back(model.apply());
      }
    }
    return results;
  };
  expect_what_the_reference_gives(work, 1e-12);
  EXPECT_LE(num_made(), 4) << "QFunction and loop, at quadrature points and at points";
}

Values applied(const char *on, const Function &function, const std::string &define = "", const std::string &root = "") {
  const CeedHandle ceed{open(on)};
  if (!define.empty()) ok(CeedAddJitDefine(ceed, define.c_str()));
  if (!root.empty()) ok(CeedAddJitSourceRoot(ceed, root.c_str()));
  return Model(ceed, {}, function).apply();
}

/// What an operator of the folder's scale() computes.
class GenChanges : public Gen {
 protected:
  void SetUp() override {
    write_factor(3);
    function_ = write_scale();
  }
  void expect_factor(CeedScalar factor, const Environment &changes = {}, const std::string &define = "",
                     const std::string &root = "", SourceLocation where = SourceLocation::current()) const {
    const ::testing::ScopedTrace trace(where.file_name(), static_cast<int>(where.line()), "called here");
    const Ran ran =
        in_process(environment(changes), [&] { return Results{applied(resource, function_, define, root)}; });
    ASSERT_EQ(ran.failure, "");
    EXPECT_EQ(ran.err, "");
    Values want = applied(reference_resource, {scale<1>, ""});
    for (CeedScalar &value : want) value *= factor;
    expect_close(ran.results.at(0), want, 1e-13, "scale()");
  }

  Function function_{};
};

TEST_F(GenChanges, OfAnIncludedHeaderCount) {
  expect_factor(3);
  EXPECT_EQ(num_made(), 1);
  write_factor(5);
  expect_factor(5);
  EXPECT_EQ(num_made(), 2);
  write_factor(3);
  expect_factor(3);
  EXPECT_EQ(num_made(), 2) << "what was compiled first is there still";
}

TEST_F(GenChanges, OfAnIncludedHeaderCountWithinAProcess) {
  const Ran ran = in_process(environment(), [&] {
    const CeedHandle ceed{open(resource)};
    const Model one(ceed, {}, function_);
    Results results{one.apply()};
    write_factor(5);
    results.push_back(one.apply());
    results.push_back(Model(ceed, {}, function_).apply());
    return results;
  });
  ASSERT_EQ(ran.failure, "");
  expect_close(ran.results.at(0), applied(reference_resource, {scale<3>, ""}), 1e-13, "before");
  EXPECT_EQ(ran.results.at(1), ran.results.at(0)) << "an operator that is there";
  expect_close(ran.results.at(2), applied(reference_resource, {scale<5>, ""}), 1e-13, "a new operator");
  EXPECT_EQ(num_made(), 2);
}

TEST_F(GenChanges, OfAHeaderBelowASourceRootCount) {
  std::filesystem::create_directories(folder() / "root" / "below");
  const std::string root = folder() / "root";
  const auto write_below = [&](const char *factor) {
    write("root/below/also.h", "", std::string("#define FACTOR ") + factor + "\n", nullptr);
  };
  function_ = write("rooted.h", "scale", "#include <below/also.h>\n#include \"scale.h\"\n", scale<7>);
  write_below("8");
  expect_factor(8, {}, "", root);
  write_below("9");
  expect_factor(9, {}, "", root);
  expect_factor(9, {}, "", root);
  EXPECT_EQ(num_made(), 2);
}

/// Names of files and folders are what they are.
TEST_F(GenChanges, OfFoldersWithSpacesCount) {
  const std::filesystem::path odd = folder() / "one two's (3)";
  std::filesystem::create_directory(odd);
  const auto write_odd = [&](const char *factor) {
    write("one two's (3)/odd factor.h", "", std::string("#define FACTOR ") + factor + "\n", nullptr);
  };
  function_ =
      write("one two's (3)/odd scale.h", "scale", "#include <odd factor.h>\n#include \"../scale.h\"\n", scale<7>);
  const Environment own{{"CEED_CACHE_DIR", odd / "the cache"}};
  write_odd("8");
  expect_factor(8, own, "", odd);
  write_odd("9");
  expect_factor(9, own, "", odd);
  EXPECT_EQ(num_made(), 2);
}

TEST_F(GenChanges, OfTheTextCount) {
  expect_factor(3);
  write("scale.h", "scale",
        "#include <ceed/types.h>\n"
        "CEED_QFUNCTION(scale)(void *, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {\n"
        "  for (CeedInt q = 0; q < Q; q++) out[0][q] = 11 * in[2][q] * in[1][q] * in[0][q];\n"
        "  return 0;\n"
        "}\n",
        scale<7>);
  expect_factor(11);
  EXPECT_EQ(num_made(), 2);
}

TEST_F(GenChanges, OfDefinesCount) {
  expect_factor(3);
  expect_factor(4, {}, "FACTOR=4");
  expect_factor(-2, {}, "FACTOR=-2");
  expect_factor(4, {}, "FACTOR=4");
  EXPECT_EQ(num_made(), 3);
  expect_factor(5, {}, "-DFACTOR=5");
  expect_factor(6, {}, "-D FACTOR=6");
}

/// What is defined for the QFunction may have any name: the rest of the text has names of its own.
TEST_F(GenChanges, OfDefinesReachTheQFunctionAlone) {
  const auto with = [&](const std::string &factor) {
    return write("named.h", "scale", "#define FACTOR " + factor + "\n#include \"scale.h\"\n", scale<7>);
  };
  CeedScalar factor = 15;
  for (const std::string name : {"W", "N", "Job", "first", "job", "Count", "size"}) {
    SCOPED_TRACE(name);
    function_ = with(name);
    expect_factor(factor, {}, name + "=" + std::to_string(static_cast<int>(factor)));
    factor++;
  }
  function_ = with("BY(2)");
  expect_factor(14, {}, "BY(n)=(7*(n))");
  function_ = with("(10*TEN)");
  expect_factor(10, {}, "TEN");
}

TEST_F(GenChanges, OfTheUsersFlagsCount) {
  const std::string flags = environment().at("CEED_GEN_FLAGS");
  expect_factor(6, {{"CEED_GEN_FLAGS", flags + " -DFACTOR=6"}});
  expect_factor(3);
  expect_factor(6, {{"CEED_GEN_FLAGS", flags + " -DFACTOR=6"}});
  EXPECT_EQ(num_made(), 2);
}

/// Another compiler of the same name: its size and its time are not those of the one before.
TEST_F(GenChanges, OfTheCompilerCount) {
  const std::string call = "exec " + quoted(folder() / "diary_cxx");
  const Environment own{{"CEED_CXX", write_program("own_cxx", call + " \"$@\"\n")}};
  expect_factor(3, own);
  write_program("own_cxx", call + " -DFACTOR=12 \"$@\"\n");
  expect_factor(12, own);
  expect_factor(12, own);
  EXPECT_EQ(num_made(), 2);
  // Its arguments are part of its name.
  expect_factor(3, {{"CEED_CXX", (folder() / "diary_cxx").string() + " -O0"}});
  expect_factor(13, {{"CEED_CXX", (folder() / "diary_cxx").string() + " -DFACTOR=13"}});
  EXPECT_EQ(num_made(), 4);
}

}  // namespace
