/// @file
/// An operator at quadrature points, W elements at a time.
#pragma once

#include <ceed/plugin.h>

#include <vector>

#include "access.hpp"
#include "block_basis.hpp"
#include "block_map.hpp"
#include "fields.hpp"

namespace hg::host {

/// v = Σ_e R_e^T B^T D(B R_e u) as a loop over blocks of elements, made once from the operator's program: gather,
/// evaluate, call the QFunction at W Q points, integrate, scatter. Point q of lane l is the QFunction's point q W + l.
/// All arrays of a block are made when it is first used; the loop allocates nothing. One thread at a time.
///
/// Memory: for each block W numbers for each node and point of each field, whatever the size of the mesh.
/// Floor of an application, bytes for each element: 4 nodes (offsets), 8 for each number of the fields stored at
/// points, 16 for each degree of freedom (read, write).
class BlockOperator {
 public:
  /// Whether a program can be taken: at quadrature points, and W Q points are a multiple of the QFunction's vector
  /// length.
  static bool takes(const Kernels &kernels, const CeedProgram &program);
  BlockOperator(const Kernels &kernels, const CeedProgram &program);

  void set_function(CeedQFunctionUser function) { function_ = function; }
  /// As CeedOperatorOps::apply_add().
  void apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode);
  /// The part of it that belongs to the elements from `first` on.
  void apply_from(CeedInt first, const CeedProgram &program, const ProgramArrays &arrays, void *context);
  /// As CeedOperatorOps::linear_assemble_qfunction().
  void linear_assemble_qfunction(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem, CeedVector values);
  /// Bytes of its arrays and bases.
  std::size_t num_bytes() const {
    std::size_t bytes = sizeof *this + arena_.num_bytes();
    for (const auto &basis : bases_) bytes += basis.num_bytes();
    return bytes;
  }

 private:
  struct Side {
    BlockMap map;
    int block = -1;  ///< its nodes' values, where a basis wants them
    bool is_active;
  };
  /// `size` values at each point, in arena_[array].
  struct PointArray {
    int array;
    CeedInt size;
  };
  void place_inputs(const CeedProgram &program);
  void place_outputs(const CeedProgram &program);
  void add_result(CeedInt side, int array);
  void make_arrays(const CeedProgram &program);
  void fill_weights(const CeedProgram &program);
  void plan_ahead();
  void ask_for_block(CeedSize first, const std::vector<const CeedScalar *> &sources);
  void ask_for_nodes(CeedInt first, CeedInt num_elem, CeedInt end, const ProgramArrays &arrays) const;
  void evaluate(const std::vector<const CeedScalar *> &sources);
  void integrate();
  void narrow(CeedInt n, CeedInt stride, CeedInt size, CeedScalar *values) const;
  void widen(CeedInt n, CeedInt stride, CeedInt size, CeedScalar *values) const;
  const BlockBasis &basis(CeedInt space) const { return bases_[basis_of_space_[space]]; }
  void read(CeedInt first, CeedInt num_elem, const std::vector<const CeedScalar *> &sources);
  void call(const CeedProgram &program, CeedInt first, CeedInt num_elem, void *context);
  void write(CeedInt first, CeedInt num_elem, const std::vector<CeedScalar *> &sinks);

  const Kernels *kernels_;
  CeedInt W_, Q_, vec_length_ = 1;
  CeedQFunctionUser function_ = nullptr;
  std::vector<Side> sources_, sinks_;
  std::vector<BlockBasis> bases_;
  std::vector<CeedInt> basis_of_space_;  ///< index in bases_
  std::vector<Evaluation> evaluations_, integrations_;
  std::vector<Copy> copies_in_;
  std::vector<Result> results_;                           ///< nodes of sinks, or values at the points
  std::vector<int> input_arrays_, output_arrays_;         ///< of the QFunction's fields
  std::vector<PointArray> input_values_, output_values_;  ///< each array once
  int work_ = -1;
  Ahead ahead_;
  CeedInt ahead_source_ = -1;
  Arena arena_;
  std::vector<const CeedScalar *> in_;
  std::vector<CeedScalar *> out_;
};

}  // namespace hg::host
