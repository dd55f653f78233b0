// The entry of libFuzzer.
#include <cstdio>
#include <cstdlib>

#include "graph.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  try {
    hg::fuzz::run_graph({data, size});
  } catch (const hg::fuzz::Defect &defect) {
    std::fprintf(stderr, "%s\n", defect.what());
    std::abort();
  }
  return 0;
}
