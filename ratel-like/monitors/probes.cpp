#include "monitors/probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "options/error.hpp"
#include "options/options.hpp"

namespace hg {

namespace {

// The smallest rank that holds a place answers for it.
int owner_of(MPI_Comm comm, bool here) {
  int rank, size, mine, owner;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  mine = here ? rank : size;
  MPI_Allreduce(&mine, &owner, 1, MPI_INT, MPI_MIN, comm);
  return owner < size ? owner : -1;
}

Location locate(const Mesh &mesh, const HexLocator &locator, const std::array<double, 3> &place) {
  const Location where = locator.find(place.data());
  if (owner_of(mesh.comm, where.place == PointPlace::kInside) < 0) {
    fail("option -probe: the point (%g, %g, %g) lies outside the mesh", place[0], place[1], place[2]);
  }
  return where;
}

// Lagrange polynomials through the nodes, at X.
std::vector<double> lagrange(const std::vector<double> &nodes, double X) {
  std::vector<double> N(nodes.size(), 1.);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (i != j) N[i] *= (X - nodes[j]) / (nodes[i] - nodes[j]);
    }
  }
  return N;
}

}  // namespace

Places read_probes(MPI_Comm comm) {
  OptionGroup group(comm, "", "Probes");
  const std::vector<double> flat = group.reals(
      "probe", "x,y,z of places whose displacement is monitored; MPM follows the nearest material points [m]", {}, -1);
  if (flat.size() % 3 != 0) fail("option -probe: %zu numbers, expected 3 for each place", flat.size());
  Places places(flat.size() / 3);
  for (std::size_t i = 0; i < flat.size(); ++i) places[i / 3][i % 3] = flat[i];
  return places;
}

MeshProbes::MeshProbes(const Mesh &mesh, const HexLocator &locator, const Places &places) : mesh_(mesh) {
  const int P = static_cast<int>(mesh.order) + 1;
  std::vector<double> nodes(P), weights(P);
  ceed_check(CeedLobattoQuadrature(P, nodes.data(), weights.data()));
  int rank;
  MPI_Comm_rank(mesh.comm, &rank);
  for (const auto &place : places) {
    const Location where = locate(mesh, locator, place);
    Place here;
    if (owner_of(mesh.comm, where.place == PointPlace::kInside) == rank) {
      here.cell = where.index;
      const auto Nx = lagrange(nodes, where.xi[0]), Ny = lagrange(nodes, where.xi[1]),
                 Nz = lagrange(nodes, where.xi[2]);
      for (int k = 0; k < P; ++k) {
        for (int j = 0; j < P; ++j) {
          for (int i = 0; i < P; ++i) here.shape.push_back(Nx[i] * Ny[j] * Nz[k]);
        }
      }
    }
    places_.push_back(std::move(here));
  }
}

std::vector<std::array<double, 3>> MeshProbes::evaluate(std::span<const double> local) const {
  std::vector<std::array<double, 3>> values(places_.size());
  if (values.empty()) return values;
  for (std::size_t p = 0; p < places_.size(); ++p) {
    const Place &place = places_[p];
    for (std::size_t n = 0; n < place.shape.size(); ++n) {
      const CeedInt offset = mesh_.node_offsets()[place.cell * place.shape.size() + n];
      for (int c = 0; c < 3; ++c) values[p][c] += place.shape[n] * local[offset + c];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(3 * values.size()), MPI_DOUBLE, MPI_SUM, mesh_.comm);
  return values;
}

PointProbes::PointProbes(const Mesh &mesh, const HexLocator &locator, const Swarm &swarm, const Places &places)
    : comm_(mesh.comm) {
  const PointField<double> X0(swarm, field::X0);
  const PointField<std::int64_t> id(swarm, field::id);
  const std::size_t n = id.size();
  if (!places.empty() && swarm.global_size() == 0) fail("option -probe: there are no material points");
  for (const auto &place : places) {
    locate(mesh, locator, place);
    std::vector<double> distance(n);
    double nearest = std::numeric_limits<double>::infinity(), nearest_of_all;
    for (std::size_t p = 0; p < n; ++p) {
      distance[p] = std::hypot(X0[3 * p] - place[0], X0[3 * p + 1] - place[1], X0[3 * p + 2] - place[2]);
      nearest = std::min(nearest, distance[p]);
    }
    MPI_Allreduce(&nearest, &nearest_of_all, 1, MPI_DOUBLE, MPI_MIN, comm_);
    // Equal but for rounding, which grows with the coordinates.
    const double slack = 1e-9 * (nearest_of_all + std::hypot(place[0], place[1], place[2]));
    std::vector<std::int64_t> mine;
    for (std::size_t p = 0; p < n; ++p) {
      if (distance[p] <= nearest_of_all + slack) mine.push_back(id[p]);
    }
    int size, count = static_cast<int>(mine.size());
    MPI_Comm_size(comm_, &size);
    std::vector<int> counts(size), starts(size + 1, 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
    for (int r = 0; r < size; ++r) starts[r + 1] = starts[r] + counts[r];
    std::vector<std::int64_t> all(starts[size]);
    MPI_Allgatherv(mine.data(), count, MPI_INT64_T, all.data(), counts.data(), starts.data(), MPI_INT64_T, comm_);
    std::sort(all.begin(), all.end());
    ids_.push_back(std::move(all));
  }
}

std::vector<std::array<double, 3>> PointProbes::evaluate(const Swarm &swarm) const {
  std::vector<std::array<double, 3>> values(ids_.size());
  if (values.empty()) return values;
  std::vector<std::int64_t> wanted;
  for (const auto &ids : ids_) wanted.insert(wanted.end(), ids.begin(), ids.end());
  std::sort(wanted.begin(), wanted.end());
  const PointField<double> u(swarm, field::u);
  const PointField<std::int64_t> id(swarm, field::id);
  for (std::size_t p = 0; p < id.size(); ++p) {
    if (!std::binary_search(wanted.begin(), wanted.end(), id[p])) continue;
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      if (!std::binary_search(ids_[k].begin(), ids_[k].end(), id[p])) continue;
      for (int c = 0; c < 3; ++c) values[k][c] += u[3 * p + c] / static_cast<double>(ids_[k].size());
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(3 * values.size()), MPI_DOUBLE, MPI_SUM, comm_);
  return values;
}

}  // namespace hg
