/// @file
/// What the fake of CUDA's and HIP's libraries is told, and tells.
#pragma once

#include <utility>
#include <vector>

/// One driver with two devices, whose memory is the host's and whose kernels do nothing, and one compiler.
struct FakeVendors {
  int current = none;              ///< device; CUDA's context is its number + 1 as a pointer
  int num_retained = 0;            ///< contexts that were asked for
  int num_compiled = 0;            ///< texts
  int num_launched = 0;            ///< kernels, beside those of graphs
  int refused_loads = 0;           ///< how many times code is refused from now on
  bool is_full = false;            ///< there is no memory left
  std::vector<void *> worked_on;   ///< the stream of each copy, clearing and kernel
  std::vector<void *> waited_for;  ///< streams, by the host
  int num_events = 0;              ///< that are there
  void *recorded = nullptr;        ///< the stream of the last event
  /// Streams that wait for others.
  std::vector<std::pair<void *, void *>> waits;
  bool reuses_functions = false;            ///< a function of a new module has the handle of an old one's
  int num_functions = 0;                    ///< that were asked for
  int num_graphs = 0, num_executables = 0;  ///< that are there
  int num_made = 0, num_changed = 0;        ///< executables that were made, nodes that were changed
  /// How many times a kernel of a graph, a graph, a change are refused from now on.
  int refused_nodes = 0, refused_graphs = 0, refused_changes = 0;
  /// A kernel that a graph was launched with.
  struct Called {
    void *function = nullptr;
    int job = 0;  ///< its first number
    unsigned num_blocks = 0, num_threads = 0, shared_bytes = 0;
    void *stream = nullptr;

    bool operator==(const Called &) const = default;
  };
  std::vector<Called> called;
  std::vector<int> allowed;  ///< bytes of shared memory that functions were allowed
  /// A kernel of the user's: how it was called last.
  struct UserCall {
    void *context = nullptr;
    int Q = 0;
    const void *first_input = nullptr, *first_output = nullptr;
    unsigned num_blocks = 0, num_threads = 0;
    void *stream = nullptr;
  } user_call;
  char user_kernel = 0;  ///< whose address is its handle
  static constexpr int none = -1;
};
/// The library that is linked to a test and the one that is loaded by it are the same.
extern FakeVendors fake;
