/// @file
/// bps-assembly: what it costs to assemble a bake-off problem at points, beside the same at as many quadrature points.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "assembly_case.hpp"
#include "library.hpp"
#include "number_list.hpp"
#include "record.hpp"

namespace {

using namespace hg::bps;

struct Options {
  std::string ceed = "/cpu/self/ref/serial", problem = "bp4", degree = "1-3", json;
  CeedInt cells = 4;
  int repetitions = 5;
  double at_most = 0;
};

void add_options(CLI::App &app, Options &options) {
  app.add_option("--ceed", options.ceed, "backend resource")->capture_default_str();
  app.add_option("--problem", options.problem, "bp1 ... bp6")->capture_default_str();
  app.add_option("--degree", options.degree, "polynomial degrees, such as 1,2,3 or 1-4")->capture_default_str();
  app.add_option("--cells", options.cells, "cells a direction")->capture_default_str()->check(CLI::Range(1, 100));
  app.add_option("--reps", options.repetitions, "timed assemblies of each kind, of which the best counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  app.add_option("--json", options.json, "write one record for each degree to this file");
  app.add_option("--at-most", options.at_most,
                 "exit code 1 if a diagonal or matrix at points takes more than this many times what it takes at "
                 "quadrature points");
}

void print(const AssemblyRecord &record) {
  for (const AssemblyTimes &times : record.kinds) {
    fmt::print("{:4} p={} {:>4} points a cell  {:12}  {:10.3f} us at quadrature points  ", record.problem,
               record.degree, record.points_per_cell, times.kind, 1e6 * times.at_quadrature);
    if (times.at_points) {
      fmt::print("{:10.3f} us at points  ratio {:.2f}\n", 1e6 * *times.at_points, times.ratio());
    } else {
      fmt::print("refused at points\n");
    }
  }
}

bool is_within(const AssemblyRecord &record, double at_most) {
  for (const AssemblyTimes &times : record.kinds) {
    const bool counts = times.kind == "diagonal" || times.kind == "matrix";
    if (counts && !(times.at_points && times.ratio() <= at_most)) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char **argv) {
  CLI::App app{
      "Times the assembly of a bake-off problem, in microseconds for each element: the QFunction, the diagonal, the\n"
      "point blocks of the diagonal, and all entries; at quadrature points, and at material points that lie there."};
  Options options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const Problem *problem = find_problem(options.problem);
    if (problem == nullptr) throw Error(fmt::format("--problem {}: unknown; known are bp1 to bp6", options.problem));
    const Context ceed = open_ceed(options.ceed);
    nlohmann::ordered_json records = nlohmann::ordered_json::array();
    bool is_good = true;
    fmt::print("{}, libceed {}, {}, best of {}\n", resource_name(ceed), library_version(), cpu_name(),
               options.repetitions);
    for (const CeedInt degree : parse_integers("--degree", options.degree, 1, 8)) {
      const AssemblyRecord record = time_assembly(ceed, *problem, degree, options.cells, options.repetitions);
      print(record);
      std::fflush(stdout);
      records.push_back(record);
      if (options.at_most > 0) is_good = is_within(record, options.at_most) && is_good;
      if (!options.json.empty()) write_json(options.json, records);
    }
    return is_good ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "bps-assembly: {}\n", error.what());
    return 2;
  }
}
