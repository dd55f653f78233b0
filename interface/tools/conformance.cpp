#include "conformance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "child.hpp"

namespace hg::info {

namespace {

namespace fs = std::filesystem;

/// A folder for the record, removed at the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "ceed-info-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder in " + name);
    folder_ = name;
  }
  Scratch(const Scratch &) = delete;
  Scratch &operator=(const Scratch &) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path record() const { return folder_ / "record"; }

 private:
  fs::path folder_;
};

std::vector<std::string> split(const std::string &line, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// "Backends/VectorConformance" and "KeepsItsLength/cpu_self" without what the parameter adds.
std::string suite_name(const std::string &name) {
  return name.substr(name.find('/') == std::string::npos ? 0 : name.find('/') + 1);
}
std::string case_name(const std::string &name) {
  return name.substr(0, name.find('/'));
}

/// The record as it is now: see tests/conformance/records.hpp. The last case may have no end.
std::vector<Case> read(const fs::path &record) {
  std::ifstream stream(record);
  std::vector<Case> cases;
  bool is_running = false;
  for (std::string line; std::getline(stream, line);) {
    const auto fields = split(line, '\t');
    if (fields.size() < 4) continue;
    if (fields[0] == "start") {
      cases.push_back({fields[1], suite_name(fields[2]), case_name(fields[3]), Outcome::crashed, 0, ""});
      is_running = true;
    } else if (is_running && fields.size() >= 5) {
      Case &last = cases.back();
      last.outcome = fields[0] == "passed"    ? Outcome::passed
                     : fields[0] == "skipped" ? Outcome::skipped
                                              : Outcome::failed;
      last.seconds = std::strtod(fields[4].c_str(), nullptr) / 1000;
      last.message = fields.size() > 5 ? fields[5] : "";
      is_running = false;
    }
  }
  return cases;
}

/// The filter without the cases that are not about one backend.
std::string without_foreign_cases(const std::string &filter) {
  const std::string positive = filter.empty() ? "*" : filter;
  return positive + (positive.find('-') == std::string::npos ? "-" : ":") + "ExpectedBackends.*";
}

/// The last lines of what a process printed.
std::string tail(const std::string &text, std::size_t num_lines) {
  std::size_t start = text.size();
  while (start > 0 && (text[start - 1] != '\n' || start == text.size() || num_lines-- > 1)) start--;
  std::string end = text.substr(start);
  std::replace(end.begin(), end.end(), '\n', ' ');
  return end;
}

std::string how_it_ended(const Ended &ended) {
  const std::string how =
      ended.signal != 0 ? name_of_signal(ended.signal) : fmt::format("exit status {}", ended.exit_status);
  return "ended the process by " + how + ": " + tail(ended.printed, 3);
}

}  // namespace

const char *name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::passed:
      return "passed";
    case Outcome::failed:
      return "failed";
    case Outcome::skipped:
      return "skipped";
    case Outcome::crashed:
      break;
  }
  return "crashed";
}

void Tally::add(Outcome outcome) {
  (outcome == Outcome::passed    ? passed
   : outcome == Outcome::failed  ? failed
   : outcome == Outcome::skipped ? skipped
                                 : crashed)++;
}

Tally Report::tally() const {
  Tally all;
  for (const Case &one : cases) all.add(one.outcome);
  return all;
}

std::map<std::string, Tally> Report::tally_by_area() const {
  std::map<std::string, Tally> areas;
  for (const Case &one : cases) areas[one.area].add(one.outcome);
  return areas;
}

fs::path conformance_program() {
  const fs::path folder = fs::canonical("/proc/self/exe").parent_path();
  const fs::path program = (folder / HG_CONFORMANCE).lexically_normal();
  if (!fs::exists(program)) {
    throw std::runtime_error(
        fmt::format("the conformance suite is not there: {}\nIt is built and installed where GoogleTest is found and "
                    "BUILD_TESTING is on.",
                    program.string()));
  }
  return program;
}

Report run_conformance(const std::string &resource, const SuiteOptions &options) {
  const Scratch scratch;
  std::vector<std::string> command{conformance_program().string(), "--ceed=" + resource,
                                   "--record=" + scratch.record().string()};
  for (const std::string &plugin : options.plugins) command.push_back("--plugin=" + plugin);
  command.push_back("--gtest_filter=" + without_foreign_cases(options.filter));
  Report report{resource, {}};
  std::map<std::size_t, std::string> ends;  // of cases that ended the process
  for (;;) {
    const Ended ended = run_program(command, options.is_shown);
    const std::size_t before = report.cases.size();
    report.cases = read(scratch.record());
    const bool has_crashed = report.cases.size() > before && report.cases.back().outcome == Outcome::crashed;
    if (!has_crashed) {
      if (report.cases.empty()) {
        throw std::runtime_error(fmt::format("no case of the suite ran on {} ({} {}): {}", resource,
                                             ended.signal != 0 ? "signal" : "exit status",
                                             ended.signal != 0 ? ended.signal : ended.exit_status,
                                             tail(ended.printed, 5)));
      }
      break;
    }
    ends[report.cases.size() - 1] = how_it_ended(ended);
  }
  for (const auto &[index, message] : ends) report.cases[index].message = message;
  return report;
}

nlohmann::ordered_json to_json(const Report &report) {
  const auto counts = [](const Tally &tally) {
    return nlohmann::ordered_json{{"passed", tally.passed},
                                  {"failed", tally.failed},
                                  {"skipped", tally.skipped},
                                  {"crashed", tally.crashed}};
  };
  nlohmann::ordered_json areas, cases = nlohmann::ordered_json::array();
  for (const auto &[area, tally] : report.tally_by_area()) areas[area] = counts(tally);
  for (const Case &one : report.cases) {
    cases.push_back({{"area", one.area},
                     {"suite", one.suite},
                     {"case", one.name},
                     {"outcome", name_of(one.outcome)},
                     {"seconds", one.seconds},
                     {"message", one.message}});
  }
  return {{"resource", report.resource}, {"total", counts(report.tally())}, {"areas", areas}, {"cases", cases}};
}

}  // namespace hg::info
