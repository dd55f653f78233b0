#include "number_list.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "ceed_handles.hpp"

namespace hg::bps {

namespace {

template <class Number>
std::optional<Number> to_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

std::vector<std::string> split(const std::string &text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t comma; (comma = text.find(',', begin)) != std::string::npos; begin = comma + 1)
    parts.push_back(text.substr(begin, comma - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

std::vector<CeedInt> parse_integers(const std::string &option, const std::string &text, CeedInt low, CeedInt high) {
  std::vector<CeedInt> values;
  for (const auto &part : split(text)) {
    const std::string_view view = part;
    const std::size_t dash = view.find('-', 1);
    const auto first = to_number<CeedInt>(view.substr(0, dash));
    const auto last = dash == std::string::npos ? first : to_number<CeedInt>(view.substr(dash + 1));
    if (!first || !last || *first > *last || *first < low || *last > high)
      throw Error(fmt::format("{} {}: '{}' is not a number or a range within {} to {}", option, text, part, low, high));
    for (CeedInt value = *first; value <= *last; value++) values.push_back(value);
  }
  return values;
}

std::vector<double> parse_reals(const std::string &option, const std::string &text, double low, double high) {
  std::vector<double> values;
  for (const auto &part : split(text)) {
    const auto value = to_number<double>(part);
    if (!value || !(*value >= low) || !(*value <= high))
      throw Error(fmt::format("{} {}: '{}' is not a number within {} to {}", option, text, part, low, high));
    values.push_back(*value);
  }
  return values;
}

}  // namespace hg::bps
