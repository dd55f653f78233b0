// The rate of copies between two vectors where a backend keeps them: the ceiling of operators that stream their data.
#include <ceed.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
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

}  // namespace

int main(int argc, char **argv) {
  if (argc != 2 && !(argc == 4 && std::strcmp(argv[2], "--json") == 0)) {
    std::fprintf(
        stderr,
        "usage: device-bandwidth RESOURCE [--json FILE]\n"
        "The best rate of 10 times 10 copies of 2^26 numbers (the emulator: 2^16), reads and writes counted.\n");
    return 2;
  }
  const std::string resource = argv[1];
  const CeedSize length = resource.rfind("/gpu/emu", 0) == 0 ? 1 << 16 : 1 << 26;
  constexpr int batch = 10;
  Ceed ceed = nullptr;
  CeedVector from = nullptr, to = nullptr, last = nullptr;
  ok(CeedInit(resource.c_str(), &ceed));
  ok(CeedVectorCreate(ceed, length, &from));
  ok(CeedVectorCreate(ceed, length, &to));
  ok(CeedVectorCreate(ceed, 1, &last));
  ok(CeedVectorSetValue(from, 1.0));
  ok(CeedVectorSetValue(to, 2.0));
  std::vector<double> seconds;
  for (int i = 0; i < 11; i++) {
    const double start = now();
    for (int j = 0; j < batch; j++) ok(CeedVectorCopy(from, to));
    // A norm comes after all that was asked for before, and waits.
    CeedScalar norm = 0;
    ok(CeedVectorSetValue(last, 1.0));
    ok(CeedVectorNorm(last, CEED_NORM_2, &norm));
    if (i > 0) seconds.push_back((now() - start) / batch);
  }
  const double best = *std::min_element(seconds.begin(), seconds.end());
  const double rate = 2.0 * static_cast<double>(length) * sizeof(CeedScalar) / best / 1e9;
  std::printf("%s: %.1f GB/s\n", resource.c_str(), rate);
  int status = 0;
  if (argc == 4) {
    std::FILE *file = std::fopen(argv[3], "w");
    if (file == nullptr ||
        std::fprintf(file, "{\"ceed\": \"%s\", \"length\": %td, \"seconds\": %.9g, \"gb_per_s\": %.6g}\n",
                     resource.c_str(), length, best, rate) < 0) {
      std::fprintf(stderr, "device-bandwidth: '%s' cannot be written\n", argv[3]);
      status = 1;
    }
    if (file != nullptr) std::fclose(file);
  }
  ok(CeedVectorDestroy(&from));
  ok(CeedVectorDestroy(&to));
  ok(CeedVectorDestroy(&last));
  ok(CeedDestroy(&ceed));
  return status;
}
