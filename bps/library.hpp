/// @file
/// The library that this process found: its version, its file, its backends.
#pragma once

#include <ceed/backend.h>

#include <optional>
#include <string>
#include <vector>

namespace hg::bps {

/// `major.minor.patch`, followed by the source revision where the library knows it.
std::string library_version();

/// Every resource in the library's registry, in its order.
std::vector<std::string> registered_resources();

/// The resources among registered_resources() that initialise on this machine, each once, and are there for work: neither
/// memcheck nor the emulator.
std::vector<std::string> usable_resources();

/// The bytes that an operator works with, where the library counts them: it is looked for by its name, so that these
/// programs run with libraries that do not have CeedOperatorGetMemory().
std::optional<CeedOperatorMemory> operator_memory(Ceed ceed, CeedOperator op);

}  // namespace hg::bps
