/// @file
/// bps-kernel: the bake-off problems on one process, on any library with the interface of ceed.h.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <vector>

#include "kernel_check.hpp"
#include "kernel_options.hpp"
#include "kernel_table.hpp"
#include "library.hpp"

namespace {

using namespace hg::bps;

/// Counts the cases on standard error: in place on a terminal, one line each elsewhere.
class Progress {
 public:
  Progress(std::size_t total, bool quiet) : total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}
  ~Progress() {
    if (!quiet_ && terminal_ && done_ > 0) fmt::print(stderr, "\r\033[K");
  }
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  void start(const std::string &what) {
    done_++;
    if (quiet_) return;
    fmt::print(stderr, "{}[{}/{}] {}{}", terminal_ ? "\r\033[K" : "", done_, total_, what, terminal_ ? "" : "\n");
    std::fflush(stderr);
  }

 private:
  std::size_t total_, done_ = 0;
  bool quiet_, terminal_;
};

/// Where the points of a case lie: nowhere (quadrature), or a placement with a count.
struct PointChoice {
  std::optional<Placement> placement;
  CeedInt per_cell = 0;
};

std::vector<PointChoice> timed_points(const KernelOptions &options) {
  std::vector<PointChoice> choices;
  for (const auto &placement : options.placements) {
    if (!placement || *placement == Placement::quadrature) {
      choices.push_back({placement, 0});
    } else {
      for (const CeedInt per_cell : options.points) choices.push_back({placement, per_cell});
    }
  }
  if (choices.empty()) choices.push_back({});
  return choices;
}

/// What --check tests: what was asked for, by default quadrature and every placement; with enough points for p where
/// their number was not asked for.
std::vector<PointChoice> checked_points(const KernelOptions &options, CeedInt degree) {
  if (!options.points.empty()) return timed_points(options);
  const CeedInt per_cell = (degree + 2) * (degree + 2) * (degree + 2);
  const CeedInt random = 4 * (degree + 1) * (degree + 1) * (degree + 1);
  if (options.placements.empty()) {
    return {{}, {Placement::gauss, per_cell}, {Placement::uniform, per_cell}, {Placement::random, random}};
  }
  std::vector<PointChoice> choices;
  for (const auto &placement : options.placements)
    choices.push_back({placement, placement == Placement::random ? random : per_cell});
  return choices;
}

void time_all(const KernelOptions &options, std::vector<Record> &records) {
  const auto choices = timed_points(options);
  Progress progress(options.resources.size() * options.problems.size() * options.degrees.size() * options.dofs.size() *
                        choices.size(),
                    options.quiet);
  for (const auto &resource : options.resources) {
    const Context ceed = open_ceed(resource);
    for (const Problem &problem : options.problems)
      for (const CeedInt degree : options.degrees)
        for (const double dofs : options.dofs)
          for (const auto &[placement, per_cell] : choices) {
            const Case which{problem, degree, box_for_dofs(dofs, degree, problem.num_comp), placement, per_cell};
            progress.start(fmt::format("{} on {}", which.description(), resource));
            records.push_back(run_case(ceed, which, options.repetitions, options.cg));
            if (options.json) write_records(*options.json, records);
          }
  }
}

/// Returns the number of properties that failed.
int check_all(const KernelOptions &options, std::vector<Record> &records) {
  int passed = 0, failed = 0;
  const auto report = [&](const CheckLine &line, const std::string &resource) {
    (line.passed ? passed : failed)++;
    fmt::print("{} {} on {} ({})\n", line.passed ? "PASS" : "FAIL", line.what, resource, line.numbers);
    std::fflush(stdout);
  };
  for (const auto &resource : options.resources) {
    const Context ceed = open_ceed(resource);
    for (const Problem &problem : options.problems)
      for (const CeedInt degree : options.degrees) {
        report(check_agreement(ceed, problem, degree), resource);
        for (const auto &[placement, per_cell] : checked_points(options, degree)) {
          report(check_convergence(ceed, problem, degree, placement, per_cell, records), resource);
          if (options.json) write_records(*options.json, records);
        }
      }
  }
  fmt::print("{} passed, {} failed\n", passed, failed);
  return failed;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    const ParsedOptions parsed = parse_options(argc, argv);
    if (!parsed.options) return parsed.exit_code;
    const KernelOptions &options = *parsed.options;
    std::vector<Record> records;
    // A file that cannot be written is worth knowing before the work, not after it.
    if (options.json) write_records(*options.json, records);
    if (options.check) return check_all(options, records) == 0 ? 0 : 1;
    time_all(options, records);
    fmt::print("libceed {}, {}, best of {} applications\n{}", library_version(), cpu_name(), options.repetitions,
               format_table(records));
    return 0;
  } catch (const std::exception &error) {
    fmt::print(stderr, "bps-kernel: {}\n", error.what());
    return 2;
  }
}
