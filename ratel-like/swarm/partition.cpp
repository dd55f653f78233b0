#include "swarm/partition.hpp"

#include <metis.h>
#include <petscpartitioner.h>
#include <petscsf.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "options/error.hpp"

namespace hg {
namespace {

/// The dual graph of a mesh, all of it on rank 0.
struct DualGraph {
  std::vector<PetscInt> starts{0}, neighbours, weights;
};

struct Sizes {
  std::vector<int> counts, starts;
  int total = 0;
};

/// Lengths of every rank's part of a gather to rank 0.
Sizes gather_sizes(MPI_Comm comm, std::size_t mine) {
  int size;
  MPI_Comm_size(comm, &size);
  if (mine > static_cast<std::size_t>(std::numeric_limits<int>::max())) fail("dual graph too large to be gathered");
  const int n = static_cast<int>(mine);
  Sizes s;
  s.counts.resize(size);
  s.starts.assign(size, 0);
  MPI_Allgather(&n, 1, MPI_INT, s.counts.data(), 1, MPI_INT, comm);
  for (int r = 1; r < size; r++) s.starts[r] = s.starts[r - 1] + s.counts[r - 1];
  s.total = s.starts[size - 1] + s.counts[size - 1];
  return s;
}

std::vector<PetscInt> gather(MPI_Comm comm, const std::vector<PetscInt> &mine) {
  const Sizes s = gather_sizes(comm, mine.size());
  int rank;
  MPI_Comm_rank(comm, &rank);
  std::vector<PetscInt> all(rank == 0 ? s.total : 0);
  MPI_Gatherv(mine.data(), static_cast<int>(mine.size()), MPIU_INT, all.data(), s.counts.data(), s.starts.data(),
              MPIU_INT, 0, comm);
  return all;
}

/// Collective, for that is what asking a DM for its coordinates is.
std::vector<PetscInt> cell_weights(DM dm, PetscInt c_start, PetscInt c_end, const CellWeightFn &weight) {
  std::vector<PetscInt> weights(c_end - c_start, 1);
  if (!weight) return weights;
  Vec coordinates;
  PetscSection section;
  petsc_check(DMGetCoordinatesLocal(dm, &coordinates));
  petsc_check(DMGetCoordinateSection(dm, &section));
  for (PetscInt c = c_start; c < c_end; c++) {
    PetscInt n = 0;
    PetscScalar *corners = nullptr;
    petsc_check(DMPlexVecGetClosure(dm, section, coordinates, c, &n, &corners));
    double centroid[3] = {0, 0, 0};
    for (PetscInt i = 0; i < n; i++) centroid[i % 3] += 3.0 * corners[i] / static_cast<double>(n);
    petsc_check(DMPlexVecRestoreClosure(dm, section, coordinates, c, &n, &corners));
    weights[c - c_start] = weight(centroid);
    if (weights[c - c_start] < 0) {
      fail("weight %" PetscInt_FMT " of mesh cell %" PetscInt_FMT ": expected at least 0", weights[c - c_start], c);
    }
  }
  return weights;
}

DualGraph gather_graph(DM dm, MPI_Comm comm, const std::vector<PetscInt> &weights) {
  PetscInt n = 0, *offsets = nullptr, *adjacency = nullptr;
  petsc_check(DMPlexCreatePartitionerGraph(dm, 0, &n, &offsets, &adjacency, nullptr));
  std::vector<PetscInt> degrees(n), neighbours(adjacency, adjacency + (n ? offsets[n] : 0));
  for (PetscInt v = 0; v < n; v++) degrees[v] = offsets[v + 1] - offsets[v];
  petsc_check(PetscFree(offsets));
  petsc_check(PetscFree(adjacency));
  DualGraph graph;
  degrees = gather(comm, degrees);
  for (const PetscInt d : degrees) graph.starts.push_back(graph.starts.back() + d);
  graph.neighbours = gather(comm, neighbours);
  graph.weights = gather(comm, weights);
  return graph;
}

/// This rank's cells grouped by part, as PETSC partitioners of type shell take them.
void cut_by_metis(DM dm, MPI_Comm comm, PetscPartitioner partitioner, const CellWeightFn &weight) {
  PetscMPIInt rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  PetscInt c_start, c_end;
  petsc_check(DMPlexGetHeightStratum(dm, 0, &c_start, &c_end));
  const DualGraph graph = gather_graph(dm, comm, cell_weights(dm, c_start, c_end, weight));
  std::vector<PetscInt> all;
  if (rank == 0) all = partition_graph(graph.starts, graph.neighbours, graph.weights, size);
  std::vector<PetscInt> mine(c_end - c_start);
  const Sizes s = gather_sizes(comm, mine.size());
  MPI_Scatterv(all.data(), s.counts.data(), s.starts.data(), MPIU_INT, mine.data(), static_cast<int>(mine.size()),
               MPIU_INT, 0, comm);
  std::vector<PetscInt> sizes(size, 0), points(mine.size());
  for (const PetscInt part : mine) sizes[part]++;
  std::iota(points.begin(), points.end(), 0);
  std::stable_sort(points.begin(), points.end(), [&](PetscInt a, PetscInt b) { return mine[a] < mine[b]; });
  petsc_check(PetscPartitionerSetType(partitioner, PETSCPARTITIONERSHELL));
  petsc_check(PetscPartitionerShellSetPartition(partitioner, size, sizes.data(), points.data()));
}

}  // namespace

std::vector<PetscInt> partition_graph(std::span<const PetscInt> starts, std::span<const PetscInt> neighbours,
                                      std::span<const PetscInt> weights, PetscInt num_parts) {
  const auto n = static_cast<PetscInt>(starts.size()) - 1;
  std::vector<PetscInt> part(n, 0);
  if (n == 0 || num_parts == 1) return part;
  const auto limit = static_cast<std::size_t>(std::numeric_limits<idx_t>::max());
  if (neighbours.size() > limit || static_cast<std::size_t>(n) > limit) {
    fail("dual graph with %zu entries: METIS was built for at most %zu", neighbours.size(), limit);
  }
  if (num_parts >= n) {
    std::iota(part.begin(), part.end(), 0);
    return part;
  }
  std::vector<idx_t> xadj(starts.begin(), starts.end()), adjncy(neighbours.begin(), neighbours.end());
  std::vector<idx_t> vwgt(n, 1), cut(n);
  PetscInt heaviest = 1;
  for (const PetscInt w : weights) heaviest = std::max(heaviest, w);
  // METIS sums weights in idx_t: scale them so that no sum overflows.
  const double scale = std::min(1.0, 1e9 / (static_cast<double>(heaviest) * static_cast<double>(n)));
  for (std::size_t v = 0; v < weights.size(); v++) {
    vwgt[v] = weights[v] ? std::max<idx_t>(1, static_cast<idx_t>(static_cast<double>(weights[v]) * scale)) : 0;
  }
  idx_t nvtxs = static_cast<idx_t>(n), ncon = 1, nparts = static_cast<idx_t>(num_parts), edges_cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 17;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_NCUTS] =
      4;  // the best of four tries: 144 faces, not 192, between two halves of 12 x 12 x 12 cells
  const int code = METIS_PartGraphKway(&nvtxs, &ncon, xadj.data(), adjncy.data(), vwgt.data(), nullptr, nullptr,
                                       &nparts, nullptr, nullptr, options, &edges_cut, cut.data());
  if (code != METIS_OK)
    fail("METIS_PartGraphKway failed with code %d on a graph of %d cells", code, static_cast<int>(nvtxs));
  std::copy(cut.begin(), cut.end(), part.begin());
  // On small graphs METIS may leave a part empty; such a rank takes a cell of the part with most cells.
  std::vector<PetscInt> sizes(num_parts, 0);
  for (const PetscInt p : part) sizes[p]++;
  for (PetscInt p = 0; p < num_parts; p++) {
    if (sizes[p]) continue;
    const auto largest = static_cast<PetscInt>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    *std::find(part.begin(), part.end(), largest) = p;
    sizes[largest]--;
    sizes[p]++;
  }
  return part;
}

