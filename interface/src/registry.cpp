#include "registry.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <list>
#include <mutex>

#include "ceed.hpp"

namespace hg {

namespace {

struct Registry {
  bool is_loaded = false;
  std::vector<RegistryEntry> entries;
  std::list<PluginRecord> plugins;  ///< only grows: CeedPluginGetList() gives out addresses of its strings
};

Registry &the_registry() {
  static Registry registry;
  return registry;
}

/// Whether `name` is `prefix`, or goes on after it with another component.
bool starts_with_components(std::string_view name, std::string_view prefix) {
  if (name.substr(0, prefix.size()) != prefix) return false;
  return name.size() == prefix.size() || name[prefix.size()] == '/';
}

/// Names that only libCEED has, or that are ours where their plugin is built, lead to the nearest of ours: their users'
/// scripts run. The target is a request, not a backend: it resolves to whatever is there. Empty for other names.
std::string_view nearest_of_ours(std::string_view request) {
  if (request.empty()) return {};
  static const std::pair<std::string_view, std::string_view> foreign[] = {
      {"/cpu/self/opt/serial", "/cpu/self"},        {"/cpu/self/opt/blocked", "/cpu/self"},
      {"/cpu/self/avx/serial", "/cpu/self"},        {"/cpu/self/avx/blocked", "/cpu/self"},
      {"/cpu/self/xsmm/serial", "/cpu/self"},       {"/cpu/self/xsmm/blocked", "/cpu/self"},
      {"/cpu/self/ref/blocked", "/cpu/self/ref"},
      {"/cpu/self/memcheck/blocked", "/cpu/self/memcheck"}, {"/gpu/cuda/shared", "/gpu/cuda"},
      {"/gpu/cuda/magma/det", "/gpu/cuda"},         {"/gpu/hip/shared", "/gpu/hip"},
      {"/gpu/hip/magma/det", "/gpu/hip"},
  };
  for (const auto &[theirs, ours] : foreign) {
    if (starts_with_components(theirs, request)) return ours;
  }
  return {};
}

/// The resource that shares most characters with the request; NULL where none shares more than the first.
const char *closest(std::string_view request, const std::vector<RegistryEntry> &entries) {
  std::size_t longest = 1;
  const char *found = nullptr;
  for (const auto &entry : entries) {
    const std::string_view name = entry.resource;
    const auto end = std::mismatch(request.begin(), request.end(), name.begin(), name.end()).first;
    const auto shared = static_cast<std::size_t>(end - request.begin());
    if (shared > longest) longest = shared, found = entry.resource;
  }
  return found;
}

/// Checks that a backend and its ancestors have filled all entries that are not optional.
void require_complete(const CeedBackendOps &ops, const CeedBackend &backend) {
  const std::pair<bool, const char *> entries[] = {
      {ops.vector.create, "vector.create"},
      {ops.vector.destroy, "vector.destroy"},
      {ops.vector.set_array, "vector.set_array"},
      {ops.vector.take_array, "vector.take_array"},
      {ops.vector.sync_array, "vector.sync_array"},
      {ops.vector.get_array, "vector.get_array"},
      {ops.vector.get_array_read, "vector.get_array_read"},
      {ops.vector.get_array_write, "vector.get_array_write"},
      {ops.vector.has_valid_array, "vector.has_valid_array"},
      {ops.vector.has_borrowed_array, "vector.has_borrowed_array"},
      {ops.restriction.apply, "restriction.apply"},
      {ops.basis.apply, "basis.apply"},
      {ops.basis.apply_at_points, "basis.apply_at_points"},
      {ops.qfunction.apply, "qfunction.apply"},
      {ops.op.apply_add, "op.apply_add"},
      {ops.op.linear_assemble_qfunction, "op.linear_assemble_qfunction"},
  };
  for (const auto &entry : entries) {
    require(entry.first, CEED_ERROR_MAJOR, [&] {
      return text("Backend does not implement %s, which is not optional (%s)", entry.second, backend.resource);
    });
  }
}

/// The records as they are now.
std::vector<const PluginRecord *> recorded_plugins() {
  Registry &registry = the_registry();
  const std::lock_guard lock(registry_mutex());
  std::vector<const PluginRecord *> records;
  for (const auto &record : registry.plugins) records.push_back(&record);
  return records;
}

std::string resource_list() {
  std::string list;
  for (const auto &entry : registry()) list += std::string("\n  ") + entry.resource;
  return list;
}

}  // namespace

std::recursive_mutex &registry_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

std::vector<RegistryEntry> registry() {
  Registry &registry = the_registry();
  const std::lock_guard lock(registry_mutex());
  if (!registry.is_loaded) {
    registry.is_loaded = true;  // before it is so: a plugin may load another one
    try {
      for (const CeedPluginEntry entry : built_in_plugins()) {
        const CeedPlugin *plugin = entry();
        const bool is_known = std::any_of(registry.plugins.begin(), registry.plugins.end(),
                                          [&](const PluginRecord &known) { return known.plugin == plugin; });
        if (!is_known) register_plugin(*plugin, "");
      }
      load_plugins_in_search_path();
    } catch (...) {  // memory has run out: the next call goes on from here
      registry.is_loaded = false;
      throw;
    }
  }
  return registry.entries;
}

void record_refused(std::string path, std::string error) {
  Registry &registry = the_registry();
  const std::lock_guard lock(registry_mutex());
  const bool is_known = std::any_of(registry.plugins.begin(), registry.plugins.end(), [&](const PluginRecord &known) {
    return known.path == path && known.plugin == nullptr && known.error == error;
  });
  if (!is_known) registry.plugins.push_back({std::move(path), nullptr, std::move(error)});
}

bool is_registered(std::string_view path) {
  Registry &registry = the_registry();
  const std::lock_guard lock(registry_mutex());
  return std::any_of(registry.plugins.begin(), registry.plugins.end(), [&](const PluginRecord &known) {
    return known.path == path && known.plugin != nullptr;
  });
}

void register_plugin(const CeedPlugin &plugin, std::string path) {
  require(plugin.api_version == CEED_PLUGIN_API_VERSION, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("Plugin '%s' is for plugin API version %u; this library has version %u", plugin.name,
                plugin.api_version, CEED_PLUGIN_API_VERSION);
  });
  require(plugin.size >= sizeof(CeedPlugin), CEED_ERROR_INCOMPATIBLE, [&] {
    return text("Plugin '%s' describes itself in %zu bytes; expected at least %zu", plugin.name, plugin.size,
                sizeof(CeedPlugin));
  });
  require(plugin.name != nullptr, CEED_ERROR_INCOMPATIBLE, "a plugin has no name");
  require(plugin.backends != nullptr || plugin.num_backends == 0, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("Plugin '%s' counts %zu backends and has a NULL list of them", plugin.name, plugin.num_backends);
  });
  Registry &registry = the_registry();
  const std::lock_guard lock(registry_mutex());
  std::vector<RegistryEntry> entries = registry.entries;
  const auto add = [&](const char *resource, const CeedBackend &backend) {
    require(resource != nullptr && resource[0] == '/', CEED_ERROR_MINOR, [&] {
      return text("Plugin '%s' names a resource '%s'; expected one that starts with '/'", plugin.name,
                  resource != nullptr ? resource : "(null)");
    });
    for (const auto &entry : entries) {
      require(std::strcmp(entry.resource, resource) != 0, CEED_ERROR_MINOR, [&] {
        return text("Resource '%s' of plugin '%s' is there already, from plugin '%s'", resource, plugin.name,
                    entry.plugin);
      });
    }
    entries.push_back({resource, &backend, plugin.name});
  };
  for (std::size_t i = 0; i < plugin.num_backends; i++) {
    const CeedBackend &backend = plugin.backends[i];
    require(backend.init != nullptr, CEED_ERROR_MINOR,
            [&] { return text("Backend '%s' of plugin '%s' has no init", backend.resource, plugin.name); });
    add(backend.resource, backend);
    for (const char *const *alias = backend.aliases; alias != nullptr && *alias != nullptr; alias++) add(*alias, backend);
  }
  std::list<PluginRecord> record;
  record.push_back({std::move(path), &plugin, ""});
  registry.entries = std::move(entries);
  registry.plugins.splice(registry.plugins.end(), record);
}

