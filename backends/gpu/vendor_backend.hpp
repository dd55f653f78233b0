/// @file
/// The backends of a vendor.
#pragma once

#include "../host/access.hpp"
#include "tables.hpp"
#include "vendor.hpp"

namespace hg::gpu {

/// Preferred to those on the host by whoever asks for any, the one whose operators are one kernel before the other.
template <const Vendor &vendor>
constexpr CeedBackend stages_of(const char *resource) {
  constexpr unsigned priority = 20;
  return on_device(
      resource, priority, [](const char **reason) { return score_of(vendor, reason); },
      [](Ceed ceed, const char *, CeedBackendOps *ops) {
        return host::wall(ceed, [&] { host::chk(init_stages(ceed, make_driver(vendor), ops)); });
      });
}
template <const Vendor &vendor>
constexpr CeedBackend fused_of(const char *resource) {
  constexpr unsigned priority = 15;
  return on_device(
      resource, priority, [](const char **reason) { return score_of(vendor, reason); },
      [](Ceed ceed, const char *options, CeedBackendOps *ops) {
        return host::wall(ceed, [&] { host::chk(init_fused(ceed, make_driver(vendor), options, ops)); });
      });
}

}  // namespace hg::gpu
