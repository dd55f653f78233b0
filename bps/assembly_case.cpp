#include "assembly_case.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "clock.hpp"
#include "library.hpp"
#include "record.hpp"

namespace hg::bps {

namespace {

CeedSize num_entries(Ceed ceed, CeedOperator op) {
  CeedSize count = 0;
  check(ceed, CeedOperatorLinearAssembleGetNumEntries(op, &count));
  return count;
}

/// One kind of assembly of one operator, into memory that it keeps.
class Assembly {
 public:
  Assembly(Ceed ceed, const Bakeoff &bakeoff, const Problem &problem, const std::string &kind)
      : ceed_(ceed), op_(bakeoff.op()), kind_(kind) {
    if (kind == "diagonal") values_ = make_vector(ceed, bakeoff.num_dofs());
    if (kind == "point blocks") values_ = make_vector(ceed, bakeoff.num_dofs() * problem.num_comp);
    if (kind == "matrix") values_ = make_vector(ceed, num_entries(ceed, op_));
  }

  /// Returns the error code of the library.
  int run() {
    if (kind_ == "diagonal") return CeedOperatorLinearAssembleDiagonal(op_, values_, CEED_REQUEST_IMMEDIATE);
    if (kind_ == "point blocks")
      return CeedOperatorLinearAssemblePointBlockDiagonal(op_, values_, CEED_REQUEST_IMMEDIATE);
    if (kind_ == "matrix") return CeedOperatorLinearAssemble(op_, values_);
    // Into the same vector each time.
    return CeedOperatorLinearAssembleQFunctionBuildOrUpdate(op_, values_.address(), restriction_.address(),
                                                            CEED_REQUEST_IMMEDIATE);
  }

  /// Runs once, and waits until the device, if there is one, is done.
  int run_to_end() {
    const int code = run();
    CeedMemType mem_type = CEED_MEM_HOST;
    check(ceed_, CeedGetPreferredMemType(ceed_, &mem_type));
    CeedScalar norm = 0;
    if (code == CEED_ERROR_SUCCESS && values_ && mem_type == CEED_MEM_DEVICE) {
      check(ceed_, CeedVectorNorm(values_, CEED_NORM_MAX, &norm));
    }
    return code;
  }

 private:
  Ceed ceed_;
  CeedOperator op_;
  std::string kind_;
  Vector values_;
  Restriction restriction_;  ///< of the assembled QFunction
};

double time_once(Ceed ceed, Assembly &assembly) {
  const double start = now();
  check(ceed, assembly.run_to_end());
  return now() - start;
}

}  // namespace

AssemblyRecord time_assembly(Ceed ceed, const Problem &problem, CeedInt degree, CeedInt num_cells_1d, int repetitions) {
  const BoxMesh mesh({num_cells_1d, num_cells_1d, num_cells_1d}, degree, problem.num_comp);
  const Cells cells = mesh.cells();
  const Bakeoff at_quadrature(ceed, problem, degree, cells),
      at_points(ceed, problem, degree, cells, place_points(cells, problem, degree, Placement::quadrature, 0));
  AssemblyRecord record;
  record.problem = problem.name;
  record.ceed = resource_name(ceed);
  record.degree = degree;
  record.q_1d = problem.q_1d(degree);
  record.repetitions = repetitions;
  record.elements = at_quadrature.num_elem();
  record.dofs = at_quadrature.num_dofs();
  record.points_per_cell = at_points.num_points() / at_points.num_elem();
  record.cpu = cpu_name();
  record.library_version = library_version();
  for (const char *kind : {"qfunction", "diagonal", "point blocks", "matrix"}) {
    Assembly quadrature(ceed, at_quadrature, problem, kind), points(ceed, at_points, problem, kind);
    check(ceed, quadrature.run_to_end());
    const bool is_refused = points.run_to_end() == CEED_ERROR_UNSUPPORTED;
    AssemblyTimes times{kind, std::numeric_limits<double>::infinity(), {}};
    double best_at_points = times.at_quadrature;
    for (int i = 0; i < repetitions; i++) {
      times.at_quadrature = std::min(times.at_quadrature, time_once(ceed, quadrature));
      if (!is_refused) best_at_points = std::min(best_at_points, time_once(ceed, points));
    }
    times.at_quadrature /= record.elements;
    if (!is_refused) times.at_points = best_at_points / record.elements;
    record.kinds.push_back(times);
  }
  return record;
}

void to_json(nlohmann::ordered_json &json, const AssemblyRecord &r) {
  json = {
      {"program", "bps-assembly"},
      {"problem", r.problem},
      {"ceed", r.ceed},
      {"degree", r.degree},
      {"q_1d", r.q_1d},
      {"elements", r.elements},
      {"dofs", r.dofs},
      {"points_per_cell", r.points_per_cell},
      {"repetitions", r.repetitions},
      {"assembly", nlohmann::ordered_json::array()},
      {"cpu", r.cpu},
      {"library_version", r.library_version},
  };
  for (const AssemblyTimes &times : r.kinds) {
    nlohmann::ordered_json entry = {{"kind", times.kind},
                                    {"seconds_per_element", {{"quadrature", times.at_quadrature}, {"points", nullptr}}},
                                    {"ratio", nullptr}};
    if (times.at_points) {
      entry["seconds_per_element"]["points"] = *times.at_points;
      entry["ratio"] = times.ratio();
    }
    json["assembly"].push_back(entry);
  }
}

}  // namespace hg::bps
