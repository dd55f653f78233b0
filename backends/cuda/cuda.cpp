/// Backends on devices of CUDA.
#include "../gpu/tables.hpp"
#include "../host/access.hpp"
#include "vendor.hpp"

namespace hg::cuda {

namespace {

int init(Ceed ceed, const char *, CeedBackendOps *ops) {
  return host::wall(ceed, [&] { host::chk(gpu::init_stages(ceed, gpu::make_driver(vendor), ops)); });
}

int score(const char **reason) {
  return gpu::score_of(vendor, reason);
}

constexpr CeedBackend backend{.resource = "/gpu/cuda/ref",
                              .parent = "/cpu/self/ref/serial",
                              .priority = 20,
                              .aliases = nullptr,
                              .score = score,
                              .init = init};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "cuda",
                            .num_backends = 1,
                            .backends = &backend};

}  // namespace

}  // namespace hg::cuda

const CeedPlugin *ceed_plugin_v1() {
  return &hg::cuda::plugin;
}
