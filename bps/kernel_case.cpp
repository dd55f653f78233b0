#include "kernel_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "clock.hpp"
#include "library.hpp"

namespace hg::bps {

namespace {

/// Seconds of each of `repetitions` applications, after that of the first one. Work on a device is asynchronous: there,
/// the time of ten applications and the norm that waits for them is divided by ten.
std::vector<double> time_applications(Ceed ceed, const Bakeoff &bakeoff, CeedVector u, CeedVector v, int repetitions) {
  CeedMemType preferred = CEED_MEM_HOST;
  check(ceed, CeedGetPreferredMemType(ceed, &preferred));
  const bool on_device = preferred == CEED_MEM_DEVICE;
  const int batch = on_device ? 10 : 1;
  const auto wait = [&] {
    CeedScalar norm = 0;
    if (on_device) check(ceed, CeedVectorNorm(v, CEED_NORM_2, &norm));
  };
  const double first = now();
  bakeoff.apply(u, v);
  wait();
  std::vector<double> seconds{now() - first};
  for (int i = 0; i < repetitions; i++) {
    const double start = now();
    for (int j = 0; j < batch; j++) bakeoff.apply(u, v);
    wait();
    seconds.push_back((now() - start) / batch);
  }
  return seconds;
}

Bakeoff make_bakeoff(Ceed ceed, const Case &which, const Cells &cells) {
  if (!which.placement) return Bakeoff(ceed, which.problem, which.degree, cells);
  return Bakeoff(ceed, which.problem, which.degree, cells,
                 place_points(cells, which.problem, which.degree, *which.placement, which.points_per_cell));
}

}  // namespace

std::string Case::description() const {
  std::string text =
      fmt::format("{} p={}, {}×{}×{} cells", problem.name, degree, num_cells[0], num_cells[1], num_cells[2]);
  if (placement == Placement::quadrature) return text + ", points at its quadrature points";
  if (placement) text += fmt::format(", {} {} points a cell", points_per_cell, name(*placement));
  return text;
}

CaseOperator::CaseOperator(Ceed ceed, const Case &which)
    : CaseOperator(ceed, which, BoxMesh(which.num_cells, which.degree, which.problem.num_comp)) {}

CaseOperator::CaseOperator(Ceed ceed, const Case &which, const BoxMesh &mesh)
    : bakeoff_(make_bakeoff(ceed, which, mesh.cells())) {
  if (which.problem.is_poisson) mask_ = make_vector(ceed, mesh.interior_mask());
}

Record run_case(Ceed ceed, const Case &which, int repetitions, const CgOptions &cg) {
  const CaseOperator case_operator(ceed, which);
  const Bakeoff &bakeoff = case_operator.bakeoff();
  const Vector b = bakeoff.right_hand_side(), x = make_vector(ceed, bakeoff.num_dofs());

  Record record;
  record.program = "bps-kernel";
  record.problem = which.problem.name;
  record.ceed = resource_name(ceed);
  record.degree = which.degree;
  record.q_1d = which.problem.q_1d(which.degree);
  record.elements = bakeoff.num_elem();
  record.dofs = bakeoff.num_dofs();
  record.points = bakeoff.num_points();
  if (which.placement) {
    record.points_per_cell = record.points / record.elements;
    record.placement = name(*which.placement);
  }
  record.bytes = bakeoff.work().bytes;
  record.flops = bakeoff.work().flops;
  record.cpu = cpu_name();
  record.library_version = library_version();

  std::vector<double> seconds = time_applications(ceed, bakeoff, b, x, repetitions);
  record.seconds_created = bakeoff.seconds_created();
  record.seconds_first = seconds.front();
  seconds.erase(seconds.begin());
  record.memory = operator_memory(ceed, bakeoff.op());
  record.compulsory_memory = bakeoff.work().held_bytes;
  std::ranges::sort(seconds);
  record.repetitions = repetitions;
  record.seconds_best = seconds.front();
  record.seconds_median = (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]) / 2;

  const CgResult result = conjugate_gradients(ceed, bakeoff, case_operator.mask(), b, x, cg);
  record.cg_iterations = result.iterations;
  record.cg_converged = result.converged;
  record.cg_seconds = result.seconds;
  if (result.converged) {
    const ErrorSums error = bakeoff.error(x);
    record.error = error.relative_l2();
    record.error_h1 = error.relative_h1();
  }
  return record;
}

}  // namespace hg::bps
