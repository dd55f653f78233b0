#include "kernel_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

namespace hg::bps {

namespace {

auto case_of(const Record &r) {
  return std::tuple(r.problem, r.placement, r.points_per_cell, r.degree, r.dofs);
}

}  // namespace

std::string format_table(std::vector<Record> records) {
  if (records.empty()) return {};
  const auto by_case = [](const Record &a, const Record &b) { return case_of(a) < case_of(b); };
  std::ranges::stable_sort(records, by_case);
  std::size_t width = 4;
  for (const Record &r : records) width = std::max(width, r.ceed.size());

  std::string table =
      fmt::format("{:4} {:>2} {:>3} {:>9} {:>9} {:13}  {:<{}}  {:>10} {:>8} {:>8} {:>6} {:>7} {:>5} {:>9} {:>8}\n", "",
                  "p", "q1d", "DoFs", "points", "placement", "ceed", width, "s/apply", "MDoF/s", "Mpoint/s", "GB/s",
                  "GFLOP/s", "CG it", "CG MDoF/s", "error");
  for (auto group = records.begin(); group != records.end();) {
    const auto end = std::upper_bound(group, records.end(), *group, by_case);
    const auto fastest =
        std::min_element(group, end, [](const Record &a, const Record &b) { return a.seconds_best < b.seconds_best; });
    for (auto r = group; r != end; ++r) {
      const std::string placement =
          r->placement ? fmt::format("{} {}", *r->placement, *r->points_per_cell) : std::string("-");
      table += fmt::format(
          "{:4} {:>2} {:>3} {:>9} {:>9} {:13}  {:<{}}  {:>10.3e} {:>7.2f}{} {:>8.2f} {:>6.2f} {:>7.2f} {:>5} {:>9.2f} "
          "{:>8}\n",
          r->problem, r->degree, r->q_1d, r->dofs, r->points, placement, r->ceed, width, r->seconds_best,
          r->mdofs_per_s(), r == fastest && end - group > 1 ? '*' : ' ', r->mpoints_per_s(), r->gb_per_s(),
          r->gflops_per_s(), r->cg_iterations, r->cg_mdofs_per_s(), r->error ? fmt::format("{:.1e}", *r->error) : "-");
    }
    group = end;
  }
  return table;
}

}  // namespace hg::bps
