/// @file
/// Work in processes of its own: what ends them does not end this program.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hg::info {

/// How a child process ended.
struct Ended {
  int exit_status = 0;  ///< of exit(); meaningless after a signal
  int signal = 0;       ///< that ended it; 0: none
  std::string printed;  ///< what it wrote

  bool is_fine() const { return signal == 0 && exit_status == 0; }
};

/// Runs `work` in a copy of this process; what it returns is handed back as `printed`.
Ended in_child(const std::function<std::string()> &work);
/// Runs a program. Its output is handed back, or passed on as it comes (`is_shown`). Throws std::runtime_error where it
/// cannot be started.
Ended run_program(const std::vector<std::string> &command, bool is_shown);
/// "signal 11 (Segmentation fault)"
std::string name_of_signal(int signal);

}  // namespace hg::info
