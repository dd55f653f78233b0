#include "plex_mesh.hpp"

#include <petscfe.h>

#include <limits>
#include <numeric>
#include <span>
#include <string>

namespace hg::bps {

namespace {

using FiniteElement = Handle<PetscFE, PetscFEDestroy>;
using Section = Handle<PetscSection, PetscSectionDestroy>;
constexpr const char *boundary_name = "bakeoff boundary";

/// Index of component 0 of every node of every local cell in the local vectors of a DM with one tensor field.
struct LocalOffsets {
  PetscInt num_cells = 0, cell_size = 0, num_comp = 0, local_size = 0;
  std::vector<CeedInt> offsets;
};

LocalOffsets tensor_offsets(DM dm) {
  LocalOffsets local;
  PetscInt *offsets = nullptr;
  ok(DMPlexSetClosurePermutationTensor(dm, PETSC_DETERMINE, nullptr));
  ok(DMPlexGetLocalOffsets(dm, nullptr, 0, 0, 0, &local.num_cells, &local.cell_size, &local.num_comp, &local.local_size,
                           &offsets));
  local.offsets.assign(offsets, offsets + local.num_cells * local.cell_size);
  ok(PetscFree(offsets));
  return local;
}

/// The layout of `num_comp` interleaved components on the nodes of `scalar`; all of a constrained point is left out of
/// global vectors.
Section interleave(DM box, PetscSection scalar, PetscInt num_comp, bool constrain) {
  Section section;
  DMLabel boundary = nullptr;
  PetscInt begin = 0, end = 0;
  ok(DMGetLabel(box, boundary_name, &boundary));
  ok(PetscSectionCreate(PetscObjectComm(reinterpret_cast<PetscObject>(box)), section.out()));
  ok(PetscSectionGetChart(scalar, &begin, &end));
  ok(PetscSectionSetChart(section, begin, end));
  const auto dofs_of = [&](PetscInt point, bool &constrained) {
    PetscInt dof = 0, value = -1;
    ok(PetscSectionGetDof(scalar, point, &dof));
    if (constrain) ok(DMLabelGetValue(boundary, point, &value));
    constrained = value == 1;
    return num_comp * dof;
  };
  bool constrained = false;
  for (PetscInt point = begin; point < end; point++) {
    const PetscInt dof = dofs_of(point, constrained);
    ok(PetscSectionSetDof(section, point, dof));
    if (constrained) ok(PetscSectionSetConstraintDof(section, point, dof));
  }
  ok(PetscSectionSetUp(section));
  for (PetscInt point = begin; point < end; point++) {
    const PetscInt dof = dofs_of(point, constrained);
    PetscInt scalar_offset = 0, offset = 0;
    ok(PetscSectionGetOffset(scalar, point, &scalar_offset));
    ok(PetscSectionGetOffset(section, point, &offset));
    if (dof > 0 && offset != num_comp * scalar_offset)
      throw Error("the layout of the mesh is not in the order of its points: the solution cannot be laid over it");
    if (!constrained || dof == 0) continue;
    std::vector<PetscInt> all(dof);
    std::iota(all.begin(), all.end(), 0);
    ok(PetscSectionSetConstraintIndices(section, point, all.data()));
  }
  return section;
}

}  // namespace

void ok(PetscErrorCode code) {
  if (code == 0) return;
  const char *text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw Error("PETSc error " + std::to_string(static_cast<int>(code)) + (text ? std::string(": ") + text : ""));
}

PlexMesh::PlexMesh(MPI_Comm comm, std::array<PetscInt, 3> num_cells, const Problem &problem, CeedInt degree)
    : num_global_cells_(num_cells[0] * num_cells[1] * num_cells[2]) {
  build_box(comm, num_cells);
  build_coordinates();
  build_solution(problem, degree);
}

Cells PlexMesh::cells() const {
  return {num_elem_, num_dofs_, dof_offsets_, vertex_offsets_, coordinates_};
}

void PlexMesh::build_box(MPI_Comm comm, std::array<PetscInt, 3> num_cells) {
  ok(DMPlexCreateBoxMesh(comm, 3, PETSC_FALSE, num_cells.data(), nullptr, nullptr, nullptr, PETSC_TRUE, box_.out()));
  // Marked before the mesh is divided: afterwards, faces between ranks look like boundary too.
  DMLabel boundary = nullptr;
  ok(DMCreateLabel(box_, boundary_name));
  ok(DMGetLabel(box_, boundary_name, &boundary));
  ok(DMPlexMarkBoundaryFaces(box_, 1, boundary));
  ok(DMPlexLabelComplete(box_, boundary));
  PetscPartitioner partitioner = nullptr;
  ok(DMPlexGetPartitioner(box_, &partitioner));
  ok(PetscPartitionerSetFromOptions(partitioner));
  Dm divided;
  ok(DMPlexDistribute(box_, 0, nullptr, divided.out()));
  if (divided) box_ = std::move(divided);
  ok(DMViewFromOptions(box_, nullptr, "-dm_view"));

  PetscInt begin = 0, end = 0;
  ok(DMPlexGetHeightStratum(box_, 0, &begin, &end));
  num_elem_ = static_cast<CeedInt>(end - begin);
  PetscInt fewest = num_elem_;
  MPI_Allreduce(MPI_IN_PLACE, &fewest, 1, MPIU_INT, MPI_MIN, comm);
  if (fewest == 0) throw CollectiveError("a rank has no cell: ask for more -local_nodes or -cells, or use fewer ranks");
}

void PlexMesh::build_coordinates() {
  FiniteElement linear;
  ok(PetscFECreateLagrange(PETSC_COMM_SELF, 3, 3, PETSC_FALSE, 1, PETSC_DETERMINE, linear.out()));
  ok(DMProjectCoordinates(box_, linear));
  DM coordinate_dm = nullptr;
  ok(DMGetCoordinateDM(box_, &coordinate_dm));
  LocalOffsets local = tensor_offsets(coordinate_dm);
  vertex_offsets_ = std::move(local.offsets);

  Vec values = nullptr;
  const PetscScalar *array = nullptr;
  PetscInt size = 0;
  ok(DMGetCoordinatesLocal(box_, &values));
  ok(VecGetLocalSize(values, &size));
  ok(VecGetArrayRead(values, &array));
  for (PetscInt i = 0; i < size; i += 3) {
    const auto x = deform({array[i], array[i + 1], array[i + 2]});
    coordinates_.insert(coordinates_.end(), x.begin(), x.end());
  }
  ok(VecRestoreArrayRead(values, &array));
}

void PlexMesh::build_solution(const Problem &problem, CeedInt degree) {
  const PetscInt num_comp = problem.num_comp;
  // One component gives the layout of the nodes; PETSc inverts a dense matrix of all DoFs of a cell to make an element.
  Dm scalar_dm;
  FiniteElement lagrange;
  ok(DMClone(box_, scalar_dm.out()));
  ok(PetscFECreateLagrange(PETSC_COMM_SELF, 3, 1, PETSC_FALSE, degree, 1, lagrange.out()));
  ok(DMAddField(scalar_dm, nullptr, reinterpret_cast<PetscObject>(static_cast<PetscFE>(lagrange))));
  ok(DMCreateDS(scalar_dm));
  LocalOffsets local = tensor_offsets(scalar_dm);
  PetscSection scalar_section = nullptr;
  ok(DMGetLocalSection(scalar_dm, &scalar_section));

  if (num_comp * PetscInt64(local.local_size) > std::numeric_limits<CeedInt>::max())
    throw Error("a rank has more than 2147483647 DoFs: ask for fewer -local_nodes");
  num_dofs_ = static_cast<CeedSize>(num_comp) * local.local_size;
  dof_offsets_ = std::move(local.offsets);
  for (CeedInt &offset : dof_offsets_) offset *= problem.num_comp;

  const Section section = interleave(box_, scalar_section, num_comp, problem.is_poisson);
  ok(DMClone(box_, solution_dm_.out()));
  ok(DMSetLocalSection(solution_dm_, section));
}

}  // namespace hg::bps
