/// Backends on devices of HIP.
#include "../gpu/vendor_backend.hpp"
#include "vendor.hpp"

namespace hg::hip {

namespace {

constexpr CeedBackend backend = gpu::stages_of<vendor>("/gpu/hip/ref");

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "hip",
                            .num_backends = 1,
                            .backends = &backend};

}  // namespace

}  // namespace hg::hip

const CeedPlugin *ceed_plugin_v1() {
  return &hg::hip::plugin;
}
