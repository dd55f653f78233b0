/// @file
/// A distributed mesh of the deformed unit cube, and the layout of a bake-off solution on it.
#pragma once

#include <petscdmplex.h>

#include <array>
#include <vector>

#include "ceed_handles.hpp"
#include "cells.hpp"
#include "problem.hpp"

namespace hg::bps {

using Dm = Handle<DM, DMDestroy>;
using PetscVector = Handle<Vec, VecDestroy>;

/// Throws Error for a PETSc error code, after PETSc has printed its trace.
void ok(PetscErrorCode code);

/// Hexahedra of a DMPlex box, divided among the ranks, with (p + 1)³ nodes a cell.
class PlexMesh {
 public:
  /// Collective. Throws CollectiveError if a rank gets no cell, Error if it gets more DoFs than an
  /// offset can count.
  PlexMesh(MPI_Comm comm, std::array<PetscInt, 3> num_cells, const Problem &problem, CeedInt degree);

  /// Its global vectors leave out the DoFs on the boundary for Poisson; its local vectors have them, as zeros.
  DM dm() const { return solution_dm_; }
  /// Of this rank, in the numbering of dm()'s local vectors; valid while this object lives.
  Cells cells() const;
  PetscInt num_global_cells() const { return num_global_cells_; }

 private:
  void build_box(MPI_Comm comm, std::array<PetscInt, 3> num_cells);
  void build_coordinates();
  void build_solution(const Problem &problem, CeedInt degree);

  Dm box_, solution_dm_;
  PetscInt num_global_cells_ = 0;
  CeedInt num_elem_ = 0;
  CeedSize num_dofs_ = 0;
  std::vector<CeedInt> dof_offsets_, vertex_offsets_;
  std::vector<CeedScalar> coordinates_;
};

}  // namespace hg::bps
