/// @file
/// One kernel for a whole operator: its text, printed from the operator's program.
#pragma once

#include <ceed/plugin.h>

#include <string>
#include <vector>

#include "function_text.hpp"

namespace hg::gpu {

/// A text with the kernel `hg_operator`, and what it is launched with.
struct OperatorText {
  std::string text;                 ///< empty where the program is not one that is taken
  std::vector<CeedScalar> numbers;  ///< OperatorJob::numbers
  std::vector<CeedScalar> tables;   ///< OperatorFacts::tables
  CeedInt num_elem = 1;             ///< elements of a block; at points 0: each thread takes a point of any cell
  CeedInt points_of_step = 1;       ///< at points: points of a cell that are taken at a time
  int lanes = 0, slots = 0;         ///< at points, where cells are taken: Block's, as they were chosen
  double places_of_point = 1;       ///< with these: how many threads there are for a point, counted over all steps
  int num_threads = 0;              ///< of a block
  int num_blocks = 1;               ///< that a processor is to hold
  std::size_t shared_bytes = 0;     ///< of a block
};

/// What a block may have.
struct Block {
  int num_threads = 256;  ///< at most
  int warp_size = 32;
  std::size_t shared_bytes = 0;  ///< at most; three blocks should find room where one processor has as much for all
  int lanes = 0, slots = 0;      ///< at points: Tuning's

  int whole_warps(int threads) const { return (threads + warp_size - 1) / warp_size * warp_size; }
};

/// What a kernel does with an operator: applies it, or writes what CeedOperatorOps::linear_assemble_qfunction() and the
/// kinds of CeedAssembleKind say to OperatorFacts::entries (diagonals: to the active sink).
enum class Purpose { apply, qfunction, matrix, diagonal, point_blocks };

/// An operator at quadrature points. Not taken: restrictions with orientations or in blocks, QFunctions for several
/// points at a time, what does not fit into the shared memory of a block, and assemblies that AssemblyText does not
/// take.
OperatorText elements_text(const Block &block, const CeedProgram &program, const FunctionText &function,
                           Purpose purpose = Purpose::apply);
/// An operator at points of the elements' own; the same is not taken.
OperatorText cells_text(const Block &block, const CeedProgram &program, const FunctionText &function,
                        Purpose purpose = Purpose::apply);

// What both have.

/// Whether so many numbers can be told with each call, in the bytes of a job.
bool fits_a_job(const CeedProgram &program, std::size_t num_numbers);
/// Whether the restrictions and the QFunction of a program are such as kernels take.
bool is_taken(const CeedProgram &program);
/// Whether a field goes through a basis.
inline bool is_evaluated(const CeedProgramField &field) {
  return field.eval_mode != CEED_EVAL_NONE && field.eval_mode != CEED_EVAL_WEIGHT;
}
/// Whether no other sink has the vector of this one.
bool is_alone(const CeedProgram &program, CeedInt sink);
/// The text before the kernel's own lines: the QFunction, `constants`, the text `name` of text/ with that of the sides,
/// and of assembly where it `assembles`, and the job's type.
std::string begin_text(const CeedProgram &program, const FunctionText &function, const std::string &constants,
                       const char *name, bool assembles, const OperatorText &text);
/// Where the QFunction puts its outputs: arrays out0, out1, ...
std::vector<std::string> output_lines(const CeedProgram &program);
/// Calls it for one point, from in0, in1, ... to out0, out1, ...
std::vector<std::string> call_lines(const CeedProgram &program);
/// Where `values` are in `all`, which gets them where it does not have them.
int keep(std::vector<CeedScalar> &all, const std::vector<CeedScalar> &values);

}  // namespace hg::gpu
