/// @file
/// What a compiled operator works on: shared by the text that is compiled at run time and by what calls it.
#pragma once

#include <ceed/types.h>

namespace hg::gen {

/// Where the entries of an element lie in an L-vector (see CeedElementMap): node n of component c at
///   offsets[e*elem_size + n] + c*comp_stride, or n + c*comp_stride + e*elem_stride where there are no offsets;
/// at points, component c of the p-th one at offsets[offsets[e] + p]*num_comp + c.
struct Side {
  const CeedInt *offsets;
  CeedSize comp_stride, elem_stride;
  CeedSize l_size;  ///< entries of the L-vector
};

/// One application to the elements [first, end), to which each sink is added.
struct Job {
  CeedInt first, end;
  void *context;                     ///< of the QFunction
  const Side *sources, *sinks;       ///< as in the program
  const CeedScalar *const *inputs;   ///< L-vectors of the sources
  CeedScalar *const *outputs;        ///< L-vectors of the sinks
  const bool *sets;                  ///< at points: which sinks are set, not added to
  const CeedScalar *const *numbers;  ///< matrices and weights, as they were printed
  CeedScalar *work;                  ///< as many numbers as were printed
  const Side *points;                ///< at points: their reference coordinates,
  const CeedScalar *x_ref;           ///< and the L-vector that holds them
  CeedInt failed;                    ///< first element of the block in which the QFunction did not return 0
};

/// The entry of a compiled operator: what the QFunction returned.
using Apply = int (*)(Job *job);

}  // namespace hg::gen
