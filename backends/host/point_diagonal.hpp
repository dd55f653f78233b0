/// @file
/// Diagonals of element matrices at points of the elements' own.
#pragma once

#include <ceed/plugin.h>

#include <memory>
#include <vector>

#include "element_assembly.hpp"
#include "memory.hpp"

namespace hg::host {

/// K[(r,n),(c,n)] = Σ_q Σ_(l,k) D(q)[(l,r),(k,c)] B_l(q,n) B_k(q,n) where all functions are those of one space and
/// their derivatives: points side by side, direction by direction. Floor: see integrate_squares().
class PointDiagonal final : public ElementAssembly {
 public:
  /// NULL where this coupling is not taken.
  static std::unique_ptr<ElementAssembly> make(const Kernels &kernels, const CeedProgram &program, CeedInt source,
                                               CeedInt sink, CeedAssembleKind kind);
  std::size_t num_bytes() const override;
  void compute(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem, const CeedScalar *qfunction,
               CeedScalar *entries) override;

 private:
  explicit PointDiagonal(const Kernels &kernels) : kernels_(&kernels) {}
  bool choose(const CeedProgram &program, CeedInt source, CeedInt sink);
  void make_terms(const CeedProgram &program, CeedInt source, CeedInt sink);

  const Kernels *kernels_;
  ComponentPairs pairs_ = {};
  CeedBasis basis_ = nullptr;
  CeedInt num_nodes_ = 0;
  PointSquares squares_ = {};
  std::vector<std::vector<CeedInt>> components_;  ///< of each term: places in D for the pair (0,0), which are added up
  IntegrateSquares integrate_ = nullptr;
  Array sums_;
  std::vector<CeedScalar> coefficients_, x_ref_, values_;
};

}  // namespace hg::host
