/// @file
/// Runs the conformance suite on a backend and reads what it found.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hg::info {

enum class Outcome { passed, failed, skipped, crashed };
const char *name_of(Outcome outcome);

/// One case of the suite.
struct Case {
  std::string area, suite, name;  ///< "operator_points", "PointsTest", "MassIsExact"
  Outcome outcome = Outcome::passed;
  double seconds = 0;
  std::string message;  ///< what failed, why it was skipped, how the process ended
};

/// Numbers of cases by outcome.
struct Tally {
  int passed = 0, failed = 0, skipped = 0, crashed = 0;

  void add(Outcome outcome);
  int total() const { return passed + failed + skipped + crashed; }
  bool is_fine() const { return failed == 0 && crashed == 0; }
};

struct Report {
  std::string resource;
  std::vector<Case> cases;

  Tally tally() const;
  std::map<std::string, Tally> tally_by_area() const;
};

struct SuiteOptions {
  std::vector<std::string> plugins;  ///< files to load
  std::string filter;                ///< of GoogleTest; "": all cases
  bool is_shown = false;             ///< pass on what the suite prints
};

/// The suite's program: installed beside this one. Throws std::runtime_error where it is not there.
std::filesystem::path conformance_program();

/// Runs all cases on a backend given by its full name. A case that ends the process costs no other case: the suite is
/// started again after it. Throws std::runtime_error where the suite does not run at all.
Report run_conformance(const std::string &resource, const SuiteOptions &options);

nlohmann::ordered_json to_json(const Report &report);

}  // namespace hg::info
