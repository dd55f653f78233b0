#include "program.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace hg::test {

std::string quoted(const std::filesystem::path &path) {
  return std::string("'").append(path.string()).append("'");
}

Finished run(const std::string &command) {
  const TemporaryFolder folder;
  const auto out = folder / "out", err = folder / "err";
  const int status = std::system(("( " + command + " ) > " + quoted(out) + " 2> " + quoted(err)).c_str());
  Finished finished;
  finished.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  finished.out = read_text(out);
  finished.err = read_text(err);
  return finished;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "honeyguide_test_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make a temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

namespace {

constexpr const char *cache_variable = "CEED_CACHE_DIR";

}  // namespace

EmptyCache::EmptyCache() {
  if (const char *usual = std::getenv(cache_variable)) usual_ = usual;
  ::setenv(cache_variable, folder_.path().c_str(), 1);
}

EmptyCache::~EmptyCache() {
  if (usual_) {
    ::setenv(cache_variable, usual_->c_str(), 1);
  } else {
    ::unsetenv(cache_variable);
  }
}

std::size_t EmptyCache::num_files() const {
  const std::filesystem::recursive_directory_iterator files(folder_.path());
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

std::string read_text(const std::filesystem::path &file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace hg::test
