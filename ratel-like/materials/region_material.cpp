#include "materials/region_material.hpp"

#include <string>

#include "options/error.hpp"

namespace hg {

RegionMaterial read_region_material(MPI_Comm comm, const Region &region) {
  const std::string title = region.name.empty() ? "Material" : "Material " + region.name;
  OptionGroup common(comm, "", "Material");
  OptionGroup group(comm, region.prefix, title);

  std::string known;
  for (const Material *material : materials()) {
    known += (known.empty() ? "one of " : ", ") + std::string(material->name);
    for (std::string_view alias : material->aliases) known += ", " + std::string(alias);
  }
  std::string model;
  if (!region.prefix.empty() && common.given("model")) model = common.string("model", known.c_str(), "");
  model = group.string("model", known.c_str(), model);
  if (model.empty() && group.helping()) model = materials()[0]->name;
  if (model.empty()) fail("%s is missing: %s", group.full("model").c_str(), known.c_str());

  RegionMaterial filling;
  try {
    filling.material = &find_material(model);
  } catch (const Error &error) {
    fail("%s: %s", group.full("model").c_str(), error.what());
  }
  filling.parameters.E = group.required_real("E", "Young's modulus [Pa]", Range::positive());
  filling.parameters.nu =
      group.required_real("nu", "Poisson's ratio", {.min = -1., .max = 0.5, .min_open = true, .max_open = true});
  filling.parameters.rho = group.real("rho", "density of the undeformed body [kg/m^3]", 1., Range::at_least(0.));
  return filling;
}

std::vector<RegionMaterial> read_region_materials(MPI_Comm comm, std::span<const Region> regions) {
  std::vector<RegionMaterial> fillings;
  for (const Region &region : regions) fillings.push_back(read_region_material(comm, region));
  return fillings;
}

}  // namespace hg
