/// @file
/// Records that the bake-off programs leave.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/program.hpp"

namespace hg::test {

/// A name for a test from the arguments it tries: their letters and digits.
std::string name_from(const std::string &arguments);

nlohmann::json read_json(const std::filesystem::path &file);

/// Expects that a record has every field of the schema with a value of its kind, and that its rates follow from its
/// times.
void expect_record(const nlohmann::json &record);

}  // namespace hg::test
