/// @file
/// A restriction described by plain numbers, and its matrix by definition.
#pragma once

#include <ceed/backend.h>

#include <memory>
#include <string>
#include <vector>

#include "support/handles.hpp"
#include "support/random.hpp"

namespace hg::test {

/// What the functions that make restrictions are given, and what they are to do with it.
struct RestrictionCase {
  CeedRestrictionType type = CEED_RESTRICTION_STANDARD;
  CeedInt num_elem = 0, num_comp = 1;
  CeedInt elem_size = 0;   ///< at points: the largest number of points of an element
  CeedInt block_size = 0;  ///< 0: made by a function without blocks
  CeedInt comp_stride = 1;
  CeedSize l_size = 0;
  std::vector<CeedInt> offsets;  ///< as the functions take them; empty: strided
  CeedInt strides[3] = {0, 0, 0};
  CeedInt num_points = 0;
  std::shared_ptr<bool[]> orients;     ///< num_elem*elem_size
  std::vector<CeedInt8> curl_orients;  ///< num_elem*elem_size*3

  CeedInt num_nodes(CeedInt e) const;
  /// A term of a value of the E-vector: coefficient * l[place].
  struct Term {
    CeedSize place;
    CeedScalar coefficient;
  };
  /// The terms of component c of node n of element e.
  std::vector<Term> terms(CeedInt e, CeedInt n, CeedInt c) const;
};

/// In words, for the trace of a failed test.
std::string describe(const RestrictionCase &c);

/// A random case of the type: few elements or none, 1 to 9 nodes and components; `is_blocked`: made as a blocked one
/// of 1 to 5 elements a block.
RestrictionCase random_restriction(Random &random, CeedRestrictionType type, bool is_blocked);

/// The case on a backend. With CEED_USE_POINTER the case must outlive what is made; for CEED_OWN_POINTER it is copied.
Restriction make_restriction(Ceed ceed, const RestrictionCase &c, CeedCopyMode copy_mode = CEED_COPY_VALUES);

/// The same with the signs of its orientation dropped, and without any orientation.
RestrictionCase without_signs(RestrictionCase c);
RestrictionCase without_orientation(RestrictionCase c);

/// Place in the E-vector, from what the backend tells of its layout, of component c of node n of element e.
CeedSize e_place(CeedElemRestriction rstr, CeedInt e, CeedInt n, CeedInt c);

}  // namespace hg::test
