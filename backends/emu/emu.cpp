/// Backends on a device that is none, for tests of what is compiled for devices.
#include <iterator>

#include "../gpu/tables.hpp"
#include "../host/access.hpp"
#include "../jit/compiler.hpp"
#include "emulator.hpp"

namespace hg::emu {

namespace {

template <bool is_fused>
int init(Ceed ceed, const char *options, CeedBackendOps *ops) {
  return host::wall(ceed, [&] {
    const Options parsed = parse(options);
    gpu::init(ceed, std::make_shared<Emulator>(parsed), is_fused, parsed.device, ops);
  });
}

int score(const char **reason) {
  static const std::string why = [] {
    try {
      jit::Compiler::find();
      return std::string();
    } catch (const jit::NotCompiled &error) {
      return std::string(error.what());
    }
  }();
  if (why.empty()) return 1;
  *reason = why.c_str();
  return 0;
}

constexpr CeedBackend backends[] = {gpu::on_device("/gpu/emu/ref", CEED_MAX_BACKEND_PRIORITY, score, init<false>),
                                    gpu::on_device("/gpu/emu/gen", CEED_MAX_BACKEND_PRIORITY, score, init<true>)};

constexpr CeedPlugin plugin{.size = sizeof(CeedPlugin),
                            .api_version = CEED_PLUGIN_API_VERSION,
                            .name = "emu",
                            .num_backends = std::size(backends),
                            .backends = backends};

}  // namespace

}  // namespace hg::emu

const CeedPlugin *ceed_plugin_v1() {
  return &hg::emu::plugin;
}
