// The rate of copies where a backend keeps its vectors, the ceiling of operators that stream their data; and what an
// operator reaches that only copies what is stored at points, as material updates do.
#include <ceed.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace {

void ok(int code) {
  if (code == CEED_ERROR_SUCCESS) return;
  std::fprintf(stderr, "device-bandwidth: error %d\n", code);
  std::exit(1);
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds of one call of f: the best of ten times ten, after ten that are not counted.
template <typename F>
double best_seconds(Ceed ceed, F &&f) {
  constexpr int batch = 10, turns = 11;
  CeedVector last = nullptr;
  ok(CeedVectorCreate(ceed, 1, &last));
  double best = std::numeric_limits<double>::max();
  for (int i = 0; i < turns; i++) {
    const double start = now();
    for (int j = 0; j < batch; j++) f();
    // A norm comes after all that was asked for before, and waits.
    CeedScalar norm = 0;
    ok(CeedVectorSetValue(last, 1.0));
    ok(CeedVectorNorm(last, CEED_NORM_2, &norm));
    if (i > 0) best = std::min(best, (now() - start) / batch);
  }
  ok(CeedVectorDestroy(&last));
  return best;
}

double seconds_of_copies(Ceed ceed, CeedSize length) {
  CeedVector from = nullptr, to = nullptr;
  ok(CeedVectorCreate(ceed, length, &from));
  ok(CeedVectorCreate(ceed, length, &to));
  ok(CeedVectorSetValue(from, 1.0));
  ok(CeedVectorSetValue(to, 2.0));
  const double seconds = best_seconds(ceed, [&] { ok(CeedVectorCopy(from, to)); });
  ok(CeedVectorDestroy(&from));
  ok(CeedVectorDestroy(&to));
  return seconds;
}

/// v = u, `size` numbers at each of 27 points in a cell.
double seconds_at_points(Ceed ceed, CeedInt num_cells, CeedInt size) {
  constexpr CeedInt of_cell = 27;
  const CeedInt num_points = num_cells * of_cell;
  std::vector<CeedInt> ids(num_cells + 1 + num_points);
  for (CeedInt e = 0; e <= num_cells; e++) ids[e] = num_cells + 1 + e * of_cell;
  std::iota(ids.begin() + num_cells + 1, ids.end(), 0);
  const auto stored = [&](CeedInt count, CeedElemRestriction *rstr, CeedVector *vec) {
    const CeedSize length = static_cast<CeedSize>(num_points) * count;
    ok(CeedElemRestrictionCreateAtPoints(ceed, num_cells, num_points, count, length, CEED_MEM_HOST, CEED_USE_POINTER,
                                         ids.data(), rstr));
    ok(CeedVectorCreate(ceed, length, vec));
    ok(CeedVectorSetValue(*vec, 0.5));
  };
  CeedElemRestriction rstr = nullptr, rstr_x = nullptr, rstr_v = nullptr;
  CeedVector u = nullptr, v = nullptr, x = nullptr;
  stored(size, &rstr, &u);
  stored(size, &rstr_v, &v);
  stored(3, &rstr_x, &x);
  CeedQFunction qf = nullptr;
  CeedOperator op = nullptr;
  ok(CeedQFunctionCreateIdentity(ceed, size, CEED_EVAL_NONE, CEED_EVAL_NONE, &qf));
  ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op));
  ok(CeedOperatorSetField(op, "input", rstr, CEED_BASIS_NONE, u));
  ok(CeedOperatorSetField(op, "output", rstr_v, CEED_BASIS_NONE, v));
  ok(CeedOperatorAtPointsSetPoints(op, rstr_x, x));
  const double seconds = best_seconds(
      ceed, [&] { ok(CeedOperatorApply(op, CEED_VECTOR_NONE, CEED_VECTOR_NONE, CEED_REQUEST_IMMEDIATE)); });
  ok(CeedOperatorDestroy(&op));
  ok(CeedQFunctionDestroy(&qf));
  for (CeedVector *vec : {&u, &v, &x}) ok(CeedVectorDestroy(vec));
  for (CeedElemRestriction *one : {&rstr, &rstr_v, &rstr_x}) ok(CeedElemRestrictionDestroy(one));
  return seconds;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 2 && !(argc == 4 && std::strcmp(argv[2], "--json") == 0)) {
    std::fprintf(
        stderr,
        "usage: device-bandwidth RESOURCE [--json FILE]\n"
        "The best rate of 10 times 10 copies of 2^26 numbers (the emulator: 2^16), reads and writes counted;\n"
        "and of an operator that copies 9 numbers at each of 4.2 million points (4320), with 4 bytes more for\n"
        "each of these.\n");
    return 2;
  }
  const std::string resource = argv[1];
  const bool is_emulator = resource.rfind("/gpu/emu", 0) == 0;
  const CeedSize length = is_emulator ? 1 << 16 : 1 << 26;
  const CeedInt num_cells = is_emulator ? 160 : 155000, num_points = num_cells * 27, size = 9;
  Ceed ceed = nullptr;
  ok(CeedInit(resource.c_str(), &ceed));
  const double copies = seconds_of_copies(ceed, length), at_points = seconds_at_points(ceed, num_cells, size);
  const double rate = 2.0 * static_cast<double>(length) * sizeof(CeedScalar) / copies / 1e9;
  const double rate_at_points = num_points * (2.0 * size * sizeof(CeedScalar) + sizeof(CeedInt)) / at_points / 1e9;
  std::printf("%s: %.1f GB/s; at points %.1f GB/s\n", resource.c_str(), rate, rate_at_points);
  int status = 0;
  if (argc == 4) {
    std::FILE *file = std::fopen(argv[3], "w");
    if (file == nullptr ||
        std::fprintf(file,
                     "{\"ceed\": \"%s\", \"length\": %td, \"seconds\": %.9g, \"gb_per_s\": %.6g,\n"
                     " \"points\": {\"num_points\": %d, \"size\": %d, \"seconds\": %.9g, \"gb_per_s\": %.6g}}\n",
                     resource.c_str(), length, copies, rate, num_points, size, at_points, rate_at_points) < 0) {
      std::fprintf(stderr, "device-bandwidth: '%s' cannot be written\n", argv[3]);
      status = 1;
    }
    if (file != nullptr) std::fclose(file);
  }
  ok(CeedDestroy(&ceed));
  return status;
}
