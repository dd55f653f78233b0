/// @file
/// What backends there are, and what each says of itself.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hg::info {

struct BackendInfo {
  std::string resource;
  std::string plugin;  ///< name of the plugin it came with
  std::string path;    ///< file of the plugin; "": part of the library
  std::string parent;  ///< resource whose tables it starts from; "": none
  std::vector<std::string> aliases;
  unsigned priority = 0;
  int score = 0;
  bool is_available = false;
  std::string reason;  ///< why it is not available
  // Of an open backend:
  std::string memory;                ///< preferred memory type
  bool host_memory_only = false, is_deterministic = false, has_streams = false;
  std::vector<std::string> changed;  ///< entries of its tables that are not its parent's
};

/// A plugin that was refused.
struct RefusedPlugin {
  std::string path, error;
};

struct BackendList {
  std::vector<BackendInfo> backends;  ///< preferred ones first
  std::vector<RefusedPlugin> refused;
};

/// Loads the plugins (those at `plugins` too), scores and opens each backend; in a process of its own, so that a backend
/// which ends the process is one that is not available.
BackendList list_backends(const std::vector<std::string> &plugins);

/// Where a request leads: the full name of the backend with the request's options, or why it leads nowhere.
struct Resolved {
  std::string resource;  ///< "": nowhere
  std::string error;
};
Resolved resolve(const std::string &request);

void print(const BackendList &list);
nlohmann::ordered_json to_json(const BackendList &list);
/// Version of the library and of its interface.
nlohmann::ordered_json library_json();
std::string library_text();

}  // namespace hg::info
