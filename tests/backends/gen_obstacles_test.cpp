// Operators that cannot be compiled, or whose cache others change: they are told of and run interpreted.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <iostream>
#include <memory>

#include "gen_workshop.hpp"

namespace {

using namespace hg::test;
namespace fs = std::filesystem;

/// Files of this process become no larger while this lives.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const struct rlimit limit { bytes, before_.rlim_max };
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("setrlimit() failed");
  }
  FileLimit(const FileLimit &) = delete;
  FileLimit &operator=(const FileLimit &) = delete;
  ~FileLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  struct rlimit before_ {};
};

constexpr rlim_t no_limit = RLIM_INFINITY;

class GenObstacles : public Workshop {
 protected:
  void SetUp() override {
    write_factor(3);
    function_ = write_scale();
  }

  /// Three operators, two of them alike, at quadrature points, and one at points; and an assembly.
  static Results work(const char *resource, const Function &function) {
    const CeedHandle ceed{open(resource)};
    const Model one(ceed, {}, function), other(ceed, {}, function), large(ceed, {.P = 4, .Q = 5}, function);
    Model at_points(ceed, {.at_points = true}, function);
    Random random(7800);
    at_points.place_points({0, 3, 9, 17, 2, 1, 0, 30, 8, 16, 4}, random);
    Results results;
    for (const Model *model : {&one, &other, &large, static_cast<const Model *>(&at_points), &one}) {
      results.push_back(model->apply());
    }
    const Vector diagonal = make_vector(ceed, large.size(), 0.0);
    ok(CeedOperatorLinearAssembleDiagonal(large.op(), diagonal, CEED_REQUEST_IMMEDIATE));
    results.push_back(values_of(diagonal));
    return results;
  }

  /// One warning; results are those of the interpreting backend, bit for bit.
  void expect_interpreted(const Environment &changes, rlim_t limit, const std::string &reason) const {
    const Ran ran = in_process(environment(changes), [&] {
      const FileLimit small(limit);
      return work(compiled_resource, function_);
    });
    ASSERT_EQ(ran.failure, "");
    EXPECT_EQ(num_warnings(ran.err), 1) << ran.err;
    EXPECT_NE(ran.err.find(reason), std::string::npos) << "expected \"" << reason << "\" in: " << ran.err;
    const bool has_name = ran.err.find("'scale'") != std::string::npos;
    EXPECT_EQ(has_name, !function_.location.empty()) << "the QFunction's name: " << ran.err;
    expect_equal(ran.results, work(interpreted_resource, function_));
  }

  /// With CEED_JIT_ERROR_ON_FAILURE each application is an error, and so is each assembly.
  void expect_error_where_asked_for(Environment changes, rlim_t limit, const std::string &reason) const {
    changes["CEED_JIT_ERROR_ON_FAILURE"] = "1";
    const Ran ran = in_process(environment(changes), [&] {
      const FileLimit small(limit);
      const CeedHandle ceed{open(compiled_resource)};
      const Model model(ceed, {}, function_);
      const Vector in = make_vector(ceed, model.some_input()), out = make_vector(ceed, model.size(), 0.0);
      const auto note = [](int code) {
        std::cerr << "application: " << last_report().message << '\n';
        forget_reports();
        return static_cast<CeedScalar>(code);
      };
      Values codes;
      for (int i = 0; i < 2; i++) {
        codes.push_back(note(CeedOperatorApply(model.op(), in, out, CEED_REQUEST_IMMEDIATE)));
        codes.push_back(note(CeedOperatorLinearAssembleDiagonal(model.op(), out, CEED_REQUEST_IMMEDIATE)));
      }
      return Results{codes};
    });
    ASSERT_EQ(ran.failure, "");
    const CeedScalar failed = CEED_ERROR_BACKEND;
    EXPECT_EQ(ran.results.at(0), (Values{failed, failed, failed, failed}));
    int count = 0;
    for (std::size_t at = ran.err.find(reason); at != std::string::npos; at = ran.err.find(reason, at + 1)) count++;
    EXPECT_EQ(count, 4) << "expected \"" << reason << "\" four times in: " << ran.err;
    EXPECT_EQ(num_warnings(ran.err), 0) << ran.err;
  }

