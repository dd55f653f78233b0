/// @file
/// Small dense linear algebra on the host. Matrices are row-major.
#pragma once

#include <ceed/types.h>

#include <vector>

namespace hg {

/// Moore-Penrose inverse, n by m, of an m by n matrix with m >= n and full column rank: (A^T A)^-1 A^T, computed from a
/// Householder QR factorisation. Throws CEED_ERROR_DIMENSION where m < n, and CEED_ERROR_MINOR where the columns are
/// dependent to rounding; the message names the matrix as `what`.
std::vector<CeedScalar> pseudo_inverse(const std::vector<CeedScalar> &a, CeedInt m, CeedInt n, const char *what);

/// C = A B for A l by m, B m by n.
std::vector<CeedScalar> multiply(const std::vector<CeedScalar> &a, const std::vector<CeedScalar> &b, CeedInt l,
                                 CeedInt m, CeedInt n);

}  // namespace hg
