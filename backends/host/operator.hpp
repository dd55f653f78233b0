/// @file
/// An operator's program on the kernels of this room.
#pragma once

#include <ceed/plugin.h>

#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <variant>

#include "block_operator.hpp"
#include "element_assembly.hpp"
#include "point_operator.hpp"

namespace hg::host {

/// At quadrature points or at points, as its program says. One thread at a time. It is what the operators of a backend
/// have for data (CeedOperatorSetData()), so that the functions of avx serve those of its children as well.
class Operator {
 public:
  /// NULL where the kernels do not take the program.
  static std::unique_ptr<Operator> make(const Kernels &kernels, const CeedProgram &program);

  /// Calls another function in place of the QFunction's.
  void set_function(CeedQFunctionUser function);
  /// To be called before anything else below: follows the points where they have been set again.
  void follow(const CeedProgram &program);
  /// As CeedOperatorOps::apply_add().
  void apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode);
  /// The part of it that belongs to the elements from `first` on; at quadrature points alone.
  void apply_from(CeedInt first, const CeedProgram &program, const ProgramArrays &arrays, void *context);
  /// As CeedOperatorOps::linear_assemble_qfunction().
  void linear_assemble_qfunction(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem, CeedVector values);
  /// As CeedOperatorOps::linear_assemble_elements(); false where the coupling is not taken.
  bool linear_assemble_elements(const CeedProgram &program, CeedInt source, CeedInt sink, CeedAssembleKind kind,
                                CeedInt first_elem, CeedInt num_elem, const CeedScalar *qfunction, CeedScalar *entries);
  /// As CeedOperatorOps::get_memory().
  std::size_t num_bytes() const {
    std::size_t bytes = std::visit([](const auto &own) { return own.num_bytes(); }, either_);
    for (const auto &[coupling, own] : matrices_) bytes += own ? own->num_bytes() : 0;
    return bytes;
  }

 private:
  using Either = std::variant<BlockOperator, PointOperator>;
  Operator(const Kernels &kernels, Either either) : kernels_(&kernels), either_(std::move(either)) {}

  const Kernels *kernels_;
  Either either_;
  /// Made when they are first asked for; NULL: not taken.
  std::map<std::tuple<CeedInt, CeedInt, CeedAssembleKind>, std::unique_ptr<ElementAssembly>> matrices_;
};

}  // namespace hg::host
