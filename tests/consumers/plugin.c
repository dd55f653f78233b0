/* A plugin outside of the tree, in C: a backend that does as its parent does. */
#include <ceed/plugin.h>

static int score(const char **reason) {
  *reason = "";
  return 1;
}

static int init(Ceed ceed, const char *options, CeedBackendOps *ops) {
  (void)ceed;
  (void)options;
  return ops->op.apply_add ? CEED_ERROR_SUCCESS : CEED_ERROR_BACKEND; /* the parent's tables are there */
}

static const CeedBackend backends[] = {{.resource = "/outside/of the tree",
                                        .parent = "/cpu/self/ref/serial",
                                        .priority = 100,
                                        .aliases = NULL,
                                        .score = score,
                                        .init = init}};
static const CeedPlugin plugin = {.size = sizeof(CeedPlugin),
                                  .api_version = CEED_PLUGIN_API_VERSION,
                                  .name = "outside",
                                  .num_backends = 1,
                                  .backends = backends};

const CeedPlugin *ceed_plugin_v1(void) { return &plugin; }
