// What a basis tells about itself.
#include <algorithm>
#include <cmath>

#include "basis.hpp"
#include "view.hpp"

namespace {

constexpr CeedScalar rounding = 1e-14;

/// A table as View prints it: one row stays on the line of its name.
void print_table(const hg::Lines &line, const char *name, CeedSize rows, CeedInt columns,
                 const std::vector<CeedScalar> &values) {
  const auto row = [&](CeedSize i) {
    std::string numbers;
    for (CeedInt j = 0; j < columns; j++) {
      const CeedScalar x = values[i * columns + j];
      numbers += hg::text("\t% 12.8f", std::abs(x) > rounding ? x : 0.0);
    }
    return numbers;
  };
  if (rows == 1) return line(1, "%-10s%s", name, row(0).c_str());
  line(1, "%s", name);
  for (CeedSize i = 0; i < rows; i++) line(2, "[%" CeedSize_FMT "]%s", i, row(i).c_str());
}

/// Kronecker product of 1D matrices, x fastest in rows and columns; direction g (none if negative) takes `grad_1d`.
void kronecker(const CeedBasis_private &b, CeedInt g, CeedScalar *matrix) {
  for (CeedInt q = 0; q < b.Q; q++) {
    for (CeedInt n = 0; n < b.P; n++) {
      CeedScalar product = 1.0;
      for (CeedInt d = 0, q_rest = q, n_rest = n; d < b.dim; d++, q_rest /= b.Q_1d, n_rest /= b.P_1d) {
        product *= (d == g ? b.grad_1d : b.interp_1d)[(q_rest % b.Q_1d) * b.P_1d + n_rest % b.P_1d];
      }
      matrix[static_cast<CeedSize>(q) * b.P + n] = product;
    }
  }
}

/// Multiply-add pairs of a sum-factorised evaluation from P to Q points a direction. Partial results are shared: after
/// direction d there are the value and d+1 derivatives.
CeedSize contraction_size(CeedInt dim, CeedSize P, CeedSize Q, bool is_grad) {
  CeedSize size = 0;
  for (CeedInt d = 0; d < dim; d++) {
    CeedSize entries = P * Q;
    for (CeedInt k = 0; k < d; k++) entries *= Q;
    for (CeedInt k = d + 1; k < dim; k++) entries *= P;
    const CeedInt partials = !is_grad ? 1 : d + 1 < dim ? d + 2 : dim;
    size += entries * partials;
  }
  return size;
}

/// Body of the getters of a number or pointer; `function` is the getter.
template <typename T, typename Get>
int get(CeedBasis basis, T *value, const char *name, Get &&getter, const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(basis), [&] { hg::result(value, name) = getter(hg::deref_basis(basis)); }, function);
}

}  // namespace

