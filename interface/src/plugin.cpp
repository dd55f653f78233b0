/// Plugin libraries: found, opened, checked.
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "ceed.hpp"
#include "registry.hpp"

namespace hg {

namespace {

thread_local std::string load_error;

/// Opens a plugin and registers it. Throws Error with a message that names the file.
void load_plugin(const std::filesystem::path &path) {
  // A plugin stays open for the whole process: its code may be referenced by any Ceed.
  void *handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw Error(CEED_ERROR_MINOR, text("Plugin '%s' cannot be opened: %s", path.c_str(), dlerror()));
  }
  const auto reject = [&](int code, const std::string &message) {
    dlclose(handle);
    throw Error(code, text("Plugin '%s' is refused: %s", path.c_str(), message.c_str()));
  };
  const auto entry = reinterpret_cast<CeedPluginEntry>(dlsym(handle, "ceed_plugin_v1"));
  if (entry == nullptr) reject(CEED_ERROR_INCOMPATIBLE, "it does not export the symbol ceed_plugin_v1");
  try {
    const CeedPlugin *plugin = entry();
    require(plugin != nullptr, CEED_ERROR_INCOMPATIBLE, "ceed_plugin_v1() returned NULL");
    register_plugin(*plugin);
  } catch (const Error &error) {
    reject(error.code(), error.what());
  } catch (const std::exception &error) {
    reject(CEED_ERROR_MAJOR, std::string("it threw while loading: ") + error.what());
  } catch (...) {
    reject(CEED_ERROR_MAJOR, "it threw while loading");
  }
}

std::vector<std::filesystem::path> search_path() {
  std::vector<std::filesystem::path> directories;
  Dl_info info{};
  if (dladdr(reinterpret_cast<void *>(&load_plugins_in_search_path), &info) != 0 && info.dli_fname != nullptr) {
    directories.push_back(std::filesystem::path(info.dli_fname).parent_path() / "ceed-plugins");
  }
  if (const char *variable = std::getenv("CEED_PLUGIN_PATH"); variable != nullptr) {
    std::string_view rest = variable;
    while (!rest.empty()) {
      const auto colon = rest.find(':');
      if (colon != 0) directories.emplace_back(rest.substr(0, colon));
      rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
    }
  }
  return directories;
}

}  // namespace

void load_plugins_in_search_path() {
  std::set<std::filesystem::path> seen;
  for (const auto &directory : search_path()) {
    std::error_code ignored;
    std::vector<std::filesystem::path> files;
    for (const auto &file : std::filesystem::directory_iterator(directory, ignored)) {
      if (file.path().extension() == ".so") files.push_back(file.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto &file : files) {
      const auto canonical = std::filesystem::weakly_canonical(file, ignored);
      if (!seen.insert(canonical).second) continue;
      try {
        load_plugin(file);
      } catch (const Error &error) {
        // One bad plugin must not take the others away; say so and go on.
        std::fprintf(stderr, "ceed: %s\n", error.what());
      }
    }
  }
}

}  // namespace hg

int CeedPluginLoad(const char *path) {
  hg::load_error.clear();
  try {
    hg::require(path != nullptr, CEED_ERROR_MINOR, "Plugin path is NULL; expected a file name");
    hg::registry();
    hg::load_plugin(path);
    return CEED_ERROR_SUCCESS;
  } catch (const hg::Error &error) {
    hg::load_error = error.what();
    return error.code();
  } catch (const std::exception &error) {
    hg::load_error = error.what();
    return CEED_ERROR_MAJOR;
  }
}

const char *CeedPluginLoadError(void) { return hg::load_error.c_str(); }