  void expect_obstacle(const Environment &changes, const std::string &reason, rlim_t limit = no_limit) const {
    expect_interpreted(changes, limit, reason);
    expect_error_where_asked_for(changes, limit, reason);
  }

  Function function_{};
};

TEST_F(GenObstacles, ACompilerThatIsNotThere) {
  const std::string nowhere = folder() / "no" / "compiler";
  expect_obstacle({{"CEED_CXX", nowhere}}, "CEED_CXX names no program: '" + nowhere + "'");
  expect_obstacle({{"CEED_CXX", "no-such-compiler -O1"}}, "CEED_CXX names no program: 'no-such-compiler'");
  expect_obstacle({{"CEED_CXX", ""}, {"CXX", nowhere}}, "CXX names no program: '" + nowhere + "'");
}

TEST_F(GenObstacles, NoCompilerInPath) {
  expect_obstacle({{"CEED_CXX", ""}, {"PATH", ""}}, "there is no compiler");
}

TEST_F(GenObstacles, ACompilerThatIsNone) {
  const std::string broken = write_program("broken", "");
  std::ofstream(broken) << "no program at all";
  expect_obstacle({{"CEED_CXX", broken}}, "'" + broken + "': Exec format error");
  expect_obstacle({{"CEED_CXX", write_program("lazy", "exit 0\n")}}, "the compiler refuses it");
  expect_obstacle({{"CEED_CXX", write_program("rude", "echo tea >&2\nkill -9 $$\n")}}, "tea");
  EXPECT_EQ(num_made(), 0);
  EXPECT_EQ(num_cached(".cpp"), 0) << "texts stay that are of no use";
}

/// The compiler's message leads to the user's own file and line.
TEST_F(GenObstacles, ATextThatIsWrong) {
  function_ = write("wrong.h", "scale", R"(#include <ceed/types.h>

CEED_QFUNCTION(scale)(void *context, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  for (CeedInt q = 0; q < Q; q++) out[0][q] = flactor * in[0][q];
  return 0;
}
)",
                    scale<7>);
  expect_obstacle({}, (folder() / "wrong.h").string() + ":4:");
  EXPECT_EQ(num_cached(".so"), 0);
  EXPECT_EQ(num_cached(".cpp"), 0) << "texts stay that are of no use";
}

TEST_F(GenObstacles, ATextThatIsNotThere) {
  function_.location = "nowhere/scale.h:scale";
  expect_obstacle({}, "'nowhere/scale.h' is not there");
}

TEST_F(GenObstacles, AHeaderThatIsNotThere) {
  fs::remove(folder() / "factor.h");
  expect_obstacle({}, "scale.h:2:");
}

/// Who gives no text wants nothing compiled: no error, but a word.
TEST_F(GenObstacles, NoText) {
  function_.location = "";
  expect_interpreted({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}, no_limit, "without the place of its source");
}

TEST_F(GenObstacles, AFolderThatCannotBeMade) {
  std::ofstream(folder() / "file") << "a file";
  expect_obstacle({{"CEED_CACHE_DIR", folder() / "file" / "cache"}}, "cannot be made");
  expect_obstacle({{"CEED_CACHE_DIR", folder() / "file"}}, "is no folder");
  expect_obstacle({{"CEED_CACHE_DIR", ""}, {"XDG_CACHE_HOME", ""}, {"HOME", ""}}, "there is no folder");
}

TEST_F(GenObstacles, AFolderInWhichOthersMayWrite) {
  const fs::path shared = folder() / "shared";
  for (const fs::perms who : {fs::perms::group_write, fs::perms::others_write}) {
    fs::create_directory(shared);
    fs::permissions(shared, fs::perms::owner_all | who);
    expect_obstacle({{"CEED_CACHE_DIR", shared}}, "is not to be trusted");
    EXPECT_TRUE(fs::is_empty(shared));
    fs::remove(shared);
  }
}

