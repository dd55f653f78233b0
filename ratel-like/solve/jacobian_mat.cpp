#include "solve/jacobian_mat.hpp"

#include <ceed/backend.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "mesh/lend.hpp"
#include "options/error.hpp"
#include "options/options.hpp"
#include "solve/stages.hpp"

namespace hg {

namespace {

JacobianMat &self(Mat mat) {
  void *context;
  petsc_check(MatShellGetContext(mat, &context));
  return *static_cast<JacobianMat *>(context);
}

PetscErrorCode multiply_callback(Mat mat, Vec x, Vec y) {
  return guard([&] { self(mat).multiply(x, y); });
}

PetscErrorCode diagonal_callback(Mat mat, Vec d) {
  return guard([&] { self(mat).diagonal(d); });
}

}  // namespace

JacobianMat::Type read_mat_type(MPI_Comm comm) {
  OptionGroup group(comm, "", "Jacobian");
  return group.choice("mat_type", "shell: product and diagonal only; aij: assembled, for -pc_type lu, gamg",
                      {"shell", "aij"}, "shell") == "aij"
             ? JacobianMat::Type::aij
             : JacobianMat::Type::shell;
}

JacobianMat::JacobianMat(const Mesh &mesh, Type type) : mesh_(mesh), type_(type) {
  petsc_check(DMCreateLocalVector(mesh.dm, local_in_.put()));
  petsc_check(VecDuplicate(local_in_, local_out_.put()));
  ceed_check(CeedVectorCreate(mesh.ceed, mesh.local_size, ceed_in_.put()));
  ceed_check(CeedVectorCreate(mesh.ceed, mesh.local_size, ceed_out_.put()));

  VecHandle global;
  petsc_check(DMCreateGlobalVector(mesh.dm, global.put()));
  petsc_check(VecGetLocalSize(global, &num_rows_));
  petsc_check(VecGetOwnershipRange(global, &first_row_, nullptr));
  if (type == Type::shell) {
    VecType vec_type;  // the matrix gives out vectors like those of the mesh, on a device where they are
    petsc_check(DMGetVecType(mesh.dm, &vec_type));
    petsc_check(MatCreateShell(mesh.comm, num_rows_, num_rows_, PETSC_DETERMINE, PETSC_DETERMINE, this, mat_.put()));
    petsc_check(MatShellSetVecType(mat_, vec_type));
    petsc_check(MatShellSetOperation(mat_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply_callback)));
    petsc_check(MatShellSetOperation(mat_, MATOP_MULT_TRANSPOSE, reinterpret_cast<void (*)()>(multiply_callback)));
    petsc_check(MatShellSetOperation(mat_, MATOP_GET_DIAGONAL, reinterpret_cast<void (*)()>(diagonal_callback)));
  } else {
    petsc_check(MatCreate(mesh.comm, mat_.put()));
    petsc_check(MatSetSizes(mat_, num_rows_, num_rows_, PETSC_DETERMINE, PETSC_DETERMINE));
    MatType mat_type;
    petsc_check(DMGetMatType(mesh.dm, &mat_type));
    petsc_check(MatSetType(mat_, mat_type));
    petsc_check(MatSetOption(mat_, MAT_SYMMETRIC, PETSC_TRUE));
  }

  ISLocalToGlobalMapping to_global;
  PetscInt size;
  const PetscInt *indices;
  petsc_check(DMGetLocalToGlobalMapping(mesh.dm, &to_global));
  petsc_check(ISLocalToGlobalMappingGetSize(to_global, &size));
  petsc_check(ISLocalToGlobalMappingGetIndices(to_global, &indices));
  global_index_.assign(indices, indices + size);
  petsc_check(ISLocalToGlobalMappingRestoreIndices(to_global, &indices));
  if (size != mesh.local_size) {
    fail("local to global mapping of %" PetscInt_FMT " entries, expected %" PetscInt_FMT, size, mesh.local_size);
  }
}

void JacobianMat::set_operator(CeedOperator op, const InactiveRows &inactive) {
  op_ = op;
  inactive_ = &inactive;
  ceed_check(CeedOperatorPrepareFor(op, type_ == Type::aij ? CEED_USE_ASSEMBLE : CEED_USE_APPLY));
  if (type_ == Type::aij) pattern();
}

