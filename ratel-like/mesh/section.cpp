// Nodes of an order-p space: how many each mesh point owns, and where a cell's tensor-ordered nodes lie among them.
//
// A vertex owns one node, an edge p-1, a quadrilateral (p-1)², a cell (p-1)³. An edge counts its nodes from the first
// to the second vertex of its cone; a face counts them in its own frame (from its first vertex, fastest towards the
// second). Cones travel unchanged when a mesh is distributed, so every cell and every rank agrees on that order.
#include <algorithm>

#include "mesh/mesh.hpp"
#include "options/error.hpp"

namespace hg {

namespace {

struct Edge {
  PetscInt offset;
  bool reversed;  // the edge runs against the cell's direction
};

struct Face {
  PetscInt offset;
  bool swapped;      // the face's first direction is the second one of the cell
  bool reversed[2];  // in the cell's first and second direction on the face
};

int corner_of(std::span<const PetscInt> vertices, PetscInt vertex) {
  return static_cast<int>(std::find(vertices.begin(), vertices.end(), vertex) - vertices.begin());
}

int direction_between(int corner_a, int corner_b) {
  const int bit = corner_a ^ corner_b;
  return bit == 1 ? 0 : bit == 2 ? 1 : 2;
}

}  // namespace

SectionHandle Mesh::make_section(PetscInt space_order, CeedInt num_comp, std::span<const char> constrained) const {
  SectionHandle section;
  PetscInt start, end;
  petsc_check(PetscSectionCreate(comm, section.put()));
  petsc_check(PetscSectionSetNumFields(section, 1));
  petsc_check(PetscSectionSetFieldComponents(section, 0, num_comp));
  petsc_check(DMPlexGetChart(base_, &start, &end));
  petsc_check(PetscSectionSetChart(section, start, end));
  std::vector<std::pair<PetscInt, std::vector<PetscInt>>> constraints;
  std::size_t entry = 0;
  for (PetscInt dim = 0, nodes = 1; dim <= 3; ++dim, nodes *= space_order - 1) {
    PetscInt stratum_start, stratum_end;
    petsc_check(DMPlexGetDepthStratum(base_, dim, &stratum_start, &stratum_end));
    for (PetscInt point = stratum_start; point < stratum_end; ++point) {
      petsc_check(PetscSectionSetDof(section, point, nodes * num_comp));
      petsc_check(PetscSectionSetFieldDof(section, point, 0, nodes * num_comp));
    }
  }
  if (constrained.empty()) {
    petsc_check(PetscSectionSetUp(section));
    return section;
  }
  // Entries of a local vector follow the chart, point after point.
  for (PetscInt point = start; point < end; ++point) {
    PetscInt dof;
    petsc_check(PetscSectionGetDof(section, point, &dof));
    std::vector<PetscInt> indices;
    for (PetscInt i = 0; i < dof; ++i, ++entry) {
      if (entry < constrained.size() && constrained[entry]) indices.push_back(i);
    }
    if (indices.empty()) continue;
    petsc_check(PetscSectionSetConstraintDof(section, point, static_cast<PetscInt>(indices.size())));
    petsc_check(PetscSectionSetFieldConstraintDof(section, point, 0, static_cast<PetscInt>(indices.size())));
    constraints.emplace_back(point, std::move(indices));
  }
  if (entry != constrained.size()) {
    fail("Mesh::constrain: %zu flags for %zu entries of a local vector", constrained.size(), entry);
  }
  petsc_check(PetscSectionSetUp(section));
  for (const auto &[point, indices] : constraints) {
    petsc_check(PetscSectionSetConstraintIndices(section, point, indices.data()));
    petsc_check(PetscSectionSetFieldConstraintIndices(section, point, 0, indices.data()));
  }
  return section;
}

std::vector<CeedInt> Mesh::make_offsets(PetscSection section, PetscInt space_order, CeedInt num_comp) const {
  PetscInt size;
  petsc_check(PetscSectionGetStorageSize(section, &size));
  if (size > std::numeric_limits<CeedInt>::max()) {
    fail("%" PetscInt_FMT " local unknowns are more than the 32-bit offsets of CEED hold: use more ranks", size);
  }
  const int p = static_cast<int>(space_order), P = p + 1, inner = p - 1;
  const std::size_t nodes = static_cast<std::size_t>(P) * P * P;
  std::vector<CeedInt> offsets(nodes * num_cells);
  const auto offset_of = [&](PetscInt point) {
    PetscInt offset;
    petsc_check(PetscSectionGetOffset(section, point, &offset));
    return offset;
  };

  for (CeedInt cell = 0; cell < num_cells; ++cell) {
    const std::span<const PetscInt> corners(vertices.data() + 8 * static_cast<std::size_t>(cell), 8);
    // edges[d][low corner of the edge], faces[direction normal to the face][side]
    Edge edges[3][8] = {};
    Face quads[3][2] = {};
    for (int f = 0; p > 1 && f < 6; ++f) {
      const PetscInt face = faces[6 * static_cast<std::size_t>(cell) + f];
      PetscInt closure_size, *closure = nullptr;
      petsc_check(DMPlexGetTransitiveClosure(base_, face, PETSC_TRUE, &closure_size, &closure));
      // Closure of a quadrilateral: itself, four edges, four vertices around it.
      int around[4];
      for (int i = 0; i < 4; ++i) {
        const PetscInt edge = closure[2 * (1 + i)];
        const PetscInt *ends;
        petsc_check(DMPlexGetCone(base_, edge, &ends));
        const int first = corner_of(corners, ends[0]), second = corner_of(corners, ends[1]);
        edges[direction_between(first, second)][std::min(first, second)] = {offset_of(edge), first > second};
        around[i] = corner_of(corners, closure[2 * (5 + i)]);
      }
      petsc_check(DMPlexRestoreTransitiveClosure(base_, face, PETSC_TRUE, &closure_size, &closure));
      const int normal = f / 2, first = normal == 0 ? 1 : 0, second = normal == 2 ? 1 : 2;
      quads[normal][f % 2] = {offset_of(face),
                              direction_between(around[0], around[1]) != first,
                              {(around[0] >> first & 1) != 0, (around[0] >> second & 1) != 0}};
    }
    const PetscInt interior = offset_of(cell_start + cell);

    for (int node = 0; node < static_cast<int>(nodes); ++node) {
      const int at[3] = {node % P, node / P % P, node / P / P};
      int open[3], num_open = 0, low = 0;  // directions in which the node is inside; the corner at the low end of them
      for (int d = 0; d < 3; ++d) {
        if (at[d] > 0 && at[d] < p) open[num_open++] = d;
        if (at[d] == p) low |= 1 << d;
      }
      PetscInt offset, index = 0;
      if (num_open == 0) {
        offset = offset_of(corners[low]);
      } else if (num_open == 1) {
        const Edge &edge = edges[open[0]][low];
        offset = edge.offset;
        index = edge.reversed ? p - 1 - at[open[0]] : at[open[0]] - 1;
      } else if (num_open == 2) {
        const int normal = 3 - open[0] - open[1];
        const Face &quad = quads[normal][low >> normal & 1];
        const int s = quad.reversed[0] ? p - 1 - at[open[0]] : at[open[0]] - 1;
        const int t = quad.reversed[1] ? p - 1 - at[open[1]] : at[open[1]] - 1;
        offset = quad.offset;
        index = quad.swapped ? s * inner + t : t * inner + s;
      } else {
        offset = interior;
        index = ((at[2] - 1) * inner + at[1] - 1) * inner + at[0] - 1;
      }
      offsets[nodes * cell + node] = static_cast<CeedInt>(offset + index * num_comp);
    }
  }
  return offsets;
}

}  // namespace hg
