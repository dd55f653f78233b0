/// Plugin libraries: found, judged, opened, registered.
#include <dirent.h>
#include <dlfcn.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>

#include "ceed.hpp"
#include "library_file.hpp"
#include "registry.hpp"

namespace hg {

namespace {

namespace fs = std::filesystem;

thread_local std::string load_error;

/// Opens a library. Its static constructors run here, and an exception of theirs goes through dlopen(), whose
/// declaration promises that none does: it is called by a pointer that promises nothing. Such a library stays mapped,
/// half made, so it is refused for good. The dynamic loader's lock stays with this thread then: a later dlopen() of
/// another thread waits for ever.
void *open_library(const fs::path &path) {
  static std::set<fs::path> half_made;
  std::string thrown;
  if (half_made.count(path) != 0) throw Error(CEED_ERROR_MAJOR, "a static constructor of it threw before");
  void *(*volatile opener)(const char *, int) = dlopen;
  try {
    void *handle = opener(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw Error(CEED_ERROR_MINOR, dlerror());
    return handle;
  } catch (const Error &) {
    throw;
  } catch (const std::exception &error) {
    thrown = std::string("a static constructor of it threw: ") + error.what();
  } catch (...) {
    thrown = "a static constructor of it threw";
  }
  half_made.insert(path);
  throw Error(CEED_ERROR_MAJOR, thrown);
}

/// Registers what an open library exports. Throws Error with the reason why it is refused.
void register_library(void *handle, const fs::path &path) {
  const auto entry = reinterpret_cast<CeedPluginEntry>(dlsym(handle, "ceed_plugin_v1"));
  require(entry != nullptr, CEED_ERROR_INCOMPATIBLE, "it does not export the symbol ceed_plugin_v1");
  const CeedPlugin *plugin = nullptr;
  try {
    plugin = entry();
  } catch (const std::exception &error) {
    throw Error(CEED_ERROR_MAJOR, std::string("it threw while loading: ") + error.what());
  } catch (...) {
    throw Error(CEED_ERROR_MAJOR, "it threw while loading");
  }
  require(plugin != nullptr, CEED_ERROR_INCOMPATIBLE, "ceed_plugin_v1() returned NULL");
  register_plugin(*plugin, path.string());
}

/// Opens a plugin and registers it. Throws Error with a message that names the file.
void load_plugin(const fs::path &path) {
  const std::lock_guard lock(registry_mutex());
  const auto refuse = [&](int code, const char *verdict, const char *reason) {
    const std::string message = text("Plugin '%s' %s: %s", path.c_str(), verdict, reason);
    record_refused(path.string(), message);
    throw Error(code, message);
  };
  if (const std::string reason = why_not_loadable(path); !reason.empty()) {
    refuse(CEED_ERROR_MINOR, "cannot be opened", reason.c_str());
  }
  // A plugin stays open for the whole process: its code may be referenced by any Ceed.
  void *handle = nullptr;
  try {
    handle = open_library(fs::absolute(path));
  } catch (const Error &error) {
    refuse(error.code(), "cannot be opened", error.what());
  }
  int code = CEED_ERROR_SUCCESS;
  std::string reason;
  try {
    register_library(handle, path);
  } catch (const Error &error) {
    code = error.code();
    reason = error.what();
  } catch (...) {
    dlclose(handle);
    throw;
  }
  if (code == CEED_ERROR_SUCCESS) return;
  dlclose(handle);  // not before an exception of a type of the plugin's own is gone
  refuse(code, "is refused", reason.c_str());
}

/// Loads a plugin of the search path. One bad plugin must not take the others away: say so and go on.
void load_or_complain(const fs::path &file, std::set<fs::path> &seen) {
  std::error_code ignored;
  if (!seen.insert(fs::weakly_canonical(file, ignored)).second) return;
  if (is_registered(file.string())) return;  // an earlier load ended half way
  try {
    load_plugin(file);
  } catch (const std::bad_alloc &) {
    throw;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "ceed: %s\n", error.what());
  }
}

void load_folder(const fs::path &folder, std::set<fs::path> &seen) {
  // Not by std::filesystem::directory_iterator: libstdc++'s ends the process where memory runs out.
  struct Close {
    void operator()(DIR *stream) const noexcept { closedir(stream); }
  };
  const std::unique_ptr<DIR, Close> stream(opendir(folder.c_str()));
  if (!stream) {
    if (errno == ENOMEM) throw std::bad_alloc();
    return;
  }
  std::vector<fs::path> files;
  while (const dirent *entry = readdir(stream.get())) {
    if (fs::path(entry->d_name).extension() == ".so") files.push_back(folder / entry->d_name);
  }
  std::sort(files.begin(), files.end());
  for (const auto &file : files) load_or_complain(file, seen);
}

/// ceed-plugins/ beside the core library: as it was found, and where links lead.
std::vector<fs::path> folders_beside_library() {
  std::vector<fs::path> folders;
  Dl_info info{};
  if (dladdr(reinterpret_cast<void *>(&load_plugins_in_search_path), &info) != 0 && info.dli_fname != nullptr) {
    const fs::path library = info.dli_fname;
    std::error_code ignored;
    folders.push_back(library.parent_path() / "ceed-plugins");
    const fs::path real = fs::weakly_canonical(library, ignored).parent_path() / "ceed-plugins";
    if (!ignored && real != folders.front()) folders.push_back(real);
  }
  return folders;
}

}  // namespace

void load_plugins_in_search_path() {
  std::set<fs::path> seen;
  for (const auto &folder : folders_beside_library()) load_folder(folder, seen);
  const char *variable = std::getenv("CEED_PLUGIN_PATH");
  std::string_view rest = variable != nullptr ? variable : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    const fs::path entry = rest.substr(0, colon);
    rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
    std::error_code ignored;
    if (entry.empty()) continue;
    if (fs::is_directory(entry, ignored)) {
      load_folder(entry, seen);
    } else if (fs::exists(entry, ignored)) {
      load_or_complain(entry, seen);
    } else {
      std::fprintf(stderr, "ceed: CEED_PLUGIN_PATH has '%s', which is neither a folder nor a plugin\n", entry.c_str());
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
