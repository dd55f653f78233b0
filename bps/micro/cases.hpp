/// @file
/// What micro-benchmarks call: kernels of backends/host in the shapes that operators have. One list serves the program
/// that times them and the one that has their instructions counted.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kernels.hpp"

namespace hg::micro {

/// An instruction set of this machine, and its tables of kernels.
struct InstructionSet {
  std::string name;  ///< "avx2"
  const host::Kernels *blocked, *serial;

  /// Numbers of a pack.
  CeedInt width() const { return blocked->width; }
  /// Instructions of a multiplication with addition: the portable text takes two.
  int fma_instructions() const { return name == "portable" ? 2 : 1; }
};

/// Those that this machine has, the widest first. CEED_HOST_ISA names one to use alone; throws std::runtime_error where
/// it names none of them.
std::vector<InstructionSet> instruction_sets();

/// What one call does. The floor is that of backends/host (kernels.hpp, points.hpp, block_copy.hpp): what cannot be
/// left out, in instructions on packs of W numbers, or on single numbers where these lie anywhere in an L-vector.
struct Work {
  double fmas = 0;  ///< multiplications with additions of packs
  double loads = 0, stores = 0;
  double number_loads = 0, number_stores = 0;
  double bytes = 0;  ///< read and written, each array once

  double instructions(const InstructionSet &set) const {
    return fmas * set.fma_instructions() + loads + stores + number_loads + number_stores;
  }
  double flops(const InstructionSet &set) const { return 2 * fmas * set.width(); }
};

/// One kernel in one shape.
struct Case {
  std::string name;  ///< "avx2/blocked/contraction/even/5x4/set"
  Work work;
  std::function<std::function<void()>()> prepare;  ///< makes the arrays; its result calls the kernel once
};

/// All kernels of an instruction set: for blocks of elements (blocked), for one element at a time (serial).
std::vector<Case> cases(const InstructionSet &set);

}  // namespace hg::micro
