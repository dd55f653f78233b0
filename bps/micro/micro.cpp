/// @file
/// bps-micro: times the kernels of backends/host, for every instruction set of this machine or for the one that
/// CEED_HOST_ISA names. Options and output are Google Benchmark's (--help); counters beside its own:
///   flops_per_second, bytes_per_second: of the floor's arithmetic, and of each array read and written once
///   floor: the time of the kernel's floor at the rates of this core, over the time taken
/// The rates are measured when the program starts, and stand in the JSON's context.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

#include "cases.hpp"
#include "peaks.hpp"

namespace {

using namespace hg::micro;

void time_case(benchmark::State &state, const Case &one, double flops, double floor) {
  const auto call = one.prepare();
  for (auto _ : state) {
    call();
    benchmark::ClobberMemory();
  }
  const auto each_second = benchmark::Counter::kIsIterationInvariantRate;
  if (flops > 0) state.counters["flops_per_second"] = {flops, each_second};
  state.counters["bytes_per_second"] = {one.work.bytes, each_second};
  state.counters["floor"] = {floor, each_second};
}

void add_to_context(const std::string &isa, const char *what, double rate) {
  char number[32];
  std::snprintf(number, sizeof number, "%.4g", rate);
  benchmark::AddCustomContext(isa + "_" + what + "_per_second", number);
}

void register_all() {
  for (const InstructionSet &set : instruction_sets()) {
    const Peaks peaks = measure_peaks(set);
    add_to_context(set.name, "fmas", peaks.fmas);
    add_to_context(set.name, "loads", peaks.loads);
    add_to_context(set.name, "stores", peaks.stores);
    add_to_context(set.name, "number_loads", peaks.number_loads);
    add_to_context(set.name, "number_stores", peaks.number_stores);
    for (const Case &one : cases(set)) {
      benchmark::RegisterBenchmark(one.name.c_str(), time_case, one, one.work.flops(set),
                                   floor_seconds(one.work, peaks));
    }
  }
}

}  // namespace

int main(int argc, char **argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    register_all();
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bps-micro: %s\n", error.what());
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
