/// @file
/// The tables of the backends that work on a device.
#pragma once

#include <ceed/plugin.h>

#include <memory>

#include "../host/access.hpp"
#include "driver.hpp"
#include "options.hpp"

namespace hg::gpu {

void fill_vector_ops(CeedVectorOps &ops);
void fill_restriction_ops(CeedElemRestrictionOps &ops);
void fill_basis_ops(CeedBasisOps &ops);
void fill_qfunction_ops(CeedQFunctionOps &ops, UserKernels user_kernels);
void fill_operator_ops(CeedOperatorOps &ops, bool is_fused);

/// Sets a Ceed up whose work is done in stages, a kernel each, on the device of `driver`: the backends .../ref; or,
/// with is_fused, with operators that are one kernel where that is possible: the backends .../gen. `ops` are those of
/// the reference, which does what is not taken here. Throws.
void init(Ceed ceed, std::shared_ptr<Driver> driver, bool is_fused, const Options &options, CeedBackendOps *ops);

/// A backend on a device, for a plugin's list.
constexpr CeedBackend on_device(const char *resource, unsigned priority, decltype(CeedBackend::score) score,
                                decltype(CeedBackend::init) init) {
  return {.resource = resource,
          .parent = "/cpu/self/ref/serial",
          .priority = priority,
          .aliases = nullptr,
          .score = score,
          .init = init};
}

/// What a backend keeps with an object, by the object's functions for that; made where there is none yet.
template <typename Kept, typename Object>
Kept &kept_with(Object object, int (*get)(Object, void *), int (*set)(Object, void *)) {
  Kept *kept = nullptr;
  host::chk(get(object, &kept));
  if (kept != nullptr) return *kept;
  auto made = std::make_unique<Kept>();
  host::chk(set(object, made.get()));
  return *made.release();
}

/// The tables of the reference.
const CeedBackendOps &parents_tables();

}  // namespace hg::gpu
