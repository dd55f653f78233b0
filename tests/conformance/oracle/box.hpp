/// @file
/// A box of elements with continuous nodes of degree P_1d - 1, mapped from the unit cube: what the operators of real
/// programs stand on.
#pragma once

#include <functional>
#include <vector>

#include "support/errors.hpp"
#include "support/values.hpp"

namespace hg::test {

struct Box {
  /// n elements in each direction; map takes a point of the unit cube to its place.
  Box(CeedInt dim, CeedInt n, CeedInt P_1d, const std::function<Values(const Values &)> &map);
  /// The unit cube itself.
  Box(CeedInt dim, CeedInt n, CeedInt P_1d);

  /// Restriction of a field of num_comp components, component c of node i at c * num_nodes + i.
  Restriction restriction(Ceed ceed, CeedInt num_comp) const;

  CeedInt dim, P_1d, num_elem, elem_size;
  CeedInt num_nodes;
  std::vector<CeedInt> offsets;  ///< (node, element), node fastest
  Values coordinates;            ///< component c of node i at c * num_nodes + i
};

/// A smooth one-to-one map that bends every direction.
Values bent(const Values &x);

}  // namespace hg::test
