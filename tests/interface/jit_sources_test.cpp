// Sources that are compiled when the program runs: roots, definitions, and files found below the roots.
#include <ceed/jit-tools.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/program.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

class JitSources : public testing::Test {
 protected:
  using Get = int (*)(Ceed, CeedInt *, const char ***);
  using Restore = int (*)(Ceed, const char ***);

  std::vector<std::string> listed(Get get, Restore restore) {
    CeedInt count = -1;
    const char **texts = nullptr;
    ok(get(ceed, &count, &texts));
    std::vector<std::string> result(texts, texts + count);
    ok(restore(ceed, &texts));
    EXPECT_EQ(texts, nullptr);
    return result;
  }

  CeedHandle ceed{open(reference_resource)};
};

TEST_F(JitSources, AreKeptInTheirOrder) {
  EXPECT_TRUE(listed(CeedGetJitDefines, CeedRestoreJitDefines).empty());
  ok(CeedAddJitSourceRoot(ceed, "/first"));
  ok(CeedAddJitSourceRoot(ceed, "/second"));
  ok(CeedAddJitDefine(ceed, "ORDER=3"));
  ok(CeedAddRustSourceRoot(ceed, "/rust"));
  EXPECT_EQ(listed(CeedGetJitSourceRoots, CeedRestoreJitSourceRoots), (std::vector<std::string>{"/first", "/second"}));
  EXPECT_EQ(listed(CeedGetJitDefines, CeedRestoreJitDefines), (std::vector<std::string>{"ORDER=3"}));
  EXPECT_EQ(listed(CeedGetRustSourceRoots, CeedRestoreRustSourceRoots), (std::vector<std::string>{"/rust"}));
  for (const auto add : {CeedAddJitSourceRoot, CeedAddJitDefine, CeedAddRustSourceRoot}) {
    expect_error(add(ceed, nullptr), CEED_ERROR_MINOR, {"empty"});
    expect_error(add(ceed, ""), CEED_ERROR_MINOR, {"empty"});
  }
}

TEST_F(JitSources, FilesAreThereOrNot) {
  const TemporaryFolder folder;
  const std::string file = (folder / "scale.h").string();
  std::ofstream(file) << "\n";
  const auto is_there = [&](const std::string &path) {
    bool is_valid = false;
    ok(CeedCheckFilePath(ceed, path.c_str(), &is_valid));
    return is_valid;
  };
  EXPECT_TRUE(is_there(file));
  EXPECT_TRUE(is_there(file + ":scale")) << "the name of a function may follow";
  EXPECT_FALSE(is_there(file + "h"));
  EXPECT_FALSE(is_there(folder.path().string())) << "a folder";
}

TEST_F(JitSources, PathsAreMadeRelative) {
  const char *path = "/opt/ceed/jit-source/old/include/ceed/jit-source/gallery/scale.h", *relative = nullptr;
  ok(CeedGetJitRelativePath(path, &relative));
  EXPECT_STREQ(relative, "ceed/jit-source/gallery/scale.h");
  EXPECT_EQ(relative, path + std::string(path).rfind("ceed/jit-source"));
  EXPECT_EQ(CeedGetJitRelativePath("/opt/scale.h", &relative), CEED_ERROR_MAJOR);
}

TEST_F(JitSources, FilesAreFoundBelowTheRoots) {
  const TemporaryFolder first, second;
  for (const TemporaryFolder *folder : {&first, &second}) std::filesystem::create_directories(*folder / "ceed/jit-source");
  std::ofstream(first / "ceed/jit-source/a.h") << "a";
  std::ofstream(second / "ceed/jit-source/a.h") << "other a";
  std::ofstream(second / "ceed/jit-source/b.h") << "b";
  ok(CeedAddJitSourceRoot(ceed, first.path().c_str()));
  ok(CeedAddJitSourceRoot(ceed, second.path().c_str()));
  const auto found = [&](const char *name) {
    const char *path = nullptr;
    ok(CeedGetJitAbsolutePath(ceed, name, &path));
    const std::string result = path;
    std::free(const_cast<char *>(path));
    return result;
  };
  EXPECT_EQ(found("ceed/jit-source/a.h"), (first / "ceed/jit-source/a.h").string());
  EXPECT_EQ(found("ceed/jit-source/b.h"), (second / "ceed/jit-source/b.h").string());
  const char *path = nullptr;
  expect_error(CeedGetJitAbsolutePath(ceed, "ceed/jit-source/c.h", &path), CEED_ERROR_MAJOR,
               {"ceed/jit-source/c.h", first.path().string(), second.path().string()});
}

}  // namespace
