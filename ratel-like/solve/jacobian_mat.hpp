/// @file
/// The Jacobian of a solid as a PETSc matrix, from its CEED operator.
#pragma once

#include <ceed.h>
#include <petscmat.h>

#include <vector>

#include "mesh/mesh.hpp"
#include "options/handle.hpp"
#include "solve/inactive_rows.hpp"

namespace hg {

/// -mat_type shell (default): product and diagonal of the operator, nothing is stored.
/// -mat_type aij: assembled, for direct solvers and algebraic multigrid; on a device where the mesh's DM has matrices
/// and vectors there.
/// Rows and columns are the entries of a global vector of mesh.dm, so constrained entries are not in it. Inactive rows,
/// that no point supports, are rows of the identity.
class JacobianMat {
 public:
  enum class Type { shell, aij };

  /// Made after the mesh has its constraints; the mesh must outlive it. Collective.
  JacobianMat(const Mesh &mesh, Type type);

  Mat mat() const { return mat_; }
  Type type() const { return type_; }

  /// From now on the matrix is that of `op` (borrowed), which maps local vectors to local vectors, and of rows of the
  /// identity (borrowed). Collective.
  void set_operator(CeedOperator op, const InactiveRows &inactive);

  /// Brings the matrix up to date with the data of the operator, plus `damping` times the mean of its diagonal's size
  /// on the diagonal. Collective.
  void update(double damping = 0);

  /// y = J x, on global vectors.
  void multiply(Vec x, Vec y);
  /// The diagonal of J.
  void diagonal(Vec d);

  /// Row or column of each entry of a local vector; negative for constrained entries.
  const std::vector<PetscInt> &global_index() const { return global_index_; }

 private:
  void pattern();
  /// Where PETSc takes entries of an assembled matrix from.
  CeedMemType memory_of_values() const;

  const Mesh &mesh_;
  Type type_;
  MatHandle mat_;
  CeedOperator op_ = nullptr;
  PetscInt num_rows_ = 0, first_row_ = 0;  ///< of this rank
  double shift_ = 0;                       ///< added to the diagonal
  const InactiveRows *inactive_ = nullptr;
  std::vector<PetscInt> global_index_;
  VecHandle local_in_, local_out_;
  CeedVectorHandle ceed_in_, ceed_out_;
  /// Entries of the elements, then those of the diagonal, which inactive rows have.
  CeedVectorHandle entries_, indicator_;
  std::vector<CeedInt> rows_, columns_;  ///< of the pattern in force, to know when it changes
};

/// Reads -mat_type.
JacobianMat::Type read_mat_type(MPI_Comm comm);

}  // namespace hg
