/// @file
/// An operator at points of the elements' own, W elements and W points at a time.
#pragma once

#include <ceed/plugin.h>

#include <memory>
#include <vector>

#include "access.hpp"
#include "block_map.hpp"
#include "fields.hpp"
#include "point_basis.hpp"
#include "point_block.hpp"

namespace hg::host {

/// v = Σ_e R_e^T B^T D(B R_e u) with B at points: nodes are gathered and turned into Chebyshev coefficients for W
/// elements side by side; each element's points are evaluated W at a time; the QFunction is called for the points of
/// all W elements at once, each point once (but for those that fill up its vector length). Elements may have any number
/// of points, none too. Made from the operator's program; when points are set again its bases are kept, and the rest,
/// a look at the number of points of each element and the arrays of a block, is made anew. One thread at a time.
///
/// Memory: W numbers for each node and coefficient of a field, and one for each point of W elements and value of a
/// field. Floor of an application, bytes for each point: 8 dim (reference coordinates), 4 (its place), 8 for each
/// number stored there; multiplications see evaluate_points().
class PointOperator {
 public:
  /// Whether a program can be taken: at points, in bases that the kernels take, with the other fields at points.
  static bool takes(const Kernels &kernels, const CeedProgram &program);
  PointOperator(const Kernels &kernels, const CeedProgram &program);

  /// The same operator for points that were set again: bases and the function are kept.
  PointOperator followed(const CeedProgram &program) const;
  /// CeedProgram::points_epoch of the points that it was made for
  CeedSize points_epoch() const { return points_epoch_; }
  void set_function(CeedQFunctionUser function) { function_ = function; }
  /// As CeedOperatorOps::apply_add().
  void apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode);
  /// As CeedOperatorOps::linear_assemble_qfunction().
  void linear_assemble_qfunction(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem, CeedVector values);
  /// Bytes of its arrays and bases.
  std::size_t num_bytes() const {
    std::size_t bytes = sizeof *this + arena_.num_bytes();
    for (const auto &basis : bases_) bytes += basis.num_bytes();
    return bytes;
  }

 private:
  /// A side at points has a list of its points, the others a map of their nodes.
  struct Side {
    const CeedElementMap *points = nullptr;
    std::unique_ptr<BlockMap> nodes;
    int block = -1;  ///< its nodes' values
    CeedInt num_comp;
    bool is_active;
  };
  PointOperator(const Kernels &kernels, const CeedProgram &program, std::vector<PointBasis> bases);
  Side make_side(const Kernels &kernels, const CeedProgramSide &side) const;
  int add_values(CeedInt size);
  bool add_nodes(Side &side);
  void make_arrays(const CeedProgram &program);
  CeedInt elements_to_assemble(CeedSize numbers_of_point) const;
  void place_inputs(const CeedProgram &program);
  void place_outputs(const CeedProgram &program);
  PointBlock block(CeedInt first, CeedInt num_elem, bool may_lie_across) const;
  void call(const CeedProgram &program, const PointBlock &block, void *context);
  template <typename Kernel>
  void for_points(const PointBlock &block, const PointBasis &basis, Ahead &ahead, Kernel &&kernel) const;
  const PointBasis &basis(CeedInt space) const { return bases_[basis_of_space_[space]]; }
  Ahead ask_for(const PointBlock &block, const CeedElementMap &map, const CeedScalar *l) const;
  void read(const PointBlock &block, const CeedScalar *x_ref, const std::vector<const CeedScalar *> &sources);
  void write(const PointBlock &block, const ProgramArrays &arrays);
  void pad(const PointBlock &block, CeedInt size, CeedScalar *values) const;

  const Kernels *kernels_;
  CeedInt W_, vec_length_ = 1;
  bool has_nodes_ = false;       ///< some field is evaluated from nodes or integrated to them
  bool may_lie_across_ = false;  ///< blocks of points, see PointBlock
  CeedInt few_elements_ = 1;     ///< of a block, where all is at points
  CeedSize points_epoch_;
  CeedQFunctionUser function_ = nullptr;
  const CeedElementMap *points_ = nullptr;
  CeedInt dim_ = 0;
  CeedInt most_points_ = 0;  ///< largest stride of a block
  std::vector<Side> sources_, sinks_;
  std::vector<PointBasis> bases_;
  std::vector<CeedInt> basis_of_space_;  ///< index in bases_; -1 for that of weights
  std::vector<Evaluation> evaluations_, integrations_;
  std::vector<Copy> copies_in_, copies_out_;  ///< at points
  std::vector<Result> results_;               ///< nodes of sinks
  std::vector<int> input_arrays_, output_arrays_;
  std::vector<CeedInt> input_sizes_;
  CeedInt largest_source_ = -1;  ///< of those at points
  int x_ref_ = -1, coefficients_ = -1, sums_ = -1, work_ = -1;
  Arena arena_;
  std::vector<CeedInt> places_;  ///< of a block's points
  std::vector<const CeedScalar *> in_;
  std::vector<CeedScalar *> out_;
};

}  // namespace hg::host
