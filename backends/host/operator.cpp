#include "operator.hpp"

namespace hg::host {

std::unique_ptr<Operator> Operator::make(const Kernels &kernels, const CeedProgram &program) {
  if (PointOperator::takes(kernels, program)) {
    return std::unique_ptr<Operator>(new Operator(kernels, PointOperator(kernels, program)));
  }
  if (BlockOperator::takes(kernels, program)) {
    return std::unique_ptr<Operator>(new Operator(kernels, BlockOperator(kernels, program)));
  }
  return nullptr;
}

void Operator::set_function(CeedQFunctionUser function) {
  std::visit([&](auto &own) { own.set_function(function); }, either_);
}

void Operator::apply_from(CeedInt first, const CeedProgram &program, const ProgramArrays &arrays, void *context) {
  std::get<BlockOperator>(either_).apply_from(first, program, arrays, context);
}

void Operator::follow(const CeedProgram &program) {
  auto *at_points = std::get_if<PointOperator>(&either_);
  if (at_points != nullptr && at_points->points_epoch() != program.points_epoch) {
    either_ = at_points->followed(program);
  }
}

void Operator::apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  std::visit([&](auto &own) { own.apply_add(program, in, out, mode); }, either_);
}

void Operator::linear_assemble_qfunction(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem,
                                         CeedVector values) {
  std::visit([&](auto &own) { own.linear_assemble_qfunction(program, first_elem, num_elem, values); }, either_);
}

bool Operator::linear_assemble_elements(const CeedProgram &program, CeedInt source, CeedInt sink, CeedAssembleKind kind,
                                        CeedInt first_elem, CeedInt num_elem, const CeedScalar *qfunction,
                                        CeedScalar *entries) {
  const auto [found, is_new] = matrices_.try_emplace({source, sink, kind});
  if (is_new) found->second = make_element_assembly(*kernels_, program, source, sink, kind);
  if (!found->second) return false;
  found->second->compute(program, first_elem, num_elem, qfunction, entries);
  return true;
}

}  // namespace hg::host
