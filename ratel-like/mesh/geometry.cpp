// Corners, faces and node coordinates of the cells.
#include <algorithm>

#include "mesh/mesh.hpp"
#include "options/error.hpp"

namespace hg {

namespace {

// DMPlex lists the vertices of a hexahedron as its low face seen from below, then its high face seen from above; this
// is the place of each tensor-ordered corner in that list.
constexpr int plex_corner[8] = {0, 3, 1, 2, 4, 5, 7, 6};

// det ∂x/∂X at a corner of the trilinear cell, from the three edges that meet there.
double corner_det(std::span<const double, 24> corners, int corner) {
  double edge[3][3];
  for (int d = 0; d < 3; ++d) {
    const int low = corner & ~(1 << d), high = corner | (1 << d);
    for (int c = 0; c < 3; ++c) edge[d][c] = (corners[3 * high + c] - corners[3 * low + c]) / 2;
  }
  return edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) -
         edge[0][1] * (edge[1][0] * edge[2][2] - edge[1][2] * edge[2][0]) +
         edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
}

}  // namespace

void Mesh::read_geometry(const std::function<void(double *)> &deform) {
  PetscInt vertex_start, vertex_end;
  petsc_check(DMPlexGetDepthStratum(base_, 0, &vertex_start, &vertex_end));
  vertices.resize(8 * static_cast<std::size_t>(num_cells));
  for (CeedInt cell = 0; cell < num_cells; ++cell) {
    PetscInt size, *closure = nullptr, plex_vertices[8], found = 0;
    petsc_check(DMPlexGetTransitiveClosure(base_, cell_start + cell, PETSC_TRUE, &size, &closure));
    for (PetscInt i = 0; i < size; ++i) {
      const PetscInt point = closure[2 * i];
      if (point >= vertex_start && point < vertex_end && found < 8) plex_vertices[found++] = point;
    }
    petsc_check(DMPlexRestoreTransitiveClosure(base_, cell_start + cell, PETSC_TRUE, &size, &closure));
    for (int corner = 0; corner < 8; ++corner) vertices[8 * cell + corner] = plex_vertices[plex_corner[corner]];
  }

  Vec coordinates;
  PetscSection section;
  petsc_check(DMGetCoordinatesLocal(base_, &coordinates));
  petsc_check(DMGetCoordinateSection(base_, &section));
  const PetscInt num_vertices = vertex_end - vertex_start;
  std::vector<double> vertex_coords(3 * static_cast<std::size_t>(num_vertices));
  PetscScalar *array;
  petsc_check(VecGetArray(coordinates, &array));
  for (PetscInt v = 0; v < num_vertices; ++v) {
    PetscInt offset;
    petsc_check(PetscSectionGetOffset(section, vertex_start + v, &offset));
    if (deform) deform(array + offset);
    std::copy_n(array + offset, 3, vertex_coords.data() + 3 * v);
  }
  petsc_check(VecRestoreArray(coordinates, &array));
  if (deform) petsc_check(DMSetCoordinatesLocal(base_, coordinates));

  std::vector<CeedInt> offsets(vertices.size());
  corner_coords.resize(24 * static_cast<std::size_t>(num_cells));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    offsets[i] = static_cast<CeedInt>(3 * (vertices[i] - vertex_start));
    std::copy_n(vertex_coords.data() + offsets[i], 3, corner_coords.data() + 3 * i);
  }
  rstr_x = make_restriction(offsets, 1, 3, 3 * num_vertices);
  ceed_check(CeedVectorCreate(ceed, 3 * num_vertices, x.put()));
  ceed_check(CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, vertex_coords.data()));

  for (CeedInt cell = 0; cell < num_cells; ++cell) {
    for (int corner = 0; corner < 8; ++corner) {
      const double det = corner_det(corners(cell), corner);
      if (!(det > 0)) {
        const double *at = corner_coords.data() + 24 * static_cast<std::size_t>(cell) + 3 * corner;
        fail("mesh: cell %" CeedInt_FMT " is inverted at its corner (%g, %g, %g): determinant %g, expected > 0", cell,
             at[0], at[1], at[2], det);
      }
    }
  }
  find_faces();
}

void Mesh::find_faces() {
  faces.assign(6 * static_cast<std::size_t>(num_cells), -1);
  neighbours.assign(faces.size(), -1);
  for (CeedInt cell = 0; cell < num_cells; ++cell) {
    const PetscInt *cone;
    petsc_check(DMPlexGetCone(base_, cell_start + cell, &cone));
    for (int f = 0; f < 6; ++f) {
      // The four corners of a face agree in one bit: that is its direction and its side.
      PetscInt size, *closure = nullptr;
      int all = 7, any = 0;
      petsc_check(DMPlexGetTransitiveClosure(base_, cone[f], PETSC_TRUE, &size, &closure));
      for (int corner = 0; corner < 8; ++corner) {
        for (PetscInt i = 0; i < size; ++i) {
          if (closure[2 * i] == vertices[8 * cell + corner]) {
            all &= corner;
            any |= corner;
          }
        }
      }
      petsc_check(DMPlexRestoreTransitiveClosure(base_, cone[f], PETSC_TRUE, &size, &closure));
      const int direction = all ? (all == 1 ? 0 : all == 2 ? 1 : 2) : (any == 6 ? 0 : any == 5 ? 1 : 2);
      const std::size_t slot = 6 * static_cast<std::size_t>(cell) + 2 * direction + (all ? 1 : 0);
      faces[slot] = cone[f];
      PetscInt support_size;
      const PetscInt *support;
      petsc_check(DMPlexGetSupportSize(base_, cone[f], &support_size));
      petsc_check(DMPlexGetSupport(base_, cone[f], &support));
      for (PetscInt i = 0; i < support_size; ++i) {
        if (support[i] != cell_start + cell) neighbours[slot] = support[i] - cell_start;
      }
    }
  }
}

const std::vector<double> &Mesh::node_coordinates(PetscInt space_order) const {
  if (const auto known = node_coordinates_.find(space_order); known != node_coordinates_.end()) return known->second;
  const MeshSpace &scalar = space(space_order, 1);
  auto &coordinates = node_coordinates_[space_order];
  PetscSection section;
  petsc_check(DMGetLocalSection(scalar.dm, &section));
  const std::vector<CeedInt> nodes = make_offsets(section, space_order, 1);
  const int P = static_cast<int>(space_order) + 1;
  std::vector<double> reference(P), weights(P);
  ceed_check(CeedLobattoQuadrature(P, reference.data(), weights.data()));
  coordinates.assign(3 * static_cast<std::size_t>(scalar.local_size), 0.);
  for (CeedInt cell = 0; cell < num_cells; ++cell) {
    const auto corner = corners(cell);
    for (int node = 0; node < P * P * P; ++node) {
      const double X[3] = {reference[node % P], reference[node / P % P], reference[node / P / P]};
      double at[3] = {0, 0, 0};
      for (int a = 0; a < 8; ++a) {
        double N = 1;
        for (int d = 0; d < 3; ++d) N *= (1 + (a >> d & 1 ? X[d] : -X[d])) / 2;
        for (int c = 0; c < 3; ++c) at[c] += N * corner[3 * a + c];
      }
      std::copy_n(at, 3, coordinates.data() + 3 * static_cast<std::size_t>(nodes[P * P * P * cell + node]));
    }
  }
  return coordinates;
}

}  // namespace hg
