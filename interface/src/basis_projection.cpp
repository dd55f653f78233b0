// The basis that takes values at the nodes of one basis to the nodes of another: both are compared at the quadrature
// points that they share, and the difference is least there in the sense of least squares.
#include "basis.hpp"
#include "dense.hpp"

namespace {

constexpr const char *interpolation = "CeedBasis: interpolation of basis_to";

/// interp_to^+ A for each of the `slabs` matrices A, rows by P_from, that lie one after another in `a`; rows is the
/// number of rows of interp_to. `inverse` is P_to by rows.
std::vector<CeedScalar> project(const std::vector<CeedScalar> &inverse, const std::vector<CeedScalar> &a, CeedInt P_to,
                                CeedInt P_from) {
  const auto rows = static_cast<CeedInt>(inverse.size() / P_to);
  const std::size_t slab = static_cast<std::size_t>(rows) * P_from;
  std::vector<CeedScalar> projected;
  for (std::size_t first = 0; first < a.size(); first += slab) {
    const auto product = hg::multiply(inverse, {a.data() + first, slab}, P_to, rows, P_from);
    projected.insert(projected.end(), product.begin(), product.end());
  }
  return projected;
}

/// Both bases are tensor products of one dimension: so is the projection. Its functions are those of `from`, also at
/// arbitrary points.
hg::Ref<CeedBasis_private> project_1d(const CeedBasis_private &from, const CeedBasis_private &to) {
  auto basis = hg::make_tensor_basis(from.ceed.get(), from.dim, from.num_comp, from.P_1d, to.P_1d);
  const auto inverse = hg::pseudo_inverse(to.interp_1d, to.Q_1d, to.P_1d, interpolation);
  basis->interp_1d = project(inverse, from.interp_1d, to.P_1d, from.P_1d);
  basis->grad_1d = project(inverse, from.grad_1d, to.P_1d, from.P_1d);
  basis->chebyshev_1d = from.chebyshev_1d;
  basis->q_ref.assign(static_cast<std::size_t>(to.P_1d), 0.0);
  basis->q_weight.assign(static_cast<std::size_t>(to.P_1d), 0.0);
  return basis;
}

/// With full matrices. Degrees of freedom are numbers in every space, so that the projection is a basis in H^1: in
/// H(div) and H(curl) it maps coefficients, and has no derivative.
hg::Ref<CeedBasis_private> project_full(CeedBasis_private &from, CeedBasis_private &to) {
  auto basis = hg::make_basis(from.ceed.get(), CEED_FE_SPACE_H1, from.topology, from.num_comp, from.P, to.P);
  const CeedInt rows = hg::q_components(to, CEED_EVAL_INTERP) * to.Q;
  const auto inverse = hg::pseudo_inverse(hg::matrix(to, CEED_EVAL_INTERP), rows, to.P, interpolation);
  basis->interp = project(inverse, hg::matrix(from, CEED_EVAL_INTERP), to.P, from.P);
  if (from.fe_space == CEED_FE_SPACE_H1 && (from.is_tensor || !from.derivative.empty())) {
    basis->derivative = project(inverse, hg::matrix(from, CEED_EVAL_GRAD), to.P, from.P);
  }
  basis->q_ref.assign(static_cast<std::size_t>(from.dim) * to.P, 0.0);
  basis->q_weight.assign(static_cast<std::size_t>(to.P), 0.0);
  return basis;
}

}  // namespace

int CeedBasisCreateProjection(CeedBasis basis_from, CeedBasis basis_to, CeedBasis *basis_project) {
  return hg::guard(hg::ceed_of(basis_from), [&] {
    auto &from = hg::deref_basis(basis_from), &to = hg::deref_basis(basis_to);
    hg::require_argument(basis_project, "basis_project (where the handle goes)");
    hg::require(from.fe_space == to.fe_space, CEED_ERROR_INCOMPATIBLE, [&] {
      return hg::text("CeedBasis: projection from a %s to a %s; expected bases in one kind of space",
                      CeedFESpaces[from.fe_space], CeedFESpaces[to.fe_space]);
    });
    hg::require(from.Q == to.Q, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedBasis: projection needs bases with the same quadrature points; basis_from has %" CeedInt_FMT
                      ", basis_to has %" CeedInt_FMT,
                      from.Q, to.Q);
    });
    const CeedInt values_from = hg::q_components(from, CEED_EVAL_INTERP),
                  values_to = hg::q_components(to, CEED_EVAL_INTERP);
    hg::require(values_from == values_to, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedBasis: projection from values with %" CeedInt_FMT " entries to values with %" CeedInt_FMT
                      "; expected elements of one dimension in this space",
                      values_from, values_to);
    });
    const bool is_tensor = from.is_tensor && to.is_tensor && from.dim == to.dim;
    hg::hand_out(is_tensor ? project_1d(from, to) : project_full(from, to), basis_project);
  });
}
