#include "basis.hpp"

#include <cmath>
#include <limits>

#include "vector.hpp"

namespace {

/// Never destroyed: programs may still hold the constant when they end.
union Sentinel {
  Sentinel() : object() { object.is_sentinel = true; }
  ~Sentinel() {}
  CeedBasis_private object;
};
Sentinel none;

CeedElemTopology tensor_topology(CeedInt dim) {
  return dim == 1 ? CEED_TOPOLOGY_LINE : dim == 2 ? CEED_TOPOLOGY_QUAD : CEED_TOPOLOGY_HEX;
}

/// Checks the sizes and makes a tensor-product basis without matrices.
hg::Ref<CeedBasis_private> make_tensor(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P_1d, CeedInt Q_1d) {
  hg::deref(ceed, "Ceed");
  const auto require_range = [](const char *name, CeedInt value, CeedInt least, CeedInt most) {
    hg::require(least <= value && value <= most, CEED_ERROR_DIMENSION, [&] {
      const std::string upper = most < std::numeric_limits<CeedInt>::max() ? hg::text(" to %" CeedInt_FMT, most) : "";
      return hg::text("CeedBasis: %s is %" CeedInt_FMT "; expected %" CeedInt_FMT "%s", name, value, least,
                      upper.empty() ? " or more" : upper.c_str());
    });
  };
  // P^dim and Q^dim must be CeedInts; far beyond use, this only keeps them from overflowing.
  const CeedInt most = dim <= 1 ? std::numeric_limits<CeedInt>::max() : dim == 2 ? 46340 : 1290;
  require_range("dim", dim, 1, 3);
  require_range("num_comp", num_comp, 1, std::numeric_limits<CeedInt>::max());
  require_range("the number of nodes in a direction", P_1d, 1, most);
  require_range("the number of quadrature points in a direction", Q_1d, 1, most);
  auto basis = hg::Ref<CeedBasis_private>::adopt(new CeedBasis_private);
  basis->ceed = hg::Ref<Ceed_private>(ceed);
  basis->topology = tensor_topology(dim);
  basis->dim = dim;
  basis->num_comp = num_comp;
  basis->P_1d = P_1d;
  basis->Q_1d = Q_1d;
  basis->P = CeedIntPow(P_1d, dim);
  basis->Q = CeedIntPow(Q_1d, dim);
  return basis;
}

/// Shows the finished basis to the backend and hands it out.
void hand_out(hg::Ref<CeedBasis_private> basis, CeedBasis *handle) {
  const auto &ops = basis->ceed->ops.basis;
  if (ops.create != nullptr) hg::check(ops.create(basis.get()));
  basis->is_known_to_backend = true;
  *handle = basis.release();
}

/// What an apply moves: num_points points with q_comp values a component, num_nodes nodes.
struct Sizes {
  CeedSize num_nodes, num_points;
  CeedInt q_comp;
};

void require_length(const CeedBasis_private &basis, const char *name, CeedVector vec, CeedSize least,
                    CeedEvalMode mode) {
  hg::deref(vec, name);
  hg::require(!vec->is_sentinel, CEED_ERROR_INCOMPATIBLE, [&] {
    return hg::text("CeedBasis: %s is a constant such as CEED_VECTOR_NONE; expected a vector of %" CeedSize_FMT
                    " or more entries for evaluation mode %s",
                    name, least, CeedEvalModes[mode]);
  });
  hg::require(vec->length >= least, CEED_ERROR_DIMENSION, [&] {
    return hg::text("Input/output vectors too short for basis and evaluation mode: %s has %" CeedSize_FMT
                    " entries; expected at least %" CeedSize_FMT " (mode %s, dim %" CeedInt_FMT
                    ", components %" CeedInt_FMT ")",
                    name, vec->length, least, CeedEvalModes[mode], basis.dim, basis.num_comp);
  });
}

/// Checks what quadrature points and arbitrary points have in common.
void require_mode(CeedTransposeMode t_mode, CeedEvalMode mode, bool add) {
  hg::require(mode == CEED_EVAL_INTERP || mode == CEED_EVAL_GRAD || mode == CEED_EVAL_WEIGHT, CEED_ERROR_UNSUPPORTED,
              [&] {
                return hg::text(
                    "CeedBasis: evaluation mode is %d; an H^1 basis has CEED_EVAL_INTERP, CEED_EVAL_GRAD "
                    "and CEED_EVAL_WEIGHT",
                    static_cast<int>(mode));
              });
  hg::require(t_mode == CEED_NOTRANSPOSE || t_mode == CEED_TRANSPOSE, CEED_ERROR_UNSUPPORTED, [&] {
    return hg::text("CeedBasis: transpose mode is %d; expected CEED_NOTRANSPOSE or CEED_TRANSPOSE",
                    static_cast<int>(t_mode));
  });
  hg::require(mode != CEED_EVAL_WEIGHT || t_mode == CEED_NOTRANSPOSE, CEED_ERROR_UNSUPPORTED,
              "CeedBasis: CEED_EVAL_WEIGHT has no transpose; expected CEED_NOTRANSPOSE");
  hg::require(!add || t_mode == CEED_TRANSPOSE, CEED_ERROR_UNSUPPORTED,
              "CeedBasis: adding is for the transpose; expected CEED_TRANSPOSE");
}

void require_vectors(const CeedBasis_private &basis, CeedTransposeMode t_mode, CeedEvalMode mode, const Sizes &sizes,
                     CeedVector u, CeedVector v) {
  const CeedSize at_points = sizes.num_points * sizes.q_comp * (mode == CEED_EVAL_WEIGHT ? 1 : basis.num_comp);
  const CeedSize at_nodes = sizes.num_nodes * basis.num_comp;
  const bool is_transpose = t_mode == CEED_TRANSPOSE;
  require_length(basis, "v", v, is_transpose ? at_nodes : at_points, mode);
  if (mode == CEED_EVAL_WEIGHT) return;
  require_length(basis, "u", u, is_transpose ? at_points : at_nodes, mode);
  hg::require(u != v, CEED_ERROR_INCOMPATIBLE, "CeedBasis: u and v are the same vector; expected two");
}

void require_elements(CeedInt num_elem) {
  hg::require(num_elem >= 0, CEED_ERROR_DIMENSION, [&] {
    return hg::text("CeedBasis: num_elem is %" CeedInt_FMT "; expected zero or more elements", num_elem);
  });
}

void apply(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode mode, CeedVector u, CeedVector v,
           bool add) {
  const auto &b = hg::deref_basis(basis);
  require_elements(num_elem);
  require_mode(t_mode, mode, add);
  const CeedSize n = num_elem;
  require_vectors(b, t_mode, mode, {n * b.P, n * b.Q, hg::q_components(b, mode)}, u, v);
  const auto &ops = b.ceed->ops.basis;
  hg::require(ops.apply != nullptr, CEED_ERROR_UNSUPPORTED, "Backend does not implement CeedBasisApply");
  hg::check(ops.apply(basis, num_elem, t_mode, mode, u, v, add));
}

void apply_at_points(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode,
                     CeedEvalMode mode, CeedVector x_ref, CeedVector u, CeedVector v, bool add) {
  const auto &b = hg::deref_basis(basis);
  require_elements(num_elem);
  require_mode(t_mode, mode, add);
  if (num_elem > 0) hg::require_argument(b, num_points, "num_points (a count for each element)");
  CeedSize total = 0;
  for (CeedInt e = 0; e < num_elem; e++) {
    hg::require(num_points[e] >= 0, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedBasis: num_points of element %" CeedInt_FMT " is %" CeedInt_FMT "; expected zero or more", e,
                      num_points[e]);
    });
    total += num_points[e];
  }
  if (mode != CEED_EVAL_WEIGHT) {
    hg::require_polynomial(b);
    require_length(b, "x_ref", x_ref, total * b.dim, mode);
    hg::require(x_ref != v, CEED_ERROR_INCOMPATIBLE, "CeedBasis: x_ref and v are the same vector; expected two");
  }
  require_vectors(b, t_mode, mode, {static_cast<CeedSize>(num_elem) * b.P, total, hg::q_components(b, mode)}, u, v);
  const auto &ops = b.ceed->ops.basis;
  hg::require(ops.apply_at_points != nullptr, CEED_ERROR_UNSUPPORTED,
              "Backend does not implement CeedBasisApplyAtPoints");
  hg::check(ops.apply_at_points(basis, num_elem, num_points, t_mode, mode, x_ref, u, v, add));
}