TEST_F(GenObstacles, ASizeThatIsNone) {
  for (const char *size : {"much", "-1", "12MiB", "nan"}) {
    expect_obstacle({{"CEED_CACHE_SIZE", size}}, std::string("CEED_CACHE_SIZE is '") + size + "'");
  }
}

/// No room for our own headers; then, with these there, for what the compiler writes.
TEST_F(GenObstacles, NoRoom) {
  expect_obstacle({}, "cannot be written", 1000);
  EXPECT_EQ(num_starts(), 0);
  ASSERT_EQ(in_process(environment(), [&] { return work(compiled_resource, function_); }).failure, "");
  const int num_made_with_room = num_made();
  write_factor(4);
  expect_obstacle({}, "the compiler refuses it", 12000);
  EXPECT_GT(num_made(), num_made_with_room) << "the compiler was not asked";
  EXPECT_EQ(num_cached(".so"), num_made_with_room);
}

/// Programs that let nobody wait for processes.
TEST_F(GenObstacles, NobodyWhoWaitsIsNone) {
  const Ran ran = in_process(environment({{"CEED_JIT_ERROR_ON_FAILURE", "1"}}), [&] {
    ::signal(SIGCHLD, SIG_IGN);
    return work(compiled_resource, function_);
  });
  EXPECT_EQ(ran.failure, "");
  EXPECT_EQ(num_cached(".so"), num_made());
  write("scale.h", "scale", "this is no C", scale<7>);
  expect_error_where_asked_for({}, no_limit, "scale.h:1:");
}

/// What an obstacle stopped goes on when it is out of the way.
TEST_F(GenObstacles, ComputesRightlyAfterwards) {
  for (const Environment &changes : {Environment{{"CEED_CXX", "no-such-compiler"}}, Environment{}}) {
    const Ran ran = in_process(environment(changes), [&] { return work(compiled_resource, function_); });
    ASSERT_EQ(ran.failure, "");
    EXPECT_EQ(num_warnings(ran.err), changes.empty() ? 0 : 1);
    const Results want = work(reference_resource, {changes.empty() ? scale<3> : scale<7>, ""});
    ASSERT_EQ(ran.results.size(), want.size());
    for (std::size_t i = 0; i < want.size(); i++) expect_close(ran.results[i], want[i], 1e-12, "result");
  }
}

class GenCache : public GenObstacles {
 protected:
  Results compiled() const { return work(reference_resource, {scale<3>, ""}); }
  void expect_compiled(const Ran &ran) const {
    ASSERT_EQ(ran.failure, "");
    EXPECT_EQ(ran.err, "");
    const Results want = compiled();
    ASSERT_EQ(ran.results.size(), want.size());
    for (std::size_t i = 0; i < want.size(); i++) expect_close(ran.results[i], want[i], 1e-12, "result");
  }
};

TEST_F(GenCache, LetsOneProcessCompileForSeveral) {
  std::vector<std::unique_ptr<Process>> processes;
  for (int i = 0; i < 5; i++) {
    processes.push_back(std::make_unique<Process>(environment(), [&] { return work(compiled_resource, function_); }));
  }
  Results first;
  for (const auto &process : processes) {
    const Ran ran = process->wait();
    expect_compiled(ran);
    if (first.empty()) first = ran.results;
    expect_equal(ran.results, first);
  }
  EXPECT_EQ(num_made(), num_cached(".so"));
  EXPECT_EQ(num_cached(".lock"), 0);
}

