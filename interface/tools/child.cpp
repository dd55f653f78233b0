#include "child.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace hg::info {

namespace {

constexpr int not_started = 127;

/// Forks. `act` runs in the child with the writing end of a pipe, and never returns.
template <typename F>
Ended fork_and_read(F &&act) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error(std::string("pipe(): ") + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("fork(): ") + std::strerror(errno));
  if (child == 0) {
    ::close(ends[0]);
    act(ends[1]);
    ::_exit(not_started);
  }
  ::close(ends[1]);
  Ended ended;
  char buffer[4096];
  for (ssize_t count = 0; (count = ::read(ends[0], buffer, sizeof buffer)) != 0;) {
    if (count < 0 && errno != EINTR) break;
    if (count > 0) ended.printed.append(buffer, static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ended.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return ended;
}

void write_all(int file, const std::string &text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

}  // namespace

Ended in_child(const std::function<std::string()> &work) {
  return fork_and_read([&](int pipe) {
    write_all(pipe, work());
    ::_exit(0);
  });
}

Ended run_program(const std::vector<std::string> &command, bool is_shown) {
  std::vector<char *> arguments;
  for (const std::string &argument : command) arguments.push_back(const_cast<char *>(argument.c_str()));
  arguments.push_back(nullptr);
  Ended ended = fork_and_read([&](int pipe) {
    if (!is_shown) {
      ::dup2(pipe, 1);
      ::dup2(pipe, 2);
    }
    ::execv(arguments[0], arguments.data());
  });
  if (ended.signal == 0 && ended.exit_status == not_started) {
    throw std::runtime_error("cannot start '" + command.front() + "'");
  }
  return ended;
}

std::string name_of_signal(int signal) {
  return "signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
}

}  // namespace hg::info