/// Nodes of the Lagrange basis: Gauss-Lobatto points; the centre for the constant one.
std::vector<CeedScalar> lagrange_nodes(CeedInt P) {
  std::vector<CeedScalar> nodes(P, 0.0);
  if (P > 1) hg::check(CeedLobattoQuadrature(P, nodes.data(), nullptr));
  return nodes;
}

std::vector<CeedScalar> identity(CeedInt n) {
  std::vector<CeedScalar> matrix(static_cast<std::size_t>(n) * n, 0.0);
  for (CeedInt i = 0; i < n; i++) matrix[i * n + i] = 1.0;
  return matrix;
}

/// Values and derivatives at x of the Lagrange polynomials of distinct nodes, by their products.
void lagrange(const std::vector<CeedScalar> &nodes, CeedScalar x, CeedScalar *value, CeedScalar *derivative) {
  const auto P = static_cast<CeedInt>(nodes.size());
  for (CeedInt j = 0; j < P; j++) {
    // Product rule, one factor (x - x_i) / (x_j - x_i) after another.
    CeedScalar product = 1.0, slope = 0.0;
    for (CeedInt i = 0; i < P; i++) {
      if (i == j) continue;
      const CeedScalar scale = nodes[j] - nodes[i];
      slope = (slope * (x - nodes[i]) + product) / scale;
      product *= (x - nodes[i]) / scale;
    }
    value[j] = product;
    derivative[j] = slope;
  }
}

}  // namespace

const CeedBasis CEED_BASIS_NONE = &none.object;

