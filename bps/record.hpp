/// @file
/// The record of one bake-off run, the same from every program, and the JSON file that collects them.
#pragma once

#include <ceed/backend.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hg::bps {

/// One run. A record in a JSON file has the fields of to_json(), all present; what does not apply is null.
struct Record {
  std::string program;  ///< `bps-kernel` or `bps`
  std::string problem;
  std::string ceed;  ///< full resource
  int degree = 0, q_1d = 0;
  long long elements = 0, dofs = 0;
  long long points = 0;                      ///< quadrature points, or material points
  std::optional<long long> points_per_cell;  ///< of an operator at points
  std::optional<std::string> placement;      ///< of an operator at points
  int repetitions = 0;
  double seconds_best = 0, seconds_median = 0;  ///< of one application of the operator
  double seconds_created = 0;                   ///< restriction, basis and operator
  double seconds_first = 0;                     ///< first application, with all that is made for it
  double bytes = 0, flops = 0;                  ///< compulsory bytes and formula flops of one application
  std::optional<CeedOperatorMemory> memory;     ///< where the library counts it
  double compulsory_memory = 0;                 ///< bytes that the operator must hold
  int cg_iterations = 0;
  bool cg_converged = false;
  double cg_seconds = 0;
  std::optional<double> error, error_h1;  ///< relative, if CG converged
  int ranks = 1;
  std::string cpu, library_version;

  double mdofs_per_s() const { return dofs / seconds_best / 1e6; }
  double mpoints_per_s() const { return points / seconds_best / 1e6; }
  double gb_per_s() const { return bytes / seconds_best / 1e9; }
  double gflops_per_s() const { return flops / seconds_best / 1e9; }
  double cg_mdofs_per_s() const { return cg_seconds > 0 ? double(dofs) * cg_iterations / cg_seconds / 1e6 : 0; }
};

/// Rates are of the best time.
void to_json(nlohmann::ordered_json &json, const Record &record);

/// Writes all records as one JSON array, as write_json() does.
void write_records(const std::filesystem::path &file, const std::vector<Record> &records);

/// Writes any records; an older file stays whole until the new one is. Throws Error.
void write_json(const std::filesystem::path &file, const nlohmann::ordered_json &json);

/// Name of this machine's processor.
std::string cpu_name();

}  // namespace hg::bps
