// A good plugin: everything is the reference's, but operators count their applications before they delegate, and the
// options of the resource are kept.
#include <ceed/plugin.h>

#include <atomic>
#include <cstdio>
#include <cstring>

namespace {

CeedBackendOps parent;
std::atomic<int> num_applications = 0;
char last_options[64] = "";

int apply_add(CeedOperator op, const CeedProgram *program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  num_applications++;
  return parent.op.apply_add(op, program, in, out, mode);
}

int init(Ceed, const char *options, CeedBackendOps *ops) {
  parent = *ops;
  ops->op.apply_add = apply_add;
  std::snprintf(last_options, sizeof last_options, "%s", options);
  return CEED_ERROR_SUCCESS;
}

const char *const aliases[] = {"/test/alias of delegate", nullptr};
const CeedBackend backends[] = {{.resource = "/test/delegate",
                                 .parent = "/cpu/self/ref/serial",
                                 .priority = 1000,
                                 .aliases = aliases,
                                 .score = nullptr,
                                 .init = init}};
const CeedPlugin plugin = {.size = sizeof(CeedPlugin),
                           .api_version = CEED_PLUGIN_API_VERSION,
                           .name = "delegate",
                           .num_backends = 1,
                           .backends = backends};

}  // namespace

const CeedPlugin *ceed_plugin_v1(void) {
  return &plugin;
}

CEED_EXTERN int delegate_num_applications(void);
int delegate_num_applications(void) {
  return num_applications;
}
CEED_EXTERN const char *delegate_last_options(void);
const char *delegate_last_options(void) {
  return last_options;
}
