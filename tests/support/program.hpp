/// @file
/// Runs a program as a shell would, and reads what it leaves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hg::test {

struct Finished {
  int code = -1;  ///< exit code; 128 + signal if one ended it
  std::string out, err;
};

/// A path as one word of a shell command.
std::string quoted(const std::filesystem::path &path);

/// Runs a shell command to its end.
Finished run(const std::string &command);

/// A folder of its own for one test, gone afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;
  ~TemporaryFolder();
  const std::filesystem::path &path() const { return path_; }
  std::filesystem::path operator/(const std::string &name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// What is compiled at run time is kept in a folder of its own, empty at first, for a scope: CEED_CACHE_DIR.
class EmptyCache {
 public:
  EmptyCache();
  EmptyCache(const EmptyCache &) = delete;
  EmptyCache &operator=(const EmptyCache &) = delete;
  ~EmptyCache();
  /// Files in it.
  std::size_t num_files() const;

 private:
  TemporaryFolder folder_;
  std::optional<std::string> usual_;
};

std::string read_text(const std::filesystem::path &file);

}  // namespace hg::test
