/// @file
/// What follows the colon in the resource of a backend that works on a device.
#pragma once

#include <string>
#include <string_view>

#include "device.hpp"

namespace hg::gpu {

/// The device that the calling thread has chosen with its vendor's calls, or the first one.
inline constexpr int current_device = -1;

struct Options {
  int device_id = current_device;       ///< which device, from 0 on, or the current one
  int threads = Device::usual_threads;  ///< most threads of a block of a whole operator, from 32 to 1024
};
inline constexpr std::string_view device_option = "device_id=";
/// "device_id=1". Throws DeviceError, with what was expected.
int parse_device(const std::string &option);
/// "device_id=1,threads=128". Throws DeviceError, with what was expected.
Options parse_options(const std::string &text);

}  // namespace hg::gpu