CeedBasis_private::~CeedBasis_private() {
  if (!is_known_to_backend) return;
  const auto &ops = ceed->ops.basis;
  if (ops.destroy != nullptr) ops.destroy(this);
}

int CeedBasisCreateTensorH1Lagrange(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P, CeedInt Q,
                                    CeedQuadMode quad_mode, CeedBasis *basis) {
  return hg::guard(ceed, [&] {
    auto b = make_tensor(ceed, dim, num_comp, P, Q);
    hg::require_argument(*b, basis, "basis (where the handle goes)");
    b->q_ref.resize(Q);
    b->q_weight.resize(Q);
    switch (quad_mode) {
      case CEED_GAUSS:
        hg::check(CeedGaussQuadrature(Q, b->q_ref.data(), b->q_weight.data()));
        break;
      case CEED_GAUSS_LOBATTO:
        hg::require(Q >= 2, CEED_ERROR_DIMENSION, [&] {
          return hg::text("CeedBasis: Q is %" CeedInt_FMT "; expected at least 2 Gauss-Lobatto points", Q);
        });
        hg::check(CeedLobattoQuadrature(Q, b->q_ref.data(), b->q_weight.data()));
        break;
      default:
        throw hg::Error(CEED_ERROR_UNSUPPORTED,
                        hg::text("CeedBasis: quadrature mode is %d; expected CEED_GAUSS or CEED_GAUSS_LOBATTO",
                                 static_cast<int>(quad_mode)));
    }
    const auto nodes = lagrange_nodes(P);
    b->interp_1d.resize(static_cast<std::size_t>(Q) * P);
    b->grad_1d.resize(b->interp_1d.size());
    for (CeedInt i = 0; i < Q; i++) lagrange(nodes, b->q_ref[i], &b->interp_1d[i * P], &b->grad_1d[i * P]);
    b->chebyshev_1d = hg::chebyshev_coefficients(nodes, identity(P), P);
    hand_out(std::move(b), basis);
  });
}

int CeedBasisCreateTensorH1(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P_1d, CeedInt Q_1d,
                            const CeedScalar *interp_1d, const CeedScalar *grad_1d, const CeedScalar *q_ref_1d,
                            const CeedScalar *q_weight_1d, CeedBasis *basis) {
  return hg::guard(ceed, [&] {
    auto b = make_tensor(ceed, dim, num_comp, P_1d, Q_1d);
    hg::require_argument(*b, interp_1d, "interp_1d (Q_1d * P_1d entries)");
    hg::require_argument(*b, grad_1d, "grad_1d (Q_1d * P_1d entries)");
    hg::require_argument(*b, q_ref_1d, "q_ref_1d (Q_1d entries)");
    hg::require_argument(*b, q_weight_1d, "q_weight_1d (Q_1d entries)");
    hg::require_argument(*b, basis, "basis (where the handle goes)");
    b->q_ref.assign(q_ref_1d, q_ref_1d + Q_1d);
    b->q_weight.assign(q_weight_1d, q_weight_1d + Q_1d);
    const std::size_t size = static_cast<std::size_t>(Q_1d) * P_1d;
    b->interp_1d.assign(interp_1d, interp_1d + size);
    b->grad_1d.assign(grad_1d, grad_1d + size);
    if (Q_1d >= P_1d) b->chebyshev_1d = hg::chebyshev_coefficients(b->q_ref, b->interp_1d, P_1d);
    hand_out(std::move(b), basis);
  });
}

int CeedBasisApply(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector u,
                   CeedVector v) {
  return hg::guard(hg::ceed_of(basis), [&] { apply(basis, num_elem, t_mode, eval_mode, u, v, false); });
}

int CeedBasisApplyAdd(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector u,
                      CeedVector v) {
  return hg::guard(hg::ceed_of(basis), [&] { apply(basis, num_elem, t_mode, eval_mode, u, v, true); });
}

int CeedBasisApplyAtPoints(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode,
                           CeedEvalMode eval_mode, CeedVector x_ref, CeedVector u, CeedVector v) {
  return hg::guard(hg::ceed_of(basis),
                   [&] { apply_at_points(basis, num_elem, num_points, t_mode, eval_mode, x_ref, u, v, false); });
}

int CeedBasisApplyAddAtPoints(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode,
                              CeedEvalMode eval_mode, CeedVector x_ref, CeedVector u, CeedVector v) {
  return hg::guard(hg::ceed_of(basis),
                   [&] { apply_at_points(basis, num_elem, num_points, t_mode, eval_mode, x_ref, u, v, true); });
}

int CeedBasisReferenceCopy(CeedBasis basis, CeedBasis *basis_copy) {
  return hg::guard(hg::ceed_of(basis), [&] { hg::reference_copy(basis, basis_copy); });
}

int CeedBasisReference(CeedBasis basis) {
  return hg::guard(hg::ceed_of(basis), [&] { hg::reference(&hg::deref(basis, "CeedBasis")); });
}

int CeedBasisDestroy(CeedBasis *basis) {
  return hg::guard(basis != nullptr ? hg::ceed_of(*basis) : nullptr, [&] { hg::destroy(basis); });
}
