#include "compiler.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <sstream>
#include <system_error>

extern char **environ;

namespace hg::jit {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char *, 1> of_gcc{"-fno-gnu-unique"};
constexpr std::array<const char *, 1> of_clang{"-fveclib=libmvec"};
constexpr std::array<const char *, 1> report_of_gcc{"-fopt-info-vec-optimized-missed"};
constexpr std::array<const char *, 2> report_of_clang{"-Rpass=loop-vectorize", "-Rpass-analysis=loop-vectorize"};

/// The program that a shell would start; empty where there is none.
fs::path program_named(const std::string &name) {
  const auto can_run = [](const fs::path &file) {
    return ::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file);
  };
  if (name.find('/') != std::string::npos) return can_run(name) ? fs::path(name) : fs::path();
  const char *path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (const fs::path file = fs::path(folder) / name; can_run(file)) return file;
  }
  return {};
}

std::vector<std::string> words(const char *text) {
  std::istringstream stream(text != nullptr ? text : "");
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Runs a command; what it says on both of its streams.
Compiler::Outcome run(const std::vector<std::string> &command) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw NotCompiled("no pipe: " + std::generic_category().message(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 2);
  std::vector<char *> arguments;
  for (const auto &word : command) arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int failure = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  Compiler::Outcome outcome{false, ""};
  std::array<char, 4096> buffer;
  while (failure == 0) {
    const ssize_t length = ::read(ends[0], buffer.data(), buffer.size());
    if (length < 0 && errno == EINTR) continue;
    if (length <= 0) break;
    outcome.messages.append(buffer.data(), static_cast<std::size_t>(length));
  }
  ::close(ends[0]);
  if (failure != 0) throw NotCompiled("'" + command[0] + "': " + std::generic_category().message(failure));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno == EINTR) continue;
    outcome.is_done = true;  // somebody else has waited for it: what it was to make is missing, or is there
    return outcome;
  }
  outcome.is_done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return outcome;
}

}  // namespace

std::vector<std::string> flags_of_user() {
  return words(std::getenv("CEED_GEN_FLAGS"));
}

Compiler Compiler::find() {
  for (const char *variable : {"CEED_CXX", "CXX"}) {
    std::vector<std::string> command = words(std::getenv(variable));
    if (command.empty()) continue;
    const fs::path program = program_named(command[0]);
    if (program.empty()) throw NotCompiled(std::string(variable) + " names no program: '" + command[0] + "'");
    command[0] = program;
    return Compiler(command);
  }
  for (const char *name : {"c++", "g++", "clang++"}) {
    if (const fs::path program = program_named(name); !program.empty()) return Compiler({program});
  }
  throw NotCompiled("there is no compiler: neither c++ nor g++ nor clang++ is in PATH, and CEED_CXX names none");
}

Compiler::Compiler(std::vector<std::string> command) : command_(std::move(command)) {
  std::error_code ignored;
  const fs::path program = fs::canonical(command_[0], ignored);
  struct stat facts {};
  ::stat(command_[0].c_str(), &facts);
  std::ostringstream text;
  text << program.string() << ' ' << facts.st_size << ' ' << facts.st_mtim.tv_sec << '.' << facts.st_mtim.tv_nsec;
  for (std::size_t i = 1; i < command_.size(); i++) text << ' ' << command_[i];
  for (const char *option : of_gcc) text << ' ' << option;
  for (const char *option : of_clang) text << ' ' << option;
  identity_ = text.str();
}

bool Compiler::is_clang() const {
  std::vector<std::string> command = command_;
  command.emplace_back("--version");
  return run(command).messages.find("clang") != std::string::npos;
}

Compiler::Outcome Compiler::compile(const std::vector<std::string> &options, bool is_report_wanted,
                                    const fs::path &source, const fs::path &library) const {
  std::vector<std::string> command = command_;
  const auto add = [&](const auto &more) { command.insert(command.end(), more.begin(), more.end()); };
  add(options);
  if (is_clang()) {
    add(of_clang);
    if (is_report_wanted) add(report_of_clang);
  } else {
    add(of_gcc);
    if (is_report_wanted) add(report_of_gcc);
  }
  add(std::vector<std::string>{"-shared", "-fPIC", "-o", library, source, "-lm"});
  return run(command);
}

}  // namespace hg::jit
