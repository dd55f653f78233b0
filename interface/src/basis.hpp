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
  std::vector<CeedScalar> q_ref;     ///< tensor: Q_1d; else (direction, point)
  std::vector<CeedScalar> q_weight;  ///< tensor: Q_1d; else Q
  std::vector<CeedScalar> interp_1d, grad_1d;  ///< Q_1d by P_1d, row-major
  std::vector<CeedScalar> interp, grad;        ///< Q by P and dim by Q by P, row-major; made on demand for tensor bases
  /// Column j: coefficients in Chebyshev polynomials T_0 ... T_(P_1d-1) of node j's 1D basis function, row-major
  /// P_1d by P_1d. Empty where the quadrature points do not determine them.
  std::vector<CeedScalar> chebyshev_1d;
  void *data = nullptr;  ///< of the backend
};

namespace hg {

/// Whether two bases are the same: the same handle, or the same sizes and matrices.
bool equal(const CeedBasis_private &a, const CeedBasis_private &b);
/// Number of values at a point for one component.
CeedInt q_components(const CeedBasis_private &basis, CeedEvalMode mode);
/// 1D values and derivatives of all basis functions at x: value[P_1d], derivative[P_1d]. Throws where the basis cannot
/// be evaluated away from its quadrature points.
void evaluate_1d(const CeedBasis_private &basis, CeedScalar x, CeedScalar *value, CeedScalar *derivative);

}  // namespace hg
