/// @file
/// Bytes as a program that calls the C interface. A first byte chooses what kind:
/// a right operator, whose action and matrices are compared with the oracle of the conformance suite; or a sequence of
/// calls, right and wrong ones, on objects that it makes or that a right operator stands on.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace hg::fuzz {

/// What a program showed to be wrong.
struct Defect : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs the program that the bytes mean; any bytes mean one, and its sizes are bounded. Throws Defect.
void run_graph(std::span<const std::uint8_t> bytes);

/// The backend that a byte chooses: ref, memcheck, or avx in blocks or one element at a time.
const char *backend_of(std::uint8_t byte);

/// Print each call and what it returns, for a look at one program.
extern bool prints_calls;

}  // namespace hg::fuzz
