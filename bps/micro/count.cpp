/// @file
/// bps-micro-count: calls every kernel of backends/host once, so that callgrind counts the instructions of that call.
/// count.py runs it under valgrind; by itself it counts nothing.
///
/// usage: bps-micro-count [--list] [REGEX]
/// REGEX: only cases in whose names it is found. --list: calls nothing, and prints a line for each case: name,
/// instructions of the floor, flops, bytes, with tabs between.
#include <valgrind/callgrind.h>

#include <cstdio>
#include <exception>
#include <regex>
#include <string>

#include "cases.hpp"

namespace {

using namespace hg::micro;

/// Calls it once to warm up (what the loader binds late), then once more to be counted: callgrind writes a file that
/// has the case's name.
void count(const Case &one) {
  const auto call = one.prepare();
  call();
  CALLGRIND_ZERO_STATS;
  CALLGRIND_TOGGLE_COLLECT;
  call();
  CALLGRIND_TOGGLE_COLLECT;
  CALLGRIND_DUMP_STATS_AT(one.name.c_str());
}

}  // namespace

int main(int argc, char **argv) {
  int first = 1;
  const bool only_list = argc > first && std::string(argv[first]) == "--list";
  if (only_list) first++;
  if (argc > first + 1) {
    std::fprintf(stderr, "usage: bps-micro-count [--list] [REGEX]\n");
    return 2;
  }
  try {
    const std::regex wanted(argc > first ? argv[first] : "");
    for (const InstructionSet &set : instruction_sets()) {
      for (const Case &one : cases(set)) {
        if (!std::regex_search(one.name, wanted)) continue;
        if (only_list) {
          std::printf("%s\t%.17g\t%.17g\t%.17g\n", one.name.c_str(), one.work.instructions(set), one.work.flops(set),
                      one.work.bytes);
        } else {
          count(one);
        }
      }
    }
  } catch (const std::regex_error &error) {
    std::fprintf(stderr, "bps-micro-count: '%s' is not a regular expression: %s\n", argv[first], error.what());
    return 2;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bps-micro-count: %s\n", error.what());
    return 2;
  }
}
