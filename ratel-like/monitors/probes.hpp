/// @file
/// Displacement at places chosen by -probe x,y,z[,x,y,z...].
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "swarm/locate.hpp"
#include "swarm/swarm.hpp"

namespace hg {

using Places = std::vector<std::array<double, 3>>;

/// Reads -probe. Collective.
Places read_probes(MPI_Comm comm);

/// Evaluates an order-p field of the mesh at fixed places.
class MeshProbes {
 public:
  /// Error that names the place if it lies in no cell of any rank. Collective.
  MeshProbes(const Mesh &mesh, const HexLocator &locator, const Places &places);

  /// Values of a local array of mesh.dm, the same on every rank. Collective.
  std::vector<std::array<double, 3>> evaluate(std::span<const double> local) const;

 private:
  struct Place {
    CeedInt cell = -1;  ///< -1: another rank evaluates it
    std::vector<double> shape;
  };
  const Mesh &mesh_;
  std::vector<Place> places_;
};

/// Follows material points: those whose initial position is nearest to a place. Several that are equally near stand for
/// it together, with their mean displacement.
class PointProbes {
 public:
  /// Collective. Error that names the place if it lies outside the mesh.
  PointProbes(const Mesh &mesh, const HexLocator &locator, const Swarm &swarm, const Places &places);

  /// Mean displacement u of the points of each place, the same on every rank. Collective.
  std::vector<std::array<double, 3>> evaluate(const Swarm &swarm) const;

 private:
  MPI_Comm comm_;
  std::vector<std::vector<std::int64_t>> ids_;  ///< of each place, ascending, the same on every rank
};

}  // namespace hg
