/// @file
/// The backends of a vendor.
#pragma once

#include "../host/access.hpp"
#include "tables.hpp"
#include "vendor.hpp"

namespace hg::gpu {

/// The one in stages; preferred to those on the host by whoever asks for any.
template <const Vendor &vendor>
constexpr CeedBackend stages_of(const char *resource) {
  constexpr unsigned priority = 20;
  return stages(
      resource, priority, [](const char **reason) { return score_of(vendor, reason); },
      [](Ceed ceed, const char *, CeedBackendOps *ops) {
        return host::wall(ceed, [&] { host::chk(init_stages(ceed, make_driver(vendor), ops)); });
      });
}

}  // namespace hg::gpu
