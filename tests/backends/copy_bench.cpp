// Speed of an operator whose fields are all at material points, as an update of materials has them, beside a loop over
// the same arrays; prints one JSON record for each resource, best of ten.
//   copy-bench RESOURCE ... [-cells N]      27 points in each of N cells (30000)
// Floor: 216 bytes a point, nine numbers each of two fields that are read and of one that is written.
#include <ceed.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "combine.h"
#include "support/handles.hpp"

namespace {
using namespace hg::test;

constexpr CeedInt points_per_cell = 27, num_comp = 9;

void chk(int code) {
  if (code != CEED_ERROR_SUCCESS) throw std::runtime_error("the library returned " + std::to_string(code));
}

template <typename Work>
double best_seconds(Work &&work) {
  double best = std::numeric_limits<double>::max();
  for (int rep = 0; rep < 10; rep++) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

Vector filled(Ceed ceed, CeedSize length, CeedScalar value) {
  Vector vector;
  chk(CeedVectorCreate(ceed, length, vector.out()));
  chk(CeedVectorSetValue(vector, value));
  return vector;
}

/// Where points lie in lists of their own: those of a cell after those of the cell before.
Restriction at_points(Ceed ceed, CeedInt num_cells, CeedInt components) {
  const CeedInt num_points = num_cells * points_per_cell;
  std::vector<CeedInt> offsets(num_cells + 1 + num_points);
  for (CeedInt cell = 0; cell <= num_cells; cell++) offsets[cell] = num_cells + 1 + cell * points_per_cell;
  std::iota(offsets.begin() + num_cells + 1, offsets.end(), 0);
  Restriction made;
  chk(CeedElemRestrictionCreateAtPoints(ceed, num_cells, num_points, components,
                                        static_cast<CeedSize>(num_points) * components, CEED_MEM_HOST, CEED_COPY_VALUES,
                                        offsets.data(), made.out()));
  return made;
}

void measure(const std::string &resource, CeedInt num_cells) {
  CeedHandle ceed;
  chk(CeedInit(resource.c_str(), ceed.out()));
  const char *name = nullptr;
  chk(CeedGetResource(ceed, &name));
  const CeedSize num_points = static_cast<CeedSize>(num_cells) * points_per_cell, length = num_points * num_comp;
  const Restriction rstr = at_points(ceed, num_cells, num_comp), rstr_x = at_points(ceed, num_cells, 3);
  const Vector x = filled(ceed, 3 * num_points, 0.1), a = filled(ceed, length, 1.0), b = filled(ceed, length, 2.0),
               o = filled(ceed, length, 0.0);
  QFunction qf;
  chk(CeedQFunctionCreateInterior(ceed, 1, combine, combine_loc, qf.out()));
  chk(CeedQFunctionAddInput(qf, "a", num_comp, CEED_EVAL_NONE));
  chk(CeedQFunctionAddInput(qf, "b", num_comp, CEED_EVAL_NONE));
  chk(CeedQFunctionAddOutput(qf, "o", num_comp, CEED_EVAL_NONE));
  Operator op;
  chk(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  chk(CeedOperatorSetField(op, "a", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  chk(CeedOperatorSetField(op, "b", rstr, CEED_BASIS_NONE, b));
  chk(CeedOperatorSetField(op, "o", rstr, CEED_BASIS_NONE, o));
  chk(CeedOperatorAtPointsSetPoints(op, rstr_x, x));
  const auto apply = [&] { chk(CeedOperatorApply(op, a, CEED_VECTOR_NONE, CEED_REQUEST_IMMEDIATE)); };
  apply();  // what is made once
  const double seconds = best_seconds(apply);

  const CeedScalar *from = nullptr, *half = nullptr;
  CeedScalar *to = nullptr, norm = 0;
  chk(CeedVectorNorm(o, CEED_NORM_MAX, &norm));
  if (norm != 2.0) throw std::runtime_error("the largest entry is " + std::to_string(norm) + ", expected 2");
  chk(CeedVectorGetArrayRead(a, CEED_MEM_HOST, &from));
  chk(CeedVectorGetArrayRead(b, CEED_MEM_HOST, &half));
  chk(CeedVectorGetArray(o, CEED_MEM_HOST, &to));
  const double loop = best_seconds([&] {
    for (CeedSize i = 0; i < length; i++) to[i] = from[i] + 0.5 * half[i];
  });
  chk(CeedVectorRestoreArray(o, &to));
  chk(CeedVectorRestoreArrayRead(b, &half));
  chk(CeedVectorRestoreArrayRead(a, &from));
  const double gigabytes = 3e-9 * sizeof(CeedScalar) * static_cast<double>(length);
  std::printf(
      "{\"program\": \"copy-bench\", \"ceed\": \"%s\", \"points\": %lld, \"mpoints_per_s\": %.1f, \"gb_per_s\": %.2f, "
      "\"loop_gb_per_s\": %.2f}\n",
      name, static_cast<long long>(num_points), 1e-6 * static_cast<double>(num_points) / seconds, gigabytes / seconds,
      gigabytes / loop);
}

}  // namespace

int main(int argc, char **argv) {
  CeedInt num_cells = 30000;
  std::vector<std::string> resources;
  for (int i = 1; i < argc; i++) {
    if (std::string(argv[i]) != "-cells") {
      resources.emplace_back(argv[i]);
    } else if (i + 1 == argc || (num_cells = std::atoi(argv[++i])) < 1 || num_cells > 50000000) {
      std::fprintf(stderr, "copy-bench: -cells wants a number from 1 to 50000000\n");
      return 2;
    }
  }
  if (resources.empty()) {
    std::fprintf(stderr, "usage: copy-bench RESOURCE ... [-cells N]\n");
    return 2;
  }
  try {
    for (const auto &resource : resources) measure(resource, num_cells);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "copy-bench: %s\n", error.what());
    return 1;
  }
}
