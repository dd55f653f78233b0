/// @file
/// Dirichlet conditions: which entries of the displacement are given, and their values over time.
///
/// -bc_clamp f,...          all components on the faces with label "Face Sets" value f, zero unless moved by
///   -bc_clamp_f_translate x,y,z[,x,y,z...]   one vector for each time [m]
///   -bc_clamp_f_rotate rx,ry,rz,c0,c1[,...]  rotation by θ = c0 + c1 (r·x)/|r| radians about the axis r through the
///   origin
/// -bc_slip f,...           some components on a face
///   -bc_slip_f_components i,...              0, 1, 2 for x, y, z
///   -bc_slip_f_translate a,...               a value for each component and time [m]
/// -bc_mms f,...            all components as in the manufactured solution
///   -bc_<kind>_f_times t,...                 times of the values [s]; default: -ts_max_time
///   -bc_<kind>_f_interpolation linear|step   as for the body force
/// Where faces meet, clamp goes before slip before mms, and the face listed first before the others.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "options/options.hpp"

namespace hg {

/// One face with given displacement.
struct BoundaryFace {
  enum class Kind { clamp, slip, mms };

  Kind kind = Kind::clamp;
  PetscInt face = 0;                             ///< value in the label "Face Sets"
  std::array<bool, 3> components{};              ///< which components are given
  std::vector<double> times;                     ///< [s], ascending
  std::vector<std::array<double, 3>> translate;  ///< one for each time, or empty [m]
  std::vector<std::array<double, 5>> rotate;     ///< one for each time, or empty: axis, c0, c1
  Ramp ramp = Ramp::linear;
  double final_time = 1.;  ///< mms: the solution is multiplied by t/final_time, at most 1

  /// Displacement at time t of the node that lies at x.
  std::array<double, 3> value(double t, std::span<const double, 3> x) const;
  /// Displacement from t_from to t of the piece of the face that lies at x at time t_from. A face that rotates is
  /// followed back to where it was at first, so that an increment of a rigid motion is one; other faces give the
  /// difference of their values at x.
  std::array<double, 3> increment(double t_from, double t, std::span<const double, 3> x) const;
};

class BoundaryConditions {
 public:
  /// Reads the options and constrains the mesh. Errors: a face that the mesh does not have, wrong numbers of values.
  BoundaryConditions(Mesh &mesh, MPI_Comm comm);
  /// The same for given faces; collective.
  BoundaryConditions(Mesh &mesh, std::vector<BoundaryFace> faces);

  /// Writes into the constrained entries of a local vector of mesh.dm: with scale = 0 the total displacement at t
  /// (FEM), else scale times the increment from t_from to t (MPM, whose nodes lie at x again in every step). Other
  /// entries stay.
  void insert(double t, double t_from, double scale, std::span<double> local) const;

  const std::vector<BoundaryFace> &faces() const { return faces_; }

  /// One constrained entry: its place in a local vector, and the face that gives its value.
  struct Entry {
    PetscInt index;
    int face;
  };
  const std::vector<Entry> &entries() const { return entries_; }

  static std::vector<BoundaryFace> read(MPI_Comm comm);

 private:
  const Mesh &mesh_;
  std::vector<BoundaryFace> faces_;
  std::vector<Entry> entries_;
};

/// A₀ of the manufactured solution [m].
inline constexpr double mms_amplitude = 1e-3;

/// The factor of loads that follow the manufactured solution: t/final_time, at most 1.
double mms_factor(double t, double final_time);

}  // namespace hg
