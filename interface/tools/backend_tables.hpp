/// @file
/// The tables of a backend, by the names of their entries.
#pragma once

#include <ceed/plugin.h>

#include <string>
#include <vector>

namespace hg::info {

/// Names ("vector.create") of the entries of `ops` that are not those of `parent`.
std::vector<std::string> changed_entries(const CeedBackendOps &ops, const CeedBackendOps &parent);
/// The same in short: a group of which all entries changed is its name alone, of more than two their number.
std::string in_short(const std::vector<std::string> &entries);

}  // namespace hg::info
