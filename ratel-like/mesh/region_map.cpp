#include "mesh/region_map.hpp"

#include <algorithm>

#include "options/error.hpp"

namespace hg {

namespace {

// Rounding may not decide on which side of a box's face a point lies.
bool inside(const std::array<double, 6> &box, std::span<const double, 3> x) {
  for (int c = 0; c < 3; ++c) {
    const double slack = 1e-10 * (box[c + 3] - box[c]);
    if (x[c] < box[c] - slack || x[c] > box[c + 3] + slack) return false;
  }
  return true;
}

}  // namespace

RegionMap::RegionMap(const Mesh &mesh, std::span<const Region> regions)
    : mesh_(mesh), regions_(regions.begin(), regions.end()), labelled_(regions.size()), cells_(regions.size()) {
  if (std::count_if(regions_.begin(), regions_.end(), [](const Region &region) { return region.takes_rest(); }) > 1) {
    fail("two regions have neither a label nor a box, expected at most one");
  }
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    if (regions_[r].label_name.empty()) continue;
    labelled_[r].assign(mesh.num_cells, 0);
    PetscInt found = 0, total = 0;
    for (CeedInt cell = 0; cell < mesh.num_cells; ++cell) {
      PetscInt value = -1;
      petsc_check(DMGetLabelValue(mesh.dm, regions_[r].label_name.c_str(), mesh.cell_start + cell, &value));
      const auto &wanted = regions_[r].label_values;
      labelled_[r][cell] = std::find(wanted.begin(), wanted.end(), value) != wanted.end();
      found += labelled_[r][cell];
    }
    MPI_Allreduce(&found, &total, 1, MPIU_INT, MPI_SUM, mesh.comm);
    if (total == 0) {
      fail("option -%slabel_value: no cell of the mesh has this value in the label '%s'", regions_[r].prefix.c_str(),
           regions_[r].label_name.c_str());
    }
  }
  of_cell_.resize(mesh.num_cells);
  for (CeedInt cell = 0; cell < mesh.num_cells; ++cell) {
    double centroid[3] = {0, 0, 0};
    const auto corners = mesh.corners(cell);
    for (int i = 0; i < 24; ++i) centroid[i % 3] += corners[i] / 8;
    of_cell_[cell] = find(cell, centroid);
    if (of_cell_[cell] >= 0) cells_[of_cell_[cell]].push_back(cell);
  }
}

int RegionMap::find(CeedInt cell, std::span<const double, 3> x) const {
  int rest = -1;
  for (int r = 0; r < num_regions(); ++r) {
    const Region &region = regions_[r];
    if (region.takes_rest()) rest = r;
    if (!labelled_[r].empty() && labelled_[r][cell]) return r;
    if (region.box && inside(*region.box, x)) return r;
  }
  return rest;
}

int RegionMap::of_point(CeedInt cell, std::span<const double, 3> x) const {
  return find(cell, x);
}

void RegionMap::require_all_cells() const {
  PetscInt without = std::count(of_cell_.begin(), of_cell_.end(), -1), total = 0;
  MPI_Allreduce(&without, &total, 1, MPIU_INT, MPI_SUM, mesh_.comm);
  if (total) {
    fail("%" PetscInt_FMT " of %" PetscInt_FMT " cells are in no region of -material, expected all to be in one", total,
         mesh_.num_cells_global);
  }
}

}  // namespace hg
