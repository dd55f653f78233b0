/// @file
/// Compiled libraries on disk and in this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "compiler.hpp"

namespace hg::jit {

/// A folder of compiled libraries, for any number of processes: an entry appears whole, under the name of all that it
/// depends on, or not at all; one process compiles it while others wait.
///
/// The folder is CEED_CACHE_DIR, else honeyguide/ in XDG_CACHE_HOME, else in ~/.cache; it is made, for its owner alone,
/// and one in which others may write is refused. CEED_CACHE_SIZE (MiB, 512 by default) bounds it: when an entry is
/// added, those that were not used for longest go.
class Cache {
 public:
  /// Throws NotCompiled where the folder cannot be used.
  Cache();

  const std::filesystem::path &folder() const { return folder_; }
  /// What is to be compiled.
  struct Request {
    std::string text;                  ///< the source
    std::vector<std::string> options;  ///< for the compiler
    std::string depends_on;            ///< what beside these decides what comes out
    bool is_report_wanted;             ///< see Compiler::compile()
  };
  /// The library, opened once in a process, where it stays. `said`: what the compiler said, now or, where a report is
  /// wanted, when it was compiled; untouched where it is open already. Throws NotCompiled, with the compiler's
  /// messages.
  void *library(const Compiler &compiler, const Request &request, std::string *said) const;
  /// What make() returns for a request, from the disk where it is there and `is_usable`; what cannot be written there
  /// is told once. Throws what make() throws.
  std::string code(const std::string &request, const std::function<std::string()> &make, bool is_usable = true) const;
  /// Makes sure that a file of this name is there, with this text.
  void keep(const std::filesystem::path &name, const std::string &text) const;

 private:
  void compile(const Compiler &compiler, const Request &request, const std::string &name, std::string *said) const;
  void trim() const;

  std::filesystem::path folder_;
  std::uintmax_t largest_;  ///< bytes
};

/// 32 hexadecimal digits (XXH3, 128 bits).
std::string digest(const std::string &text);

}  // namespace hg::jit
