/// Sources that are compiled when the program runs: where they are looked for, and with which definitions.
#include <ceed/jit-tools.h>
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "ceed.hpp"
#include "version.hpp"

namespace {

namespace fs = std::filesystem;

constexpr std::string_view sources_of_the_library = "ceed/jit-source";

/// The folder of the headers that were installed with this library; empty where it runs from its build folder.
fs::path installed_headers() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void *>(&CeedGetJitAbsolutePath), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code failure;
  const fs::path folder = fs::weakly_canonical(info.dli_fname, failure).parent_path() / hg::lib_to_include;
  return fs::is_directory(folder / sources_of_the_library, failure) ? folder.lexically_normal() : fs::path();
}

char *copy_of(const std::string &text) {
  char *copy = ::strdup(text.c_str());
  if (copy == nullptr) throw std::bad_alloc();
  return copy;
}

/// Adds a text of the user's to a list of the Ceed.
int add(Ceed ceed, std::vector<std::string> Ceed_private::*list, const char *text, const char *what,
        const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      ceed,
      [&] {
        hg::deref(ceed, "Ceed");
        hg::require(text != nullptr && *text != '\0', CEED_ERROR_MINOR,
                    [&] { return hg::text("%s is NULL or empty; expected text", what); });
        (ceed->*list).emplace_back(text);
      },
      function);
}

/// A list of C strings for the caller of the Get functions below; freed by the Restore functions.
int get(Ceed ceed, std::vector<std::string> Ceed_private::*list, CeedInt *count, const char ***strings,
        const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      ceed,
      [&] {
        const auto &texts = hg::deref(ceed, "Ceed").*list;
        hg::require_argument(count, "where the number of strings goes");
        hg::require_argument(strings, "where the list of strings goes");
        auto **pointers = static_cast<const char **>(std::calloc(texts.size() + 1, sizeof(const char *)));
        if (pointers == nullptr) throw std::bad_alloc();
        for (std::size_t i = 0; i < texts.size(); i++) pointers[i] = texts[i].c_str();
        *strings = pointers;
        *count = static_cast<CeedInt>(texts.size());
      },
      function);
}

int restore(const char ***list) {
  if (list != nullptr) {
    std::free(static_cast<void *>(*list));
    *list = nullptr;
  }
  return CEED_ERROR_SUCCESS;
}

}  // namespace

int CeedAddJitSourceRoot(Ceed ceed, const char *jit_source_root) {
  return add(ceed, &Ceed_private::jit_source_roots, jit_source_root, "The source root");
}

int CeedAddJitDefine(Ceed ceed, const char *jit_define) {
  return add(ceed, &Ceed_private::jit_defines, jit_define, "The define");
}

int CeedAddRustSourceRoot(Ceed ceed, const char *rust_source_root) {
  return add(ceed, &Ceed_private::rust_source_roots, rust_source_root, "The Rust source root");
}

int CeedGetJitSourceRoots(Ceed ceed, CeedInt *num_source_roots, const char ***jit_source_roots) {
  return get(ceed, &Ceed_private::jit_source_roots, num_source_roots, jit_source_roots);
}

int CeedGetJitDefines(Ceed ceed, CeedInt *num_defines, const char ***jit_defines) {
  return get(ceed, &Ceed_private::jit_defines, num_defines, jit_defines);
}

int CeedGetRustSourceRoots(Ceed ceed, CeedInt *num_source_roots, const char ***rust_source_roots) {
  return get(ceed, &Ceed_private::rust_source_roots, num_source_roots, rust_source_roots);
}

int CeedRestoreJitSourceRoots(Ceed, const char ***jit_source_roots) { return restore(jit_source_roots); }

int CeedRestoreJitDefines(Ceed, const char ***jit_defines) { return restore(jit_defines); }

int CeedRestoreRustSourceRoots(Ceed, const char ***rust_source_roots) { return restore(rust_source_roots); }

int CeedCheckFilePath(Ceed ceed, const char *source_file_path, bool *is_valid) {
  return hg::guard(ceed, [&] {
    hg::require(source_file_path != nullptr, CEED_ERROR_MINOR, "CeedCheckFilePath: the path is NULL; expected a file");
    const std::string_view path = source_file_path;
    std::error_code ignored;
    hg::result(is_valid, "is_valid") = fs::is_regular_file(path.substr(0, path.rfind(':')), ignored);
  });
}

int CeedGetJitRelativePath(const char *absolute_file_path, const char **relative_file_path) {
  return hg::guard(nullptr, [&] {
    hg::require(absolute_file_path != nullptr, CEED_ERROR_MINOR,
                "CeedGetJitRelativePath: the path is NULL; expected a file");
    const auto start = std::string_view(absolute_file_path).rfind(sources_of_the_library);
    hg::require(start != std::string_view::npos, CEED_ERROR_MAJOR, [&] {
      return hg::text("'%s' is not below a folder 'ceed/jit-source'", absolute_file_path);
    });
    hg::result(relative_file_path, "relative_file_path") = absolute_file_path + start;
  });
}

int CeedGetJitAbsolutePath(Ceed ceed, const char *relative_file_path, const char **absolute_file_path) {
  return hg::guard(ceed, [&] {
    const auto &roots = hg::deref(ceed, "Ceed").jit_source_roots;
    hg::require(relative_file_path != nullptr, CEED_ERROR_MINOR,
                "CeedGetJitAbsolutePath: the path is NULL; expected a file");
    hg::require_argument(absolute_file_path, "absolute_file_path (where the text goes)");
    std::vector<fs::path> folders(roots.begin(), roots.end());
    if (const fs::path headers = installed_headers(); !headers.empty()) folders.push_back(headers);
    std::string tried;
    for (const auto &folder : folders) {
      const fs::path file = folder / relative_file_path;
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored)) {
        *absolute_file_path = copy_of(fs::absolute(file).lexically_normal().string());
        return;
      }
      tried += "\n  " + folder.string();
    }
    throw hg::Error(CEED_ERROR_MAJOR, hg::text("Source file '%s' was not found below%s", relative_file_path,
                                               tried.empty() ? " any folder: there is no source root" : tried.c_str()));
  });
}
