#include "source.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "../host/access.hpp"
#include "cache.hpp"

namespace hg::jit {

namespace fs = std::filesystem;

namespace {

bool is_file(const fs::path &path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The folder of installed QFunctions; it may not be there.
fs::path installed_sources() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<void *>(&CeedInit), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code failure;
  return (fs::weakly_canonical(info.dli_fname, failure).parent_path() / HG_LIB_TO_INCLUDE / "ceed/jit-source")
      .lexically_normal();
}

/// Adds a file, and all that it includes by quotes, to `all`, each once. What is not found is left to the compiler.
void read(const fs::path &file, const std::vector<fs::path> &roots, std::set<fs::path> &seen, std::string &all) {
  std::error_code failure;
  if (!is_file(file) || !seen.insert(fs::weakly_canonical(file, failure)).second) return;
  std::ostringstream stream;
  stream << std::ifstream(file).rdbuf();
  const std::string text = stream.str();
  all += file.string() + '\n' + text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const Include include = included_by(line);
    if (include.name.empty()) continue;
    if (include.is_quoted) read(file.parent_path() / include.name, roots, seen, all);
    for (const auto &root : roots) read(root / include.name, roots, seen, all);
  }
}

std::vector<std::string> strings(Ceed ceed, int (*get)(Ceed, CeedInt *, const char ***),
                                 int (*restore)(Ceed, const char ***)) {
  CeedInt count = 0;
  const char **texts = nullptr;
  host::chk(get(ceed, &count, &texts));
  std::vector<std::string> copies(texts, texts + count);
  host::chk(restore(ceed, &texts));
  return copies;
}

}  // namespace

Source Source::of(CeedQFunction qf) {
  const char *path = nullptr, *name = nullptr;
  host::chk(CeedQFunctionGetSourcePath(qf, &path));
  host::chk(CeedQFunctionGetKernelName(qf, &name));
  if (path == nullptr || *path == '\0') throw NoSource("it came without the place of its source");
  const Ceed ceed = CeedQFunctionReturnCeed(qf);
  Source source{.file = path, .function = name, .roots = {}, .defines = {}};
  for (const auto &root : strings(ceed, CeedGetJitSourceRoots, CeedRestoreJitSourceRoots))
    source.roots.emplace_back(root);
  source.roots.push_back(installed_sources());
  source.defines = strings(ceed, CeedGetJitDefines, CeedRestoreJitDefines);
  for (const auto &root : source.roots) {
    if (!is_file(source.file) && is_file(root / path)) source.file = root / path;
  }
  if (!is_file(source.file)) throw NotCompiled("its source '" + std::string(path) + "' is not there");
  source.file = fs::absolute(source.file).lexically_normal();
  return source;
}

std::string digest_of(const Source &source) {
  std::set<fs::path> seen;
  std::string all;
  read(source.file, source.roots, seen, all);
  return digest(all);
}

std::string_view directive(std::string_view line) {
  const auto hash = line.find_first_not_of(" \t");
  if (hash == std::string_view::npos || line[hash] != '#') return {};
  const auto word = line.find_first_not_of(" \t", hash + 1);
  return word == std::string_view::npos ? std::string_view() : line.substr(word);
}

Include included_by(std::string_view line) {
  const std::string_view words = directive(line);
  if (words.substr(0, 7) != "include") return {};
  const auto begin = words.find_first_of("\"<");
  if (begin == std::string_view::npos) return {};
  const bool is_quoted = words[begin] == '"';
  const auto end = words.find(is_quoted ? '"' : '>', begin + 1);
  if (end == std::string_view::npos) return {};
  return {std::string(words.substr(begin + 1, end - begin - 1)), is_quoted};
}

Defines lines_of(const std::vector<std::string> &defines) {
  Defines lines;
  for (std::string define : defines) {
    if (define.starts_with("-D")) define.erase(0, std::min(define.find_first_not_of(' ', 2), define.size()));
    if (define.empty()) continue;
    if (define[0] == '-') {
      lines.options.push_back(std::move(define));
      continue;
    }
    const auto equals = define.find('=');
    const bool has_value = equals != std::string::npos;
    lines.begin += "#define " + define.substr(0, equals) + ' ' + (has_value ? define.substr(equals + 1) : "1") + '\n';
    lines.end += "#undef " + define.substr(0, std::min(equals, define.find('('))) + '\n';
  }
  return lines;
}

}  // namespace hg::jit
