#include "record.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "ceed_handles.hpp"

namespace hg::bps {

namespace {

template <class T>
nlohmann::ordered_json nullable(const std::optional<T> &value) {
  if (value) return *value;
  return nullptr;
}

nlohmann::ordered_json to_json(const CeedOperatorMemory &memory) {
  return {{"total", memory.total},    {"program", memory.program}, {"restrictions", memory.restrictions},
          {"bases", memory.bases},    {"vectors", memory.vectors}, {"assembly", memory.assembly},
          {"backend", memory.backend}};
}

}  // namespace

void to_json(nlohmann::ordered_json &json, const Record &r) {
  json = {
      {"program", r.program},
      {"problem", r.problem},
      {"ceed", r.ceed},
      {"degree", r.degree},
      {"q_1d", r.q_1d},
      {"elements", r.elements},
      {"dofs", r.dofs},
      {"points", r.points},
      {"points_per_cell", nullable(r.points_per_cell)},
      {"placement", nullable(r.placement)},
      {"repetitions", r.repetitions},
      {"seconds_per_apply", {{"best", r.seconds_best}, {"median", r.seconds_median}}},
      {"seconds_setup", {{"create", r.seconds_created}, {"first_apply", r.seconds_first}}},
      {"mdofs_per_s", r.mdofs_per_s()},
      {"mpoints_per_s", r.mpoints_per_s()},
      {"gb_per_s", r.gb_per_s()},
      {"flops", r.flops},
      {"gflops_per_s", r.gflops_per_s()},
      {"memory", r.memory ? to_json(*r.memory) : nlohmann::ordered_json()},
      {"compulsory_memory", r.compulsory_memory},
      {"memory_ratio",
       r.memory ? nlohmann::ordered_json(r.memory->total / r.compulsory_memory) : nlohmann::ordered_json()},
      {"cg_iterations", r.cg_iterations},
      {"cg_converged", r.cg_converged},
      {"cg_seconds", r.cg_seconds},
      {"cg_mdofs_per_s", r.cg_mdofs_per_s()},
      {"error", nullable(r.error)},
      {"error_h1", nullable(r.error_h1)},
      {"ranks", r.ranks},
      {"cpu", r.cpu},
      {"library_version", r.library_version},
  };
}

void write_records(const std::filesystem::path &file, const std::vector<Record> &records) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Record &record : records) json.push_back(record);
  write_json(file, json);
}

void write_json(const std::filesystem::path &file, const nlohmann::ordered_json &json) {
  std::filesystem::path partial = file;
  partial += ".partial";
  std::ofstream stream(partial);
  stream << json.dump(2) << '\n';
  stream.close();
  if (!stream) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw Error("cannot write the records to " + file.string());
  }
  std::error_code error;
  std::filesystem::rename(partial, file, error);
  if (error) throw Error("cannot write the records to " + file.string() + ": " + error.message());
}

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const auto begin = line.find_first_not_of(" \t", line.find(':') + 1);
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown";
}

}  // namespace hg::bps
