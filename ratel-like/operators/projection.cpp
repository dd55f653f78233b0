#include "operators/projection.hpp"

#include <petscksp.h>

#include <algorithm>

#include "mesh/lend.hpp"
#include "operators/qfunction_specs.hpp"
#include "options/error.hpp"
#include "qfunctions/common/contexts.h"

namespace hg {

namespace {

using KspHandle = Handle<KSP, KSPDestroy>;

/// What the matrix of the consistent projection needs to multiply.
struct MassMatrix {
  DM dm;
  CeedOperator mass;  ///< null on a rank without points
  CeedVector in, out;
  VecHandle local_in, local_out, diagonal;
};

PetscErrorCode multiply(Mat A, Vec x, Vec y) {
  return guard([&] {
    MassMatrix *matrix;
    petsc_check(MatShellGetContext(A, &matrix));
    petsc_check(DMGlobalToLocal(matrix->dm, x, INSERT_VALUES, matrix->local_in));
    if (matrix->mass) {
      const Lend in(matrix->local_in, matrix->in, Access::read), out(matrix->local_out, matrix->out, Access::write);
      ceed_check(CeedOperatorApply(matrix->mass, matrix->in, matrix->out, CEED_REQUEST_IMMEDIATE));
    } else {
      petsc_check(VecZeroEntries(matrix->local_out));
    }
    petsc_check(VecZeroEntries(y));
    petsc_check(DMLocalToGlobal(matrix->dm, matrix->local_out, ADD_VALUES, y));
  });
}

PetscErrorCode get_diagonal(Mat A, Vec diagonal) {
  return guard([&] {
    MassMatrix *matrix;
    petsc_check(MatShellGetContext(A, &matrix));
    petsc_check(VecCopy(matrix->diagonal, diagonal));
  });
}

void copy_to(Vec vec, std::span<const double> values) {
  PetscScalar *array;
  petsc_check(VecGetArrayWrite(vec, &array));
  std::ranges::copy(values, array);
  petsc_check(VecRestoreArrayWrite(vec, &array));
}

}  // namespace

PointProjection::PointProjection(const Mesh &mesh, PetscInt order, ProjectionKind kind)
    : mesh_(mesh), order_(order), kind_(kind), cache_(mesh.ceed) {
  if (kind == ProjectionKind::lumped && order != 1) {
    fail("lumped projection needs the linear space, but order %" PetscInt_FMT
         " was asked for; use the consistent projection there",
         order);
  }
}

Integration PointProjection::with_space(CeedInt num_comp) const {
  Integration part;
  part.ceed = mesh_.ceed;
  part.num_points = points_->num_points;
  part.restriction = points_->restriction;
  part.points = share(points_->points.get());
  part.x_ref = share(points_->x_ref.get());
  const Integration::AtPoints &q_data = points_->at_points.at(field_names::q_data);
  part.at_points[field_names::q_data] = {share(q_data.rstr.get()), share(q_data.values.get())};
  const CeedBasisHandle basis = mesh_.basis(order_, num_comp, static_cast<CeedInt>(order_ + 1), CEED_GAUSS);
  for (const char *name : {"nodal", "dual", "scalar"}) {
    part.on_mesh[name] = {share(mesh_.space(order_, num_comp).rstr.get()), share(basis.get()), {}};
  }
  return part;
}

void PointProjection::attach(const Integration &points) {
  points_ = &points;
  operators_.clear();
  const MeshSpace &space = mesh_.space(order_, 1);
  volume_.assign(static_cast<std::size_t>(space.local_size), 0.);
  if (points.points) {
    CeedVectorHandle volume;
    ceed_check(CeedVectorCreate(mesh_.ceed, space.local_size, volume.put()));
    const CeedOperatorHandle op = with_space(1).make(cache_, specs::weight);
    ceed_check(CeedOperatorApply(op, CEED_VECTOR_NONE, volume, CEED_REQUEST_IMMEDIATE));
    volume_ = to_host(volume);
  }
  mesh_.sum_shared(order_, 1, volume_);
}

PointProjection::Operators &PointProjection::operators(CeedInt num_comp) {
  if (!points_) fail("a projection was asked for before points were attached to it");
  const auto found = operators_.find(num_comp);
  if (found != operators_.end()) return found->second;
  Operators &ops = operators_[num_comp];
  const MeshSpace &space = mesh_.space(order_, num_comp);
  ceed_check(CeedVectorCreate(mesh_.ceed, space.local_size, ops.nodal.put()));
  ceed_check(CeedVectorCreate(mesh_.ceed, space.local_size, ops.result.put()));
  if (!points_->points) return ops;

  Integration part = with_space(num_comp);
  part.add("value", num_comp);
  ops.at_points = share(part.at_points["value"].values.get());
  ops.context = make_context(mesh_.ceed, HgMassContext{num_comp});
  const QFunctionField value{"value", num_comp, CEED_EVAL_NONE}, nodal{"nodal", num_comp, CEED_EVAL_INTERP};
  const QFunctionField dual{"dual", num_comp, CEED_EVAL_INTERP};
  ops.to_nodes = part.make(cache_, specs::mass(value, dual), ops.context);
  ops.mass = part.make(cache_, specs::mass(nodal, dual), ops.context);
  ops.to_points = part.make(cache_, specs::copy(nodal, value), ops.context, "value");
  return ops;
}

std::vector<double> PointProjection::to_mesh(std::span<const double> values, CeedInt num_comp) {
  Operators &ops = operators(num_comp);
  const std::size_t expected = static_cast<std::size_t>(points_->num_points) * num_comp;
  if (values.size() != expected) {
    fail("projection of %zu values, expected %zu: %d at each point", values.size(), expected, num_comp);
  }
  std::vector<double> b(static_cast<std::size_t>(mesh_.space(order_, num_comp).local_size), 0.);
  if (ops.to_nodes) {
    ceed_check(CeedVectorSetArray(ops.at_points, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<double *>(values.data())));
    ceed_check(CeedOperatorApply(ops.to_nodes, CEED_VECTOR_NONE, ops.result, CEED_REQUEST_IMMEDIATE));
    b = to_host(ops.result);
  }
  if (kind_ == ProjectionKind::consistent) {
    solve(ops, num_comp, b);
    return b;
  }
  mesh_.sum_shared(order_, num_comp, b);
  for (std::size_t k = 0; k < b.size(); k++) {
    const double volume = volume_[k / num_comp];
    b[k] = volume > 0. ? b[k] / volume : 0.;
  }
  return b;
}

void PointProjection::solve(Operators &ops, CeedInt num_comp, std::vector<double> &b) {
  const MeshSpace &space = mesh_.space(order_, num_comp);
  MassMatrix matrix{space.dm, ops.mass, ops.nodal, ops.result, {}, {}, {}};
  VecHandle rhs, solution;
  petsc_check(DMCreateGlobalVector(space.dm, rhs.put()));
  petsc_check(VecDuplicate(rhs, solution.put()));
  petsc_check(VecDuplicate(rhs, matrix.diagonal.put()));
  petsc_check(DMCreateLocalVector(space.dm, matrix.local_in.put()));
  petsc_check(DMCreateLocalVector(space.dm, matrix.local_out.put()));
  copy_to(matrix.local_in, b);
  petsc_check(VecZeroEntries(rhs));
  petsc_check(DMLocalToGlobal(space.dm, matrix.local_in, ADD_VALUES, rhs));

  if (ops.mass) {
    const Lend out(matrix.local_out, ops.result, Access::write);
    ceed_check(CeedOperatorLinearAssembleDiagonal(ops.mass, ops.result, CEED_REQUEST_IMMEDIATE));
  } else {
    petsc_check(VecZeroEntries(matrix.local_out));
  }
  petsc_check(VecZeroEntries(matrix.diagonal));
  petsc_check(DMLocalToGlobal(space.dm, matrix.local_out, ADD_VALUES, matrix.diagonal));
  // A node that no point supports has a row and a right-hand side of zeros: it stays at its initial zero.
  PetscScalar *diagonal;
  PetscInt size;
  petsc_check(VecGetLocalSize(matrix.diagonal, &size));
  petsc_check(VecGetArray(matrix.diagonal, &diagonal));
  std::replace_if(
      diagonal, diagonal + size, [](double d) { return !(d > 0.); }, 1.);
  petsc_check(VecRestoreArray(matrix.diagonal, &diagonal));

  MatHandle A;
  petsc_check(MatCreateShell(mesh_.comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE, &matrix, A.put()));
  petsc_check(MatShellSetOperation(A, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  petsc_check(MatShellSetOperation(A, MATOP_GET_DIAGONAL, reinterpret_cast<void (*)()>(get_diagonal)));
  KspHandle ksp;
  PC pc;
  petsc_check(KSPCreate(mesh_.comm, ksp.put()));
  petsc_check(KSPSetOptionsPrefix(ksp, "projection_"));
  petsc_check(KSPSetOperators(ksp, A, A));
  petsc_check(KSPSetType(ksp, KSPCG));
  petsc_check(KSPGetPC(ksp, &pc));
  petsc_check(PCSetType(pc, PCJACOBI));
  petsc_check(KSPSetTolerances(ksp, 1e-12, 1e-50, PETSC_DEFAULT, PETSC_DEFAULT));
  petsc_check(KSPSetFromOptions(ksp));
  petsc_check(KSPSolve(ksp, rhs, solution));
  KSPConvergedReason reason;
  petsc_check(KSPGetConvergedReason(ksp, &reason));
  if (reason < 0) fail("consistent projection of a point field did not converge: %s", KSPConvergedReasons[reason]);

  petsc_check(DMGlobalToLocal(space.dm, solution, INSERT_VALUES, matrix.local_in));
  const PetscScalar *nodal;
  petsc_check(VecGetArrayRead(matrix.local_in, &nodal));
  std::copy_n(nodal, b.size(), b.begin());
  petsc_check(VecRestoreArrayRead(matrix.local_in, &nodal));
}

std::vector<double> PointProjection::to_points(std::span<const double> nodal, CeedInt num_comp) {
  Operators &ops = operators(num_comp);
  const auto expected = static_cast<std::size_t>(mesh_.space(order_, num_comp).local_size);
  if (nodal.size() != expected) fail("%zu nodal values, expected %zu", nodal.size(), expected);
  if (!ops.to_points) return {};
  ceed_check(CeedVectorSetArray(ops.nodal, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<double *>(nodal.data())));
  ceed_check(CeedOperatorApply(ops.to_points, ops.nodal, ops.at_points, CEED_REQUEST_IMMEDIATE));
  return to_host(ops.at_points);
}

}  // namespace hg
