/// @file
/// Small dense linear algebra on the host. Matrices are row-major. `what` names the matrix in errors.
#pragma once

#include <ceed/types.h>

#include <span>
#include <vector>

namespace hg {

/// A = Q R for A m by n with m >= n, in place: R on and above the diagonal, below it the reflectors of
/// Q = H_0 H_1 ... H_(n-1), H_k = I - tau_k v_k v_k^T, v_k = (0, ..., 0, 1, a_(k+1,k), ..., a_(m-1,k)); tau has n
/// entries. Throws CEED_ERROR_DIMENSION where m < n.
void qr_factorize(CeedScalar *a, CeedScalar *tau, CeedInt m, CeedInt n, const char *what);

/// A = Q A or A = Q^T A for A m by n, with entry (i, j) at a[i*row + j*col], and Q the product of the k <= m reflectors
/// in q (m by k) and tau, as qr_factorize() leaves them.
void apply_q(CeedScalar *a, const CeedScalar *q, const CeedScalar *tau, bool is_transpose, CeedInt m, CeedInt n,
             CeedInt k, CeedInt row, CeedInt col);

/// Moore-Penrose inverse, n by m, of an m by n matrix with m >= n and full column rank: R^-1 Q^T. Throws
/// CEED_ERROR_DIMENSION where m < n, and CEED_ERROR_MINOR where the columns are dependent to rounding.
std::vector<CeedScalar> pseudo_inverse(std::span<const CeedScalar> a, CeedInt m, CeedInt n, const char *what);

/// C = A B for A l by m, B m by n.
std::vector<CeedScalar> multiply(std::span<const CeedScalar> a, std::span<const CeedScalar> b, CeedInt l, CeedInt m,
                                 CeedInt n);

/// A = V diag(lambda) V^T for a symmetric matrix (its lower triangle is read): overwrites it with V, whose columns are
/// orthonormal, and writes the n eigenvalues in ascending order. Throws CEED_ERROR_MINOR where an entry is not finite.
void symmetric_eigen(CeedScalar *a, CeedScalar *lambda, CeedInt n, const char *what);

/// X^T A X = diag(lambda), X^T B X = I for A symmetric and B symmetric positive definite, n by n; X has n*n and lambda,
/// ascending, n entries. Throws CEED_ERROR_MINOR where B is not positive definite to rounding.
void simultaneous_diagonalize(std::span<const CeedScalar> a, std::span<const CeedScalar> b, CeedScalar *x,
                              CeedScalar *lambda, CeedInt n);

}  // namespace hg
