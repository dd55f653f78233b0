#include "memory_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "child.hpp"
#include "support_table.hpp"

namespace hg::info {

namespace {

using Json = nlohmann::ordered_json;

/// Poisson of degree 2 on a box, with stored data of six numbers a point.
constexpr CeedInt dim = 3, P_1d = 3, Q_1d = 4, cells_1d = 16, num_stored = 6, points_1d = 3;
constexpr CeedInt num_elem = cells_1d * cells_1d * cells_1d, num_nodes = P_1d * P_1d * P_1d,
                  num_qpts = Q_1d * Q_1d * Q_1d, num_points = points_1d * points_1d * points_1d;

void check(int code) {
  if (code == CEED_ERROR_SUCCESS) return;
  const char *message = nullptr;
  CeedGetErrorMessage(nullptr, &message);
  throw std::runtime_error(message != nullptr ? message : "it gave no message");
}

CeedVector filled(Ceed ceed, CeedSize length) {
  CeedVector vec = nullptr;
  check(CeedVectorCreate(ceed, length, &vec));
  check(CeedVectorSetValue(vec, 0.5));
  return vec;
}

CeedElemRestriction at_points(Ceed ceed, CeedInt num_comp) {
  std::vector<CeedInt> offsets;
  for (CeedInt e = 0; e <= num_elem; e++) offsets.push_back(num_elem + 1 + e * num_points);
  for (CeedInt p = 0; p < num_elem * num_points; p++) offsets.push_back(p);
  CeedElemRestriction rstr = nullptr;
  check(CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_elem * num_points, num_comp,
                                          CeedSize{num_elem} * num_points * num_comp, CEED_MEM_HOST, CEED_COPY_VALUES,
                                          offsets.data(), &rstr));
  return rstr;
}

/// The nodes of the box, and its L-vectors' length.
CeedElemRestriction of_nodes(Ceed ceed, CeedSize *l_size) {
  constexpr CeedInt along = cells_1d * (P_1d - 1) + 1;
  std::vector<CeedInt> offsets;
  for (CeedInt e = 0; e < num_elem; e++) {
    const CeedInt cell[dim] = {e % cells_1d, e / cells_1d % cells_1d, e / (cells_1d * cells_1d)};
    for (CeedInt n = 0; n < num_nodes; n++) {
      const CeedInt node[dim] = {n % P_1d, n / P_1d % P_1d, n / (P_1d * P_1d)};
      CeedInt offset = 0;
      for (CeedInt d = dim; d-- > 0;) offset = offset * along + cell[d] * (P_1d - 1) + node[d];
      offsets.push_back(offset);
    }
  }
  *l_size = CeedSize{along} * along * along;
  CeedElemRestriction rstr = nullptr;
  check(CeedElemRestrictionCreate(ceed, num_elem, num_nodes, 1, 1, *l_size, CEED_MEM_HOST, CEED_COPY_VALUES,
                                  offsets.data(), &rstr));
  return rstr;
}

/// For a child process, whose end frees what is made here.
CeedOperatorMemory memory_of(const std::string &resource, bool is_at_points) {
  Ceed ceed = nullptr;
  check(CeedInit(resource.c_str(), &ceed));
  CeedSize l_size = 0;
  const CeedElemRestriction nodes = of_nodes(ceed, &l_size);
  CeedElemRestriction stored = nullptr;
  if (is_at_points) {
    stored = at_points(ceed, num_stored);
  } else {
    check(CeedElemRestrictionCreateStrided(ceed, num_elem, num_qpts, num_stored,
                                           CeedSize{num_elem} * num_qpts * num_stored, CEED_STRIDES_BACKEND, &stored));
  }
  CeedBasis basis = nullptr;
  check(CeedBasisCreateTensorH1Lagrange(ceed, dim, 1, P_1d, Q_1d, CEED_GAUSS, &basis));
  CeedQFunction qf = nullptr;
  check(CeedQFunctionCreateInteriorByName(ceed, "Poisson3DApply", &qf));
  CeedOperator op = nullptr;
  check((is_at_points ? CeedOperatorCreateAtPoints : CeedOperatorCreate)(ceed, qf, CEED_QFUNCTION_NONE,
                                                                         CEED_QFUNCTION_NONE, &op));
  const CeedSize num_data = CeedSize{num_elem} * (is_at_points ? num_points : num_qpts) * num_stored;
  check(CeedOperatorSetField(op, "du", nodes, basis, CEED_VECTOR_ACTIVE));
  check(CeedOperatorSetField(op, "qdata", stored, CEED_BASIS_NONE, filled(ceed, num_data)));
  check(CeedOperatorSetField(op, "dv", nodes, basis, CEED_VECTOR_ACTIVE));
  if (is_at_points) {
    check(CeedOperatorAtPointsSetPoints(op, at_points(ceed, dim), filled(ceed, CeedSize{num_elem} * num_points * dim)));
  }
  // What a backend makes for the first application counts, too.
  check(CeedOperatorApply(op, filled(ceed, l_size), filled(ceed, l_size), CEED_REQUEST_IMMEDIATE));
  CeedOperatorMemory memory{};
  check(CeedOperatorGetMemory(op, &memory));
  return memory;
}

Json parts_of(const CeedOperatorMemory &memory) {
  return {{"program", memory.program}, {"restrictions", memory.restrictions}, {"bases", memory.bases},
          {"vectors", memory.vectors}, {"assembly", memory.assembly},         {"backend", memory.backend},
          {"total", memory.total}};
}

OperatorBytes measure(const std::string &resource, bool is_at_points) {
  OperatorBytes bytes{.resource = resource, .what = {}, .error = {}};
  const CeedInt count = is_at_points ? num_points : num_qpts;
  bytes.what = fmt::format("Poisson, degree {}, {} hexahedra, {} {} each", P_1d - 1, num_elem, count,
                           is_at_points ? "points" : "quadrature points");
  // At points: their places and coordinates.
  const CeedSize of_point =
      num_stored * sizeof(CeedScalar) + (is_at_points ? sizeof(CeedInt) + dim * sizeof(CeedScalar) : 0);
  bytes.compulsory = num_elem * (num_nodes * static_cast<CeedSize>(sizeof(CeedInt)) + count * of_point);
  const Ended ended = in_child([&] {
    ::setenv("CEED_ERROR_HANDLER", "store", 1);
    try {
      return parts_of(memory_of(resource, is_at_points)).dump();
    } catch (const std::exception &error) {
      return std::string("!") + error.what();
    }
  });
  const Json found = ended.is_fine() ? Json::parse(ended.printed, nullptr, false) : Json();
  if (found.is_object()) {
    bytes.memory = {found["program"],  found["restrictions"], found["bases"], found["vectors"],
                    found["assembly"], found["backend"],      found["total"]};
  } else if (ended.signal != 0) {
    bytes.error = "it ended the process by " + name_of_signal(ended.signal);
  } else {
    bytes.error = ended.printed.starts_with('!') ? ended.printed.substr(1) : "it ended the process";
  }
  return bytes;
}

}  // namespace

