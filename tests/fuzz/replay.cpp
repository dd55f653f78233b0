// Runs stored programs: fuzz_replay [-v] FILE_OR_FOLDER... (-v prints each call). Fails where one shows a defect, and
// names it also where it ends the process.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "graph.hpp"

namespace {

std::string current;  ///< the file at hand

void name_current(int signal) {
  std::fprintf(stderr, "fuzz_replay: signal %d in %s\n", signal, current.c_str());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// All files of the arguments, in a fixed order.
std::vector<std::filesystem::path> files_of(int argc, char **argv) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; i++) {
    if (std::strcmp(argv[i], "-v") == 0) {
      hg::fuzz::prints_calls = true;
    } else if (std::filesystem::is_directory(argv[i])) {
      for (const auto &entry : std::filesystem::recursive_directory_iterator(argv[i])) {
        if (entry.is_regular_file()) files.push_back(entry.path());
      }
    } else {
      files.emplace_back(argv[i]);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

/// Told by the address sanitizer before its report.
extern "C" void __asan_on_error() {
  std::fprintf(stderr, "fuzz_replay: %s\n", current.c_str());
}

int main(int argc, char **argv) {
  for (const int signal : {SIGABRT, SIGFPE, SIGSEGV}) std::signal(signal, name_current);
  const auto files = files_of(argc, argv);
  int num_failed = 0;
  for (const auto &file : files) {
    current = file.string();
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
      std::fprintf(stderr, "fuzz_replay: cannot read %s\n", current.c_str());
      return 1;
    }
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
    try {
      hg::fuzz::run_graph(bytes);
    } catch (const std::exception &error) {
      std::fprintf(stderr, "fuzz_replay: %s: %s\n", current.c_str(), error.what());
      num_failed++;
    }
  }
  std::printf("%zu programs, %d failed\n", files.size(), num_failed);
  return files.empty() || num_failed > 0 ? 1 : 0;
}
