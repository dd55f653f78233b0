#include "backend_list.hpp"

#include <ceed/plugin.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "backend_tables.hpp"
#include "child.hpp"

namespace hg::info {

namespace {

using Json = nlohmann::ordered_json;

/// The first line of the message kept for errors without a Ceed, without the place in the source.
std::string stored_message() {
  const char *kept = nullptr;
  CeedGetErrorMessage(nullptr, &kept);
  std::string message = kept != nullptr ? kept : "";
  message.resize(std::min(message.size(), message.find("\nAvailable backend resources:")));
  if (const auto place = message.find("(): "); place != std::string::npos) message.erase(0, place + 4);
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

/// An open backend.
class Open {
 public:
  explicit Open(const std::string &resource) {
    ::setenv("CEED_ERROR_HANDLER", "store", 1);
    if (CeedInit(resource.c_str(), &ceed_) != 0) throw std::runtime_error(stored_message());
  }
  Open(const Open &) = delete;
  Open &operator=(const Open &) = delete;
  ~Open() { CeedDestroy(&ceed_); }
  operator Ceed() const { return ceed_; }
  const CeedBackendOps &ops() const {
    const CeedBackendOps *ops = nullptr;
    if (CeedGetBackendOps(ceed_, &ops) != 0) throw std::runtime_error("the tables cannot be read");
    return *ops;
  }

 private:
  Ceed ceed_ = nullptr;
};

/// Scores and opens a backend; for a child process.
Json examine(const CeedBackend &backend) {
  Json found = {{"score", 1}, {"is_available", false}, {"reason", ""}};
  try {
    if (backend.score != nullptr) {
      const char *reason = nullptr;
      found["score"] = 0;
      const int score = backend.score(&reason);
      found["score"] = score;
      if (score <= 0) {
        found["reason"] = reason != nullptr && *reason != '\0' ? reason : "its score is 0, without a reason";
        return found;
      }
    }
    const Open ceed(backend.resource);
    CeedMemType memory = CEED_MEM_HOST;
    bool is_deterministic = false;
    CeedGetPreferredMemType(ceed, &memory);
    CeedIsDeterministic(ceed, &is_deterministic);
    found["memory"] = CeedMemTypes[memory];
    found["is_deterministic"] = is_deterministic;
    found["host_memory_only"] = ceed.ops().host_memory_only;
    found["has_streams"] = ceed.ops().ceed_set_stream != nullptr;
    if (backend.parent != nullptr) {
      const Open parent(backend.parent);
      found["changed"] = changed_entries(ceed.ops(), parent.ops());
    }
    found["is_available"] = true;
  } catch (const std::exception &error) {
    found["reason"] = error.what();
  } catch (...) {
    found["reason"] = "it threw";
  }
  return found;
}

BackendInfo describe(const CeedPluginInfo &plugin, const CeedBackend &backend) {
  BackendInfo info;
  info.resource = backend.resource;
  info.plugin = plugin.plugin->name;
  info.path = plugin.path;
  info.parent = backend.parent != nullptr ? backend.parent : "";
  for (const char *const *alias = backend.aliases; alias != nullptr && *alias != nullptr; alias++) {
    info.aliases.emplace_back(*alias);
  }
  info.priority = backend.priority;
  const Ended ended = in_child([&] {
    return examine(backend).dump(-1, ' ', false, Json::error_handler_t::replace);
  });
  const Json found = ended.is_fine() ? Json::parse(ended.printed, nullptr, false) : Json();
  if (!found.is_object()) {
    info.reason = ended.signal != 0 ? "opening it ended the process by " + name_of_signal(ended.signal)
                                    : fmt::format("opening it ended the process with exit status {}", ended.exit_status);
    return info;
  }
  info.score = found.value("score", 0);
  info.is_available = found.value("is_available", false);
  info.reason = found.value("reason", "");
  info.memory = found.value("memory", "");
  info.host_memory_only = found.value("host_memory_only", false);
  info.is_deterministic = found.value("is_deterministic", false);
  info.has_streams = found.value("has_streams", false);
  info.changed = found.value("changed", std::vector<std::string>{});
  return info;
}

std::string features_of(const BackendInfo &info) {
  std::vector<std::string> features{info.memory + " memory" + (info.host_memory_only ? " only" : "")};
  features.emplace_back(info.is_deterministic ? "deterministic" : "sums in any order");
  if (info.has_streams) features.emplace_back("streams");
  return fmt::format("{}", fmt::join(features, ", "));
}

}  // namespace

BackendList list_backends(const std::vector<std::string> &plugins) {
  for (const std::string &plugin : plugins) {
    if (CeedPluginLoad(plugin.c_str()) != 0) throw std::runtime_error(CeedPluginLoadError());
  }
  std::size_t count = 0;
  CeedPluginInfo *found = nullptr;
  if (CeedPluginGetList(&count, &found) != 0) throw std::runtime_error("the list of plugins cannot be read");
  const std::unique_ptr<CeedPluginInfo, void (*)(void *)> owner(found, std::free);
  BackendList list;
  for (const CeedPluginInfo *plugin = found; plugin != found + count; plugin++) {
    if (plugin->plugin == nullptr) {
      list.refused.push_back({plugin->path, plugin->error});
      continue;
    }
    for (std::size_t i = 0; i < plugin->plugin->num_backends; i++) {
      list.backends.push_back(describe(*plugin, plugin->plugin->backends[i]));
    }
  }
  std::stable_sort(list.backends.begin(), list.backends.end(), [](const auto &a, const auto &b) {
    return a.is_available != b.is_available ? a.is_available : a.priority < b.priority;
  });
  return list;
}

Resolved resolve(const std::string &request) {
  const Ended ended = in_child([&]() -> std::string {
    try {
      const Open ceed(request);
      const char *resource = nullptr;
      if (CeedGetResource(ceed, &resource) != 0) return "!it has no name";
      const auto colon = request.find(':');
      return resource + (colon != std::string::npos ? request.substr(colon) : "");
    } catch (const std::exception &error) {
      return std::string("!") + error.what();
    }
  });
  if (ended.signal != 0) return {"", "opening it ended the process by " + name_of_signal(ended.signal)};
  if (ended.exit_status != 0 || ended.printed.empty()) return {"", "opening it ended the process"};
  if (ended.printed.front() == '!') return {"", ended.printed.substr(1)};
  return {ended.printed, ""};
}

std::string library_text() {
  const Json library = library_json();
  return fmt::format("Honeyguide {}, interface {}, revision {}", library["version"].get<std::string>(),
                     library["interface"].get<std::string>(), library["revision"].get<std::string>());
}

Json library_json() {
  int major = 0, minor = 0, patch = 0;
  const char *revision = nullptr;
  CeedGetVersion(&major, &minor, &patch, nullptr);
  CeedGetGitVersion(&revision);
  return {{"version", HG_VERSION},
          {"interface", fmt::format("{}.{}.{}", major, minor, patch)},
          {"revision", revision != nullptr ? revision : ""}};
}

void print(const BackendList &list) {
  fmt::print("{}\n", library_text());
  for (const BackendInfo &info : list.backends) {
    fmt::print("\n{}\n", info.resource);
    if (!info.is_available) fmt::print("  not available  {}\n", info.reason);
    fmt::print("  priority {}, score {}, plugin {} ({})\n", info.priority, info.score, info.plugin,
               info.path.empty() ? "part of the library" : info.path);
    if (!info.aliases.empty()) fmt::print("  also asked for as {}\n", fmt::join(info.aliases, ", "));
    if (info.is_available) fmt::print("  {}\n", features_of(info));
    if (info.is_available && !info.parent.empty()) {
      fmt::print("  its own: {}; the rest from {}\n", info.changed.empty() ? "nothing" : in_short(info.changed),
                 info.parent);
    }
  }
  if (!list.refused.empty()) fmt::print("\nRefused:\n");
  for (const RefusedPlugin &refused : list.refused) fmt::print("  {}\n", refused.error);
}

Json to_json(const BackendList &list) {
  Json backends = Json::array(), refused = Json::array();
  for (const BackendInfo &info : list.backends) {
    Json entry = {{"resource", info.resource}, {"plugin", info.plugin},       {"path", info.path},
                  {"parent", info.parent},     {"aliases", info.aliases},     {"priority", info.priority},
                  {"score", info.score},       {"available", info.is_available}};
    if (info.is_available) {
      entry["features"] = {{"memory", info.memory},
                           {"host_memory_only", info.host_memory_only},
                           {"deterministic", info.is_deterministic},
                           {"streams", info.has_streams}};
      entry["changed"] = info.changed;
    } else {
      entry["reason"] = info.reason;
    }
    backends.push_back(entry);
  }
  for (const RefusedPlugin &plugin : list.refused) refused.push_back({{"path", plugin.path}, {"error", plugin.error}});
  return {{"library", library_json()}, {"backends", backends}, {"refused", refused}};
}

}  // namespace hg::info
