// Bases in use: application, references.
#include "basis.hpp"

#include "vector.hpp"

namespace {

/// Never destroyed: programs may still hold the constant when they end.
union Sentinel {
  Sentinel() : object() { object.is_sentinel = true; }
  ~Sentinel() {}
  CeedBasis_private object;
};
Sentinel none;

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
void require_mode(const CeedBasis_private &basis, CeedTransposeMode t_mode, CeedEvalMode mode, bool add) {
  if (mode != CEED_EVAL_WEIGHT) hg::require_evaluation(basis, mode);
  hg::require_transpose_mode(t_mode, "CeedBasis");
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
  require_mode(b, t_mode, mode, add);
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
  require_mode(b, t_mode, mode, add);
  if (num_elem > 0) hg::require_argument(num_points, "num_points (a count for each element)");
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

}  // namespace

const CeedBasis CEED_BASIS_NONE = &none.object;

CeedBasis_private::~CeedBasis_private() {
  if (!is_known_to_backend) return;
  const auto &ops = ceed->ops.basis;
  if (ops.destroy != nullptr) ops.destroy(this);
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