namespace hg {

void require_tensor(const CeedBasis_private &b, const char *what) {
  require(b.is_tensor, CEED_ERROR_MINOR,
          [&] { return text("CeedBasis: %s was asked of a basis without tensor product", what); });
}

CeedBasis_private &deref_basis(CeedBasis basis, Where where) {
  deref(basis, "CeedBasis", where);
  require(!basis->is_sentinel, CEED_ERROR_INCOMPATIBLE, "CeedBasis is CEED_BASIS_NONE; expected a basis with matrices",
          where);
  return *basis;
}

bool equal(const CeedBasis_private &a, const CeedBasis_private &b) {
  if (&a == &b) return true;
  if (a.is_sentinel || b.is_sentinel) return false;
  return a.topology == b.topology && a.fe_space == b.fe_space && a.is_tensor == b.is_tensor && a.dim == b.dim &&
         a.num_comp == b.num_comp && a.P == b.P && a.Q == b.Q && a.q_ref == b.q_ref && a.q_weight == b.q_weight &&
         (a.is_tensor ? a.interp_1d == b.interp_1d && a.grad_1d == b.grad_1d && a.chebyshev_1d == b.chebyshev_1d
                      : a.interp == b.interp && a.derivative == b.derivative);
}

CeedEvalMode derivative_mode(CeedFESpace space) {
  switch (space) {
    case CEED_FE_SPACE_HDIV:
      return CEED_EVAL_DIV;
    case CEED_FE_SPACE_HCURL:
      return CEED_EVAL_CURL;
    default:
      return CEED_EVAL_GRAD;
  }
}

CeedInt q_components(CeedFESpace space, CeedInt dim, CeedEvalMode mode) {
  const bool is_scalar = space == CEED_FE_SPACE_H1;
  if (mode == CEED_EVAL_NONE || mode == CEED_EVAL_WEIGHT) return 1;
  if (mode == CEED_EVAL_INTERP) return is_scalar ? 1 : dim;
  require(mode == derivative_mode(space), CEED_ERROR_UNSUPPORTED, [&] {
    const char *derivative = is_scalar                     ? "CEED_EVAL_GRAD"
                             : space == CEED_FE_SPACE_HDIV ? "CEED_EVAL_DIV"
                                                           : "CEED_EVAL_CURL";
    return text("CeedBasis: evaluation mode is %d; a basis in a %s has CEED_EVAL_INTERP, %s and CEED_EVAL_WEIGHT",
                static_cast<int>(mode), CeedFESpaces[space], derivative);
  });
  return mode == CEED_EVAL_GRAD || (mode == CEED_EVAL_CURL && dim == 3) ? dim : 1;
}

CeedInt q_components(const CeedBasis_private &basis, CeedEvalMode mode) {
  const bool is_derivative = mode == CEED_EVAL_GRAD || mode == CEED_EVAL_DIV || mode == CEED_EVAL_CURL;
  require(!basis.is_sentinel || !is_derivative, CEED_ERROR_INCOMPATIBLE,
          [&] { return text("CEED_BASIS_NONE has no derivatives; evaluation mode is %s", CeedEvalModes[mode]); });
  return q_components(basis.fe_space, basis.dim, mode);
}

void require_evaluation(const CeedBasis_private &basis, CeedEvalMode mode) {
  require(mode != CEED_EVAL_NONE && mode != CEED_EVAL_WEIGHT, CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedBasis: evaluation mode is %d; expected CEED_EVAL_INTERP or a derivative", static_cast<int>(mode));
  });
  q_components(basis, mode);
  require(mode == CEED_EVAL_INTERP || basis.is_tensor || !basis.derivative.empty(), CEED_ERROR_UNSUPPORTED, [&] {
    return text("CeedBasis: evaluation mode is %s; this basis in a %s was made without a matrix for it",
                CeedEvalModes[mode], CeedFESpaces[basis.fe_space]);
  });
}

const std::vector<CeedScalar> &matrix(CeedBasis_private &basis, CeedEvalMode mode) {
  require_evaluation(basis, mode);
  const bool is_interp = mode == CEED_EVAL_INTERP;
  const std::lock_guard<std::mutex> lock(basis.matrix_mutex);
  auto &full = is_interp ? basis.interp : basis.derivative;
  if (!full.empty()) return full;
  const std::size_t size = static_cast<std::size_t>(basis.Q) * basis.P;
  full.resize(is_interp ? size : basis.dim * size);
  if (is_interp) kronecker(basis, -1, full.data());
  for (CeedInt g = 0; !is_interp && g < basis.dim; g++) kronecker(basis, g, full.data() + g * size);
  return full;
}

}  // namespace hg

void CeedBasis_private::view(FILE *stream) const {
  const hg::Lines line(stream, num_view_tabs);
  if (is_sentinel) return line(0, "CeedBasis NONE");
  line(0, "CeedBasis in a %s on a %s element", CeedFESpaces[fe_space], CeedElemTopologies[topology]);
  line(1, "P: %" CeedInt_FMT, is_tensor ? P_1d : P);
  line(1, "Q: %" CeedInt_FMT, is_tensor ? Q_1d : Q);
  line(1, "dimension: %" CeedInt_FMT, dim);
  line(1, "field components: %" CeedInt_FMT, num_comp);
  if (is_tensor) {
    print_table(line, "qref1d:", 1, Q_1d, q_ref);
    print_table(line, "qweight1d:", 1, Q_1d, q_weight);
    print_table(line, "interp1d:", Q_1d, P_1d, interp_1d);
    print_table(line, "grad1d:", Q_1d, P_1d, grad_1d);
    return;
  }
  const char *derivative_name = fe_space == CEED_FE_SPACE_H1     ? "grad:"
                                : fe_space == CEED_FE_SPACE_HDIV ? "div:"
                                                                 : "curl:";
  print_table(line, "qref:", 1, dim * Q, q_ref);
  print_table(line, "qweight:", 1, Q, q_weight);
  const auto rows = [&](const std::vector<CeedScalar> &matrix) { return static_cast<CeedSize>(matrix.size()) / P; };
  print_table(line, "interp:", rows(interp), P, interp);
  if (!derivative.empty()) print_table(line, derivative_name, rows(derivative), P, derivative);
}

int CeedBasisView(CeedBasis basis, FILE *stream) {
  return hg::view_object(basis, stream);
}

