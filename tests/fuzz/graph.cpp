#include "graph.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>

#include "objects.hpp"

namespace hg::fuzz {

bool prints_calls = false;

using namespace hg::test;

namespace {

constexpr int max_calls = 48;

/// Runs one call. Returns whether it succeeded and may have changed something.
bool run_call(Objects &objects) {
  const std::span<const Call> rooms[] = {ceed_calls(),      vector_calls(),  restriction_calls(), basis_calls(),
                                         qfunction_calls(), context_calls(), operator_calls(),    assembly_calls()};
  const std::span<const Call> room = rooms[objects.bytes.next_byte() % std::size(rooms)];
  const Call &call = room[objects.bytes.next_byte() % room.size()];
  if (prints_calls) std::fprintf(stderr, "%s ...\n", call.name);
  objects.took_nothing = false;
  forget_reports();
  const int code = call.run(objects);
  if (prints_calls) std::fprintf(stderr, "%s: %d %s\n", call.name, code, last_report().message.c_str());
  if (code == CEED_ERROR_SUCCESS) return call.changes;
  const std::string what = std::string(call.name) + " returned " + std::to_string(code);
  if (code < CEED_ERROR_UNSUPPORTED || code > CEED_ERROR_ACCESS) throw Defect(what + ", which is no error code");
  if (!objects.took_nothing && num_reports() == 0) throw Defect(what + " and told no handler");
  // What refuses a part of a call may have a positive code, and end the whole with a negative one: it is half done.
  if (!objects.took_nothing && last_report().code != code && code > 0)
    throw Defect(what + "; the handler was told another code");
  if (num_reports() > 0 && last_report().message.empty()) throw Defect(what + " without a message");
  // Negative: the object is not to be used any more.
  return code < 0 && call.changes;
}

/// Calls on nothing but what they make.
void run_calls(Random &bytes) {
  Objects objects(bytes);
  for (int i = 0; i < max_calls && bytes.has_bytes(); i++) run_call(objects);
  objects.end();
}

/// Calls on a right operator, which stays right while none of them has changed it.
void run_calls_on_operator(Random &bytes) {
  const Case c = small_case(bytes);
  const CeedHandle ceed(open(backend_of(bytes.next_byte())));
  const auto instance = std::make_unique<Instance>(ceed, c);
  Objects objects(bytes);
  objects.take_in(*instance);
  bool is_changed = false;
  for (int i = 0; i < max_calls && bytes.has_bytes(); i++) is_changed = run_call(objects) || is_changed;
  objects.end();
  if (!is_changed) expect_action(*instance, c);
}

}  // namespace

const char *backend_of(std::uint8_t byte) {
  static const char *const resources[] = {"/cpu/self/ref/serial", "/cpu/self/memcheck/serial", "/cpu/self/avx/blocked",
                                          "/cpu/self/avx/serial"};
  return resources[byte % std::size(resources)];
}

void run_graph(std::span<const std::uint8_t> data) {
  testing::FLAGS_gtest_throw_on_failure = true;
  Random bytes(data);
  try {
    switch (bytes.next_byte() % 8) {
      case 0:
      case 1:
        return run_right(bytes);
      case 2:
        return run_assembled(bytes);
      case 3:
      case 4:
      case 5:
        return run_calls_on_operator(bytes);
      default:
        return run_calls(bytes);
    }
  } catch (const Defect &) {
    throw;
  } catch (const std::exception &error) {  // a right call failed
    throw Defect(error.what());
  }
}

}  // namespace hg::fuzz

/// Short stacks of allocations, found the fast way: whole ones take ten times as long as the programs.
extern "C" __attribute__((visibility("default"))) const char *__asan_default_options() {
  return "malloc_context_size=8:quarantine_size_mb=32:allocator_may_return_null=1:strict_string_checks=1";
}
