/* The smallest backend: all that it does, its parent does. */
#include <ceed/plugin.h>

static int init(Ceed ceed, const char *options, CeedBackendOps *ops) {
  (void)ceed;
  (void)options;
  (void)ops; /* a copy of the parent's tables: changed entries are ours */
  return CEED_ERROR_SUCCESS;
}

static const CeedBackend backends[] = {{
    .resource = "/cpu/self/first",
    .parent = "/cpu/self/ref/serial",
    .priority = 1000,
    .init = init,
}};

static const CeedPlugin plugin = {
    .size = sizeof(CeedPlugin),
    .api_version = CEED_PLUGIN_API_VERSION,
    .name = "first",
    .num_backends = sizeof backends / sizeof backends[0],
    .backends = backends,
};

const CeedPlugin *ceed_plugin_v1(void) { return &plugin; }
