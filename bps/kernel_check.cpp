#include "kernel_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace hg::bps {

namespace {

/// Cells a direction of the two meshes: fine enough for the rate to show, coarse enough for the error to stay well
/// above rounding at high degree.
std::pair<CeedInt, CeedInt> mesh_pair(CeedInt degree, bool at_points) {
  switch (degree) {
    case 1:
      return at_points ? std::pair(4, 8) : std::pair(6, 12);
    case 2:
      return at_points ? std::pair(3, 6) : std::pair(4, 8);
    case 3:
      return at_points ? std::pair(2, 4) : std::pair(3, 5);
    default:
      return {2, 3};
  }
}

}  // namespace

CheckLine check_convergence(Ceed ceed, const Problem &problem, CeedInt degree, std::optional<Placement> placement,
                            CeedInt points_per_cell, std::vector<Record> &records) {
  const auto [coarse, fine] = mesh_pair(degree, placement.has_value());
  // The algebraic error must stay below the discretisation error, about 1e-10 at p = 8.
  const CgOptions cg{degree <= 4 ? 1e-9 : 1e-13, 20000};
  Case which{problem, degree, {coarse, coarse, coarse}, placement, points_per_cell};
  const Record on_coarse = run_case(ceed, which, 1, cg);
  which.num_cells = {fine, fine, fine};
  const Record on_fine = run_case(ceed, which, 1, cg);
  records.push_back(on_fine);

  CheckLine line{which.description() + ": convergence", false, {}};
  if (!on_coarse.error || !on_fine.error) {
    line.numbers = fmt::format("CG did not converge to {:.0e} in {} iterations", cg.relative_tolerance,
                               std::max(on_coarse.cg_iterations, on_fine.cg_iterations));
    return line;
  }
  const bool equal_weights = placement == Placement::uniform || placement == Placement::random;
  const bool in_h1 = problem.is_poisson && equal_weights;
  const double refinement = std::log(double(fine) / coarse);
  const double rate_l2 = std::log(*on_coarse.error / *on_fine.error) / refinement;
  const double rate_h1 = std::log(*on_coarse.error_h1 / *on_fine.error_h1) / refinement;
  const double needed = degree + (in_h1 ? 0 : 1) - 0.5;
  line.passed = (in_h1 ? rate_h1 : rate_l2) > needed;
  line.numbers = fmt::format("CG {} iterations, error {:.2e}, rate {:.2f} in L2, {:.2f} in H1; needed {} > {}",
                             on_fine.cg_iterations, *on_fine.error, rate_l2, rate_h1, in_h1 ? "H1" : "L2", needed);
  return line;
}

CheckLine check_agreement(Ceed ceed, const Problem &problem, CeedInt degree) {
  const Case at_quadrature{problem, degree, {3, 2, 2}, {}};
  const Case at_points{problem, degree, {3, 2, 2}, Placement::quadrature};
  const CaseOperator A(ceed, at_quadrature), B(ceed, at_points);
  const CeedSize length = A.bakeoff().num_dofs();
  std::mt19937_64 generator(2);
  std::vector<CeedScalar> values(length);
  for (CeedScalar &value : values) value = std::ldexp(double(generator() >> 11), -52) - 1;
  const Vector u = make_vector(ceed, values), v = make_vector(ceed, length), w = make_vector(ceed, length);
  A.bakeoff().apply(u, v);
  B.bakeoff().apply(u, w);
  CeedScalar size = 0, difference = 0;
  check(ceed, CeedVectorNorm(v, CEED_NORM_MAX, &size));
  check(ceed, CeedVectorAXPY(w, -1, v));
  check(ceed, CeedVectorNorm(w, CEED_NORM_MAX, &difference));
  return {at_points.description() + ": agreement with the operator at quadrature points",
          size > 0 && difference <= 1e-12 * size,
          fmt::format("relative difference {:.1e}; needed <= 1e-12", difference / size)};
}

}  // namespace hg::bps
