/// Backends on devices of HIP.
#include <iterator>

#include "../gpu/vendor_backend.hpp"
#include "vendor.hpp"

namespace hg::hip {

namespace {

constexpr CeedBackend backends[] = {gpu::backend_of<vendor, true>("/gpu/hip/gen"),
                                    gpu::backend_of<vendor, false>("/gpu/hip/ref")};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "hip",
                            .num_backends = std::size(backends),
                            .backends = backends};

}  // namespace

}  // namespace hg::hip

const CeedPlugin *ceed_plugin_v1() {
  return &hg::hip::plugin;
}
