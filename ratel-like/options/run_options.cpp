#include <set>

#include "options/error.hpp"
#include "options/options.hpp"

namespace hg {

namespace {

Region read_region(MPI_Comm comm, const std::string &name) {
  Region region;
  region.name = name;
  region.prefix = name + "_";
  OptionGroup group(comm, region.prefix, "Region " + name);
  const std::vector<PetscInt> values =
      group.integers("label_value", "values of the mesh label that select the region's cells", {});
  const std::string label = group.string("label_name", "mesh label that selects the region's cells", "Cell Sets");
  if (!values.empty()) {
    region.label_name = label;
    region.label_values = values;
  } else if (group.given("label_name")) {
    fail("option %s is missing: %s names the label '%s' and needs its values", group.full("label_value").c_str(),
         group.full("label_name").c_str(), label.c_str());
  }
  const std::vector<double> box =
      group.reals("region_box",
                  "x0,y0,z0,x1,y1,z1 of a box that selects cells by their centroid, points by their place [m]", {}, -1);
  if (!box.empty()) {
    if (box.size() != 6) {
      fail("option %s: %zu numbers, expected 6 (x0,y0,z0,x1,y1,z1)", group.full("region_box").c_str(), box.size());
    }
    region.box.emplace();
    for (int i = 0; i < 6; ++i) (*region.box)[i] = box[i];
    for (int c = 0; c < 3; ++c) {
      if (box[c] > box[c + 3]) {
        fail("option %s: lower end %g above upper end %g in direction %d", group.full("region_box").c_str(), box[c],
             box[c + 3], c);
      }
    }
    if (!region.label_name.empty()) {
      fail("region %s: both %s and %s are given, expected one of them", name.c_str(), group.full("region_box").c_str(),
           group.full("label_value").c_str());
    }
  }
  return region;
}

BodyForce read_forcing(MPI_Comm comm) {
  BodyForce force;
  OptionGroup group(comm, "", "Body force");
  const std::string kind =
      group.choice("forcing", "body force per unit of mass: none, a vector, or that of the manufactured solution",
                   {"none", "body", "mms"}, "none");
  PetscReal final_time = 1.;
  petsc_check(PetscOptionsGetReal(nullptr, nullptr, "-ts_max_time", &final_time, nullptr));
  if (kind == "none" && !group.helping()) return force;
  if (kind == "mms") {
    force.kind = BodyForce::Kind::mms;
    return force;
  }
  const std::vector<double> flat = group.reals("forcing_body_vector", "x,y,z of g for each time [m/s^2]", {}, -1);
  const std::vector<double> times =
      group.reals("forcing_body_times", "time of each vector, ascending [s]; default: -ts_max_time", {final_time}, -1);
  const std::string ramp = group.choice("forcing_body_interpolation",
                                        "between the times: linear (from 0 at t = 0), or step: the next time's vector",
                                        {"linear", "step"}, "linear");
  if (kind == "none" || (flat.empty() && group.helping())) return force;
  if (flat.empty() || flat.size() % 3 != 0) {
    fail("option -forcing_body_vector: %zu numbers, expected 3 for each time", flat.size());
  }
  if (times.size() != flat.size() / 3) {
    fail("option -forcing_body_times: %zu times for %zu vectors, expected as many", times.size(), flat.size() / 3);
  }
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] <= times[i - 1]) {
      fail("option -forcing_body_times: %g after %g, expected ascending", times[i], times[i - 1]);
    }
  }
  force.kind = BodyForce::Kind::body;
  force.times = times;
  force.ramp = ramp == "step" ? Ramp::step : Ramp::linear;
  for (std::size_t i = 0; i < times.size(); ++i)
    force.vectors.push_back({flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]});
  return force;
}

}  // namespace

RunOptions RunOptions::read(MPI_Comm comm) {
  RunOptions options;
  OptionGroup group(comm, "", "Run");
  options.method = group.choice("method", "finite elements or material points", {"fem", "mpm"}, "fem") == "mpm"
                       ? Method::mpm
                       : Method::fem;
  options.ceed = group.string("ceed", "CEED resource that evaluates the operators", "/cpu/self");
  const char *order_option = group.given("orders") && !group.given("order") ? "orders" : "order";
  options.order = group.integer(order_option, "polynomial order of the displacement", 1, {.min = 1, .max = 8});
  options.q_extra =
      group.integer("q_extra", "quadrature points in each direction beyond order + 1", 0, {.min = 0, .max = 16});

  const std::vector<std::string> names = group.strings(
      "material", "names of the regions; each has options of its own with its name as prefix (-<name>_model ...)", {});
  std::set<std::string> seen;
  int rest = 0;
  for (const auto &name : names) {
    if (!seen.insert(name).second) fail("option -material: region '%s' is named twice", name.c_str());
    options.regions.push_back(read_region(comm, name));
    rest += options.regions.back().takes_rest();
  }
  if (rest > 1) {
    fail("option -material: %d regions have neither -<name>_label_value nor -<name>_region_box, expected at most one",
         rest);
  }
  if (names.empty()) options.regions.emplace_back();
  options.forcing = read_forcing(comm);
  return options;
}

}  // namespace hg
