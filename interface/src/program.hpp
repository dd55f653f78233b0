/// @file
/// Lowering: from the fields of an operator to the program that backends read.
#pragma once

#include <ceed/plugin.h>

#include <vector>

struct CeedOperator_private;

namespace hg {

/// A CeedProgram and the arrays it points to.
class Program {
 public:
  /// Lowers a single operator whose fields are complete (see check_ready()). Throws where fields cannot be combined.
  explicit Program(const CeedOperator_private &op);
  Program(const Program &) = delete;
  Program &operator=(const Program &) = delete;

  const CeedProgram &view() const { return view_; }
  /// Whether another program has the same fields, sources, sinks and spaces in the same order, so that what a backend
  /// made for the one serves the other: they differ in points, restrictions at points and vectors alone.
  bool has_shape_of(const Program &other) const;
  std::size_t num_bytes() const {
    return sizeof *this + (sources_.size() + sinks_.size()) * sizeof(CeedProgramSide) +
           spaces_.size() * sizeof(CeedProgramSpace) + (inputs_.size() + outputs_.size()) * sizeof(CeedProgramField);
  }

 private:
  CeedInt side(std::vector<CeedProgramSide> &sides, CeedElemRestriction rstr, CeedVector vec);
  /// Equal restrictions are one.
  CeedElemRestriction first_equal(CeedElemRestriction rstr) const;
  CeedInt space(CeedElemRestriction rstr, CeedBasis basis);

  std::vector<CeedProgramSide> sources_, sinks_;
  std::vector<CeedProgramSpace> spaces_;
  std::vector<CeedProgramField> inputs_, outputs_;
  CeedProgram view_{};
};

}  // namespace hg
