/// @file
/// The list of backends: built-in and loaded, found by prefix and priority.
#pragma once

#include <ceed/plugin.h>

#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace hg {

/// A resource name under which a backend can be asked for.
struct RegistryEntry {
  const char *resource = nullptr;        ///< an alias or the backend's own name; the plugin keeps the text
  const CeedBackend *backend = nullptr;
  const char *plugin = nullptr;          ///< name of the plugin it came with
};

/// What became of a plugin.
struct PluginRecord {
  std::string path;                    ///< its file; "": part of the library or of the program
  const CeedPlugin *plugin = nullptr;  ///< NULL: refused
  std::string error;                   ///< why it was refused
};

/// Of the registry, of loading plugins and of opening backends: one at a time. Recursive, as a plugin's entry may load
/// another plugin and a backend's init may open another Ceed.
std::recursive_mutex &registry_mutex();
/// All entries as they are now; loads the plugins on first use.
std::vector<RegistryEntry> registry();
/// Adds the backends of a plugin and records it with its file. Throws if its version or a name in it does not fit; then
/// nothing is added.
void register_plugin(const CeedPlugin &plugin, std::string path);
/// Keeps why a plugin was refused, for the life of the process.
void record_refused(std::string path, std::string error);
/// Whether a plugin of the file is registered.
bool is_registered(std::string_view path);
/// The backend for a request: those whose name begins with it, in whole components ("/cpu/self" is a beginning of
/// "/cpu/self/ref/serial", "/cpu/self/re" is not); of these one with a positive score and the lowest priority. Names
/// that only libCEED has lead to the nearest of ours. Throws CEED_ERROR_MAJOR with the list of resources where none
/// fits: a misspelt name must not open another backend.
const CeedBackend &find_backend(std::string_view request);
/// Prints the version and the resources that can be asked for.
void print_resources(FILE *stream);
/// The backend with this very name, own name only. Throws where there is none.
const CeedBackend &backend_named(std::string_view resource);
/// Score of the backend on this machine; `reason` says why it is 0. A score that throws is 0.
int score_of(const CeedBackend &backend, std::string &reason);
/// Tables of a backend: its ancestors' inits are applied in turn to `ceed`.
void fill_tables(Ceed ceed, const CeedBackend &backend, const char *options);

/// Entries of the plugins that are part of the library (made by CMake from ceed_add_backend()).
std::vector<CeedPluginEntry> built_in_plugins();
/// Loads every plugin library in the search path: beside the core library, then CEED_PLUGIN_PATH.
void load_plugins_in_search_path();

}  // namespace hg
