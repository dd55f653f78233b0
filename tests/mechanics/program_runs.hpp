// Running the program honeyguide from tests, and reading what it wrote.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.hpp"

namespace hg::test {

struct ProgramResult {
  int status = -1;
  std::string output;  ///< stdout and stderr

  bool mentions(const std::string &text) const { return output.find(text) != std::string::npos; }
};

/// Runs `honeyguide <arguments>` on `ranks` processes.
inline ProgramResult honeyguide(const std::string &arguments, int ranks = 1) {
  std::string command = HONEYGUIDE_PROGRAM " " + arguments + " 2>&1";
  if (ranks > 1) command = HONEYGUIDE_MPIEXEC " -n " + std::to_string(ranks) + " " + command;
  const Finished finished = run(command);
  return {finished.code, finished.out};
}

/// An empty folder for one test, the working folder meanwhile; removed afterwards.
class WorkingFolder {
 public:
  WorkingFolder() : before_(std::filesystem::current_path()) { std::filesystem::current_path(folder_.path()); }
  ~WorkingFolder() { std::filesystem::current_path(before_); }
  WorkingFolder(const WorkingFolder &) = delete;
  WorkingFolder &operator=(const WorkingFolder &) = delete;

 private:
  TemporaryFolder folder_;
  std::filesystem::path before_;
};

/// Columns of a CSV file by name.
inline std::map<std::string, std::vector<double>> read_csv(const std::string &file) {
  std::map<std::string, std::vector<double>> table;
  std::ifstream in(file);
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(in, line);
  for (std::istringstream row(line); std::getline(row, cell, ',');) names.push_back(cell);
  while (std::getline(in, line)) {
    std::size_t column = 0;
    for (std::istringstream row(line); std::getline(row, cell, ',') && column < names.size(); ++column) {
      table[names[column]].push_back(std::stod(cell));
    }
  }
  return table;
}

}  // namespace hg::test
