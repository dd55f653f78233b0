// Running the program honeyguide from tests, and reading what it wrote.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

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
  ProgramResult result;
  std::FILE *pipe = popen(command.c_str(), "r");
  if (!pipe) return result;
  std::array<char, 4096> buffer;
  while (std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) result.output.append(buffer.data(), n);
  const int ended = pclose(pipe);
  result.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
  return result;
}

/// An empty folder for one test, the working folder meanwhile; removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() : before_(std::filesystem::current_path()) {
    std::string name = (std::filesystem::temp_directory_path() / "honeyguide-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::filesystem::current_path(folder_);
  }
  ~TemporaryFolder() {
    std::filesystem::current_path(before_);
    std::filesystem::remove_all(folder_);
  }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

 private:
  std::filesystem::path before_, folder_;
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
