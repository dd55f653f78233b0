// Creation: from polynomials, or from the user's matrices.
#include <algorithm>
#include <iterator>
#include <limits>

#include "basis.hpp"

namespace {

CeedElemTopology tensor_topology(CeedInt dim) {
  return dim == 1 ? CEED_TOPOLOGY_LINE : dim == 2 ? CEED_TOPOLOGY_QUAD : CEED_TOPOLOGY_HEX;
}

void require_range(const char *name, CeedInt value, CeedInt least, CeedInt most) {
  hg::require(least <= value && value <= most, CEED_ERROR_DIMENSION, [&] {
    const std::string upper = most < std::numeric_limits<CeedInt>::max() ? hg::text(" to %" CeedInt_FMT, most) : "";
    return hg::text("CeedBasis: %s is %" CeedInt_FMT "; expected %" CeedInt_FMT "%s", name, value, least,
                    upper.empty() ? " or more" : upper.c_str());
  });
}

constexpr CeedInt any = std::numeric_limits<CeedInt>::max();

hg::Ref<CeedBasis_private> make(Ceed ceed, CeedElemTopology topology, CeedInt dim, CeedInt num_comp, CeedInt P,
                                CeedInt Q) {
  auto basis = hg::Ref<CeedBasis_private>::adopt(new CeedBasis_private);
  basis->ceed = hg::Ref<Ceed_private>(ceed);
  basis->topology = topology;
  basis->dim = dim;
  basis->num_comp = num_comp;
  basis->P = P;
  basis->Q = Q;
  return basis;
}

/// `size` entries from the user's array; zeros where it is NULL.
std::vector<CeedScalar> copy_or_zeros(const CeedScalar *array, std::size_t size) {
  return array != nullptr ? std::vector<CeedScalar>(array, array + size) : std::vector<CeedScalar>(size, 0.0);
}

/// Body of the functions that take full matrices.
void create(Ceed ceed, CeedFESpace space, CeedElemTopology topology, CeedInt num_comp, CeedInt P, CeedInt Q,
            const CeedScalar *interp, const CeedScalar *derivative, const CeedScalar *q_ref, const CeedScalar *q_weight,
            CeedBasis *handle) {
  auto basis = hg::make_basis(ceed, space, topology, num_comp, P, Q);
  hg::require_argument(interp, "interp (q_comp * Q * P entries)");
  hg::require_argument(handle, "basis (where the handle goes)");
  const auto q_comp = [&](CeedEvalMode mode) { return static_cast<std::size_t>(hg::q_components(*basis, mode)); };
  const std::size_t size = static_cast<std::size_t>(Q) * P;
  basis->interp.assign(interp, interp + q_comp(CEED_EVAL_INTERP) * size);
  if (derivative != nullptr) {
    basis->derivative.assign(derivative, derivative + q_comp(hg::derivative_mode(space)) * size);
  }
  basis->q_ref = copy_or_zeros(q_ref, static_cast<std::size_t>(basis->dim) * Q);
  basis->q_weight = copy_or_zeros(q_weight, static_cast<std::size_t>(Q));
  hg::hand_out(std::move(basis), handle);
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

namespace hg {

Ref<CeedBasis_private> make_tensor_basis(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P_1d, CeedInt Q_1d) {
  deref(ceed, "Ceed");
  // P^dim and Q^dim must be CeedInts; far beyond use, this only keeps them from overflowing.
  const CeedInt most = dim <= 1 ? any : dim == 2 ? 46340 : 1290;
  require_range("dim", dim, 1, 3);
  require_range("num_comp", num_comp, 1, any);
  require_range("the number of nodes in a direction", P_1d, 1, most);
  require_range("the number of quadrature points in a direction", Q_1d, 1, most);
  auto basis = make(ceed, tensor_topology(dim), dim, num_comp, CeedIntPow(P_1d, dim), CeedIntPow(Q_1d, dim));
  basis->P_1d = P_1d;
  basis->Q_1d = Q_1d;
  return basis;
}

Ref<CeedBasis_private> make_basis(Ceed ceed, CeedFESpace space, CeedElemTopology topology, CeedInt num_comp, CeedInt P,
                                  CeedInt Q) {
  deref(ceed, "Ceed");
  constexpr CeedElemTopology topologies[] = {CEED_TOPOLOGY_LINE, CEED_TOPOLOGY_TRIANGLE, CEED_TOPOLOGY_QUAD,
                                             CEED_TOPOLOGY_TET,  CEED_TOPOLOGY_PYRAMID,  CEED_TOPOLOGY_PRISM,
                                             CEED_TOPOLOGY_HEX};
  require(std::find(std::begin(topologies), std::end(topologies), topology) != std::end(topologies),
          CEED_ERROR_DIMENSION, [&] {
            return text("CeedBasis: topology is %d; expected a CeedElemTopology such as CEED_TOPOLOGY_TRIANGLE",
                        static_cast<int>(topology));
          });
  require_range("num_comp", num_comp, 1, any);
  require_range("the number of nodes", P, 1, any);
  require_range("the number of quadrature points", Q, 1, any);
  CeedInt dim = 0;
  check(CeedBasisGetTopologyDimension(topology, &dim));
  auto basis = make(ceed, topology, dim, num_comp, P, Q);
  basis->fe_space = space;
  basis->is_tensor = false;
  return basis;
}

void hand_out(Ref<CeedBasis_private> basis, CeedBasis *handle) {
  const auto &ops = basis->ceed->ops.basis;
  if (ops.create != nullptr) check(ops.create(basis.get()));
  basis->is_known_to_backend = true;
  *handle = basis.release();
}

}  // namespace hg

int CeedBasisCreateTensorH1Lagrange(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P, CeedInt Q,
                                    CeedQuadMode quad_mode, CeedBasis *basis) {
  return hg::guard(ceed, [&] {
    auto b = hg::make_tensor_basis(ceed, dim, num_comp, P, Q);
    hg::require_argument(basis, "basis (where the handle goes)");
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
    hg::hand_out(std::move(b), basis);
  });
}

int CeedBasisCreateTensorH1(Ceed ceed, CeedInt dim, CeedInt num_comp, CeedInt P_1d, CeedInt Q_1d,
                            const CeedScalar *interp_1d, const CeedScalar *grad_1d, const CeedScalar *q_ref_1d,
                            const CeedScalar *q_weight_1d, CeedBasis *basis) {
  return hg::guard(ceed, [&] {
    auto b = hg::make_tensor_basis(ceed, dim, num_comp, P_1d, Q_1d);
    hg::require_argument(interp_1d, "interp_1d (Q_1d * P_1d entries)");
    hg::require_argument(grad_1d, "grad_1d (Q_1d * P_1d entries)");
    hg::require_argument(q_ref_1d, "q_ref_1d (Q_1d entries)");
    hg::require_argument(q_weight_1d, "q_weight_1d (Q_1d entries)");
    hg::require_argument(basis, "basis (where the handle goes)");
    b->q_ref.assign(q_ref_1d, q_ref_1d + Q_1d);
    b->q_weight.assign(q_weight_1d, q_weight_1d + Q_1d);
    const std::size_t size = static_cast<std::size_t>(Q_1d) * P_1d;
    b->interp_1d.assign(interp_1d, interp_1d + size);
    b->grad_1d.assign(grad_1d, grad_1d + size);
    if (Q_1d >= P_1d) b->chebyshev_1d = hg::chebyshev_coefficients(b->q_ref, b->interp_1d, P_1d);
    hg::hand_out(std::move(b), basis);
  });
}

int CeedBasisCreateH1(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes, CeedInt nqpts,
                      const CeedScalar *interp, const CeedScalar *grad, const CeedScalar *q_ref,
                      const CeedScalar *q_weights, CeedBasis *basis) {
  return hg::guard(ceed, [&] {
    create(ceed, CEED_FE_SPACE_H1, topo, num_comp, num_nodes, nqpts, interp, grad, q_ref, q_weights, basis);
  });
}

int CeedBasisCreateHdiv(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes, CeedInt nqpts,
                        const CeedScalar *interp, const CeedScalar *div, const CeedScalar *q_ref,
                        const CeedScalar *q_weights, CeedBasis *basis) {
  return hg::guard(ceed, [&] {
    create(ceed, CEED_FE_SPACE_HDIV, topo, num_comp, num_nodes, nqpts, interp, div, q_ref, q_weights, basis);
  });
}

int CeedBasisCreateHcurl(Ceed ceed, CeedElemTopology topo, CeedInt num_comp, CeedInt num_nodes, CeedInt nqpts,
                         const CeedScalar *interp, const CeedScalar *curl, const CeedScalar *q_ref,
                         const CeedScalar *q_weights, CeedBasis *basis) {
  return hg::guard(ceed, [&] {
    create(ceed, CEED_FE_SPACE_HCURL, topo, num_comp, num_nodes, nqpts, interp, curl, q_ref, q_weights, basis);
  });
}
