// Plugins that must be refused, one for each value of HG_BAD_PLUGIN.
#include <ceed/plugin.h>

#include <exception>
#include <stdexcept>

namespace {

[[maybe_unused]] int init(Ceed, const char *, CeedBackendOps *) {
  return CEED_ERROR_SUCCESS;
}
[[maybe_unused]] const CeedBackend backends[] = {{.resource = "/test/bad",
                                                  .parent = "/cpu/self/ref/serial",
                                                  .priority = 1,
                                                  .aliases = nullptr,
                                                  .score = nullptr,
                                                  .init = init}};

}  // namespace

#if HG_BAD_PLUGIN == 1  // another version

const CeedPlugin *ceed_plugin_v1(void) {
  static const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION + 41, "from the future", 1, backends};
  return &plugin;
}

#elif HG_BAD_PLUGIN == 2  // no symbol

CEED_EXTERN int something_else(void);
int something_else(void) {
  return 1;
}

#elif HG_BAD_PLUGIN == 3  // nothing to describe

const CeedPlugin *ceed_plugin_v1(void) {
  return nullptr;
}

#elif HG_BAD_PLUGIN == 4  // throws an exception of the standard library

const CeedPlugin *ceed_plugin_v1(void) {
  throw std::runtime_error("the device library is broken");
}

#elif HG_BAD_PLUGIN == 5  // throws something else

const CeedPlugin *ceed_plugin_v1(void) {
  throw 42;
}

#elif HG_BAD_PLUGIN == 6  // a name that is taken

const CeedPlugin *ceed_plugin_v1(void) {
  static const CeedBackend taken[] = {
      {.resource = "/test/new", .parent = nullptr, .priority = 1, .aliases = nullptr, .score = nullptr, .init = init},
      {.resource = "/cpu/self/ref/serial",
       .parent = nullptr,
       .priority = 1,
       .aliases = nullptr,
       .score = nullptr,
       .init = init}};
  static const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "a thief", 2, taken};
  return &plugin;
}

#elif HG_BAD_PLUGIN == 7  // throws a type whose code is in the plugin

namespace {
class OwnError : public std::exception {
 public:
  ~OwnError() override;
  const char *what() const noexcept override { return "an error of a type of the plugin's own"; }
};
OwnError::~OwnError() = default;
}  // namespace

const CeedPlugin *ceed_plugin_v1(void) {
  throw OwnError();
}

#elif HG_BAD_PLUGIN == 8  // a static constructor throws

namespace {
[[maybe_unused]] const int never_made = [] {
  throw std::runtime_error("no room for a table");
  return 1;
}();
}  // namespace

const CeedPlugin *ceed_plugin_v1(void) {
  static const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "half made", 1, backends};
  return &plugin;
}

#elif HG_BAD_PLUGIN == 9  // nameless

const CeedPlugin *ceed_plugin_v1(void) {
  static const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, nullptr, 1, backends};
  return &plugin;
}

#elif HG_BAD_PLUGIN == 10  // backends that are not there

const CeedPlugin *ceed_plugin_v1(void) {
  static const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "empty-handed", 3, nullptr};
  return &plugin;
}

#endif
