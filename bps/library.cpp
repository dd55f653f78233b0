#include "library.hpp"

#include <ceed.h>
#include <dlfcn.h>

#include <array>
#include <cstdlib>

#include "ceed_handles.hpp"

namespace hg::bps {

namespace {

/// Without a context to hold a message, an error of the library would end the process: ask for the code instead.
void return_errors_without_context() {
  setenv("CEED_ERROR_HANDLER", "return", 0);
}

}  // namespace

void check(Ceed ceed, int code) {
  if (code == CEED_ERROR_SUCCESS) return;
  const char *message = nullptr;
  if (ceed) CeedGetErrorMessage(ceed, &message);
  throw Error(message ? std::string(message) : "the library returned error code " + std::to_string(code));
}

Context open_ceed(const std::string &resource) {
  return_errors_without_context();
  Context context;
  if (CeedInit(resource.c_str(), context.out()) != CEED_ERROR_SUCCESS || !context) {
    std::string message = "ceed resource " + resource + ": no backend that works here; the library lists";
    for (const auto &name : registered_resources()) message += " " + name;
    throw Error(message);
  }
  CeedSetErrorHandler(context, CeedErrorStore);
  return context;
}

std::string resource_name(Ceed ceed) {
  const char *name = nullptr;
  check(ceed, CeedGetResource(ceed, &name));
  return name;
}

Vector make_vector(Ceed ceed, CeedSize length) {
  Vector vector;
  check(ceed, CeedVectorCreate(ceed, length, vector.out()));
  check(ceed, CeedVectorSetValue(vector, 0));
  return vector;
}

std::string library_version() {
  int major = 0, minor = 0, patch = 0;
  bool is_release = false;
  check(nullptr, CeedGetVersion(&major, &minor, &patch, &is_release));
  std::string version = std::to_string(major) + '.' + std::to_string(minor) + '.' + std::to_string(patch);
  const char *revision = nullptr;
  if (CeedGetGitVersion(&revision) == CEED_ERROR_SUCCESS && revision && *revision)
    version += std::string(" ") + revision;
  return version;
}

std::vector<std::string> registered_resources() {
  return_errors_without_context();
  check(nullptr, CeedRegisterAll());
  // A library stores name i at (*resources)[i]; some store it at resources[i][0]. Give room for both and read both.
  std::array<char *, 1024> slots{};
  std::array<char **, 1024> table{};
  for (std::size_t i = 0; i < table.size(); i++) table[i] = &slots[i];
  std::size_t count = 0;
  check(nullptr, CeedRegistryGetList(&count, table.data(), nullptr));
  std::vector<std::string> names;
  char **const list = table[0];
  const bool is_array = count < 2 || !slots[1];
  for (std::size_t i = 0; i < count; i++) {
    const char *name = i == 0 || is_array ? list[i] : slots[i];
    if (name) names.emplace_back(name);
  }
  if (list != &slots[0]) free(list);
  return names;
}

std::vector<std::string> usable_resources() {
  return_errors_without_context();
  std::vector<std::string> usable;
  for (const auto &name : registered_resources()) {
    // One catches misuse of arrays, one plays a device: their times mean nothing.
    if (name.find("/memcheck") != std::string::npos || name.rfind("/gpu/emu/", 0) == 0) continue;
    Context ceed;
    if (CeedInit(name.c_str(), ceed.out()) != CEED_ERROR_SUCCESS || !ceed) continue;
    if (resource_name(ceed) == name) usable.push_back(name);  // else another name of one that is listed as well
  }
  return usable;
}

std::optional<CeedOperatorMemory> operator_memory(Ceed ceed, CeedOperator op) {
  const auto get_memory =
      reinterpret_cast<decltype(&CeedOperatorGetMemory)>(dlsym(RTLD_DEFAULT, "CeedOperatorGetMemory"));
  if (get_memory == nullptr) return {};
  CeedOperatorMemory memory{};
  check(ceed, get_memory(op, &memory));
  return memory;
}

}  // namespace hg::bps