std::vector<OperatorBytes> measure_memory(const std::string &resource) {
  return {measure(resource, false), measure(resource, true)};
}

void print_memory(const std::vector<OperatorBytes> &operators) {
  std::vector<std::string> seen;
  for (const OperatorBytes &first : operators) {
    if (std::find(seen.begin(), seen.end(), first.what) != seen.end()) continue;
    fmt::print("{}{}; kB beside input and output\n", seen.empty() ? "" : "\n", first.what);
    seen.push_back(first.what);
    std::vector<std::vector<std::string>> rows{
        {"", "restrictions", "bases", "vectors", "backend", "all", "of compulsory"}};
    for (const OperatorBytes &one : operators) {
      if (one.what != first.what) continue;
      rows.push_back({one.resource});
      if (!one.error.empty()) {
        rows.back().push_back(one.error);
        continue;
      }
      const CeedOperatorMemory &m = one.memory;
      for (const CeedSize part : {m.restrictions, m.bases, m.vectors, m.backend, m.total}) {
        rows.back().push_back(fmt::format("{:.1f}", part / 1e3));
      }
      rows.back().push_back(fmt::format("{:.3f}", static_cast<double>(m.total) / one.compulsory));
    }
    print_columns(rows);
  }
}

Json to_json(const OperatorBytes &bytes) {
  Json json = {{"resource", bytes.resource}, {"operator", bytes.what}, {"compulsory", bytes.compulsory}};
  if (bytes.error.empty()) {
    json["memory"] = parts_of(bytes.memory);
  } else {
    json["error"] = bytes.error;
  }
  return json;
}

}  // namespace hg::info
