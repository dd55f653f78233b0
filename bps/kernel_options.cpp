#include "kernel_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "ceed_handles.hpp"
#include "library.hpp"
#include "number_list.hpp"

namespace hg::bps {

namespace {

constexpr CeedInt max_degree = 8;

std::vector<Problem> parse_problems(const std::vector<std::string> &texts) {
  std::vector<Problem> problems;
  for (const auto &text : texts)
    for (const auto &part : split(text)) {
      if (part == "all") {
        problems.insert(problems.end(), all_problems().begin(), all_problems().end());
      } else if (const Problem *problem = find_problem(part)) {
        problems.push_back(*problem);
      } else {
        throw Error(fmt::format("--problem {}: unknown; known are bp1, bp2, bp3, bp4, bp5, bp6 and all", part));
      }
    }
  return problems;
}

std::vector<std::optional<Placement>> parse_placements(const std::string &text) {
  std::vector<std::optional<Placement>> placements;
  for (const auto &part : split(text)) {
    if (part == "all") {
      placements.insert(placements.end(), {Placement::uniform, Placement::gauss, Placement::random});
    } else if (part == "none") {
      placements.push_back({});
    } else if (const auto placement = find_placement(part)) {
      placements.push_back(*placement);
    } else {
      throw Error(
          fmt::format("--placement {}: unknown; known are none, uniform, gauss, random, quadrature and all", part));
    }
  }
  return placements;
}

std::vector<std::string> resolve_resources(const std::vector<std::string> &requested) {
  std::vector<std::string> resources;
  for (const auto &name : requested) {
    if (name != "all") {
      resources.push_back(name);
      continue;
    }
    for (auto &usable : usable_resources()) resources.push_back(std::move(usable));
  }
  if (resources.empty()) throw Error("--ceed all: no backend of this library works on this machine");
  return resources;
}

}  // namespace

ParsedOptions parse_options(int argc, const char *const *argv) {
  CLI::App app{
      "The CEED bake-off problems BP1 to BP6 on a deformed box, at quadrature points or at material points:\n"
      "times the operator and conjugate gradients on any backend of the library that this program finds."};
  std::vector<std::string> resources{"/cpu/self"}, problems{"bp3"};
  std::string degree = "1-4", dofs = "1e5", points, placement, json, dot = "auto";
  KernelOptions options;
  app.add_option("--ceed", resources,
                 "backend resource; repeat for several, `all` for every one that works here, but checkers")
      ->capture_default_str();
  app.add_option("--problem", problems, "bp1 ... bp6 or all; several by commas or by repeating")->capture_default_str();
  app.add_option("--degree", degree, "polynomial degrees, such as 1,2,3 or 1-8")->capture_default_str();
  app.add_option("--dofs", dofs, "numbers of degrees of freedom, met as nearly as a box allows")->capture_default_str();
  app.add_option("--points", points,
                 "material points in each cell, such as 27 or 8,27,64 (default: quadrature points)");
  app.add_option("--placement", placement,
                 "where material points lie: uniform, gauss, random (in each cell, fixed seed), all of these;\n"
                 "quadrature: the quadrature points themselves, --points is not needed;\n"
                 "none: no material points; several by commas (default: none, with --points uniform)");
  app.add_option("--json", json, "write one record for each run to this file");
  app.add_option("--reps", options.repetitions, "timed applications of each operator")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  app.add_option("--cg-iterations", options.cg.max_iterations,
                 "most CG iterations of a timed run; the error is\n"
                 "reported if CG converges within them")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  app.add_option("--cg-tolerance", options.cg.relative_tolerance, "relative residual at which CG has converged")
      ->capture_default_str()
      ->check(CLI::Range(0., 1.));
  app.add_option("--cg-dot", dot,
                 "dot products of CG: `host` sums arrays, `norms` keeps vectors on the device, `auto` as the backend\n"
                 "prefers")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "host", "norms"}));
  app.add_flag("--check", options.check,
               "test instead of time: CG converges, errors fall at the optimal rate on two meshes, and points at the\n"
               "quadrature points reproduce the operator at quadrature points to 1e-12; exit code 1 if any fails");
  app.add_flag("--quiet", options.quiet, "no progress on standard error");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return {{}, app.exit(error) == 0 ? 0 : 2};
  }

  options.problems = parse_problems(problems);
  options.degrees = parse_integers("--degree", degree, 1, max_degree);
  options.dofs = parse_reals("--dofs", dofs, 8, 2e9);
  if (!points.empty()) options.points = parse_integers("--points", points, 1, 1000000);
  if (!placement.empty()) options.placements = parse_placements(placement);
  if (!options.points.empty() && options.placements.empty()) options.placements.push_back(Placement::uniform);
  const auto needs_count = [](std::optional<Placement> p) { return p && p != Placement::quadrature; };
  if (!options.check && options.points.empty() && std::ranges::any_of(options.placements, needs_count))
    throw Error(fmt::format("--placement {}: needs the number of points in each cell, --points N", placement));
  for (const auto &placement : options.placements)
    for (const CeedInt per_cell : options.points)
      if (placement) require_point_count(*placement, per_cell);
  options.cg.dot = dot == "host" ? Dot::on_host : dot == "norms" ? Dot::by_norms : Dot::preferred;
  if (!json.empty()) options.json = json;
  options.resources = resolve_resources(resources);
  return {options, 0};
}

}  // namespace hg::bps
