#include "program.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <set>

namespace hg::test {

std::string name_from(const std::string &arguments) {
  std::string name;
  for (const char c : arguments)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

nlohmann::json read_json(const std::filesystem::path &file) {
  return nlohmann::json::parse(read_text(file));
}

void expect_record(const nlohmann::json &r) {
  SCOPED_TRACE(r.dump());
  const std::set<std::string> strings{"program", "problem", "ceed", "cpu", "library_version"};
  const std::set<std::string> integers{"degree", "q_1d",        "elements",      "dofs",
                                       "points", "repetitions", "cg_iterations", "ranks"};
  const std::set<std::string> numbers{"mdofs_per_s",  "mpoints_per_s", "gb_per_s",       "flops",
                                      "gflops_per_s", "cg_seconds",    "cg_mdofs_per_s", "compulsory_memory"};
  const std::set<std::string> nullable{"points_per_cell", "placement", "error", "error_h1"};
  const std::set<std::string> parts{"program", "restrictions", "bases", "vectors", "assembly", "backend"};
  std::set<std::string> known{"seconds_per_apply", "seconds_setup", "cg_converged", "memory", "memory_ratio"};
  for (const auto &names : {strings, integers, numbers, nullable}) known.insert(names.begin(), names.end());
  for (const auto &name : known) ASSERT_TRUE(r.contains(name)) << name;
  for (const auto &item : r.items()) EXPECT_TRUE(known.contains(item.key())) << item.key() << " is not in the schema";
  for (const auto &name : strings) EXPECT_TRUE(r[name].is_string() && !r[name].get<std::string>().empty()) << name;
  for (const auto &name : integers) EXPECT_TRUE(r[name].is_number_integer() && r[name].get<long long>() > 0) << name;
  for (const auto &name : numbers) EXPECT_TRUE(r[name].is_number() && r[name].get<double>() > 0) << name;
  EXPECT_EQ(r["points_per_cell"].is_null(), r["placement"].is_null());
  EXPECT_EQ(r["error"].is_null(), !r["cg_converged"].get<bool>());
  EXPECT_EQ(r["error_h1"].is_null(), !r["cg_converged"].get<bool>());

  // These programs run with libraries that do not count; this one does.
  long long total = 0;
  ASSERT_EQ(r["memory"].size(), parts.size() + 1);
  for (const auto &name : parts) {
    const long long bytes = r["memory"].at(name);
    EXPECT_GE(bytes, 0) << name;
    total += bytes;
  }
  EXPECT_EQ(r["memory"]["total"].get<long long>(), total);
  const double ratio = r["memory_ratio"];
  EXPECT_NEAR(ratio, total / r["compulsory_memory"].get<double>(), 1e-12 * ratio);
  EXPECT_GE(ratio, 1);

  const double best = r["seconds_per_apply"]["best"], median = r["seconds_per_apply"]["median"], dofs = r["dofs"];
  EXPECT_GT(best, 0);
  EXPECT_GE(median, best);
  EXPECT_GT(r["seconds_setup"]["create"].get<double>(), 0);
  EXPECT_GT(r["seconds_setup"]["first_apply"].get<double>(), 0);
  EXPECT_NEAR(r["mdofs_per_s"].get<double>(), dofs / best / 1e6, 1e-9 * dofs / best / 1e6);
  const double points = r["points"];
  EXPECT_NEAR(r["mpoints_per_s"].get<double>(), points / best / 1e6, 1e-9 * points / best / 1e6);
  const double cg = dofs * r["cg_iterations"].get<double>() / r["cg_seconds"].get<double>() / 1e6;
  EXPECT_NEAR(r["cg_mdofs_per_s"].get<double>(), cg, 1e-9 * cg);
  const long long q = r["q_1d"], elements = r["elements"];
  if (r["placement"].is_null()) {
    EXPECT_EQ(r["points"].get<long long>(), q * q * q * elements);
  } else {
    EXPECT_EQ(r["points"].get<long long>(), r["points_per_cell"].get<long long>() * elements);
  }
}

}  // namespace hg::test
