// Calls on bases.
#include <algorithm>

#include "objects.hpp"

namespace hg::fuzz {
namespace {

constexpr std::size_t largest = 64;  ///< of Objects::count()

int create_by_matrices(Objects &o) {
  static int (*const creates[])(Ceed, CeedElemTopology, CeedInt, CeedInt, CeedInt, const CeedScalar *,
                                const CeedScalar *, const CeedScalar *, const CeedScalar *,
                                CeedBasis *) = {CeedBasisCreateH1, CeedBasisCreateHdiv, CeedBasisCreateHcurl};
  const Ceed ceed = o.ceed();
  const auto create = creates[o.bytes.next_byte() % 3];
  const CeedElemTopology topology = o.topology();
  const CeedInt num_comp = o.count(), P = o.count(), Q = o.count();
  const std::size_t size = 3 * static_cast<std::size_t>(std::max(P, 0)) * static_cast<std::size_t>(std::max(Q, 0));
  const int nulls = o.bytes.next_byte();
  const auto given = [&](int i, std::size_t length) {
    return nulls >= 128 && (nulls >> i & 1) != 0 ? nullptr : o.scalars(length);
  };
  return o.create(o.bases, [&](CeedBasis *basis) {
    return create(ceed, topology, num_comp, P, Q, given(0, size), given(1, size), given(2, 3 * largest),
                  given(3, largest), basis);
  });
}

/// An x_ref and others of the right length, or any.
CeedVector sized(Objects &o, CeedSize length) {
  return o.bytes.next_byte() >= 64 ? o.vector() : o.temporary(length, 0.5);
}

int apply(Objects &o) {
  const CeedBasis basis = o.basis();
  const CeedInt num_elem = o.count();
  const CeedTransposeMode t_mode = o.t_mode();
  const CeedEvalMode mode = o.eval_mode();
  const bool is_added = o.flag();
  CeedInt P = 1, Q = 1, num_comp = 1, q_comp = 1;
  if (basis != nullptr) {
    CeedBasisGetNumNodes(basis, &P);
    CeedBasisGetNumQuadraturePoints(basis, &Q);
    CeedBasisGetNumComponents(basis, &num_comp);
    CeedBasisGetNumQuadratureComponents(basis, mode, &q_comp);
  }
  const CeedSize comps = static_cast<CeedSize>(std::clamp(num_elem, 0, 9)) * num_comp;
  const CeedSize nodes = comps * P, points = comps * Q * q_comp;
  const bool forward = t_mode == CEED_NOTRANSPOSE;
  const CeedVector u = sized(o, forward ? nodes : points), v = sized(o, forward ? points : nodes);
  return is_added ? CeedBasisApplyAdd(basis, num_elem, t_mode, mode, u, v)
                  : CeedBasisApply(basis, num_elem, t_mode, mode, u, v);
}

int apply_at_points(Objects &o) {
  const CeedBasis basis = o.basis();
  const CeedInt num_elem = o.few();
  CeedInt num_points[8], total = 0;
  for (CeedInt &n : num_points) n = static_cast<CeedInt>(o.bytes.next_byte() % 5);
  for (CeedInt e = 0; e < num_elem; e++) total += num_points[e];
  if (o.bytes.next_byte() >= 250) num_points[0] = -1;
  const CeedTransposeMode t_mode = o.t_mode();
  const CeedEvalMode mode = o.eval_mode();
  const bool is_added = o.flag(), has_points = o.bytes.next_byte() < 250;
  CeedInt P = 1, dim = 1, num_comp = 1, q_comp = 1;
  if (basis != nullptr) {
    CeedBasisGetNumNodes(basis, &P);
    CeedBasisGetDimension(basis, &dim);
    CeedBasisGetNumComponents(basis, &num_comp);
    CeedBasisGetNumQuadratureComponents(basis, mode, &q_comp);
  }
  const CeedSize nodes = static_cast<CeedSize>(std::max(num_elem, 0)) * num_comp * P,
                 points = static_cast<CeedSize>(total) * num_comp * q_comp;
  const bool forward = t_mode == CEED_NOTRANSPOSE;
  const CeedVector x = sized(o, static_cast<CeedSize>(total) * std::max(dim, 1)),
                   u = sized(o, forward ? nodes : points), v = sized(o, forward ? points : nodes);
  return (is_added ? CeedBasisApplyAddAtPoints : CeedBasisApplyAtPoints)(
      basis, num_elem, has_points ? num_points : nullptr, t_mode, mode, x, u, v);
}

const Call calls[] = {
    {"CeedBasisCreateTensorH1Lagrange", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       const CeedInt dim = o.few(), num_comp = o.count(), P = o.few(), Q = o.few();
       const CeedQuadMode mode = o.flag() ? CEED_GAUSS : CEED_GAUSS_LOBATTO;
       return o.create(o.bases, [&](CeedBasis *basis) {
         return CeedBasisCreateTensorH1Lagrange(ceed, dim, num_comp, P, Q, mode, basis);
       });
     }},
    {"CeedBasisCreateTensorH1", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       const CeedInt dim = o.few(), num_comp = o.count(), P = o.few(), Q = o.few();
       const int nulls = o.bytes.next_byte();
       const auto given = [&](int i) { return nulls >= 128 && (nulls >> i & 1) != 0 ? nullptr : o.scalars(32); };
       return o.create(o.bases, [&](CeedBasis *basis) {
         return CeedBasisCreateTensorH1(ceed, dim, num_comp, P, Q, given(0), given(1), given(2), given(3), basis);
       });
     }},
    {"CeedBasisCreateH1, Hdiv, Hcurl", false, create_by_matrices},
    {"CeedBasisCreateProjection", false,
     [](Objects &o) {
       const CeedBasis from = o.basis(), to = o.basis();
       return o.create(o.bases, [&](CeedBasis *basis) { return CeedBasisCreateProjection(from, to, basis); });
     }},
    {"CeedBasisDestroy", false, [](Objects &o) { return o.bases.remove(o.bases.at(o.slot())); }},
    {"CeedBasisReferenceCopy", false,
     [](Objects &o) {
       const CeedBasis basis = o.basis();
       return o.create(o.bases, [&](CeedBasis *copy) { return CeedBasisReferenceCopy(basis, copy); });
     }},
    {"CeedBasisApply", true, apply},
    {"CeedBasisApplyAtPoints", true, apply_at_points},
    {"CeedBasis counts", false,
     [](Objects &o) {
       static int (*const getters[])(CeedBasis, CeedInt *) = {
           CeedBasisGetDimension,  CeedBasisGetNumComponents,       CeedBasisGetNumNodes,
           CeedBasisGetNumNodes1D, CeedBasisGetNumQuadraturePoints, CeedBasisGetNumQuadraturePoints1D,
           CeedBasisGetNumViewTabs};
       CeedInt value = 0;
       const CeedBasis basis = o.basis();
       return getters[o.bytes.next_byte() % std::size(getters)](basis, &value);
     }},
    {"CeedBasis arrays", false,
     [](Objects &o) {
       static int (*const getters[])(CeedBasis, const CeedScalar **) = {
           CeedBasisGetQRef, CeedBasisGetQWeights, CeedBasisGetInterp, CeedBasisGetInterp1D,
           CeedBasisGetGrad, CeedBasisGetGrad1D,   CeedBasisGetDiv,    CeedBasisGetCurl};
       const CeedScalar *array = nullptr;
       const CeedBasis basis = o.basis();
       return getters[o.bytes.next_byte() % std::size(getters)](basis, &array);
     }},
    {"CeedBasisGetTopology", false,
     [](Objects &o) {
       CeedElemTopology topology;
       return CeedBasisGetTopology(o.basis(), &topology);
     }},
    {"CeedBasisGetFESpace", false,
     [](Objects &o) {
       CeedFESpace space;
       return CeedBasisGetFESpace(o.basis(), &space);
     }},
    {"CeedBasisGetDerivativeMode", false,
     [](Objects &o) {
       CeedEvalMode mode;
       return CeedBasisGetDerivativeMode(o.basis(), &mode);
     }},
    {"CeedBasisGetNumQuadratureComponents", false,
     [](Objects &o) {
       CeedInt value = 0;
       const CeedBasis basis = o.basis();
       return CeedBasisGetNumQuadratureComponents(basis, o.eval_mode(), &value);
     }},
    {"CeedBasisIsTensor", false,
     [](Objects &o) {
       bool is = false;
       return CeedBasisIsTensor(o.basis(), &is);
     }},
    {"CeedBasisIsCollocated", false,
     [](Objects &o) {
       bool is = false;
       return CeedBasisIsCollocated(o.basis(), &is);
     }},
    {"CeedBasisGetCollocatedGrad", false,
     [](Objects &o) {
       CeedScalar gradient[largest * largest];
       return CeedBasisGetCollocatedGrad(o.basis(), gradient);
     }},
    {"CeedBasisGetChebyshevInterp1D", false,
     [](Objects &o) {
       CeedScalar matrix[largest * largest];
       return CeedBasisGetChebyshevInterp1D(o.basis(), matrix);
     }},
    {"CeedBasisGetChebyshevCoefficients1D", false,
     [](Objects &o) {
       CeedInt num = 0;
       const CeedScalar *coefficients = nullptr;
       return CeedBasisGetChebyshevCoefficients1D(o.basis(), &num, &coefficients);
     }},
    {"CeedOperatorGetBasisPointer", false,
     [](Objects &o) {
       const CeedScalar *matrix = nullptr;
       const CeedBasis basis = o.basis();
       return CeedOperatorGetBasisPointer(basis, o.eval_mode(), nullptr, &matrix);
     }},
    {"CeedBasisEvaluateAtPoint", false,
     [](Objects &o) {
       const CeedBasis basis = o.basis();
       CeedInt P = 0;
       if (basis != nullptr) CeedBasisGetNumNodes(basis, &P);
       CeedScalar *interp = o.scalars(std::max(P, 1)), *grad = o.scalars(3 * static_cast<std::size_t>(std::max(P, 1)));
       const CeedScalar x[3] = {o.scalar(), o.scalar(), o.scalar()};
       return CeedBasisEvaluateAtPoint(basis, x, o.flag() ? interp : nullptr, o.flag() ? grad : nullptr);
     }},
    {"CeedBasisGetFlopsEstimate", false,
     [](Objects &o) {
       CeedSize flops = 0;
       const CeedBasis basis = o.basis();
       const CeedTransposeMode t_mode = o.t_mode();
       const CeedEvalMode mode = o.eval_mode();
       const bool is_at_points = o.flag();
       return CeedBasisGetFlopsEstimate(basis, t_mode, mode, is_at_points, o.count(), &flops);
     }},
    {"CeedBasisView", false, [](Objects &o) { return CeedBasisView(o.basis(), o.stream()); }},
};

}  // namespace

std::span<const Call> basis_calls() {
  return calls;
}

}  // namespace hg::fuzz
