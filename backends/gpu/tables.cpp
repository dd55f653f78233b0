#include "tables.hpp"

#include <charconv>
#include <limits>
#include <sstream>
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

int get_transfers(Ceed ceed, CeedTransfers *transfers) {
  return wall(ceed, [&] { *transfers = Device::of(ceed).driver().transfers(); });
}

/// The number that follows `name`, from `fewest` to `most`.
int parse_number(const std::string &option, std::string_view name, int fewest, int most) {
  int number = 0;
  const char *end = option.data() + option.size();
  const auto [stop, error] = std::from_chars(option.data() + name.size(), end, number);
  if (error != std::errc() || stop != end || number < fewest || number > most) {
    throw DeviceError("option '" + option + "': expected a number from " + std::to_string(fewest) + " to " +
                      std::to_string(most));
  }
  return number;
}

}  // namespace

const CeedBackendOps &parents_tables() {
  return parents;
}

Options parse_options(const std::string &text) {
  constexpr std::string_view device = "device_id=", threads = "threads=";
  Options options;
  std::istringstream all(text);
  for (std::string option; std::getline(all, option, ',');) {
    if (option.starts_with(device)) {
      options.device_id = parse_number(option, device, 0, std::numeric_limits<int>::max());
    } else if (option.starts_with(threads)) {
      options.threads = parse_number(option, threads, 32, 1024);
    } else {
      throw DeviceError("there is no option '" + option +
                        "'; expected device_id=N, the number of a device, or threads=N, "
                        "N from 32 to 1024");
    }
  }
  return options;
}

void init(Ceed ceed, std::shared_ptr<Driver> driver, bool is_fused, const Options &options, CeedBackendOps *ops) {
  if (parents.size == 0) parents = *ops;
  auto device = std::make_unique<Device>(std::move(driver), options.threads);
  ops->preferred_mem_type = CEED_MEM_DEVICE;
  ops->is_deterministic = !is_fused;
  ops->host_memory_only = false;
  ops->ceed_destroy = destroy;
  ops->ceed_set_stream = set_stream;
  ops->ceed_get_transfers = get_transfers;
  fill_vector_ops(ops->vector);
  fill_restriction_ops(ops->restriction);
  fill_basis_ops(ops->basis);
  fill_qfunction_ops(ops->qfunction);
  fill_operator_ops(ops->op, is_fused);
  chk(CeedSetData(ceed, device.get()));
  device.release();
}

}  // namespace hg::gpu
