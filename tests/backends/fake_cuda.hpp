/// @file
/// What the fake of CUDA's libraries is told, and tells.
#pragma once

#include <vector>

/// One driver with two devices, whose memory is the host's and whose kernels do nothing, and one compiler.
struct FakeCuda {
  int current = none;              ///< the device of the current context, which is its number + 1 as a pointer
  int num_retained = 0;            ///< contexts that were asked for
  int num_compiled = 0;            ///< texts
  int num_launched = 0;            ///< kernels, beside those of graphs
  int refused_loads = 0;           ///< how many times code is refused from now on
  bool is_full = false;            ///< there is no memory left
  std::vector<void *> waited_for;  ///< streams
  int num_graphs = 0, num_executables = 0;  ///< that are there
  int num_made = 0, num_changed = 0;        ///< executables that were made, nodes that were changed
  std::vector<int> called;                  ///< the first number of each job that a graph was launched with, and
  std::vector<unsigned> blocks;             ///< the number of its blocks
  static constexpr int none = -1;
};
/// The library that is linked to a test and the one that is loaded by it are the same.
extern FakeCuda fake_cuda;
