// ceed-info: what backends there are, what they can do, and whether one is right.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "backend_list.hpp"
#include "conformance.hpp"
#include "info_options.hpp"
#include "memory_table.hpp"
#include "support_table.hpp"

namespace {

using namespace hg::info;

/// An error with the exit status that goes with it.
struct Failure {
  int exit_status;
  std::string message;
};

/// Calls `work`; what it throws ends the program with this status.
template <typename F>
auto or_exit(int exit_status, F &&work) {
  try {
    return work();
  } catch (const std::exception &error) {
    throw Failure{exit_status, error.what()};
  }
}

/// Writes JSON where it was asked for. Whether the text is still to be printed.
bool write_json(const InfoOptions &options, const nlohmann::ordered_json &json) {
  if (!options.json) return true;
  const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  if (*options.json == "-") {
    std::fputs(text.c_str(), stdout);
    return false;
  }
  std::ofstream stream(*options.json);
  stream << text;
  stream.close();
  if (!stream) throw Failure{exit_usage, "--json: cannot write " + *options.json};
  return true;
}

std::vector<Report> run_suite(const std::vector<std::string> &resources, const InfoOptions &options) {
  std::vector<Report> reports;
  for (const std::string &resource : resources) {
    const SuiteOptions suite{options.plugins, options.cases, options.is_shown};
    reports.push_back(or_exit(exit_no_suite, [&] { return run_conformance(resource, suite); }));
  }
  return reports;
}

int list(const InfoOptions &options) {
  const BackendList found = or_exit(exit_usage, [&] { return list_backends(options.plugins); });
  if (write_json(options, to_json(found))) print(found);
  return exit_fine;
}

/// Those that were asked for; without any, all that are available.
std::vector<std::string> wanted_resources(const InfoOptions &options, const BackendList &found) {
  std::vector<std::string> resources;
  for (const std::string &request : options.resources) {
    const Resolved resolved = resolve(request);
    if (resolved.resource.empty()) throw Failure{exit_unavailable, request + ": " + resolved.error};
    resources.push_back(resolved.resource);
  }
  if (options.resources.empty()) {
    for (const BackendInfo &info : found.backends) {
      if (info.is_available) resources.push_back(info.resource);
    }
  }
  return resources;
}

int show_memory(const InfoOptions &options) {
  const BackendList found = or_exit(exit_usage, [&] { return list_backends(options.plugins); });
  std::vector<OperatorBytes> operators;
  nlohmann::ordered_json json = {{"library", library_json()}, {"operators", nlohmann::ordered_json::array()}};
  bool is_fine = true;
  for (const std::string &resource : wanted_resources(options, found)) {
    for (OperatorBytes &one : measure_memory(resource)) {
      json["operators"].push_back(to_json(one));
      is_fine = is_fine && one.error.empty();
      operators.push_back(std::move(one));
    }
  }
  if (write_json(options, json)) print_memory(operators);
  return is_fine ? exit_fine : exit_failed;
}

/// Support and check: the suite on backends, and what is printed of it.
int examine(const InfoOptions &options) {
  const BackendList found = or_exit(exit_usage, [&] { return list_backends(options.plugins); });
  const std::vector<std::string> resources = wanted_resources(options, found);
  or_exit(exit_no_suite, [] { return conformance_program(); });
  const std::vector<Report> reports = run_suite(resources, options);
  nlohmann::ordered_json json = {{"library", library_json()}, {"reports", nlohmann::ordered_json::array()}};
  bool is_fine = true;
  for (const Report &report : reports) {
    json["reports"].push_back(to_json(report));
    is_fine = is_fine && report.tally().is_fine();
  }
  if (write_json(options, json)) {
    if (options.task == Task::check) {
      print_check(reports.front());
    } else {
      print_support(reports, options.is_detailed);
      for (const BackendInfo &info : found.backends) {
        if (!info.is_available) fmt::print("{} is not available: {}\n", info.resource, info.reason);
      }
    }
  }
  return is_fine ? exit_fine : exit_failed;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    const ParsedOptions parsed = parse_options(argc, argv);
    if (!parsed.options) return parsed.exit_code;
    switch (parsed.options->task) {
      case Task::list:
        return list(*parsed.options);
      case Task::memory:
        return show_memory(*parsed.options);
      default:
        return examine(*parsed.options);
    }
  } catch (const Failure &failure) {
    fmt::print(stderr, "ceed-info: {}\n", failure.message);
    return failure.exit_status;
  } catch (const std::exception &error) {
    fmt::print(stderr, "ceed-info: {}\n", error.what());
    return exit_usage;
  }
}
