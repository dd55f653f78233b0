// What is read for compilers that see no files, and what is kept of what they make.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "backends/jit/cache.hpp"
#include "backends/jit/compiler.hpp"
#include "backends/jit/flatten.hpp"
#include "support/program.hpp"

namespace {

using namespace hg;
using test::EmptyCache, test::Finished, test::TemporaryFolder;
namespace fs = std::filesystem;

/// Files of a QFunction, as one text.
class FlattenTest : public testing::Test {
 protected:
  void write(const std::string &name, const std::string &text) const {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  std::string flat() const {
    return jit::flatten({.file = folder / "main.h", .function = "f", .roots = {folder / "root"}, .defines = {}});
  }
  /// What a compiler makes of a file, without blanks.
  Finished preprocessed(const std::string &name) const {
    Finished done =
        test::run("c++ -x c++ -E -P -I" + test::quoted(folder / "root") + ' ' + test::quoted(folder / name));
    std::erase_if(done.out, [](unsigned char c) { return c == '\n' || c == ' '; });
    return done;
  }
  /// The text is to a compiler what the files are.
  void expect_same() const {
    write("flat.h", flat());
    const Finished want = preprocessed("main.h"), got = preprocessed("flat.h");
    ASSERT_EQ(want.code, 0) << want.err;
    EXPECT_EQ(got.code, 0) << got.err;
    EXPECT_EQ(got.out, want.out) << flat();
  }

  const TemporaryFolder folder;
};

TEST_F(FlattenTest, LooksBesideTheFileAndInFolders) {
  write("main.h", "#include \"near/a.h\"\n#include <far.h>\nint f;\n");
  write("near/a.h", "#include \"b.h\"\nint a;\n");
  write("near/b.h", "int b;\n");
  write("root/far.h", "int far;\n");
  expect_same();
}

/// What comes once may first be named where it is not read, and its pragma may not be read.
TEST_F(FlattenTest, LeavesConditionsToTheCompiler) {
  write("once.h", "#pragma once\nint once;\n");
  write("main.h", "#ifdef OFF\n#include \"once.h\"\n#endif\n#include \"once.h\"\n#include \"once.h\"\n");
  expect_same();
  write("once.h", "  # pragma \t once // as it says\nint once;\n");
  expect_same();
  write("twice.h", "#ifdef OFF\n#pragma once\n#endif\nint twice;\n");
  write("main.h", "#include \"twice.h\"\n#include \"twice.h\"\n");
  expect_same();
  write("main.h", "#ifdef OFF\n#include \"missing.h\"\n#endif\nint f;\n");
  expect_same();
  write("main.h", "#if 0\n#elif 1\n#include \"once.h\"\n#else\n#include \"missing.h\"\n#endif\n#include \"once.h\"\n");
  expect_same();
}

TEST_F(FlattenTest, TakesFilesThatIncludeEachOther) {
  write("main.h", "#include \"a.h\"\n#include \"b.h\"\n");
  write("a.h", "#pragma once\n#include \"b.h\"\nint a;\n");
  write("b.h", "#pragma once\n#include \"a.h\"\nint b;\n");
  expect_same();
  write("a.h", "// a guard\n#ifndef A_H\n#define A_H\n#include \"b.h\"\nint a;\n#endif\n");
  write("b.h", "#ifndef B_H\n#define B_H\n#include \"a.h\"\nint b;\n#endif\n");
  expect_same();
}

/// One file by two names.
TEST_F(FlattenTest, KnowsAFileByItself) {
  write("once.h", "#pragma once\nint once;\n");
  fs::create_symlink(folder / "once.h", folder / "same.h");
  write("main.h", "#include \"once.h\"\n#include \"same.h\"\n");
  expect_same();
}

TEST_F(FlattenTest, TakesAFileAsOftenAsItIsNamed) {
  write("row.h", "int ROW;\n");
  write("main.h", "#define ROW a\n#include \"row.h\"\n#undef ROW\n#define ROW b\n#include \"row.h\"\n");
  expect_same();
}

/// Sixty layers of two that name each other's next ones: each comes once in the text.
TEST_F(FlattenTest, DoesNotGrowWithTheWaysToAFile) {
  write("main.h", "#include \"l0.h\"\n#include \"r0.h\"\n");
  for (int i = 0; i < 60; i++) {
    const std::string next = std::to_string(i + 1), number = std::to_string(i);
    const std::string both = "#pragma once\n#include \"l" + next + ".h\"\n#include \"r" + next + ".h\"\n";
    write("l" + number + ".h", both + "int l" + number + ";\n");
    write("r" + number + ".h", both + "int r" + number + ";\n");
  }
  write("l60.h", "int l;\n");
  write("r60.h", "int r;\n");
  EXPECT_LT(flat().size(), 200000U);
}

TEST_F(FlattenTest, SaysWhereAFileIsMissing) {
  write("main.h", "int f;\n#include \"missing.h\"\n");
  write("flat.h", flat());
  const Finished done = preprocessed("flat.h");
  EXPECT_NE(done.code, 0);
  EXPECT_NE(done.err.find("main.h:2"), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("'missing.h' is neither beside"), std::string::npos) << done.err;
}

TEST_F(FlattenTest, RefusesAFileThatIncludesItself) {
  write("main.h", "#include \"a.h\"\n");
  write("a.h", "#include \"main.h\"\n");
  try {
    flat();
    FAIL() << "it came to an end";
  } catch (const jit::NotCompiled &error) {
    EXPECT_NE(std::string(error.what()).find("main.h' includes itself"), std::string::npos) << error.what();
  }
}

/// Code for devices in the cache.
TEST(CachedCode, IsMadeByOneProcessForSeveral) {
  const EmptyCache cache;
  const TemporaryFolder made;
  std::vector<pid_t> processes;
  for (int i = 0; i < 4; i++) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const std::string code = jit::Cache().code("a request", [&] {
        std::ofstream(made / std::to_string(::getpid())) << "made";
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        return std::string("code");
      });
      ::_exit(code == "code" ? 0 : 1);
    }
    processes.push_back(child);
  }
  for (const pid_t process : processes) {
    int status = -1;
    ASSERT_EQ(::waitpid(process, &status, 0), process);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(made.path()), fs::directory_iterator()), 1);
  EXPECT_EQ(cache.num_files(), 1U);
}

