#include "support_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hg::info {

namespace {

constexpr const char *not_run = "-";

/// "operator_points" as words.
std::string words(std::string area) {
  std::replace(area.begin(), area.end(), '_', ' ');
  return area;
}

std::string cell(const Tally &tally) {
  if (tally.total() == 0) return not_run;
  if (tally.skipped == tally.total()) return "skipped";
  std::string text = fmt::format("{} {}/{}", tally.is_fine() ? "yes" : "NO", tally.passed, tally.total());
  if (tally.skipped > 0) text += fmt::format(", {} skipped", tally.skipped);
  if (tally.crashed > 0) text += fmt::format(", {} crashed", tally.crashed);
  return text;
}

/// Areas, or cases of an area, that any of the reports has; sorted.
template <typename Key>
std::vector<std::string> keys_of(const std::vector<Report> &reports, Key &&key) {
  std::vector<std::string> keys;
  for (const Report &report : reports) {
    for (const Case &one : report.cases) {
      const std::string found = key(one);
      if (!found.empty() && std::find(keys.begin(), keys.end(), found) == keys.end()) keys.push_back(found);
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::string full_name(const Case &one) {
  return one.suite + "." + one.name;
}

}  // namespace

void print_columns(const std::vector<std::vector<std::string>> &rows) {
  std::vector<std::size_t> widths;
  for (const auto &row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); i++) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto &row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); i++) line += fmt::format("{:<{}}", row[i], widths[i] + 2);
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
}

void print_support(const std::vector<Report> &reports, bool is_detailed) {
  std::vector<std::vector<std::string>> rows{{"capability"}};
  for (const Report &report : reports) rows[0].push_back(report.resource);
  for (const std::string &area : keys_of(reports, [](const Case &one) { return one.area; })) {
    rows.push_back({words(area)});
    for (const Report &report : reports) {
      const auto areas = report.tally_by_area();
      rows.back().push_back(areas.count(area) != 0 ? cell(areas.at(area)) : not_run);
    }
    if (!is_detailed) continue;
    const auto name_in_area = [&](const Case &one) { return one.area == area ? full_name(one) : ""; };
    for (const std::string &name : keys_of(reports, name_in_area)) {
      rows.push_back({"  " + name});
      for (const Report &report : reports) {
        const auto found = std::find_if(report.cases.begin(), report.cases.end(),
                                        [&](const Case &one) { return one.area == area && full_name(one) == name; });
        rows.back().push_back(found != report.cases.end() ? name_of(found->outcome) : not_run);
      }
    }
  }
  print_columns(rows);
}

void print_check(const Report &report) {
  const auto print_all = [&](Outcome outcome) {
    for (const Case &one : report.cases) {
      if (one.outcome == outcome) fmt::print("{}  {}: {}\n", name_of(outcome), full_name(one), one.message);
    }
  };
  print_all(Outcome::skipped);
  print_all(Outcome::failed);
  print_all(Outcome::crashed);
  const Tally tally = report.tally();
  fmt::print("{}: {} of {} cases passed, {} failed, {} crashed, {} skipped\n", report.resource, tally.passed,
             tally.total(), tally.failed, tally.crashed, tally.skipped);
}

}  // namespace hg::info
