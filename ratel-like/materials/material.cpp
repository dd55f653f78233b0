#include "materials/material.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "materials/descriptors.hpp"
#include "options/error.hpp"

namespace hg {

std::span<const Material *const> materials() {
  static constexpr std::array all{&linear_material, &neo_hookean_initial_material, &neo_hookean_current_material};
  return all;
}

const Material &find_material(std::string_view name) {
  std::string known;
  for (const Material *material : materials()) {
    if (material->name == name || std::ranges::find(material->aliases, name) != material->aliases.end()) {
      return *material;
    }
    known += (known.empty() ? "" : ", ") + std::string(material->name);
    for (std::string_view alias : material->aliases) known += ", " + std::string(alias);
  }
  fail("unknown material \"%.*s\"; known materials: %s", static_cast<int>(name.size()), name.data(), known.c_str());
}

}  // namespace hg
