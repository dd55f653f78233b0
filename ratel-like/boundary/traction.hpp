/// @file
/// Tractions on faces of the mesh, as dead loads: force per undeformed area, direction fixed in space (FEM).
///
/// -bc_traction f,...             faces with label "Face Sets" value f
/// -bc_traction_f x,y,z[,...]     a vector for each time [Pa]
/// -bc_traction_f_times, -bc_traction_f_interpolation as for -bc_clamp
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "options/options.hpp"

namespace hg {

class Tractions {
 public:
  /// Reads the options. Errors: a face that the mesh does not have, a missing vector. Collective.
  explicit Tractions(const Mesh &mesh);

  bool empty() const { return faces_.empty(); }
  /// Adds ∫ Nᵢ t(time) dA to a local array of mesh.dm, over this rank's faces.
  void add(double time, std::span<double> local) const;

 private:
  struct Face {
    std::vector<double> times;
    std::vector<std::array<double, 3>> vectors;
    Ramp ramp = Ramp::linear;
    std::vector<CeedInt> offsets;  ///< of component 0 of each node, a node once for each face that it is on
    std::vector<double> areas;     ///< ∫ Nᵢ dA
  };
  static void integrate(const Mesh &mesh, CeedInt cell, int side, Face &face);

  std::vector<Face> faces_;
};

}  // namespace hg
