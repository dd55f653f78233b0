/// @file
/// A space on the reference element and a quadrature rule, as matrices on the host.
#pragma once

#include <mutex>
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
  CeedInt P_1d = 0, Q_1d = 0, P = 0, Q = 0;    ///< P_1d, Q_1d: tensor bases alone
  std::vector<CeedScalar> q_ref;               ///< tensor: Q_1d; else (point, direction), point fastest
  std::vector<CeedScalar> q_weight;            ///< tensor: Q_1d; else Q
  std::vector<CeedScalar> interp_1d, grad_1d;  ///< Q_1d by P_1d, row-major
  /// Values, and the one derivative that the space has (gradient, divergence or curl): q_comp by Q by P, row-major.
  /// Made on demand for tensor bases, see matrix(). The derivative is empty where the basis was made without one.
  std::vector<CeedScalar> interp, derivative;
  std::mutex matrix_mutex;  ///< of interp and derivative: operators in several threads may share the basis
  /// The 1D basis functions as polynomials: entry (k, j) is the coefficient of the Chebyshev polynomial T_k in the
  /// function of node j; row-major, P_1d columns. Lagrange bases have P_1d rows; bases from the user's matrices have
  /// Q_1d rows, the polynomial through the values at the quadrature points. Empty where those do not determine one
  /// (Q_1d < P_1d, or coinciding points).
  std::vector<CeedScalar> chebyshev_1d;
  void *data = nullptr;  ///< of the backend

  CeedInt num_chebyshev() const { return static_cast<CeedInt>(chebyshev_1d.size()) / P_1d; }
};

namespace hg {

/// Whether two bases are the same: the same handle, or the same sizes and matrices.
bool equal(const CeedBasis_private &a, const CeedBasis_private &b);
/// The evaluation mode of the space's derivative: CEED_EVAL_GRAD, CEED_EVAL_DIV or CEED_EVAL_CURL.
CeedEvalMode derivative_mode(CeedFESpace space);
/// Number of values at a point for one component; `dim` that of the element. CEED_EVAL_NONE and CEED_EVAL_WEIGHT: 1;
/// CEED_EVAL_INTERP: 1 in H^1, else dim; CEED_EVAL_GRAD: dim; CEED_EVAL_DIV: 1; CEED_EVAL_CURL: 3 in three dimensions,
/// else 1. Throws (CEED_ERROR_UNSUPPORTED) for a mode that the space does not have.
CeedInt q_components(CeedFESpace space, CeedInt dim, CeedEvalMode mode);
/// The same for a basis; CEED_BASIS_NONE has all but the derivatives.
CeedInt q_components(const CeedBasis_private &basis, CeedEvalMode mode);
/// The basis as a matrix, q_comp by Q by P, row-major, for CEED_EVAL_INTERP or the derivative; the basis keeps it.
/// Throws for a mode that the basis does not have.
const std::vector<CeedScalar> &matrix(CeedBasis_private &basis, CeedEvalMode mode);
/// Throws unless vectors can be evaluated in this mode: in the space, and its matrix was given.
void require_evaluation(const CeedBasis_private &basis, CeedEvalMode mode);
/// A new basis with sizes, but without points and matrices; throws where a size is out of range.
Ref<CeedBasis_private> make_tensor_basis(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P_1d, CeedInt Q_1d);
Ref<CeedBasis_private> make_basis(Ceed ceed, CeedFESpace space, CeedElemTopology topology, CeedInt num_comp, CeedInt P,
                                  CeedInt Q);
/// Shows the finished basis to the backend and hands it out.
void hand_out(Ref<CeedBasis_private> basis, CeedBasis *handle);
/// 1D values and derivatives of all basis functions at x: value[P_1d], derivative[P_1d]. Throws where the basis cannot
/// be evaluated away from its quadrature points.
void evaluate_1d(const CeedBasis_private &basis, CeedScalar x, CeedScalar *value, CeedScalar *derivative);
/// Throws (CEED_ERROR_MINOR) unless the basis is a tensor product; `what` was asked of it.
void require_tensor(const CeedBasis_private &basis, const char *what);
/// Throws unless the basis can be evaluated at arbitrary points.
void require_polynomial(const CeedBasis_private &basis);
/// Chebyshev coefficients, num_points by num_columns, of the polynomials that take the given values (num_points by
/// num_columns) at distinct points; empty where the points are not distinct.
std::vector<CeedScalar> chebyshev_coefficients(const std::vector<CeedScalar> &points,
                                               const std::vector<CeedScalar> &values, CeedInt num_columns);
/// A live basis that is not CEED_BASIS_NONE.
CeedBasis_private &deref_basis(CeedBasis basis, Where where = Where::current());

}  // namespace hg
