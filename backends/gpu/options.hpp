/// @file
/// What follows the colon in the resource of a backend that works on a device.
#pragma once

#include <string>

#include "device.hpp"

namespace hg::gpu {

/// The device that the calling thread has chosen with its vendor's calls, or the first one.
inline constexpr int current_device = -1;

struct Options {
  int device_id = current_device;  ///< which device, from 0 on, or the current one
  Tuning tuning;
};
/// Reads one option of them, if it is one: "device_id=1". Throws DeviceError where its value is not what was expected.
bool parse_option(const std::string &option, Options &options);
/// What parse_option() takes, for messages.
extern const char *const expected_options;
/// "device_id=1,threads=128". Throws DeviceError, with what was expected.
Options parse_options(const std::string &text);

}  // namespace hg::gpu
