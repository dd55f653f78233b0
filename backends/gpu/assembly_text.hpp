/// @file
/// What assembly adds to the texts of whole operators.
#pragma once

#include <ceed/plugin.h>

#include <functional>
#include <string>
#include <vector>

#include "operator_text.hpp"

namespace hg::gpu {

/// The functions of a space as tiles of text/assembly.hpp read them.
struct FunctionsText {
  std::string tile;        ///< type of a tile, up to its length
  std::string functions;   ///< what tiles read
  CeedInt num_nodes = 0;   ///< functions of a component
  CeedInt in_line = 1;     ///< those of a tile follow each other in a line of so many
  std::vector<int> kinds;  ///< of the rows of values
  std::vector<int> derivative_kinds;

  std::string tile_of(CeedInt length) const { return tile + ", " + std::to_string(length) + '>'; }
};

/// Columns of the QFunction's matrices, and how they are contracted with functions.
class AssemblyText {
 public:
  AssemblyText(const CeedProgram &program, Purpose purpose);

  /// Not taken: active fields that go through no basis, or through several, and more than 64 couplings of inputs and
  /// outputs.
  bool is_taken() const { return is_taken_; }
  /// No assembly at all: the operator is applied.
  bool applies() const { return purpose_ == Purpose::apply; }
  /// Whether a field of the QFunction's inputs has values of its own: active ones of an assembly are unit values.
  bool is_read(const CeedProgramField &field) const { return applies() || field.first_value < 0; }
  /// Whether matrices are contracted with functions, not just written.
  bool contracts() const { return !applies() && purpose_ != Purpose::qfunction; }
  /// The spaces of active fields, where their functions are wanted.
  const std::vector<CeedInt> &spaces() const { return spaces_; }
  /// Numbers of a lane's matrix.
  CeedInt matrix_size() const { return program_.num_active_in * program_.num_active_out | 1; }
  std::string matrices_type() const;
  /// Calls the QFunction at a point for each unit value i of the active inputs; `write` takes `column`. The passive
  /// inputs are there.
  std::vector<std::string> column_lines(const std::string &write) const;
  /// Contracts `matrices` for the elements [first, first + count) of a block, whose `lanes` are told. most_tasks: gets
  /// the number of threads that an element keeps busy.
  std::vector<std::string> contraction_lines(const std::function<FunctionsText(CeedInt space)> &functions_of,
                                             CeedInt *most_tasks = nullptr) const;

 private:
  struct Active {
    CeedInt side, space, num_comp;
  };
  /// Whether there are entries for an input and an output. On diagonals not where these have different restrictions:
  /// elements must not meet an entry of the L-vector in both.
  bool are_coupled(const Active &trial, const Active &test) const;
  bool find(const CeedProgramField *fields, CeedInt count, const CeedProgramSide *sides, std::vector<Active> &active);
  static std::string rows(const CeedProgramField *fields, CeedInt count, const Active &active,
                          const FunctionsText &functions);

  const CeedProgram &program_;
  Purpose purpose_;
  bool is_taken_ = true;
  std::vector<Active> trials_, tests_;
  std::vector<CeedInt> spaces_;
};

}  // namespace hg::gpu
