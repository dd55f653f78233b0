#include "options.hpp"

#include <charconv>
#include <limits>
#include <sstream>

namespace hg::gpu {

namespace {

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

int parse_device(const std::string &option) {
  return parse_number(option, device_option, 0, std::numeric_limits<int>::max());
}

Options parse_options(const std::string &text) {
  constexpr std::string_view threads = "threads=";
  Options options;
  std::istringstream all(text);
  for (std::string option; std::getline(all, option, ',');) {
    if (option.starts_with(device_option)) {
      options.device_id = parse_device(option);
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

}  // namespace hg::gpu
