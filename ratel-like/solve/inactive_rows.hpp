/// @file
/// Equations of places where no material is.
#pragma once

#include <petscvec.h>

#include <vector>

#include "options/handle.hpp"

namespace hg {

/// Rows of the identity among those of a global vector. Works in the memory that PETSc has its vectors in: by products
/// with vectors of zeros and ones, so that nothing is copied between a device and the host.
class InactiveRows {
 public:
  /// `rows` are counted from this rank's first one; `like` is a vector of the layout. Collective.
  void set(const std::vector<PetscInt> &rows, Vec like);
  /// 1 in each of them, 0 elsewhere; NULL: there are none on any rank.
  Vec indicator() const { return has_any_ ? inactive_.get() : nullptr; }

  /// to[row] = from[row] for each of them; the other entries stay as they are, these must be finite. Collective.
  void copy(Vec from, Vec to) const;
  /// to[row] = 1; collective.
  void set_to_one(Vec to) const;

 private:
  bool has_any_ = false;                ///< on some rank
  VecHandle inactive_, active_, work_;  ///< 1 there and 0 elsewhere, and the other way round
};

}  // namespace hg
