#include "mesh/mesh.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "options/error.hpp"
#include "options/options.hpp"
#include "swarm/partition.hpp"

namespace hg {

namespace {

void default_option(const char *name, const char *value) {
  PetscBool set = PETSC_FALSE;
  petsc_check(PetscOptionsHasName(nullptr, nullptr, name, &set));
  if (!set) petsc_check(PetscOptionsSetValue(nullptr, name, value));
}

/// Vectors and matrices are where the backend works, if this PETSc has them there: -dm_vec_type and -dm_mat_type choose
/// others.
void choose_memory(DM dm, Ceed ceed) {
  const char *resource;
  ceed_check(CeedGetResource(ceed, &resource));
  const auto set = [&](const char *backends, VecType vec, MatType mat) {
    if (!std::string_view(resource).starts_with(backends)) return;
    petsc_check(DMSetVecType(dm, vec));
    petsc_check(DMSetMatType(dm, mat));
  };
#ifdef PETSC_HAVE_CUDA
  set("/gpu/cuda/", VECCUDA, MATAIJCUSPARSE);
#endif
#if defined(PETSC_HAVE_HIP) && PETSC_VERSION_GE(3, 19, 0)
  set("/gpu/hip/", VECHIP, MATAIJHIPSPARSE);
#endif
  (void)set;  // in a PETSc without devices
}

DmHandle read_dm(MPI_Comm comm, Ceed ceed) {
  OptionGroup group(comm, "", "Mesh");
  const std::string file = group.string("dm_plex_filename", "Gmsh file of hexahedra; without it the mesh is a box", "");
  // PETSc reads the options of the box; these calls explain them.
  group.integers("dm_plex_box_faces", "cells of the box in each direction", {1, 1, 1}, 3);
  group.reals("dm_plex_box_lower", "low corner of the box [m]", {0, 0, 0}, 3);
  group.reals("dm_plex_box_upper", "high corner of the box [m]", {1, 1, 1}, 3);
  if (file.empty()) {
    default_option("-dm_plex_dim", "3");
    default_option("-dm_plex_simplex", "0");
    default_option("-dm_plex_box_faces", "1,1,1");
  } else if (!std::filesystem::is_regular_file(file)) {
    fail("option -dm_plex_filename: no file '%s'", file.c_str());
  }

  DmHandle dm;
  petsc_check(DMCreate(comm, dm.put()));
  petsc_check(DMSetType(dm, DMPLEX));
  choose_memory(dm, ceed);
  petsc_check(DMPlexDistributeSetDefault(dm, PETSC_FALSE));  // distribute_mesh does it, and keeps the cells' numbers
  try {
    petsc_check(DMSetFromOptions(dm));
  } catch (const Error &error) {
    if (file.empty()) throw;
    fail("mesh file '%s' could not be read as a mesh: %s", file.c_str(), error.what());
  }
  return dm;
}

}  // namespace

Mesh::Mesh(MPI_Comm comm_in, Ceed ceed_in, const MeshOptions &options)
    : comm(comm_in), ceed(ceed_in), order(options.order) {
  if (order < 1 || order > 8) fail("order of the displacement: %" PetscInt_FMT ", expected 1 to 8", order);
  base_ = read_dm(comm, ceed);
  cell_ids = distribute_mesh(base_, options.cell_weight);
  petsc_check(DMViewFromOptions(base_, nullptr, "-dm_view"));
  read_topology();
  read_geometry(options.deform);
  constrain({});
}

void Mesh::read_topology() {
  PetscInt dim, coordinate_dim, cell_end, found;
  petsc_check(DMGetDimension(base_, &dim));
  petsc_check(DMGetCoordinateDim(base_, &coordinate_dim));
  if (dim != 3 || coordinate_dim != 3) {
    fail("mesh of dimension %" PetscInt_FMT " in %" PetscInt_FMT " coordinates, expected hexahedra in 3", dim,
         coordinate_dim);
  }
  const PetscReal *periodic = nullptr;
  petsc_check(DMGetPeriodicity(base_, nullptr, nullptr, &periodic));
  if (periodic) fail("periodic meshes are not supported");
  petsc_check(DMPlexGetHeightStratum(base_, 0, &cell_start, &cell_end));
  PetscInt other = 0, others = 0;
  for (PetscInt cell = cell_start; cell < cell_end; ++cell) {
    DMPolytopeType type;
    petsc_check(DMPlexGetCellType(base_, cell, &type));
    other += type != DM_POLYTOPE_HEXAHEDRON;
  }
  MPI_Allreduce(&other, &others, 1, MPIU_INT, MPI_SUM, comm);
  found = cell_end - cell_start;
  MPI_Allreduce(&found, &num_cells_global, 1, MPIU_INT, MPI_SUM, comm);
  if (others || num_cells_global == 0) {
    fail("mesh with %" PetscInt_FMT " cells of which %" PetscInt_FMT " are not hexahedra, expected hexahedra only",
         num_cells_global, others);
  }
  if (found > std::numeric_limits<CeedInt>::max() / 24) {
    fail("%" PetscInt_FMT " cells on one rank are more than the 32-bit offsets of CEED hold: use more ranks", found);
  }
  num_cells = static_cast<CeedInt>(found);
}

void Mesh::constrain(std::span<const char> constrained) {
  petsc_check(DMClone(base_, dm.put()));
  SectionHandle section = make_section(order, 3, constrained);
  petsc_check(DMSetLocalSection(dm, section));
  constrained_.assign(constrained.begin(), constrained.end());
  if (!rstr_u) {
    petsc_check(PetscSectionGetStorageSize(section, &local_size));
    offsets_u_ = make_offsets(section, order, 3);
    rstr_u = make_restriction(offsets_u_, order, 3, local_size);
  }
}

const MeshSpace &Mesh::space(PetscInt space_order, CeedInt num_comp) const {
  auto &space = spaces_[{space_order, num_comp}];
  if (!space) {
    space = std::make_unique<MeshSpace>();
    space->order = space_order;
    space->num_comp = num_comp;
    petsc_check(DMClone(base_, space->dm.put()));
    SectionHandle section = make_section(space_order, num_comp, {});
    petsc_check(DMSetLocalSection(space->dm, section));
    petsc_check(PetscSectionGetStorageSize(section, &space->local_size));
    space->rstr =
        make_restriction(make_offsets(section, space_order, num_comp), space_order, num_comp, space->local_size);
  }
  return *space;
}

CeedElemRestrictionHandle Mesh::make_restriction(const std::vector<CeedInt> &offsets, PetscInt space_order,
                                                 CeedInt num_comp, PetscInt size) const {
  const auto nodes = static_cast<CeedInt>((space_order + 1) * (space_order + 1) * (space_order + 1));
  CeedElemRestrictionHandle restriction;
  ceed_check(CeedElemRestrictionCreate(ceed, num_cells, nodes, num_comp, 1, size, CEED_MEM_HOST, CEED_COPY_VALUES,
                                       offsets.data(), restriction.put()));
  return restriction;
}

CeedBasisHandle Mesh::basis(PetscInt space_order, CeedInt num_comp, CeedInt num_points_1d,
                            CeedQuadMode quadrature) const {
  CeedBasisHandle basis;
  ceed_check(CeedBasisCreateTensorH1Lagrange(ceed, 3, num_comp, static_cast<CeedInt>(space_order + 1), num_points_1d,
                                             quadrature, basis.put()));
  return basis;
}

std::vector<PetscInt> Mesh::nodes_on(PetscInt space_order, const std::string &label_name, PetscInt value) const {
  const MeshSpace &scalar = space(space_order, 1);
  PetscSection section;
  petsc_check(DMGetLocalSection(scalar.dm, &section));
  DMLabel label;
  petsc_check(DMGetLabel(base_, label_name.c_str(), &label));
  std::vector<PetscInt> nodes;
  if (!label) return nodes;
  IS points = nullptr;
  petsc_check(DMLabelGetStratumIS(label, value, &points));
  if (!points) return nodes;
  PetscInt count;
  const PetscInt *indices;
  petsc_check(ISGetLocalSize(points, &count));
  petsc_check(ISGetIndices(points, &indices));
  for (PetscInt i = 0; i < count; ++i) {
    PetscInt depth, size, *closure = nullptr;
    petsc_check(DMPlexGetPointDepth(base_, indices[i], &depth));
    if (depth < 2) continue;
    petsc_check(DMPlexGetTransitiveClosure(base_, indices[i], PETSC_TRUE, &size, &closure));
    for (PetscInt j = 0; j < size; ++j) {
      PetscInt offset, dof;
      petsc_check(PetscSectionGetOffset(section, closure[2 * j], &offset));
      petsc_check(PetscSectionGetDof(section, closure[2 * j], &dof));
      for (PetscInt node = offset; node < offset + dof; ++node) nodes.push_back(node);
    }
    petsc_check(DMPlexRestoreTransitiveClosure(base_, indices[i], PETSC_TRUE, &size, &closure));
  }
  petsc_check(ISRestoreIndices(points, &indices));
  petsc_check(ISDestroy(&points));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void Mesh::sum_shared(PetscInt space_order, int width, std::span<double> values) const {
  const MeshSpace &shared = space(space_order, width);
  if (values.size() != static_cast<std::size_t>(shared.local_size)) {
    fail("Mesh::sum_shared: %zu values, expected %" PetscInt_FMT, values.size(), shared.local_size);
  }
  VecHandle local, global;
  petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, shared.local_size, values.data(), local.put()));
  petsc_check(DMCreateGlobalVector(shared.dm, global.put()));
  petsc_check(VecZeroEntries(global));
  petsc_check(DMLocalToGlobal(shared.dm, local, ADD_VALUES, global));
  petsc_check(DMGlobalToLocal(shared.dm, global, INSERT_VALUES, local));
}

}  // namespace hg
