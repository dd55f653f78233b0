/// @file
/// Spaces that the tests of bases run through, and polynomials whose values and derivatives are known everywhere.
#pragma once

#include <ceed.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"
#include "support/values.hpp"

namespace hg::test {

/// A tensor-product Lagrange basis.
struct BasisCase {
  CeedInt dim, num_comp, P, Q;
  CeedQuadMode quad_mode;

  CeedInt num_nodes() const { return CeedIntPow(P, dim); }
  CeedInt num_qpts() const { return CeedIntPow(Q, dim); }
};

inline std::ostream &operator<<(std::ostream &stream, const BasisCase &c) {
  return stream << "dim " << c.dim << ", components " << c.num_comp << ", P " << c.P << ", Q " << c.Q << ", "
                << CeedQuadModes[c.quad_mode];
}

/// P = 2 to 9 in one to three dimensions, with fewer, as many and more points than nodes, and 1 to 9 components. In
/// three dimensions, P beyond 6 comes with one number of points each.
inline std::vector<BasisCase> basis_cases() {
  std::vector<BasisCase> cases;
  CeedInt count = 0;
  for (CeedInt dim = 1; dim <= 3; dim++) {
    for (CeedInt P = 2; P <= 9; P++) {
      for (CeedInt Q = std::max(P - 2, 1); Q <= P + 2; Q++) {
        if (dim == 3 && P > 6 && Q != P + 1) continue;
        for (const CeedQuadMode mode : {CEED_GAUSS, CEED_GAUSS_LOBATTO}) {
          if (mode == CEED_GAUSS_LOBATTO && Q < 2) continue;
          const CeedInt num_comp = dim == 3 && P > 4 ? 1 + count % 3 : 1 + count % 9;
          cases.push_back({dim, num_comp, P, Q, mode});
          count++;
        }
      }
    }
  }
  return cases;
}

inline Basis make_basis(Ceed ceed, const BasisCase &c) {
  Basis basis;
  ok(CeedBasisCreateTensorH1Lagrange(ceed, c.dim, c.num_comp, c.P, c.Q, c.quad_mode, basis.out()));
  return basis;
}

/// The same basis by its full matrices.
inline Basis without_tensor(Ceed ceed, CeedBasis tensor, const BasisCase &c) {
  CeedElemTopology topology;
  const CeedScalar *interp, *grad;
  ok(CeedBasisGetTopology(tensor, &topology));
  ok(CeedBasisGetInterp(tensor, &interp));
  ok(CeedBasisGetGrad(tensor, &grad));
  Basis full;
  ok(CeedBasisCreateH1(ceed, topology, c.num_comp, c.num_nodes(), c.num_qpts(), interp, grad, nullptr, nullptr,
                       full.out()));
  return full;
}

/// Quadrature points in one direction.
inline Values points_1d(CeedInt Q, CeedQuadMode mode) {
  Values x(static_cast<std::size_t>(Q)), w(x.size());
  ok(mode == CEED_GAUSS ? CeedGaussQuadrature(Q, x.data(), w.data()) : CeedLobattoQuadrature(Q, x.data(), w.data()));
  return x;
}

/// Nodes of a Lagrange basis in one direction.
inline Values nodes_1d(CeedInt P) {
  return P == 1 ? Values{0.0} : points_1d(P, CEED_GAUSS_LOBATTO);
}

/// The tensor grid of 1D points as (point, direction), x fastest among the points.
inline Values tensor_grid(CeedInt dim, const Values &x_1d) {
  const auto n = static_cast<CeedInt>(x_1d.size()), total = CeedIntPow(n, dim);
  Values x(static_cast<std::size_t>(total) * dim);
  for (CeedInt p = 0; p < total; p++) {
    for (CeedInt d = 0, rest = p; d < dim; d++, rest /= n) x[d * total + p] = x_1d[rest % n];
  }
  return x;
}

/// For each component a product of polynomials p_d(x_d) of one degree with random coefficients.
class Polynomial {
 public:
  Polynomial(CeedInt dim, CeedInt num_comp, CeedInt degree, Random &random)
      : dim_(dim), num_comp_(num_comp), size_(degree + 1) {
    coefficients_ = random.reals(static_cast<CeedSize>(num_comp) * dim * size_);
  }

  /// Component c at a point; direction g differentiates, -1 does not.
  CeedScalar at(CeedInt c, const CeedScalar *x, CeedInt g = -1) const {
    CeedScalar product = 1;
    for (CeedInt d = 0; d < dim_; d++) {
      const CeedScalar *a = &coefficients_[(c * dim_ + d) * size_];
      CeedScalar value = 0, derivative = 0;
      for (CeedInt k = size_ - 1; k >= 0; k--) {  // Horner
        derivative = derivative * x[d] + value;
        value = value * x[d] + a[k];
      }
      product *= d == g ? derivative : value;
    }
    return product;
  }

  /// At the points x (point, direction): (point, component), or for gradients (point, component, direction).
  Values at_points(const Values &x, bool is_grad) const {
    const auto num_points = static_cast<CeedInt>(x.size()) / dim_;
    Values values;
    for (CeedInt g = is_grad ? 0 : -1; g < (is_grad ? dim_ : 0); g++) {
      for (CeedInt c = 0; c < num_comp_; c++) {
        for (CeedInt p = 0; p < num_points; p++) {
          CeedScalar point[3] = {};
          for (CeedInt d = 0; d < dim_; d++) point[d] = x[d * num_points + p];
          values.push_back(at(c, point, g));
        }
      }
    }
    return values;
  }

 private:
  CeedInt dim_, num_comp_, size_;
  Values coefficients_;
};

/// Values at a point for one component.
inline CeedInt q_comp(const BasisCase &c, CeedEvalMode mode) {
  return mode == CEED_EVAL_GRAD ? c.dim : 1;
}

/// v = B u or B^T u for any number of elements, into a vector that held something else.
inline Values apply(Ceed ceed, CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode mode,
                    const Values &u, CeedSize length) {
  const Vector in = make_vector(ceed, u), out = make_vector(ceed, length, 17);
  ok(CeedBasisApply(basis, num_elem, t_mode, mode, in, out));
  return values_of(out);
}

/// The same at points. Vectors without entries get one that is not looked at.
inline Values apply_at_points(Ceed ceed, CeedBasis basis, const std::vector<CeedInt> &num_points,
                              CeedTransposeMode t_mode, CeedEvalMode mode, const Values &x, const Values &u,
                              CeedSize length) {
  const auto filled = [](Values values) { return values.empty() ? Values{0} : values; };
  const Vector x_ref = make_vector(ceed, filled(x)), in = make_vector(ceed, filled(u));
  const Vector out = make_vector(ceed, std::max<CeedSize>(length, 1), 17);
  ok(CeedBasisApplyAtPoints(basis, static_cast<CeedInt>(num_points.size()), num_points.data(), t_mode, mode, x_ref, in,
                            out));
  Values values = values_of(out);
  values.resize(static_cast<std::size_t>(length));
  return values;
}

/// Rounding of evaluations: products of dim sums of P terms, and derivatives that grow like P^2.
inline CeedScalar basis_tolerance(const BasisCase &c) {
  return 16 * std::numeric_limits<CeedScalar>::epsilon() * c.dim * c.P * c.P;
}

}  // namespace hg::test
