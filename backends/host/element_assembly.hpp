/// @file
/// Element matrices, or their diagonals, from the assembled QFunction.
#pragma once

#include <ceed/plugin.h>

#include <memory>

#include "access.hpp"
#include "kernels.hpp"

namespace hg::host {

/// One coupling of an operator; arrays are made with it. One thread at a time.
class ElementAssembly {
 public:
  virtual ~ElementAssembly() = default;
  /// Bytes of its tables and arrays.
  virtual std::size_t num_bytes() const = 0;
  /// As CeedOperatorOps::linear_assemble_elements().
  virtual void compute(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem, const CeedScalar *qfunction,
                       CeedScalar *entries) = 0;
};

/// NULL where the kernels do not take the coupling.
std::unique_ptr<ElementAssembly> make_element_assembly(const Kernels &kernels, const CeedProgram &program,
                                                       CeedInt source, CeedInt sink, CeedAssembleKind kind);

/// Calls visit(field, basis) for the active fields of a source (is_trial) or sink; CEED_BASIS_NONE where it has none.
template <typename Visit>
void for_each_field(const CeedProgram &program, bool is_trial, CeedInt side, Visit &&visit) {
  const CeedProgramField *fields = is_trial ? program.inputs : program.outputs;
  for (CeedInt i = 0; i < (is_trial ? program.num_inputs : program.num_outputs); i++) {
    if (fields[i].first_value < 0 || fields[i].side != side) continue;
    visit(fields[i], fields[i].space < 0 ? CEED_BASIS_NONE : program.spaces[fields[i].space].basis);
  }
}

inline const CeedElementMap &map_of(CeedElemRestriction rstr) {
  const CeedElementMap *map = nullptr;
  chk(CeedElemRestrictionGetElementMap(rstr, &map));
  return *map;
}

/// Points of element e, and where its list of them begins.
inline CeedInt num_points(const CeedElementMap &points, CeedInt e) {
  return points.offsets[e + 1] - points.offsets[e];
}
inline const CeedInt *places_of_points(const CeedElementMap &points, CeedInt e) {
  return points.offsets + points.offsets[e];
}

/// Pairs (r,c) of components whose entries are wanted.
struct ComponentPairs {
  CeedAssembleKind kind;
  CeedInt num_rows, num_columns;

  CeedInt count() const { return kind == CEED_ASSEMBLE_DIAGONAL ? num_columns : num_rows * num_columns; }
  CeedInt row(CeedInt pair) const { return kind == CEED_ASSEMBLE_DIAGONAL ? pair : pair / num_columns; }
  CeedInt column(CeedInt pair) const { return kind == CEED_ASSEMBLE_DIAGONAL ? pair : pair % num_columns; }
  /// What a pair adds to the place in D of the pair (0,0).
  CeedInt component(CeedInt pair, CeedInt num_active_out) const { return column(pair) * num_active_out + row(pair); }
};

}  // namespace hg::host