int score_of(const CeedBackend &backend, std::string &reason) {
  if (backend.score == nullptr) return 1;
  try {
    const char *why = nullptr;
    const int score = backend.score(&why);
    reason = why != nullptr ? why : "";
    return score;
  } catch (const std::exception &error) {
    reason = std::string("its score threw: ") + error.what();
  } catch (...) {
    reason = "its score threw";
  }
  return 0;
}

const CeedBackend &find_backend(std::string_view request) {
  const auto entries = registry();
  std::string unavailable;
  for (const std::string_view wanted : {request, nearest_of_ours(request)}) {
    if (wanted.empty()) continue;
    const CeedBackend *best = nullptr;
    const auto is_taken_last = [](const RegistryEntry &entry) {
      return entry.backend->priority == CEED_MAX_BACKEND_PRIORITY;
    };
    const bool has_others = std::any_of(entries.begin(), entries.end(), [&](const RegistryEntry &entry) {
      return starts_with_components(entry.resource, wanted) && !is_taken_last(entry);
    });
    for (const auto &entry : entries) {
      if (!starts_with_components(entry.resource, wanted) || (has_others && is_taken_last(entry))) continue;
      std::string reason;
      if (score_of(*entry.backend, reason) <= 0) {
        const std::string line = std::string("\n  ") + entry.resource + " is not available on this machine: " + reason;
        if (unavailable.find(line) == std::string::npos) unavailable += line;
        continue;
      }
      if (best == nullptr || entry.backend->priority < best->priority) best = entry.backend;
    }
    if (best != nullptr) return *best;
  }
  const char *near = closest(request, entries);
  throw Error(CEED_ERROR_MAJOR, text("No suitable backend: %.*s%s%s%s\nAvailable backend resources:%s",
                                     static_cast<int>(request.size()), request.data(), unavailable.c_str(),
                                     near != nullptr ? "\nClosest match: " : "", near != nullptr ? near : "",
                                     resource_list().c_str()));
}

