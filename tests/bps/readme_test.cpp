/// @file
/// Every command line in bps/README.md runs as it stands there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace hg::test {
namespace {

/// The lines of all ```sh blocks, in order.
std::vector<std::string> command_lines() {
  std::istringstream text(read_text(BPS_README));
  std::vector<std::string> commands;
  bool in_block = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      in_block = line == "```sh";
    } else if (in_block) {
      commands.push_back(line);
    }
  }
  return commands;
}

TEST(Readme, EveryCommandLineRuns) {
  for (const char *name :
       {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"})
    setenv(name, "1", 0);
  const TemporaryFolder folder;
  const std::filesystem::path kernel_folder = std::filesystem::path(BPS_KERNEL).parent_path();
  const bool has_plot = run("'" BPS_PYTHON "' -c 'import matplotlib'").code == 0;
  const auto commands = command_lines();
  ASSERT_GE(commands.size(), 7u);
  for (std::string command : commands) {
    SCOPED_TRACE(command);
    if (command.starts_with("plot.py")) {
      if (!has_plot) {
        std::cout << "not run, " BPS_PYTHON " has no matplotlib: " << command << "\n";
        continue;
      }
      command = "'" BPS_PYTHON "' '" BPS_PLOT "'" + command.substr(std::string("plot.py").size());
    }
    const Finished finished =
        run("cd " + quoted(folder / "") + " && PATH=" + quoted(kernel_folder) + ":$PATH && " + command);
    EXPECT_EQ(finished.code, 0) << finished.err;
    EXPECT_NE(finished.out, "");
  }
}

}  // namespace
}  // namespace hg::test
