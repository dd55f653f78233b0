/// @file
/// Runs a program as a shell would, and reads what it leaves.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hg::test {

struct Finished {
  int code = -1;  ///< exit code; 128 + signal if one ended it
  std::string out, err;
};

/// A name for a test from the arguments it tries: their letters and digits.
std::string name_from(const std::string &arguments);

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
  std::filesystem::path operator/(const std::string &name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path &file);
nlohmann::json read_json(const std::filesystem::path &file);

/// Expects that a record has every field of the schema with a value of its kind, and that its rates follow from its
/// times.
void expect_record(const nlohmann::json &record);

}  // namespace hg::test
