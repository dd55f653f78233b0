#include "backends.hpp"

#include <ceed/plugin.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hg::test {
namespace {

std::vector<std::string> chosen;

/// Whether tests are told to leave a resource out.
bool is_left_out(const std::string &resource) {
  const char *beginnings = std::getenv("HG_TEST_WITHOUT");
  std::istringstream all(beginnings != nullptr ? beginnings : "");
  for (std::string beginning; std::getline(all, beginning, ',');) {
    if (!beginning.empty() && resource.starts_with(beginning)) return true;
  }
  return false;
}

/// Why this machine cannot run a backend, where it says so: another one is opened instead.
std::string why_not(const std::string &resource) {
  std::size_t count = 0;
  CeedPluginInfo *plugins = nullptr;
  std::string why;
  if (CeedPluginGetList(&count, &plugins)) return why;
  for (std::size_t i = 0; i < count; i++) {
    for (std::size_t b = 0; plugins[i].plugin != nullptr && b < plugins[i].plugin->num_backends; b++) {
      const CeedBackend &backend = plugins[i].plugin->backends[b];
      const char *reason = "it does not say why";
      const bool is_this = resource.substr(0, resource.find(':')) == backend.resource && backend.score != nullptr;
      if (is_this && backend.score(&reason) == 0) why = std::string(", for it cannot run here: ") + reason;
    }
  }
  std::free(plugins);
  return why;
}

/// What opening a resource printed, and whether it worked; in a process of its own.
Backend probe(const std::string &resource) {
  Backend backend{resource, false, "", 0};
  if (chosen.empty() && is_left_out(resource)) {
    backend.reason = left_out;
    return backend;
  }
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("pipe() failed");
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork() failed");
  if (child == 0) {
    ::dup2(ends[1], 1);
    ::dup2(ends[1], 2);
    ::close(ends[0]);
    ::setenv("CEED_ERROR_HANDLER", "exit", 1);
    Ceed ceed = nullptr;
    if (CeedInit(resource.c_str(), &ceed)) ::_exit(1);
    const char *full_name = nullptr;
    if (CeedGetResource(ceed, &full_name)) ::_exit(1);
    if (full_name != resource.substr(0, resource.find(':'))) {  // options follow a colon
      std::printf("another name of %s%s", full_name, why_not(resource).c_str());
      std::fflush(stdout);
      ::_exit(2);
    }
    ::_exit(CeedDestroy(&ceed) ? 1 : 0);
  }
  ::close(ends[1]);
  char buffer[512];
  ssize_t count = 0;
  while ((count = ::read(ends[0], buffer, sizeof buffer)) > 0) backend.reason.append(buffer, count);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  backend.is_usable = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (WIFSIGNALED(status)) backend.reason += " (ended by signal " + std::to_string(WTERMSIG(status)) + ")";
  if (!backend.is_usable && backend.reason.empty()) backend.reason = "no reason given";
  // The list of all resources says nothing about this one.
  backend.reason.resize(std::min(backend.reason.size(), backend.reason.find("\nAvailable backend resources:")));
  std::replace(backend.reason.begin(), backend.reason.end(), '\n', ' ');
  return backend;
}

std::vector<std::string> listed_resources() {
  std::size_t count = 0;
  char **names = nullptr;
  CeedInt *priorities = nullptr;
  if (CeedRegisterAll()) throw std::runtime_error("CeedRegisterAll() failed");
  if (CeedRegistryGetList(&count, &names, &priorities)) throw std::runtime_error("CeedRegistryGetList() failed");
  std::vector<std::string> resources(names, names + count);
  std::free(names);
  std::free(priorities);
  std::sort(resources.begin(), resources.end());
  return resources;
}

}  // namespace

void choose_backends(std::vector<std::string> resources) {
  chosen = std::move(resources);
}

bool are_chosen() {
  return !chosen.empty();
}

std::vector<Backend> &backends() {
  static std::vector<Backend> list = [] {
    std::vector<Backend> probed;
    for (const std::string &resource : chosen.empty() ? listed_resources() : chosen) probed.push_back(probe(resource));
    return probed;
  }();
  return list;
}

std::vector<std::string> usable_backends() {
  std::vector<std::string> usable;
  for (const Backend &backend : backends()) {
    if (backend.is_usable) usable.push_back(backend.resource);
  }
  return usable;
}

std::string backend_name(const testing::TestParamInfo<std::string> &info) {
  std::string name;
  for (const char c : info.param) {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      name += c;
    } else if (!name.empty()) {
      name += '_';
    }
  }
  return name;
}

void BackendTest::SetUp() {
  for (Backend &backend : backends()) {
    if (backend.resource == GetParam()) backend.num_tests++;
  }
  forget_reports();
  ceed = CeedHandle(open(GetParam()));
}

}  // namespace hg::test
