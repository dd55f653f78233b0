/// @file
/// A space on the reference element and a quadrature rule, as matrices on the host.
#pragma once

#include <vector>

#include "ceed.hpp"

struct CeedBasis_private final : CeedObject_private {
  ~CeedBasis_private() override;
  void view(FILE *stream) const override;
  Ceed owner() const override { return ceed.get(); }

  hg::Ref<Ceed_private> ceed;
  CeedElemTopology topology = CEED_TOPOLOGY_HEX;
  CeedFESpace fe_space = CEED_FE_SPACE_H1;
  bool is_tensor = true;
  CeedInt dim = 0, num_comp = 0;
  CeedInt P_1d = 0, Q_1d = 0, P = 0, Q = 0;
  std::vector<CeedScalar> q_ref;               ///< tensor: Q_1d; else (direction, point)
  std::vector<CeedScalar> q_weight;            ///< tensor: Q_1d; else Q
  std::vector<CeedScalar> interp_1d, grad_1d;  ///< Q_1d by P_1d, row-major
  std::vector<CeedScalar> interp, grad;        ///< Q by P and dim by Q by P, row-major; made on demand for tensor bases
  /// The 1D basis functions as polynomials: entry (k, j) is the coefficient of the Chebyshev polynomial T_k in the
  /// function of node j; row-major, P_1d columns. Lagrange bases have P_1d rows; bases from the user's matrices have
  /// Q_1d rows, the polynomial through the values at the quadrature points. Empty where those do not determine one
  /// (Q_1d < P_1d, or coinciding points).
  std::vector<CeedScalar> chebyshev_1d;
  bool is_known_to_backend = false;  ///< the backend's create has run
  void *data = nullptr;              ///< of the backend

  CeedInt num_chebyshev() const { return static_cast<CeedInt>(chebyshev_1d.size()) / P_1d; }
};

namespace hg {

/// Whether two bases are the same: the same handle, or the same sizes and matrices.
bool equal(const CeedBasis_private &a, const CeedBasis_private &b);
/// Number of values at a point for one component.
CeedInt q_components(const CeedBasis_private &basis, CeedEvalMode mode);
/// 1D values and derivatives of all basis functions at x: value[P_1d], derivative[P_1d]. Throws where the basis cannot
/// be evaluated away from its quadrature points.
void evaluate_1d(const CeedBasis_private &basis, CeedScalar x, CeedScalar *value, CeedScalar *derivative);
/// Throws unless the basis can be evaluated at arbitrary points.
void require_polynomial(const CeedBasis_private &basis);
/// Chebyshev coefficients, num_points by num_columns, of the polynomials that take the given values (num_points by
/// num_columns) at distinct points; empty where the points are not distinct.
std::vector<CeedScalar> chebyshev_coefficients(const std::vector<CeedScalar> &points,
                                               const std::vector<CeedScalar> &values, CeedInt num_columns);
/// Throws if a pointer argument of a basis function is NULL; `what` names it and says what it should be.
void require_argument(const CeedBasis_private &basis, const void *argument, const char *what,
                      Where where = Where::current());
/// A live basis that is not CEED_BASIS_NONE.
CeedBasis_private &deref_basis(CeedBasis basis, Where where = Where::current());

}  // namespace hg
