#pragma once
#include <petscdmswarm.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "options/handle.hpp"
#include "swarm/cell_grid.hpp"
#include "swarm/locate.hpp"

namespace hg {

/// Names of the fields every point carries. Vectors have 3 components, tensors 9, row-major F[3 i + J].
namespace field {
inline constexpr const char *x = "x";                ///< double 3: position, m
inline constexpr const char *X0 = "X0";              ///< double 3: position when seeded, m
inline constexpr const char *u = "u";                ///< double 3: displacement since seeding, m
inline constexpr const char *v = "v";                ///< double 3: velocity, m/s
inline constexpr const char *F = "F";                ///< double 9: deformation gradient since seeding
inline constexpr const char *V = "V";                ///< double 1: current volume, m³
inline constexpr const char *V0 = "V0";              ///< double 1: volume when seeded, m³
inline constexpr const char *rho0 = "rho0";          ///< double 1: density when seeded, kg/m³; mass = rho0 V0
inline constexpr const char *material = "material";  ///< double 2: bulk modulus K, shear modulus μ, Pa
inline constexpr const char *x_ref = "x_ref";        ///< double 3: reference coordinate ξ in the cell, [-1, 1]³
inline constexpr const char *region = "region";      ///< int32: index of the region
inline constexpr const char *id = "id";              ///< int64: cell_id × points per cell + k; unique, partition-free
inline constexpr const char *cell = "cell";          ///< int32: local cell that owns the point
}  // namespace field

/// How points are placed in the reference cell: centres of an n × n × n subdivision with equal weights, Gauss-Legendre
/// n × n × n with V = w det J, or pseudo-random with equal weights. Equal weights: V = cell volume / N.
enum class PointPlacement { kUniform, kGauss, kCellRandom };

/// What becomes of a point that leaves the domain: an error, moved back to the nearest point of the nearest cell
/// (u keeps x = X0 + u), or removed with its mass, which is reported and taken off the mass that must be conserved.
enum class OutsidePolicy { kError, kProject, kRemove };

struct SwarmOptions {
  PetscInt points_per_cell = 8;                         ///< -mpm_num_points_per_cell (a cube but for cell_random)
  PointPlacement placement = PointPlacement::kUniform;  ///< -mpm_point_location_type uniform|gauss|cell_random
  PetscInt seed = 42;                                   ///< -mpm_seed, for cell_random
  OutsidePolicy outside = OutsidePolicy::kError;        ///< -mpm_point_outside error|project|remove

  double void_stiffness = 0.;  ///< -mpm_void_stiffness: see MpmOperators

  /// Reads and checks them; a bad value throws hg::Error that names option, value and expectation. Collective.
  static SwarmOptions read(MPI_Comm comm);
  /// Throws hg::Error on a number of points that the placement cannot have.
  void check() const;
};

/// What seeding asks of its caller for each point.
struct PointMaterial {
  std::int32_t region = 0;  ///< negative: no point here
  double rho0 = 0.0;        ///< kg/m³
  double K = 0.0;           ///< Pa
  double mu = 0.0;          ///< Pa
};
/// cell: local cell; x: position of the point.
using PointMaterialFn = std::function<PointMaterial(std::int32_t cell, const double x[3])>;

/// Material points of this rank: a DMSWARM_BASIC with the fields above, storage order = DMSwarm's order.
/// Movable, not copyable. One instance lives for the whole run. Functions throw hg::Error.
class Swarm {
 public:
  /// An empty swarm with every field registered. Collective on comm.
  explicit Swarm(MPI_Comm comm);

  DM dm() const { return dm_; }
  MPI_Comm comm() const;
  /// Points on this rank.
  PetscInt local_size() const;
  /// Points on all ranks. Collective.
  PetscInt global_size() const;
  /// Makes room for n points on this rank; the values of new points are not set. Not collective.
  void resize(PetscInt n);

  /// Σ rho0 V0 over all ranks, kg, independent of how points are spread (to rounding). Collective.
  double total_mass() const;

 private:
  DmHandle dm_;
};

/// Scoped access to one field of a swarm as a span in storage order, n × components. The swarm may not be resized or
/// migrated meanwhile, and a field has one accessor at a time. T must match the field's type; a name or type that the
/// swarm does not have throws hg::Error.
template <class T>
class PointField {
 public:
  PointField(const Swarm &swarm, const char *name) : PointField(swarm.dm(), name) {}
  PointField(DM dm, const char *name);
  ~PointField();
  PointField(const PointField &) = delete;
  PointField &operator=(const PointField &) = delete;

  std::span<T> span() const { return {data_, size_}; }
  T *data() const { return data_; }
  std::size_t size() const { return size_; }  ///< n × components
  PetscInt components() const { return components_; }
  T &operator[](std::size_t i) const { return data_[i]; }

 private:
  DM dm_;
  const char *name_;
  T *data_ = nullptr;
  std::size_t size_ = 0;
  PetscInt components_ = 1;
};
/// The fields above, in a fixed order: bytes of one component, and components.
struct PointFieldSpec {
  const char *name;
  std::size_t bytes;
  PetscInt components;
};
std::span<const PointFieldSpec> point_fields();

extern template class PointField<double>;
extern template class PointField<std::int32_t>;
extern template class PointField<std::int64_t>;

/// Fills an empty swarm: for each cell of the grid, points where `material` wants them; F = I, u = v = 0, x = X0.
/// Collective (only for its checks); each rank seeds its own cells, and ids, places and random numbers depend on the
/// cell's global number alone, so every partition seeds the same points.
void seed_swarm(const SwarmOptions &options, const CellGrid &grid, const HexLocator &locator,
                const PointMaterialFn &material, Swarm &swarm);

}  // namespace hg
