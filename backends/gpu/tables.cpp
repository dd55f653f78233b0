#include "tables.hpp"

#include <memory>

#include "../host/access.hpp"
#include "device.hpp"

namespace hg::gpu {

using host::chk, host::wall;

namespace {

CeedBackendOps parents;

int destroy(Ceed ceed) {
  Device *device = nullptr;
  CeedCallBackend(CeedGetData(ceed, &device));
  delete device;
  return CEED_ERROR_SUCCESS;
}

int set_stream(Ceed ceed, void *handle) {
  return wall(ceed, [&] {
    Device &device = Device::of(ceed);
    const auto one_thread = device.lock();
    device.driver().set_stream(handle);
  });
}

int get_transfers(Ceed ceed, CeedTransfers *transfers) {
  return wall(ceed, [&] { *transfers = Device::of(ceed).driver().transfers(); });
}

}  // namespace

const CeedBackendOps &parents_tables() {
  return parents;
}

void init(Ceed ceed, std::shared_ptr<Driver> driver, bool is_fused, const Options &options, CeedBackendOps *ops) {
  if (parents.size == 0) parents = *ops;
  auto device = std::make_unique<Device>(std::move(driver), options.tuning);
  ops->preferred_mem_type = CEED_MEM_DEVICE;
  ops->is_deterministic = !is_fused;
  ops->host_memory_only = false;
  ops->device_id = device->driver().properties().number;
  ops->ceed_destroy = destroy;
  ops->ceed_set_stream = set_stream;
  ops->ceed_get_transfers = get_transfers;
  fill_vector_ops(ops->vector);
  fill_restriction_ops(ops->restriction);
  fill_basis_ops(ops->basis);
  fill_qfunction_ops(ops->qfunction, device->driver().properties().user_kernels);
  fill_operator_ops(ops->op, is_fused);
  chk(CeedSetData(ceed, device.get()));
  device.release();
}

}  // namespace hg::gpu
