// A backend that replaces every entry of its tables. It opens, and nothing more.
#include <ceed/plugin.h>

#include <cstddef>
#include <cstring>

namespace {

int fails() {
  return CEED_ERROR_BACKEND;
}

int init(Ceed, const char *, CeedBackendOps *ops) {
  // From the first function to the end there is nothing but functions.
  int (*function)() = fails;
  auto *bytes = reinterpret_cast<unsigned char *>(ops);
  for (std::size_t offset = offsetof(CeedBackendOps, ceed_destroy); offset < sizeof *ops; offset += sizeof function) {
    std::memcpy(bytes + offset, &function, sizeof function);
  }
  ops->ceed_destroy = nullptr;
  return CEED_ERROR_SUCCESS;
}

const CeedBackend backends[] = {{"/test/everything", "/cpu/self/ref/serial", 900, nullptr, nullptr, init}};
const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "everything", 1, backends};

}  // namespace

const CeedPlugin *ceed_plugin_v1(void) {
  return &plugin;
}
