/// @file
/// The system's C++ compiler.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace hg::jit {

/// Why nothing was compiled; what() is for people.
struct NotCompiled : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// There is nothing to compile: the QFunction came without its source.
struct NoSource : NotCompiled {
  using NotCompiled::NotCompiled;
};

/// What the user adds to the options of whatever is compiled for the host: the words of CEED_GEN_FLAGS.
std::vector<std::string> flags_of_user();

/// A compiler with the interface of GCC's: GCC or clang.
class Compiler {
 public:
  /// What CEED_CXX names, else CXX, else c++, g++ or clang++, the first that is there; CEED_CXX and CXX may go on with
  /// arguments. Throws NotCompiled where there is none.
  static Compiler find();

  /// What tells it from another one, or from another version of itself: its path, arguments, size and time of change.
  /// (It is not asked: starting it would take longer than all the rest where nothing is to be compiled.)
  const std::string &identity() const { return identity_; }
  struct Outcome {
    bool is_done;
    std::string messages;  ///< what it said
  };
  /// Makes a shared library of a file. What only GCC or only clang knows is added to the options; `is_report_wanted`:
  /// which loops became SIMD, and why others did not, is among the messages.
  Outcome compile(const std::vector<std::string> &options, bool is_report_wanted, const std::filesystem::path &source,
                  const std::filesystem::path &library) const;

 private:
  bool is_clang() const;
  explicit Compiler(std::vector<std::string> command);

  std::vector<std::string> command_;
  std::string identity_;
};

}  // namespace hg::jit
