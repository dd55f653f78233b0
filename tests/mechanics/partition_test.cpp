// Cutting the mesh by METIS.
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "points_fixture.hpp"
#include "swarm/partition.hpp"

namespace hg::test {
namespace {

struct Graph {
  std::vector<PetscInt> starts{0}, neighbours;
};
Graph box_graph(std::array<int, 3> n) {
  const CellGrid grid = make_box_grid(n, {0, 0, 0}, {1, 1, 1});
  Graph g;
  for (std::size_t i = 0; i < grid.neighbours.size(); i++) {
    if (grid.neighbours[i] >= 0) g.neighbours.push_back(grid.neighbours[i]);
    if (i % 6 == 5) g.starts.push_back(static_cast<PetscInt>(g.neighbours.size()));
  }
  return g;
}

TEST(PartitionGraph, parts_are_balanced_and_the_cut_is_small) {
  const Graph g = box_graph({12, 12, 12});
  for (const PetscInt parts : {1, 2, 3, 5, 8}) {
    const auto part = partition_graph(g.starts, g.neighbours, {}, parts);
    std::vector<int> size(parts, 0);
    for (const PetscInt p : part) size.at(p)++;
    const double mean = 1728.0 / static_cast<double>(parts);
    for (const int s : size) {
      EXPECT_LE(s, 1.05 * mean);
      EXPECT_GE(s, 0.9 * mean);
    }
    int cut = 0;
    for (PetscInt v = 0; v < 1728; v++) {
      for (PetscInt e = g.starts[v]; e < g.starts[v + 1]; e++) cut += part[v] < part[g.neighbours[e]];
    }
    // Slabs cut (parts - 1) × 144 faces; a graph partitioner does at least nearly as well.
    EXPECT_LE(cut, 1.25 * 144 * static_cast<double>(parts - 1));
    EXPECT_EQ(part, partition_graph(g.starts, g.neighbours, {}, parts)) << "not deterministic";
  }
}

TEST(PartitionGraph, weights_count) {
  const Graph g = box_graph({16, 4, 4});
  std::vector<PetscInt> weights(256);
  for (int v = 0; v < 256; v++) weights[v] = v % 16 < 4 ? 30 : 1;  // a quarter of the cells has most of the points
  const auto part = partition_graph(g.starts, g.neighbours, weights, 2);
  PetscInt load[2] = {0, 0};
  for (int v = 0; v < 256; v++) load[part[v]] += weights[v];
  const double total = 64 * 30 + 192;
  EXPECT_NEAR(static_cast<double>(load[0]), total / 2, 0.05 * total);
}

TEST(PartitionGraph, weights_too_large_to_add_are_scaled) {
  const Graph g = box_graph({8, 8, 8});
  const std::vector<PetscInt> weights(512, 2000000000);
  const auto part = partition_graph(g.starts, g.neighbours, weights, 4);
  std::vector<int> size(4, 0);
  for (const PetscInt p : part) size.at(p)++;
  for (const int s : size) EXPECT_NEAR(s, 128, 10);
}

TEST(PartitionGraph, no_part_is_empty_when_there_are_cells_enough) {
  for (int n = 1; n < 9; n++) {
    const Graph g = box_graph({n, 1, 1});
    for (PetscInt parts = 1; parts < 9; parts++) {
      const auto part = partition_graph(g.starts, g.neighbours, {}, parts);
      const std::set<PetscInt> used(part.begin(), part.end());
      EXPECT_EQ(used.size(), static_cast<std::size_t>(std::min<PetscInt>(n, parts)))
          << n << " cells, " << parts << " parts";
      EXPECT_LT(*used.rbegin(), parts);
    }
  }
}

PetscInt global_sum(PetscInt mine) {
  PetscInt all;
  MPI_Allreduce(&mine, &all, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
  return all;
}

TEST(DistributeMesh, every_cell_once_with_its_number_before) {
  CeedHandle ceed = make_ceed();
  const auto mesh = box_mesh(ceed, "4,3,5", {});
  ASSERT_EQ(mesh->cell_ids.size(), static_cast<std::size_t>(mesh->num_cells));
  EXPECT_EQ(global_sum(mesh->num_cells), 60);
  EXPECT_GE(mesh->num_cells, 60 / ranks() * 8 / 10);
  std::vector<int> seen(60, 0), all(60);
  for (const PetscInt id : mesh->cell_ids) seen.at(id)++;
  MPI_Allreduce(seen.data(), all.data(), 60, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  EXPECT_EQ(all, std::vector<int>(60, 1));
  // The numbers mean the same cells as on one rank.
  ScopedOptions scoped{{"-dm_plex_box_faces", "4,3,5"}};
  const Mesh alone(PETSC_COMM_SELF, ceed, {});
  for (CeedInt c = 0; c < mesh->num_cells; c++) {
    const auto a = mesh->corners(c);
    const auto b = alone.corners(static_cast<CeedInt>(mesh->cell_ids[c]));
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
  }
}

TEST(DistributeMesh, cells_are_weighted) {
  if (ranks() == 1) GTEST_SKIP() << "one rank has all cells";
  CeedHandle ceed = make_ceed();
  MeshOptions options;
  options.cell_weight = [](const double *x) -> PetscInt { return x[2] < 0.25 ? 50 : 1; };
  const auto mesh = box_mesh(ceed, "6,6,8", options);
  PetscInt load = 0;
  for (CeedInt c = 0; c < mesh->num_cells; c++) {
    const auto x = mesh->corners(c);
    double z = 0;
    for (int b = 0; b < 8; b++) z += x[3 * b + 2] / 8;
    load += z < 0.25 ? 50 : 1;
  }
  const double mean = static_cast<double>(global_sum(load)) / ranks();
  EXPECT_NEAR(static_cast<double>(load), mean, 0.1 * mean);
}

TEST(DistributeMesh, PETScs_own_partitioner_by_option) {
  CeedHandle ceed = make_ceed();
  ScopedOptions scoped{{"-petscpartitioner_type", "simple"}};
  const auto mesh = box_mesh(ceed, "3,3,3", {});
  EXPECT_EQ(global_sum(mesh->num_cells), 27);
}

TEST(DistributeMesh, more_ranks_than_cells) {
  CeedHandle ceed = make_ceed();
  const auto mesh = box_mesh(ceed, "1,1,1", {});
  EXPECT_EQ(global_sum(mesh->num_cells), 1);
  const CellGrid grid = build_cell_grid(*mesh);
  const HexLocator locator(grid);
  Swarm swarm(PETSC_COMM_WORLD);
  seed_swarm({}, grid, locator, everywhere, swarm);
  locate_points({}, grid, locator, swarm);
  EXPECT_EQ(swarm.global_size(), 8);
  EXPECT_EQ(swarm.local_size(), mesh->num_cells * 8);
  const PointEpoch epoch(ceed, mesh->num_cells, swarm);
  EXPECT_EQ(epoch.num_points(), swarm.local_size());
}

}  // namespace
}  // namespace hg::test
