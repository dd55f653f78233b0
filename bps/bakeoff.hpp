/// @file
/// One bake-off problem on the cells of one process: its operator, right-hand side and error.
#pragma once

#include <ceed.h>

#include <array>

#include "ceed_handles.hpp"
#include "cells.hpp"
#include "points.hpp"
#include "problem.hpp"

namespace hg::bps {

/// Sums over the cells of one process; add those of all processes before taking roots.
struct ErrorSums {
  /// ∫|u_h − u|², ∫|u|², ∫|∇u_h − ∇u|², ∫|∇u|²
  std::array<double, 4> terms{};

  /// ‖u_h − u‖ / ‖u‖ in L2.
  double relative_l2() const;
  /// The same for the gradients.
  double relative_h1() const;
};

/// The operator of a bake-off problem, at quadrature points or at material points, with stored geometry.
///
/// Vectors are L-vectors of the cells. No boundary condition is applied here: the caller masks.
class Bakeoff {
 public:
  /// At quadrature points. `ceed` must outlive this object, `cells` need not.
  Bakeoff(Ceed ceed, const Problem &problem, CeedInt degree, const Cells &cells);
  /// At the points of `cloud`, in the order of its cells.
  Bakeoff(Ceed ceed, const Problem &problem, CeedInt degree, const Cells &cells, const PointCloud &cloud);

  void apply(CeedVector u, CeedVector v) const;
  void diagonal(CeedVector d) const;

  /// Right-hand side of the manufactured solution (qfunctions/bps/manufactured.h).
  ///
  /// At quadrature points it is ∫ v u for mass and −∫ v Δu for Poisson, by the quadrature of the operator. At material
  /// points Poisson takes ∫ ∇v·∇u by the points themselves: equal weights integrate too little for −∫ v Δu to be
  /// consistent with the operator beyond rate 2.
  Vector right_hand_side() const;

  /// Error of u against the manufactured solution, integrated with p + 3 Gauss points a direction.
  ErrorSums error(CeedVector u) const;

  /// Lives as long as this object.
  CeedOperator op() const { return operator_; }
  CeedSize num_dofs() const { return num_dofs_; }
  CeedInt num_elem() const { return num_elem_; }
  /// Quadrature points, or material points.
  CeedSize num_points() const { return num_points_; }
  Work work() const;
  /// Seconds that the restriction and basis of the solution and the operator itself took to create. The lowering of the
  /// operator, and what is compiled for it, count for its first application.
  double seconds_created() const { return seconds_created_; }

 private:
  /// A restriction and basis as one argument, to name the fields of an operator in one line each.
  struct Field {
    const char *name;
    CeedInt size;
    CeedEvalMode mode;
    CeedElemRestriction restriction;
    CeedBasis basis;
    CeedVector vector;
  };

  void build_mesh(const Cells &cells);
  void build_quadrature();
  void build_points(const PointCloud &cloud);
  void build_operator();
  Field weight_field() const;
  Operator make_operator(CeedQFunctionUser function, const char *source, bool with_solution,
                         std::initializer_list<Field> inputs, Field output, bool at_points) const;

  Ceed ceed_;
  Problem problem_;
  CeedInt degree_;
  CeedInt num_elem_ = 0;
  CeedSize num_dofs_ = 0, num_points_ = 0;
  bool at_points_ = false;
  double seconds_created_ = 0;

  Restriction solution_restriction_, mesh_restriction_, stored_restriction_, points_restriction_, weights_restriction_;
  Basis solution_basis_, mesh_basis_;
  Vector coordinates_, stored_, points_, weights_;
  Operator operator_;
};

}  // namespace hg::bps
