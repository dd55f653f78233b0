/// @file
/// Operators as one kernel.
#pragma once

#include <ceed/plugin.h>

#include <memory>
#include <vector>

#include "../host/access.hpp"
#include "device.hpp"
#include "operator_text.hpp"
#include "text/jobs.hpp"

namespace hg::gpu {

/// v += Σ_e R_e^T B^T D(B R_e u), or an assembly of it, in one launch: nothing but the L-vectors, what is stored at
/// points and what is assembled is in memory. Nothing is compiled again when points move or values change. One thread
/// at a time.
class FusedOperator {
 public:
  /// NULL where the program is not taken, see operator_text.hpp, and for diagonals where an element meets an entry of
  /// the L-vector twice. Throws jit::NoSource where the QFunction came without text, jit::NotCompiled or DeviceError
  /// where that cannot be compiled.
  static std::unique_ptr<FusedOperator> make(Device &device, const CeedProgram &program, Purpose purpose);

  /// Brings to the device what it works with beside vectors, where that is not there.
  void prepare(const CeedProgram &program);
  void apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode);
  /// What apply_add() would call, for who calls several at once, and then check()s each.
  Call call_of(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode);
  /// Throws where the QFunction has failed since.
  void check(const CeedProgram &program);
  /// What it was made for, to values[offset] and beyond: matrices of QFunctions are written, all else is added.
  void assemble(const CeedProgram &program, CeedSize offset, CeedVector values);
  std::size_t num_bytes() const { return sizeof *this + tables_.num_bytes() + cells_.num_bytes(); }

 private:
  FusedOperator(Device &device, const CeedProgram &program, const FunctionText &function, OperatorText text,
                Purpose purpose);
  void list_cells(const CeedProgram &program);
  void list_nodes(const CeedProgram &program);
  Call call_of(const CeedProgram &program, const host::ProgramArrays &arrays, const std::vector<Side> &sinks,
               CeedScalar *entries);
  void launch(const Call &call, const CeedProgram &program);

  Device &device_;
  Purpose purpose_;
  FunctionState state_;
  OperatorText text_;
  std::unique_ptr<Module> module_;
  Kernel kernel_;
  Buffer tables_;
  // At points, as long as they are where they are:
  CeedSize points_epoch_ = -1;
  CeedSize num_cells_ = 0, num_points_ = 0;
  Buffer cells_;
};

}  // namespace hg::gpu
