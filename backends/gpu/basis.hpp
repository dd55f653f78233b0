/// @file
/// Bases on a device.
#pragma once

#include <ceed/plugin.h>

#include "device.hpp"
#include "text/jobs.hpp"

namespace hg::gpu {

/// The points that fields have values at, element by element.
class Points {
 public:
  Points() = default;
  /// As many in each element.
  Points(CeedInt num_elem, CeedInt num_qpts);
  /// `counts[e]` in element e.
  Points(Device &device, CeedInt num_elem, const CeedInt *counts);

  const PointsOfElements &facts() const { return facts_; }
  std::size_t num_bytes() const { return starts_.num_bytes() + elem_.num_bytes(); }

 private:
  PointsOfElements facts_;
  Buffer starts_, elem_;
};

/// The matrices of a basis.
class BasisTables {
 public:
  BasisTables(Device &device, CeedBasis basis);

  CeedInt num_nodes() const { return num_nodes_; }
  CeedInt num_comp() const { return num_comp_; }
  /// Values of a mode for each component.
  CeedInt num_values(CeedEvalMode mode) const { return mode == CEED_EVAL_INTERP ? num_interp_ : num_derivatives_; }

  /// The basis functions at points of their own, x_ref in the layout of fields; see PointTableJob.
  Buffer at_points(const Points &points, const CeedScalar *x_ref) const;
  /// v = B u for elements one after another: nodes, then components; at the points values of components, the point
  /// fastest. `table`: of at_points(), or NULL.
  void evaluate(CeedEvalMode mode, const Points &points, CeedInt num_elem, const CeedScalar *table, const CeedScalar *u,
                CeedScalar *v) const;
  /// v = B^T u, or v += B^T u
  void integrate(CeedEvalMode mode, const Points &points, CeedInt num_elem, const CeedScalar *table,
                 const CeedScalar *u, CeedScalar *v, bool add) const;
  void weights(const Points &points, CeedScalar *v) const;

 private:
  BasisJob job(CeedEvalMode mode, const Points &points, CeedInt num_elem, const CeedScalar *table) const;

  Device *device_;
  bool is_tensor_ = false;
  CeedInt dim_ = 0, num_comp_ = 0, P_ = 0, Q_ = 0, num_nodes_ = 0, num_coefficients_ = 0;
  CeedInt num_interp_ = 1, num_derivatives_ = 0;
  Buffer interp_, derivative_, weights_, coefficients_;
};

/// Those of a basis, which keeps them.
const BasisTables &tables_of(CeedBasis basis);

}  // namespace hg::gpu
