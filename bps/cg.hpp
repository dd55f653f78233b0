/// @file
/// Conjugate gradients on the vectors of the C interface.
#pragma once

#include <ceed.h>

#include "bakeoff.hpp"

namespace hg::bps {

struct CgResult {
  int iterations = 0;
  bool converged = false;
  double seconds = 0;
  double relative_residual = 1;  ///< ‖r‖ / ‖b‖ of the recurrence
};

/// How p·Ap is computed; the interface has no dot product.
enum class Dot {
  preferred,  ///< on_host or by_norms, by the memory that the library prefers
  on_host,    ///< summed on the host arrays in place, without a copy where they already are there
  by_norms,  ///< nothing leaves the device: ‖p‖‖Ap‖ (‖s‖² − ‖d‖²) / 4 with s, d = p/‖p‖ ± Ap/‖Ap‖, whose rounding error
             ///< is below ε √κ(A) relative, at the price of two norms and two updates more
};

struct CgOptions {
  double relative_tolerance = 1e-10;  ///< on ‖r‖ / ‖b‖; 0 runs all iterations
  int max_iterations = 20;
  Dot dot = Dot::preferred;
};

/// Solves A x = b from x = 0 without a preconditioner. `mask` (1 or 0 for each DoF) restricts the system to the DoFs
/// where it is 1; null keeps all. b is masked in place.
CgResult conjugate_gradients(Ceed ceed, const Bakeoff &A, CeedVector mask, CeedVector b, CeedVector x,
                             const CgOptions &options);

}  // namespace hg::bps
