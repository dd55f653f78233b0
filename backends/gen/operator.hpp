/// @file
/// An operator with the user's QFunction compiled into it.
#pragma once

#include <ceed/plugin.h>

#include <memory>
#include <vector>

#include "../host/memory.hpp"
#include "../host/operator.hpp"
#include "library.hpp"

namespace hg::gen {

/// The operator of the SIMD backend, with two things compiled for this machine where that is possible: the QFunction,
/// and the loop over the elements with the QFunction in it. What the loop does not do (at quadrature points the last
/// block where it is not full; assembly) is the SIMD backend's, which calls the compiled QFunction. Nothing is compiled
/// again when points move or values change. One thread at a time.
class Operator : public host::Operator {
 public:
  /// NULL where the SIMD backend does not take the program. Nothing is compiled yet.
  static std::unique_ptr<Operator> make(const host::Kernels &kernels, const CeedProgram &program);

  /// As CeedOperatorOps::apply_add(). The first time the loop is compiled, or taken from the cache. Where nothing can
  /// be compiled, the reason is told on standard error, once for each QFunction, and the operator stays the SIMD
  /// backend's; with CEED_JIT_ERROR_ON_FAILURE each call is an error instead.
  void apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode);
  /// To be called before an assembly: compiles the QFunction alone, where the loop has not been compiled.
  void prepare_assembly(const CeedProgram &program);
  /// Compiles, where that was not done, what apply_add() runs.
  void prepare(const CeedProgram &program);
  /// As CeedOperatorOps::get_memory(): both operators. Compiled code is the process's.
  std::size_t num_bytes() const;

 private:
  Operator(host::Operator &&interpreted, const host::Kernels &kernels, const CeedProgram &program);
  void compile(const CeedProgram &program, bool with_loop);
  Printed print(const CeedProgram &program, const std::string &function);

  host::Kernels kernels_;  ///< as bases are made to be printed: even-odd contractions of any shape
  std::vector<host::BlockBasis> block_bases_;
  std::vector<host::PointBasis> point_bases_;
  std::vector<const CeedScalar *> numbers_;
  host::Array work_;
  std::size_t work_length_ = 0;
  bool has_function_ = false, has_loop_ = false;  ///< compiled, or tried in vain
  Apply apply_ = nullptr;                         ///< the loop; NULL where there is none
};

}  // namespace hg::gen