int CeedBasisSetNumViewTabs(CeedBasis basis, CeedInt num_tabs) {
  return hg::set_view_tabs(basis, num_tabs);
}

int CeedBasisGetNumViewTabs(CeedBasis basis, CeedInt *num_tabs) {
  return hg::get_view_tabs(basis, num_tabs);
}

int CeedBasisGetCeed(CeedBasis basis, Ceed *ceed) {
  return hg::get_ceed(basis, ceed);
}

Ceed CeedBasisReturnCeed(CeedBasis basis) {
  return hg::ceed_of(basis);
}

int CeedBasisGetDimension(CeedBasis basis, CeedInt *dim) {
  return get(basis, dim, "dim", [](auto &b) { return b.dim; });
}

int CeedBasisGetTopology(CeedBasis basis, CeedElemTopology *topo) {
  return get(basis, topo, "topo", [](auto &b) { return b.topology; });
}

int CeedBasisGetNumComponents(CeedBasis basis, CeedInt *num_comp) {
  return get(basis, num_comp, "num_comp", [](auto &b) { return b.num_comp; });
}

int CeedBasisGetNumNodes(CeedBasis basis, CeedInt *P) {
  return get(basis, P, "P", [](auto &b) { return b.P; });
}

int CeedBasisGetNumNodes1D(CeedBasis basis, CeedInt *P_1d) {
  return get(basis, P_1d, "P_1d", [](auto &b) {
    hg::require_tensor(b, "P_1d");
    return b.P_1d;
  });
}

int CeedBasisGetNumQuadraturePoints(CeedBasis basis, CeedInt *Q) {
  return get(basis, Q, "Q", [](auto &b) { return b.Q; });
}

int CeedBasisGetNumQuadraturePoints1D(CeedBasis basis, CeedInt *Q_1d) {
  return get(basis, Q_1d, "Q_1d", [](auto &b) {
    hg::require_tensor(b, "Q_1d");
    return b.Q_1d;
  });
}

int CeedBasisGetQRef(CeedBasis basis, const CeedScalar **q_ref) {
  return get(basis, q_ref, "q_ref", [](auto &b) { return b.q_ref.data(); });
}

int CeedBasisGetQWeights(CeedBasis basis, const CeedScalar **q_weights) {
  return get(basis, q_weights, "q_weights", [](auto &b) { return b.q_weight.data(); });
}

int CeedBasisGetInterp(CeedBasis basis, const CeedScalar **interp) {
  return get(basis, interp, "interp", [](auto &b) { return hg::matrix(b, CEED_EVAL_INTERP).data(); });
}

int CeedBasisGetGrad(CeedBasis basis, const CeedScalar **grad) {
  return get(basis, grad, "grad", [](auto &b) { return hg::matrix(b, CEED_EVAL_GRAD).data(); });
}

int CeedBasisGetDiv(CeedBasis basis, const CeedScalar **div) {
  return get(basis, div, "div", [](auto &b) { return hg::matrix(b, CEED_EVAL_DIV).data(); });
}

int CeedBasisGetCurl(CeedBasis basis, const CeedScalar **curl) {
  return get(basis, curl, "curl", [](auto &b) { return hg::matrix(b, CEED_EVAL_CURL).data(); });
}

int CeedOperatorGetBasisPointer(CeedBasis basis, CeedEvalMode eval_mode, const CeedScalar *identity,
                                const CeedScalar **basis_ptr) {
  return hg::guard(hg::ceed_of(basis), [&] {
    hg::deref(basis, "CeedBasis");
    hg::require_argument(basis_ptr, "basis_ptr (where the address goes)");
    if (eval_mode == CEED_EVAL_NONE) {
      hg::require_argument(identity, "identity, the matrix of CEED_EVAL_NONE");
      *basis_ptr = identity;
    } else {
      *basis_ptr = hg::matrix(hg::deref_basis(basis), eval_mode).data();
    }
  });
}

int CeedBasisGetInterp1D(CeedBasis basis, const CeedScalar **interp_1d) {
  return get(basis, interp_1d, "interp_1d", [](auto &b) {
    hg::require_tensor(b, "interp_1d");
    return b.interp_1d.data();
  });
}

int CeedBasisGetGrad1D(CeedBasis basis, const CeedScalar **grad_1d) {
  return get(basis, grad_1d, "grad_1d", [](auto &b) {
    hg::require_tensor(b, "grad_1d");
    return b.grad_1d.data();
  });
}

int CeedBasisIsTensor(CeedBasis basis, bool *is_tensor) {
  return get(basis, is_tensor, "is_tensor", [](auto &b) { return b.is_tensor; });
}

