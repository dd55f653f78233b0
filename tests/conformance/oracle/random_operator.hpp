/// @file
/// Random linear operators of all kinds, for comparison of assembled matrices with the action on unit vectors.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "blend_operator.hpp"

namespace hg::test {

/// What random operators are to have.
struct OperatorWishes {
  CeedInt dim = 1;
  bool at_points = false;
  bool has_point_blocks = false;  ///< square; all active fields have one number of components, equally far apart
  bool is_square = false;
  CeedInt max_comp = 9;
  CeedInt max_active_spaces = 3;
};

/// Lengths of the active vectors and where components stand, which several operators may share.
struct Layout {
  CeedSize in = 0, out = 0;
  CeedInt num_comp = 0, comp_stride = 1;  ///< num_comp 0: each field its own
};
Layout random_layout(Random &random, const OperatorWishes &wishes);

/// A random operator and what it stands on: one to some elements, several active spaces on overlapping entries of the
/// active vectors, restrictions of all kinds (elements may meet a node twice), bases of all spaces and none, passive
/// fields; at points, ragged and empty elements.
class RandomOperator {
 public:
  RandomOperator(Ceed ceed, Random &random, const OperatorWishes &wishes, const Layout &layout);
  operator CeedOperator() const { return op_; }
  const std::string &description() const { return description_; }

 private:
  CeedBasis make_basis(CeedInt num_comp, CeedInt &num_nodes, CeedEvalMode &derivative);
  CeedElemRestriction make_restriction(CeedInt elem_size, CeedInt num_comp, CeedInt comp_stride, CeedSize l_size);
  CeedElemRestriction make_point_restriction(CeedInt num_comp, CeedSize l_size);
  void add_active(std::vector<BlendField> &fields, CeedSize l_size);
  void add_passive();
  void compose();

  Ceed ceed_;
  Random &random_;
  OperatorWishes wishes_;
  Layout layout_;
  CeedInt num_elem_, Q_1d_, Q_ = 0;
  std::vector<CeedInt> num_points_;
  CeedInt total_points_ = 0;
  std::vector<CeedInt> point_list_;  ///< numbers of the points, as restrictions at points have them
  std::deque<Restriction> restrictions_;
  std::deque<Basis> bases_;
  std::deque<Vector> vectors_;
  std::vector<BlendField> inputs_, outputs_;
  Operator op_;
  std::string description_;
};

}  // namespace hg::test