void JacobianMat::pattern() {
  CeedSize count = 0;
  CeedInt *rows = nullptr, *columns = nullptr;
  ceed_check(CeedOperatorLinearAssembleSymbolic(op_, &count, &rows, &columns));
  const std::unique_ptr<CeedInt, decltype(&std::free)> own_rows(rows, std::free), own_columns(columns, std::free);
  int same = static_cast<CeedSize>(rows_.size()) == count && std::equal(rows_.begin(), rows_.end(), rows) &&
             std::equal(columns_.begin(), columns_.end(), columns) && entries_;
  int all_same = 0;
  MPI_Allreduce(&same, &all_same, 1, MPI_INT, MPI_MIN, mesh_.comm);
  if (all_same) return;
  rows_.assign(rows, rows + count);
  columns_.assign(columns, columns + count);
  ceed_check(CeedVectorCreate(mesh_.ceed, count + num_rows_, entries_.put()));
  ceed_check(CeedVectorCreate(mesh_.ceed, num_rows_, indicator_.put()));

  // Every row has its diagonal, also where no cell contributes, so that the pattern outlives a change of inactive rows.
  std::vector<PetscInt> i(count + num_rows_), j(i.size());
  for (CeedSize k = 0; k < count; ++k) {
    i[k] = global_index_[rows_[k]];
    j[k] = global_index_[columns_[k]];
  }
  for (PetscInt row = 0; row < num_rows_; ++row) i[count + row] = j[count + row] = first_row_ + row;
  petsc_check(MatSetPreallocationCOO(mat_, static_cast<PetscCount>(i.size()), i.data(), j.data()));
}

CeedMemType JacobianMat::memory_of_values() const {
  // Only a matrix that works where vectors are takes entries from there.
  VecType of_mat, of_mesh;
  PetscBool is_same;
  petsc_check(MatGetVecType(mat_, &of_mat));
  petsc_check(DMGetVecType(mesh_.dm, &of_mesh));
  petsc_check(PetscStrcmp(of_mat, of_mesh, &is_same));
  return is_same ? memory_of(local_out_) : CEED_MEM_HOST;
}

void JacobianMat::update(double damping) {
  shift_ = 0;
  if (type_ == Type::aij) {
    {
      const OperatorScope scope(OperatorWork::matrix);
      ceed_check(CeedOperatorLinearAssemble(op_, entries_));
    }
    const CeedMemType memory = memory_of_values();
    CeedScalar *values;
    ceed_check(CeedVectorGetArray(entries_, memory, &values));
    // What comes after the elements' entries is 0, but for the diagonal of rows that are inactive.
    if (inactive_->indicator() != nullptr) {
      CeedVectorHandle diagonal;
      ceed_check(CeedVectorCreate(mesh_.ceed, num_rows_, diagonal.put()));
      ceed_check(CeedVectorSetArray(diagonal, memory, CEED_USE_POINTER, values + rows_.size()));
      {
        Lend indicator(inactive_->indicator(), indicator_, Access::read);
        ceed_check(CeedVectorCopy(indicator_, diagonal));
      }
      CeedScalar *taken;
      ceed_check(CeedVectorTakeArray(diagonal, memory, &taken));
    }
    petsc_check(MatSetValuesCOO(mat_, values, INSERT_VALUES));
    ceed_check(CeedVectorRestoreArray(entries_, &values));
  }
  petsc_check(MatAssemblyBegin(mat_, MAT_FINAL_ASSEMBLY));
  petsc_check(MatAssemblyEnd(mat_, MAT_FINAL_ASSEMBLY));
  if (damping > 0) {
    VecHandle d;
    PetscReal sum;
    PetscInt size;
    petsc_check(MatCreateVecs(mat_, nullptr, d.put()));
    petsc_check(MatGetDiagonal(mat_, d));
    petsc_check(VecNorm(d, NORM_1, &sum));
    petsc_check(VecGetSize(d, &size));
    const double shift = damping * sum / static_cast<double>(size);
    if (type_ == Type::aij) {
      petsc_check(MatShift(mat_, shift));
    } else {
      shift_ = shift;
    }
  }
  petsc_check(MatViewFromOptions(mat_, nullptr, "-jacobian_view"));
}

void JacobianMat::multiply(Vec x, Vec y) {
  petsc_check(VecZeroEntries(local_in_));
  petsc_check(DMGlobalToLocal(mesh_.dm, x, INSERT_VALUES, local_in_));
  {
    Lend in(local_in_, ceed_in_, Access::read), out(local_out_, ceed_out_, Access::write);
    const OperatorScope scope(OperatorWork::jacobian);
    ceed_check(CeedOperatorApply(op_, ceed_in_, ceed_out_, CEED_REQUEST_IMMEDIATE));
  }
  petsc_check(VecZeroEntries(y));
  petsc_check(DMLocalToGlobal(mesh_.dm, local_out_, ADD_VALUES, y));
  if (shift_ != 0) petsc_check(VecAXPY(y, shift_, x));
  inactive_->copy(x, y);
}

void JacobianMat::diagonal(Vec d) {
  {
    Lend out(local_out_, ceed_out_, Access::write);
    const OperatorScope scope(OperatorWork::diagonal);
    ceed_check(CeedOperatorLinearAssembleDiagonal(op_, ceed_out_, CEED_REQUEST_IMMEDIATE));
  }
  petsc_check(VecZeroEntries(d));
  petsc_check(DMLocalToGlobal(mesh_.dm, local_out_, ADD_VALUES, d));
  if (shift_ != 0) petsc_check(VecShift(d, shift_));
  inactive_->set_to_one(d);
}

}  // namespace hg
