/// @file
/// The table that bps-kernel prints.
#pragma once

#include <string>
#include <vector>

#include "record.hpp"

namespace hg::bps {

/// Records in the order of their problem, degree and size, backends of the same case next to each other; where there
/// are several, the fastest is marked with a star.
std::string format_table(std::vector<Record> records);

}  // namespace hg::bps
