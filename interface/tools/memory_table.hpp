/// @file
/// What operators hold on each backend.
#pragma once

#include <ceed/backend.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hg::info {

/// The bytes of one operator on one backend.
struct OperatorBytes {
  std::string resource;
  std::string what;  ///< the operator, in words
  CeedOperatorMemory memory{};
  CeedSize compulsory = 0;  ///< what every backend must hold: offsets, data at the points, coordinates of points
  std::string error;        ///< why there are no numbers, or ""
};

/// Makes and applies two operators of the gallery on a backend, one at quadrature points and one at points, in a
/// process of its own.
std::vector<OperatorBytes> measure_memory(const std::string &resource);

void print_memory(const std::vector<OperatorBytes> &operators);
nlohmann::ordered_json to_json(const OperatorBytes &bytes);

}  // namespace hg::info
