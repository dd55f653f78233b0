/// @file
/// Fields of points on the mesh, and fields of the mesh at points.
///
/// The projection of f is the field f_h of a nodal space with Σ_p V_p N_i(x_p) (f_h(x_p) − f_p) = 0 for every node i:
///
///   consistent: M f = b,  M_ij = Σ_p V_p N_i N_j,  b_i = Σ_p V_p N_i f_p, solved by conjugate gradients;
///   lumped:     f_i = b_i / m_i,  m_i = Σ_p V_p N_i.
///
/// Consistent projection gives back every field that the space holds (given enough points in a cell). Lumped projection
/// gives back constants and, on the linear space, stays between the smallest and the largest value of the points.
/// Both keep the integral: Σ_i m_i f_i = Σ_p V_p f_p.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "operators/integration.hpp"

namespace hg {

enum class ProjectionKind { lumped, consistent };

class PointProjection {
 public:
  /// On mesh.space(order, ·), which must outlive this object. Lumped projection needs order 1: at higher orders N_i has
  /// both signs, so m_i may vanish or change sign. Throws hg::Error otherwise. Not collective.
  PointProjection(const Mesh &mesh, PetscInt order, ProjectionKind kind);

  /// Takes the points of an epoch, MpmOperators::points(), with their current volumes. It must live until the next
  /// attach(). Collective.
  void attach(const Integration &points);

  /// Values at points (num_points × num_comp, storage order) → nodal values, a local array of mesh.space(order,
  /// num_comp), the same on every rank that has the node; zero at nodes that no point supports. Collective. Options
  /// -projection_ksp_* and -projection_pc_* for the consistent solve (default CG with Jacobi to 1e-12). Throws
  /// hg::Error if the solve fails.
  std::vector<double> to_mesh(std::span<const double> values, CeedInt num_comp);

  /// Nodal values, as to_mesh() gives them → values at the points. Not collective.
  std::vector<double> to_points(std::span<const double> nodal, CeedInt num_comp);

  /// m_i = Σ_p V_p N_i(x_p), summed over ranks: a local array of mesh.space(order, 1).
  const std::vector<double> &node_volume() const { return volume_; }

 private:
  struct Operators {
    CeedOperatorHandle to_nodes, mass, to_points;
    CeedQFunctionContextHandle context;
    CeedVectorHandle at_points, nodal, result;  ///< num_points × num_comp, and two local arrays
  };
  Operators &operators(CeedInt num_comp);
  Integration with_space(CeedInt num_comp) const;
  void solve(Operators &ops, CeedInt num_comp, std::vector<double> &b);

  const Mesh &mesh_;
  PetscInt order_;
  ProjectionKind kind_;
  QFunctionCache cache_;
  const Integration *points_ = nullptr;
  std::map<CeedInt, Operators> operators_;
  std::vector<double> volume_;
};

}  // namespace hg
