/// @file
/// What backends can do, as the conformance suite found it.
#pragma once

#include <string>
#include <vector>

#include "conformance.hpp"

namespace hg::info {

/// The table capability × backend; with a line for each case where `is_detailed`.
void print_support(const std::vector<Report> &reports, bool is_detailed);
/// One backend: what failed and what was skipped, with messages, and the numbers.
void print_check(const Report &report);

/// Rows of cells in columns that are as wide as needed.
void print_columns(const std::vector<std::vector<std::string>> &rows);

}  // namespace hg::info
