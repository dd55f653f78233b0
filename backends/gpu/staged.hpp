/// @file
/// Operators in stages.
#pragma once

#include <ceed/plugin.h>

#include <memory>
#include <vector>

#include "basis.hpp"
#include "qfunction.hpp"
#include "restriction.hpp"

namespace hg::gpu {

/// v = Σ_e R_e^T B^T D(B R_e u) in stages, each for the whole mesh: gather, evaluate, call the QFunction, integrate,
/// scatter. Between them are E-vectors and the QFunction's fields, which are kept with the operator.
class StagedOperator {
 public:
  StagedOperator(Device &device, const CeedProgram &program) : device_(device) { make(program); }

  void apply_add(const CeedProgram &program, PointFunction &function, CeedVector in, CeedVector out,
                 CeedApplyMode mode);
  std::size_t num_bytes() const;

 private:
  struct Side {
    Nodes nodes;
    Buffer values;  ///< E-vector
  };
  /// Basis functions at the points of a space; empty at quadrature points.
  using Tables = std::vector<Buffer>;

  void make(const CeedProgram &program);
  void make_points(const CeedProgram &program);
  void evaluate(const CeedProgram &program, const Tables &tables);
  void integrate(const CeedProgram &program, const Tables &tables);
  Buffer field(const CeedProgramField &field) const {
    return device_.allocate(points_.facts().num_points * field.size * sizeof(CeedScalar));
  }
  Side side(CeedElemRestriction rstr) const {
    Nodes nodes(device_, rstr, Nodes::Layout::elements);
    const std::size_t bytes = nodes.e_size() * sizeof(CeedScalar);
    return {std::move(nodes), device_.allocate(bytes)};
  }

  Device &device_;
  CeedSize points_epoch_ = -1;
  Points points_;
  std::vector<Side> sources_, sinks_;
  std::unique_ptr<Side> coordinates_;
  std::vector<Buffer> inputs_, outputs_;
};

}  // namespace hg::gpu
