/// @file
/// `bps-kernel --check`: the properties that every backend must show.
#pragma once

#include <string>
#include <vector>

#include "kernel_case.hpp"

namespace hg::bps {

/// One property that was tested.
struct CheckLine {
  std::string what;
  bool passed;
  std::string numbers;  ///< what was measured, and what was needed
};

/// Two meshes of a problem, the second finer: CG must converge on both and the error must fall at the optimal rate.
///
/// Rates are of the relative error, log(e_coarse / e_fine) / log(n_fine / n_coarse), and must be nearer to the optimum
/// than to the rate one below it. In L2 the optimum is p + 1. A Poisson problem at points of equal weight is held to
/// its optimum in H1, p: such weights do not integrate the products that a duality argument needs.
///
/// `records` gets the run on the finer mesh.
CheckLine check_convergence(Ceed ceed, const Problem &problem, CeedInt degree, std::optional<Placement> placement,
                            CeedInt points_per_cell, std::vector<Record> &records);

/// The operator at points placed at the quadrature points equals the operator at quadrature points to 1e-12 relative,
/// on a vector without structure.
CheckLine check_agreement(Ceed ceed, const Problem &problem, CeedInt degree);

}  // namespace hg::bps
