#include "tables.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

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
  return wall(ceed, [&] { Device::of(ceed).driver().set_stream(handle); });
}

void init(Ceed ceed, std::shared_ptr<Driver> driver, bool is_fused, int block_threads, CeedBackendOps *ops) {
  if (parents.size == 0) parents = *ops;
  auto device = std::make_unique<Device>(std::move(driver), block_threads);
  ops->preferred_mem_type = CEED_MEM_DEVICE;
  ops->is_deterministic = !is_fused;
  ops->host_memory_only = false;
  ops->ceed_destroy = destroy;
  ops->ceed_set_stream = set_stream;
  fill_vector_ops(ops->vector);
  fill_restriction_ops(ops->restriction);
  fill_basis_ops(ops->basis);
  fill_qfunction_ops(ops->qfunction);
  fill_operator_ops(ops->op, is_fused);
  chk(CeedSetData(ceed, device.get()));
  device.release();
}

int parse_threads(const std::string &options) {
  if (options.empty()) return Device::usual_threads;
  constexpr std::string_view option = "threads=";
  constexpr int fewest = 32, most = 1024;
  int threads = 0;
  const char *end = options.data() + options.size();
  const char *number = options.data() + std::min(option.size(), options.size());
  const auto [stop, error] = std::from_chars(number, end, threads);
  if (!options.starts_with(option) || error != std::errc() || stop != end || threads < fewest || threads > most) {
    throw DeviceError("there is no option '" + options + "'; expected threads=N, N from 32 to 1024");
  }
  return threads;
}

}  // namespace

const CeedBackendOps &parents_tables() {
  return parents;
}

int init_stages(Ceed ceed, std::shared_ptr<Driver> driver, CeedBackendOps *ops) {
  return wall(ceed, [&] { init(ceed, std::move(driver), false, Device::usual_threads, ops); });
}

int init_fused(Ceed ceed, std::shared_ptr<Driver> driver, const char *options, CeedBackendOps *ops) {
  return wall(ceed, [&] { init(ceed, std::move(driver), true, parse_threads(options), ops); });
}

}  // namespace hg::gpu
