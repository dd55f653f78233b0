/// @file
/// Fields of the points drawn on the mesh, for the viewers that show meshes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "operators/mpm_operators.hpp"
#include "operators/projection.hpp"
#include "output/mesh_writer.hpp"
#include "solve/setup.hpp"

namespace hg {

/// Writes what -ts_monitor_diagnostic_quantities and -view_diagnostic_quantities ask for in a run by points: stress,
/// pressure, von Mises stress, energy density and displacement of the points, projected to the vertices of the mesh
/// (-mpm_projection lumped|consistent), and the volume of material at each vertex. The mesh is drawn where the step has
/// carried it, before it is reset: there every point lies in it as it did when the step began.
class PointsOnMesh {
 public:
  /// Reads -mpm_projection. The setup must outlive this object. Collective.
  explicit PointsOnMesh(Setup &setup);

  /// After a restart: keeps what was written up to `last_step`.
  void resume(PetscInt last_step);
  bool wanted() const { return series_ || view_; }
  /// Whether something is to be written after this step.
  bool due(PetscInt step, bool last) const;
  /// After the points were updated and before they migrate. diagnostics: num_points × num_diagnostic, storage order;
  /// delta_u: local displacement vector of the step. Collective.
  void write(PetscInt step, double time, bool last, const MpmOperators &operators, const Swarm &swarm,
             const std::vector<double> &diagnostics, std::span<const double> delta_u);

 private:
  Setup &setup_;
  std::optional<PointProjection> projection_;
  std::optional<MeshWriter> series_, view_;
};

}  // namespace hg