TEST(CachedCode, IsMadeAnewWhereItIsOfNoUse) {
  const EmptyCache cache;
  int num_made = 0;
  const auto code = [&](bool is_usable = true) {
    return jit::Cache().code(
        "a request", [&] { return "code " + std::to_string(++num_made); }, is_usable);
  };
  EXPECT_EQ(code(), "code 1");
  EXPECT_EQ(code(), "code 1");
  for (const auto &file : fs::directory_iterator(jit::Cache().folder())) {
    fs::resize_file(file.path(), file.file_size() - 1);  // a crash of the machine
  }
  EXPECT_EQ(code(), "code 2");
  EXPECT_EQ(code(false), "code 3");
  EXPECT_EQ(code(), "code 3");
}

TEST(CachedCode, IsThereWhereItCannotBeKept) {
  const EmptyCache folder;
  const jit::Cache cache;
  fs::remove_all(cache.folder());
  int num_made = 0;
  const auto make = [&] {
    num_made++;
    return std::string("code");
  };
  testing::internal::CaptureStderr();
  EXPECT_EQ(cache.code("a request", make), "code");
  EXPECT_EQ(num_made, 1);
  EXPECT_EQ(cache.code("a request", make), "code");
  const std::string told = testing::internal::GetCapturedStderr();
  const std::string words = "what is compiled for devices is not kept";
  EXPECT_NE(told.find(words), std::string::npos) << told;
  EXPECT_EQ(told.find(words), told.rfind(words)) << told;
}

}  // namespace