// The quadrature points are the nodes where interpolation is the identity.
int CeedBasisIsCollocated(CeedBasis basis, bool *is_collocated) {
  return get(basis, is_collocated, "is_collocated", [](auto &b) {
    const CeedInt n = b.is_tensor ? b.P_1d : b.P;
    if (b.P != b.Q || b.fe_space != CEED_FE_SPACE_H1) return false;
    const auto &interp = b.is_tensor ? b.interp_1d : b.interp;
    for (CeedInt i = 0; i < n; i++) {
      for (CeedInt j = 0; j < n; j++) {
        if (std::abs(interp[static_cast<CeedSize>(i) * n + j] - (i == j ? 1.0 : 0.0)) > rounding) return false;
      }
    }
    return true;
  });
}

int CeedBasisGetData(CeedBasis basis, void *data) {
  return get(basis, static_cast<void **>(data), "data", [](auto &b) { return b.data; });
}

int CeedBasisSetData(CeedBasis basis, void *data) {
  return hg::guard(hg::ceed_of(basis), [&] { hg::deref_basis(basis).data = data; });
}

int CeedBasisGetNumQuadratureComponents(CeedBasis basis, CeedEvalMode eval_mode, CeedInt *q_comp) {
  return hg::guard(hg::ceed_of(basis), [&] {
    auto &b = hg::deref(basis, "CeedBasis");
    hg::require_argument(q_comp, "q_comp");
    *q_comp = hg::q_components(b, eval_mode);
  });
}

// A multiplication and an addition count as two. At a point, the 1D functions are sums of Chebyshev polynomials.
int CeedBasisGetFlopsEstimate(CeedBasis basis, CeedTransposeMode t_mode, CeedEvalMode eval_mode, bool is_at_points,
                              CeedInt num_points, CeedSize *flops) {
  return hg::guard(hg::ceed_of(basis), [&] {
    auto &b = hg::deref_basis(basis);
    hg::require_argument(flops, "flops");
    hg::require(!is_at_points || num_points >= 0, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedBasis: num_points is %" CeedInt_FMT "; expected zero or more", num_points);
    });
    // The transpose does the same multiplications in the other order.
    hg::require_transpose_mode(t_mode, "CeedBasis");
    const CeedSize q_comp = hg::q_components(b, eval_mode);
    if (eval_mode == CEED_EVAL_NONE) {
      *flops = 0;
    } else if (eval_mode == CEED_EVAL_WEIGHT) {
      *flops = is_at_points || !b.is_tensor ? 0 : static_cast<CeedSize>(b.dim - 1) * b.Q;
    } else if (is_at_points) {
      hg::require_polynomial(b);
      const bool is_grad = eval_mode == CEED_EVAL_GRAD;
      const CeedSize tables = is_grad ? 2 : 1;
      const CeedSize one_d = b.dim * tables * (3 + 2 * static_cast<CeedSize>(b.P_1d)) * b.num_chebyshev();
      *flops = num_points * (one_d + 2 * b.num_comp * contraction_size(b.dim, b.P_1d, 1, is_grad));
    } else if (b.is_tensor) {
      *flops = 2 * b.num_comp * contraction_size(b.dim, b.P_1d, b.Q_1d, eval_mode == CEED_EVAL_GRAD);
    } else {
      *flops = 2 * b.num_comp * q_comp * b.Q * b.P;
    }
  });
}

int CeedBasisGetFESpace(CeedBasis basis, CeedFESpace *fe_space) {
  return get(basis, fe_space, "fe_space", [](auto &b) { return b.fe_space; });
}

int CeedBasisGetDerivativeMode(CeedBasis basis, CeedEvalMode *eval_mode) {
  return get(basis, eval_mode, "eval_mode", [](auto &b) {
    return b.is_tensor || !b.derivative.empty() ? hg::derivative_mode(b.fe_space) : CEED_EVAL_NONE;
  });
}

int CeedBasisGetTopologyDimension(CeedElemTopology topo, CeedInt *dim) {
  return hg::guard(nullptr, [&] {
    const bool is_known = topo >= 0 && topo <= CEED_TOPOLOGY_HEX && CeedElemTopologies[topo] != nullptr;
    hg::require(is_known, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedBasis: topology is %d; expected a CeedElemTopology such as CEED_TOPOLOGY_TRIANGLE",
                      static_cast<int>(topo));
    });
    // The dimension is the upper half of the number.
    hg::result(dim, "dim") = static_cast<CeedInt>(topo) >> 16;
  });
}