std::vector<PetscInt> distribute_mesh(DmHandle &dm, const CellWeightFn &weight) {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(dm.get()));
  PetscMPIInt rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  PetscInt c_start, c_end;
  petsc_check(DMPlexGetHeightStratum(dm, 0, &c_start, &c_end));
  PetscInt before = 0, n = c_end - c_start;
  MPI_Exscan(&n, &before, 1, MPIU_INT, MPI_SUM, comm);
  if (rank == 0) before = 0;
  std::vector<PetscInt> ids(n);
  std::iota(ids.begin(), ids.end(), before);
  if (size == 1) return ids;

  PetscPartitioner partitioner;
  petsc_check(DMPlexGetPartitioner(dm, &partitioner));
  char type[64] = "metis";
  petsc_check(PetscOptionsGetString(nullptr, nullptr, "-petscpartitioner_type", type, sizeof type, nullptr));
  if (std::string(type) == "metis") {
    cut_by_metis(dm, comm, partitioner, weight);
  } else {
    petsc_check(PetscPartitionerSetType(partitioner, type));
    petsc_check(PetscPartitionerSetFromOptions(partitioner));
  }
  SfHandle migration;
  DmHandle distributed;
  petsc_check(DMPlexDistribute(dm, 0, migration.put(), distributed.put()));
  if (!distributed) fail("the mesh could not be distributed over %d ranks", size);

  // PETSc forgets -dm_vec_type and -dm_mat_type here.
  VecType vec_type;
  MatType mat_type;
  petsc_check(DMGetVecType(dm, &vec_type));
  petsc_check(DMGetMatType(dm, &mat_type));
  petsc_check(DMSetVecType(distributed, vec_type));
  petsc_check(DMSetMatType(distributed, mat_type));

  // Cell numbers travel with the cells. Only cells carry one; other mesh points carry what nobody reads.
  PetscInt old_end, new_start, new_end, new_chart;
  petsc_check(DMPlexGetChart(dm, nullptr, &old_end));
  petsc_check(DMPlexGetChart(distributed, nullptr, &new_chart));
  petsc_check(DMPlexGetHeightStratum(distributed, 0, &new_start, &new_end));
  std::vector<PetscInt> old_ids(old_end, -1), new_ids(new_chart, -1);
  std::copy(ids.begin(), ids.end(), old_ids.begin() + c_start);
  petsc_check(PetscSFBcastBegin(migration, MPIU_INT, old_ids.data(), new_ids.data(), MPI_REPLACE));
  petsc_check(PetscSFBcastEnd(migration, MPIU_INT, old_ids.data(), new_ids.data(), MPI_REPLACE));
  ids.assign(new_ids.begin() + new_start, new_ids.begin() + new_end);
  dm = std::move(distributed);
  return ids;
}

}  // namespace hg
