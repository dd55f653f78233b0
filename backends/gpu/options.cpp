#include "options.hpp"

#include <bit>
#include <charconv>
#include <limits>
#include <sstream>
#include <string_view>

namespace hg::gpu {

namespace {

/// The number that follows `name`, from `fewest` to `most`, or a power of two of these.
int parse_number(const std::string &option, std::string_view name, int fewest, int most, bool is_power = false) {
  int number = 0;
  const char *end = option.data() + option.size();
  const auto [stop, error] = std::from_chars(option.data() + name.size(), end, number);
  const bool is_right = error == std::errc() && stop == end && number >= fewest && number <= most;
  if (!is_right || (is_power && !std::has_single_bit(static_cast<unsigned>(number)))) {
    throw DeviceError("option '" + option + "': expected " + (is_power ? "a power of two" : "a number") + " from " +
                      std::to_string(fewest) + " to " + std::to_string(most));
  }
  return number;
}

}  // namespace

const char *const expected_options =
    "device_id=N, the number of a device, threads=N, N from 32 to 1024, lanes=N, a power of two up to 64, or "
    "slots=N, N from 1 to 4";

bool parse_option(const std::string &option, Options &options) {
  const struct {
    std::string_view name;
    int &number;
    int fewest, most;
    bool is_power;
  } numbers[] = {{"device_id=", options.device_id, 0, std::numeric_limits<int>::max(), false},
                 {"threads=", options.tuning.threads, 32, 1024, false},
                 {"lanes=", options.tuning.lanes, 1, 64, true},
                 {"slots=", options.tuning.slots, 1, 4, false}};
  for (const auto &[name, number, fewest, most, is_power] : numbers) {
    if (!option.starts_with(name)) continue;
    number = parse_number(option, name, fewest, most, is_power);
    return true;
  }
  return false;
}

Options parse_options(const std::string &text) {
  Options options;
  std::istringstream all(text);
  for (std::string option; std::getline(all, option, ',');) {
    if (parse_option(option, options)) continue;
    throw DeviceError("there is no option '" + option + "'; expected " + expected_options);
  }
  return options;
}

}  // namespace hg::gpu
