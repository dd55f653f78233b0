/// Backends on devices of CUDA.
#include <iterator>

#include "../gpu/vendor_backend.hpp"
#include "vendor.hpp"

namespace hg::cuda {

namespace {

constexpr CeedBackend backends[] = {gpu::backend_of<vendor, true>("/gpu/cuda/gen"),
                                    gpu::backend_of<vendor, false>("/gpu/cuda/ref")};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "cuda",
                            .num_backends = std::size(backends),
                            .backends = backends};

}  // namespace

}  // namespace hg::cuda

const CeedPlugin *ceed_plugin_v1() {
  return &hg::cuda::plugin;
}
