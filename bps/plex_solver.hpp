/// @file
/// A bake-off operator as a PETSc matrix, and its solution with KSP.
#pragma once

#include <petscksp.h>

#include "bakeoff.hpp"
#include "plex_mesh.hpp"

namespace hg::bps {

using Matrix = Handle<Mat, MatDestroy>;
using Solver = Handle<KSP, KSPDestroy>;

/// Global vector to global vector: halo exchange, the operator on this rank's cells, and the sum back to the owners.
class PlexOperator {
 public:
  /// `ceed`, `mesh` and `bakeoff` must outlive this object.
  PlexOperator(Ceed ceed, const PlexMesh &mesh, const Bakeoff &bakeoff);

  /// A shell matrix with multiply and diagonal; this object must stay where it is while the matrix lives.
  Matrix matrix();

  void apply(Vec x, Vec y);
  void diagonal(Vec d);
  /// Sums an L-vector of every rank's cells into a global vector.
  void assemble(CeedVector local, Vec global);
  /// Sums of all ranks.
  ErrorSums error(Vec x);

 private:
  Ceed ceed_;
  DM dm_;
  const Bakeoff &bakeoff_;
  PetscVector x_local_, y_local_;
  Vector x_, y_;
};

/// What one solve took.
struct KspResult {
  PetscInt iterations = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  double seconds = 0;  ///< of the slowest rank
  PetscReal residual = 0;
};

/// CG without a preconditioner in the natural norm, at most 20 iterations to 1e-10, all of which the options -ksp_* and
/// -pc_* may change. One iteration warms up before the time is taken. The view of -ksp_view is of the timed solve.
KspResult solve(Mat A, Vec b, Vec x);

}  // namespace hg::bps