/// Whatever others throw away in the meantime.
TEST_F(GenCache, ServesSeveralProcessesThatThrowAwayEachOthersEntries) {
  std::vector<std::unique_ptr<Process>> processes;
  for (int i = 0; i < 3; i++) {
    const Environment own =
        environment({{"CEED_CACHE_SIZE", "0"},
                     {"CEED_GEN_FLAGS", environment().at("CEED_GEN_FLAGS") + " -DNUMBER=" + std::to_string(i)}});
    processes.push_back(std::make_unique<Process>(own, [&] { return work(compiled_resource, function_); }));
  }
  for (const auto &process : processes) expect_compiled(process->wait());
}

TEST_F(GenCache, KeepsWhatItHasRoomFor) {
  const Environment none = environment({{"CEED_CACHE_SIZE", "0"}});
  const auto apply = [&](CeedInt P) {
    const Ran ran = in_process(none, [&] {
      const CeedHandle ceed{open(compiled_resource)};
      return Results{Model(ceed, {.P = P}, function_).apply()};
    });
    EXPECT_EQ(ran.failure + ran.err, "");
  };
  apply(2);
  apply(3);
  EXPECT_EQ(num_made(), 2);
  EXPECT_EQ(num_cached(".so"), 1);
  EXPECT_EQ(num_cached(".cpp"), 1);
  apply(3);
  EXPECT_EQ(num_made(), 2) << "the newest entry is gone";
  apply(2);
  EXPECT_EQ(num_made(), 3);
  EXPECT_EQ(num_cached(".so"), 1);
}

/// With room for two entries, the one goes that was not used for longest.
TEST_F(GenCache, KeepsWhatIsUsed) {
  const auto apply = [&](CeedInt P, const std::string &size) {
    const Ran ran = in_process(environment({{"CEED_CACHE_SIZE", size}}), [&] {
      const CeedHandle ceed{open(compiled_resource)};
      return Results{Model(ceed, {.P = P}, function_).apply()};
    });
    EXPECT_EQ(ran.failure + ran.err, "");
  };
  apply(2, "");
  apply(3, "");
  std::uintmax_t bytes = 0;
  for (const auto &found : fs::directory_iterator(cache())) bytes += found.is_regular_file() ? found.file_size() : 0;
  const std::string room_for_two = std::to_string(static_cast<double>(bytes) * 1.2 / (1 << 20));
  apply(2, room_for_two);  // used again
  apply(4, room_for_two);  // in the place of 3
  EXPECT_EQ(num_made(), 3);
  EXPECT_EQ(num_cached(".so"), 2);
  apply(2, room_for_two);
  EXPECT_EQ(num_made(), 3) << "what was used is gone";
  apply(3, room_for_two);
  EXPECT_EQ(num_made(), 4);
}

/// Whatever the umask of the program is, nobody else can change what is going to be run.
TEST_F(GenCache, IsNobodyElsesToWrite) {
  fs::create_directory(cache());
  fs::permissions(cache(), fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec);
  expect_compiled(in_process(environment(), [&] {
    ::umask(0);
    return work(compiled_resource, function_);
  }));
  int count = 0;
  for (const auto &found : fs::recursive_directory_iterator(cache())) {
    EXPECT_EQ(found.status().permissions() & (fs::perms::group_write | fs::perms::others_write), fs::perms::none)
        << found.path();
    count++;
  }
  EXPECT_GE(count, 10) << "libraries, texts, headers";
}

/// Files of which a crash of the machine left nothing, or a part.
TEST_F(GenCache, MakesCutFilesAnew) {
  const auto again = [&] { return in_process(environment(), [&] { return work(compiled_resource, function_); }); };
  expect_compiled(again());
  const int count = num_made();
  EXPECT_EQ(num_cached(".so"), count);
  for (const int round : {1, 2}) {
    for (const auto &found : fs::recursive_directory_iterator(cache())) {
      if (found.is_regular_file()) fs::resize_file(found.path(), round == 1 ? 0 : found.file_size() / 2);
    }
    for (int i = 0; i < 2; i++) {
      expect_compiled(again());
      EXPECT_EQ(num_made(), (round + 1) * count);
    }
  }
}

}  // namespace
