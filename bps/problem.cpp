#include "problem.hpp"

#include <algorithm>
#include <array>

namespace hg::bps {

namespace {

constexpr std::array<Problem, 6> problems{{
    {"bp1", false, 1, false},
    {"bp2", false, 3, false},
    {"bp3", true, 1, false},
    {"bp4", true, 3, false},
    {"bp5", true, 1, true},
    {"bp6", true, 3, true},
}};

double cell_bytes(CeedInt degree, CeedSize num_elem) {
  const double P = degree + 1;
  return 4. * P * P * P * num_elem;
}

/// Contraction chains of one application, forward and transposed together.
double num_chains(const Problem &problem) {
  return 2. * problem.num_comp * (problem.is_poisson ? 3 : 1);
}

double point_flops(const Problem &problem) {
  return problem.num_comp * (problem.is_poisson ? 15. : 1.);
}

}  // namespace

std::span<const Problem> all_problems() {
  return problems;
}

const Problem *find_problem(std::string_view name) {
  const auto it = std::ranges::find(problems, name, &Problem::name);
  return it == problems.end() ? nullptr : &*it;
}

Work work_at_quadrature(const Problem &problem, CeedInt degree, CeedSize num_elem, CeedSize num_dofs) {
  const double P = degree + 1, Q = problem.q_1d(degree), num_points = Q * Q * Q * num_elem;
  const double chain = 2 * (P * P * P * Q + P * P * Q * Q + P * Q * Q * Q);
  const double held_bytes = cell_bytes(degree, num_elem) + 8 * problem.num_stored() * num_points;
  return {16. * num_dofs + held_bytes, num_chains(problem) * chain * num_elem + point_flops(problem) * num_points,
          held_bytes};
}

Work work_at_points(const Problem &problem, CeedInt degree, CeedSize num_elem, CeedSize num_dofs, CeedSize num_points) {
  const double P = degree + 1;
  const double chain = 2 * (P * P * P + P * P + P);
  const double read_bytes = cell_bytes(degree, num_elem) + 8. * (3 + problem.num_stored()) * num_points;
  return {16. * num_dofs + read_bytes, (num_chains(problem) * chain + point_flops(problem)) * num_points,
          read_bytes + 4. * num_points};
}

}  // namespace hg::bps
