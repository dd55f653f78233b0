#include "flatten.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <string_view>
#include <vector>

#include "cache.hpp"
#include "compiler.hpp"

namespace hg::jit {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> lines_in(const fs::path &file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool is_once(const std::string &line) {
  const std::string_view words = directive(line), pragma = "pragma";
  const auto word = words.find_first_not_of(" \t", pragma.size());
  return words.starts_with(pragma) && word != std::string_view::npos && words.substr(word).starts_with("once");
}

/// Whether all that a file has is for its first time: by its pragma, or as its first directives are a guard.
bool is_guarded(const std::vector<std::string> &lines) {
  if (std::any_of(lines.begin(), lines.end(), is_once)) return true;
  std::vector<std::string_view> first;
  for (const auto &line : lines) {
    if (first.size() < 2 && !directive(line).empty()) first.push_back(directive(line));
  }
  return first.size() == 2 && (first[0].starts_with("ifndef") || first[0].starts_with("if !defined")) &&
         first[1].starts_with("define");
}

class Flattener {
 public:
  explicit Flattener(const Source &source) : source_(source) {}

  /// `is_reached`: under no condition.
  void add(const fs::path &file, bool is_reached) {
    std::error_code ignored;
    const fs::path same = fs::weakly_canonical(file, ignored);
    if (came_.count(same) != 0) return;
    const std::vector<std::string> lines = lines_in(file);
    if (std::find(open_.begin(), open_.end(), same) != open_.end()) {
      if (is_guarded(lines)) return;
      throw NotCompiled("'" + file.string() + "' includes itself, in the end");
    }
    open_.push_back(same);
    const bool is_to_come_once = std::any_of(lines.begin(), lines.end(), is_once);
    const std::string guard = "HG_ONCE_" + digest(same.string());
    if (is_to_come_once) text_ += "#ifndef " + guard + '\n';
    mark(1, file);
    int number = 0, depth = 0;  // of conditions
    for (const std::string &line : lines) {
      number++;
      const std::string_view words = directive(line);
      if (words.starts_with("if")) depth++;
      if (words.starts_with("endif")) depth--;
      if (is_once(line)) {
        if (is_reached && depth == 0) came_.insert(same);
        text_ += "#define " + guard + '\n';
      } else if (const Include include = included_by(line); include.name.empty()) {
        text_ += line + '\n';
      } else if (const fs::path found = find(include, file); !found.empty()) {
        add(found, is_reached && depth == 0);
        mark(number + 1, file);
      } else if (include.is_quoted && !is_of_library(include.name)) {
        text_ += "#error '" + include.name +
                 "' is neither beside the file that includes it nor in a folder given by CeedAddJitSourceRoot()\n";
      } else {
        text_ += '\n';
      }
    }
    if (is_to_come_once) text_ += "#endif\n";
    open_.pop_back();
  }
  const std::string &text() const { return text_; }

 private:
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
  std::vector<fs::path> open_;  ///< files that include each other, down to this one
  std::set<fs::path> came_;     ///< files to come once that did, whatever the compiler makes of conditions
  std::string text_;
};

}  // namespace

std::string flatten(const Source &source) {
  Flattener flattener(source);
  flattener.add(source.file, true);
  return flattener.text();
}

}  // namespace hg::jit
