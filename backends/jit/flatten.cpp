#include "flatten.hpp"

#include <fstream>
#include <set>
#include <sstream>

#include "compiler.hpp"

namespace hg::jit {

namespace fs = std::filesystem;

namespace {

class Flattener {
 public:
  explicit Flattener(const Source &source) : source_(source) {}

  void add(const fs::path &file) {
    std::error_code ignored;
    const fs::path same = fs::weakly_canonical(file, ignored);
    if (come_once_.count(same) != 0) return;
    if (++depth_ > deepest) throw NotCompiled("'" + file.string() + "' includes itself, in the end");
    mark(1, file);
    std::ifstream stream(file);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      number++;
      const Include include = included_by(line);
      if (directive(line).substr(0, 11) == "pragma once") {
        come_once_.insert(same);
        text_ += '\n';
      } else if (include.name.empty()) {
        text_ += line + '\n';
      } else if (const fs::path found = find(include, file); !found.empty()) {
        add(found);
        mark(number + 1, file);
      } else if (include.is_quoted && !is_of_library(include.name)) {
        throw NotCompiled(file.string() + ":" + std::to_string(number) + ": '" + include.name +
                          "' is neither beside it nor in a folder given by CeedAddJitSourceRoot()");
      } else {
        text_ += '\n';
      }
    }
    depth_--;
  }
  const std::string &text() const { return text_; }

 private:
  static constexpr int deepest = 200;

  static bool is_of_library(const std::string &name) { return name == "ceed.h" || name.substr(0, 5) == "ceed/"; }
  fs::path find(const Include &include, const fs::path &from) const {
    std::error_code ignored;
    if (is_of_library(include.name) && include.name.substr(0, 15) != "ceed/jit-source") return {};
    if (include.is_quoted && fs::is_regular_file(from.parent_path() / include.name, ignored)) {
      return from.parent_path() / include.name;
    }
    for (const auto &root : source_.roots) {
      if (fs::is_regular_file(root / include.name, ignored)) return root / include.name;
    }
    return {};
  }
  void mark(int line, const fs::path &file) {
    text_ += "#line " + std::to_string(line) + " \"" + file.string() + "\"\n";
  }

  const Source &source_;
  std::set<fs::path> come_once_;
  std::string text_;
  int depth_ = 0;
};

}  // namespace

std::string flatten(const Source &source) {
  Flattener flattener(source);
  flattener.add(source.file);
  return flattener.text();
}

}  // namespace hg::jit