void print_resources(FILE *stream) {
  std::fprintf(stream, "Honeyguide, interface version %d.%d.%d\nAvailable backend resources:%s\n", CEED_VERSION_MAJOR,
               CEED_VERSION_MINOR, CEED_VERSION_PATCH, resource_list().c_str());
}

const CeedBackend &backend_named(std::string_view resource) {
  for (const auto &entry : registry()) {
    if (resource == entry.backend->resource) return *entry.backend;
  }
  throw Error(CEED_ERROR_MAJOR, text("No backend has the name '%.*s'\nAvailable backend resources:%s",
                                     static_cast<int>(resource.size()), resource.data(), resource_list().c_str()));
}

void fill_tables(Ceed ceed, const CeedBackend &backend, const char *options) {
  const std::lock_guard lock(registry_mutex());  // one init at a time, which may open another Ceed
  // From the backend to its oldest ancestor.
  std::vector<const CeedBackend *> line{&backend};
  while (line.back()->parent != nullptr) {
    line.push_back(&backend_named(line.back()->parent));
    require(std::find(line.begin(), line.end() - 1, line.back()) == line.end() - 1, CEED_ERROR_MAJOR, [&] {
      std::string circle;
      for (const CeedBackend *ancestor : line) circle += (circle.empty() ? "" : " -> ") + std::string(ancestor->resource);
      return text("Backend '%s' is its own ancestor: %s", backend.resource, circle.c_str());
    });
  }
  for (auto ancestor = line.rbegin(); ancestor != line.rend(); ++ancestor) {
    ceed->ops.size = sizeof(CeedBackendOps);
    ceed->ops.api_version = CEED_PLUGIN_API_VERSION;
    check((*ancestor)->init(ceed, *ancestor == &backend ? options : "", &ceed->ops));
  }
  require_complete(ceed->ops, backend);
}

}  // namespace hg

int CeedRegistryGetList(size_t *n, char ***const resources, CeedInt **array) {
  return hg::guard(nullptr, [&] {
    const auto entries = hg::registry();
    hg::result(n, "n") = entries.size();
    char **names = nullptr;
    CeedInt *priorities = nullptr;
    if (resources != nullptr) {
      names = static_cast<char **>(std::malloc(entries.size() * sizeof(char *)));
      if (names == nullptr) throw std::bad_alloc();
      for (std::size_t i = 0; i < entries.size(); i++) names[i] = const_cast<char *>(entries[i].resource);
    }
    if (array != nullptr) {
      priorities = static_cast<CeedInt *>(std::malloc(entries.size() * sizeof(CeedInt)));
      if (priorities == nullptr) {
        std::free(names);
        throw std::bad_alloc();
      }
      for (std::size_t i = 0; i < entries.size(); i++) {
        priorities[i] = static_cast<CeedInt>(entries[i].backend->priority);
      }
    }
    if (resources != nullptr) *resources = names;
    if (array != nullptr) *array = priorities;
  });
}

int CeedRegisterAll(void) {
  return hg::guard(nullptr, [] { hg::registry(); });
}

int CeedPluginRegister(const CeedPlugin *plugin) {
  return hg::guard(nullptr, [&] {
    hg::require(plugin != nullptr, CEED_ERROR_MINOR, "Plugin is NULL; expected a description");
    hg::registry();
    hg::register_plugin(*plugin, "");
  });
}

int CeedPluginGetList(size_t *num_plugins, CeedPluginInfo **plugins) {
  return hg::guard(nullptr, [&] {
    hg::require(num_plugins != nullptr && plugins != nullptr, CEED_ERROR_MINOR,
                "Address of the list of plugins is NULL; expected where it goes");
    hg::registry();
    const auto records = hg::recorded_plugins();
    auto *list = static_cast<CeedPluginInfo *>(std::calloc(std::max<std::size_t>(records.size(), 1), sizeof(CeedPluginInfo)));
    if (list == nullptr) throw std::bad_alloc();
    *plugins = list;
    for (const auto &record : records) *list++ = {record->path.c_str(), record->plugin, record->error.c_str()};
    *num_plugins = records.size();
  });
}
