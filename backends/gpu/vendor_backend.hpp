/// @file
/// The backends of a vendor.
#pragma once

#include "../host/access.hpp"
#include "tables.hpp"
#include "vendor.hpp"

namespace hg::gpu {

/// Preferred to those on the host by whoever asks for any, the one whose operators are one kernel before the other.
template <const Vendor &vendor, bool is_fused>
constexpr CeedBackend backend_of(const char *resource) {
  constexpr unsigned priority = is_fused ? 15 : 20;
  return on_device(
      resource, priority, [](const char **reason) { return score_of(vendor, reason); },
      [](Ceed ceed, const char *text, CeedBackendOps *ops) {
        return host::wall(ceed, [&] {
          const Options options = parse_options(text);
          init(ceed, make_driver(vendor, options.device_id), is_fused, options, ops);
        });
      });
}

}  // namespace hg::gpu
