// The program ceed-info: what it lists, and what it finds when it runs the conformance suite.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "support/program.hpp"

namespace {

using namespace hg::test;
using Json = nlohmann::json;

const std::string program = quoted(HG_CEED_INFO);

std::string plugin(const std::string &name) {
  return hg::test::quoted(HG_TEST_PLUGINS "/" + name + ".so");
}

Finished ceed_info(const std::string &arguments, const std::string &environment = "CEED_PLUGIN_PATH=") {
  return run(environment + " " + program + " " + arguments);
}

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)
#define EXPECT_HAS_NOT(text, part) EXPECT_EQ((text).find(part), std::string::npos) << (text)

Json backend(const Json &list, const std::string &resource) {
  for (const Json &entry : list["backends"]) {
    if (entry["resource"] == resource) return entry;
  }
  ADD_FAILURE() << resource << " is not listed in " << list.dump(2);
  return {};
}

TEST(CeedInfo, ListsWhatIsThere) {
  const Finished listed = ceed_info("--plugin " + plugin("delegate"));
  ASSERT_EQ(listed.code, 0) << listed.err;
  EXPECT_HAS(listed.out, "\n/cpu/self/ref/serial\n  priority 50, score 1, plugin ref (part of the library)\n");
  EXPECT_HAS(listed.out, "\n/test/delegate\n  priority 1000, score 1, plugin delegate (" HG_TEST_PLUGINS "/delegate.so)");
  EXPECT_HAS(listed.out, "also asked for as /test/alias of delegate");
  EXPECT_HAS(listed.out, "its own: op.apply_add; the rest from /cpu/self/ref/serial");
  EXPECT_LT(listed.out.find("/cpu/self/ref/serial"), listed.out.find("/test/delegate")) << "the preferred one is first";
#ifdef HG_HAS_DEVICES
  for (const char *name : {"/gpu/cuda/gen", "/gpu/cuda/ref", "/gpu/hip/gen", "/gpu/hip/ref"}) {
    EXPECT_HAS(listed.out, "\n" + std::string(name) + "\n");  // whether there is a device or none
  }
#endif
  // Only devices may be missing.
  const std::string missing = "\n  not available  ";
  for (auto at = listed.out.find(missing); at != std::string::npos; at = listed.out.find(missing, at + 1)) {
    const auto name = listed.out.rfind('\n', at - 1) + 1;
    EXPECT_EQ(listed.out.substr(name, 5), "/gpu/") << listed.out;
    EXPECT_NE(listed.out[at + missing.size()], '\n') << "no reason is given";
  }
  EXPECT_HAS_NOT(listed.out, "Refused");
}

TEST(CeedInfo, SaysWhyABackendIsNotAvailable) {
  const Finished listed = ceed_info("--json -", "CEED_PLUGIN_PATH=" + plugin("troubled") + ":" + plugin("faulty") + ":" +
                                                    plugin("bad_version"));
  ASSERT_EQ(listed.code, 0) << listed.err;
  const Json list = Json::parse(listed.out);
  const auto reason = [&](const std::string &resource) {
    const Json found = backend(list, resource);
    EXPECT_FALSE(found["available"].get<bool>()) << resource;
    return found["reason"].get<std::string>();
  };
  EXPECT_EQ(reason("/test/absent"), "no such device in this machine");
  EXPECT_EQ(backend(list, "/test/absent")["score"], 0);
  EXPECT_EQ(reason("/test/unsure"), "the driver is of another year");
  EXPECT_EQ(backend(list, "/test/unsure")["score"], 0);
  EXPECT_EQ(reason("/test/failing"), "the driver said 77");
  EXPECT_EQ(reason("/test/throwing"), "out of streams");
  EXPECT_HAS(reason("/test/orphan"), "/test/no such parent");
  EXPECT_HAS(reason("/test/empty"), "vector.create");
  EXPECT_HAS(reason("/test/mortal"), "signal 9");

  const Json choice = backend(list, "/test/choice/present");
  EXPECT_TRUE(choice["available"].get<bool>());
  EXPECT_EQ(choice["changed"], Json::array());
  const Json faulty = backend(list, "/test/faulty");
  EXPECT_EQ(faulty["aliases"], Json({"/test/wrong", "/test/incorrect"}));
  EXPECT_EQ(faulty["changed"], Json({"vector.norm"}));
  EXPECT_EQ(faulty["features"]["memory"], "host");
  EXPECT_EQ(faulty["features"]["deterministic"], true);
  ASSERT_EQ(list["refused"].size(), 1u);
  EXPECT_HAS(list["refused"][0]["error"].get<std::string>(), "from the future");
  EXPECT_HAS(list["refused"][0]["path"].get<std::string>(), "bad_version.so");
}

/// Some cases: the template of a plugin, among the consumers, goes through all of them.
TEST(CeedInfo, ChecksABackendOfAPlugin) {
  const Finished checked =
      ceed_info("--plugin " + plugin("delegate") + " --check /test/delegate --cases '*Basis*:*Vector*'");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
  EXPECT_HAS(checked.out, "/test/delegate: ");
  EXPECT_HAS(checked.out, " 0 failed, 0 crashed");
  EXPECT_HAS_NOT(checked.out, "/test/delegate: 0 of");
}

TEST(CeedInfo, FindsTheBackendOfAnAlias) {
  const Finished checked = ceed_info("--check /cpu/self/ref --cases '*Vector*'");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
  EXPECT_TRUE(checked.out.starts_with("/cpu/self/ref/serial: ")) << checked.out;
}

TEST(CeedInfo, TellsWhatFails) {
  const Finished checked = ceed_info("--plugin " + plugin("faulty") + " --check /test/faulty --cases '*Vector*'");
  EXPECT_EQ(checked.code, 1);
  EXPECT_HAS(checked.out, "failed  VectorConformance.");
  EXPECT_HAS(checked.out, "vector_test.cpp:");
  EXPECT_HAS(checked.out, " 0 crashed");
}

/// A case that ends the process, by a signal or by itself, is told, and the others still run.
TEST(CeedInfo, GoesOnAfterACrash) {
  const Finished checked =
      ceed_info("--plugin " + plugin("faulty") + " --check /test/crashing --cases '*VectorConformance*' --json -");
  EXPECT_EQ(checked.code, 1);
  const Json report = Json::parse(checked.out)["reports"][0];
  const Finished sound = ceed_info("--check /cpu/self/ref/serial --cases '*VectorConformance*' --json -");
  const Json whole = Json::parse(sound.out)["reports"][0];
  EXPECT_EQ(report["cases"].size(), whole["cases"].size());
  EXPECT_EQ(whole["total"]["passed"], whole["cases"].size());
  const int crashed = report["total"]["crashed"], passed = report["total"]["passed"];
  EXPECT_GE(crashed, 2);
  EXPECT_EQ(passed + crashed, static_cast<int>(whole["cases"].size()));
  std::string messages;
  for (const Json &one : report["cases"]) messages += one["message"].get<std::string>() + "\n";
  EXPECT_HAS(messages, "signal 9");
  EXPECT_HAS(messages, "the filter lost its way");
  EXPECT_HAS(messages, "exit status 33");
}

TEST(CeedInfo, PrintsTheTableOfSupport) {
  const std::string environment = "CEED_PLUGIN_PATH=" + plugin("faulty") + ":" + plugin("troubled");
  const Finished table = ceed_info("--support --cases '*Vector*:*Context*' --ceed /cpu/self/ref/serial --ceed /test/wrong",
                                   environment);
  EXPECT_EQ(table.code, 1) << table.err;  // one of them is faulty
  const std::string head = table.out.substr(0, table.out.find('\n'));
  EXPECT_TRUE(head.starts_with("capability")) << head;
  EXPECT_LT(head.find("/cpu/self/ref/serial"), head.find("/test/faulty"));
  EXPECT_NE(head.find("/test/faulty"), std::string::npos) << head;
  const auto row = [&](const std::string &name) {
    const auto start = table.out.find("\n" + name + " ");
    EXPECT_NE(start, std::string::npos) << name << " in\n" << table.out;
    return table.out.substr(start + 1, table.out.find('\n', start + 1) - start - 1);
  };
  EXPECT_HAS(row("vector"), "yes");
  EXPECT_HAS(row("vector"), "NO");
  EXPECT_HAS(row("operator context"), "yes");
  EXPECT_HAS_NOT(row("operator context"), "NO");
  EXPECT_HAS(table.out, "/test/absent is not available: no such device in this machine");

  const Finished detail = ceed_info("--support --detail --cases '*Vector*' --ceed /test/wrong", environment);
  EXPECT_HAS(detail.out, "\n  VectorConformance.CopiesValues");
  EXPECT_HAS(detail.out, "failed\n");
}

TEST(CeedInfo, PrintsTheMemoryOfOperators) {
  const Finished printed = ceed_info("--memory --ceed /cpu/self/ref/serial");
  ASSERT_EQ(printed.code, 0) << printed.err;
  EXPECT_HAS(printed.out, "4096 hexahedra, 64 quadrature points each");
  EXPECT_HAS(printed.out, "4096 hexahedra, 27 points each");
  EXPECT_HAS(printed.out, "/cpu/self/ref/serial");

  const Finished listed = ceed_info("--memory --json -");
  ASSERT_EQ(listed.code, 0) << listed.err;
  const Json operators = Json::parse(listed.out)["operators"];
  ASSERT_GE(operators.size(), 2u);
  for (const Json &one : operators) {
    SCOPED_TRACE(one.dump());
    long long sum = 0;
    for (const auto &[part, bytes] : one["memory"].items()) sum += part == "total" ? 0 : bytes.get<long long>();
    EXPECT_EQ(one["memory"]["total"], sum);
    EXPECT_GE(sum, one["compulsory"].get<long long>());
    const bool is_at_points = one["operator"].get<std::string>().find("quadrature") == std::string::npos;
    // 27 offsets; 64 times 6 numbers, or 27 times 6 numbers, 3 coordinates and a place.
    EXPECT_EQ(one["compulsory"], 4096 * (27 * 4 + (is_at_points ? 27 * (9 * 8 + 4) : 64 * 6 * 8)));
    EXPECT_EQ(one["memory"]["vectors"], 4096 * 8 * (is_at_points ? 27 * 9 : 64 * 6));
  }
}

TEST(CeedInfo, TellsWhyItCannotMeasureMemory) {
  const std::string environment = "CEED_PLUGIN_PATH=" + plugin("everything");
  const Finished printed = ceed_info("--memory --ceed /test/everything", environment);
  EXPECT_EQ(printed.code, 1);
  EXPECT_HAS(printed.out, "/test/everything");
  EXPECT_EQ(ceed_info("--memory --ceed /no/such/backend").code, 3);
}

TEST(CeedInfo, WritesJson) {
  const TemporaryFolder folder;
  const auto file = folder / "info.json";
  const Finished checked = ceed_info("--check /cpu/self/ref --cases '*Vector*' --json " + quoted(file));
  EXPECT_EQ(checked.code, 0);
  EXPECT_HAS(checked.out, "cases passed");
  const Json json = Json::parse(read_text(file));
  EXPECT_EQ(json["reports"][0]["resource"], "/cpu/self/ref/serial");
  EXPECT_FALSE(json["library"]["interface"].get<std::string>().empty());
  const Finished unwritable = ceed_info("--json /no/such/folder/info.json");
  EXPECT_EQ(unwritable.code, 2);
  EXPECT_HAS(unwritable.err, "/no/such/folder/info.json");
}

TEST(CeedInfo, RefusesWhatItDoesNotKnow) {
  const auto refused = [](const std::string &arguments, int code, const std::string &fragment) {
    SCOPED_TRACE(arguments);
    const Finished finished = ceed_info(arguments);
    EXPECT_EQ(finished.code, code) << finished.out << finished.err;
    EXPECT_HAS(finished.out + finished.err, fragment);
  };
  refused("--chekc /cpu/self", 2, "--chekc");
  refused("--check", 2, "--check");
  refused("--check ''", 2, "--check");
  refused("--check /cpu/self --support", 2, "--support");
  refused("--ceed /cpu/self", 2, "--support");
  refused("--memory --support", 2, "--support");
  refused("--memory --check /cpu/self", 2, "--check");
  refused("--detail", 2, "--support");
  refused("--cases '*'", 2, "--check");
  refused("--plugin /no/such.so", 2, "/no/such.so");
  refused("--plugin " + plugin("bad_version"), 2, "from the future");
  refused("--check /no/such/backend", 3, "No suitable backend: /no/such/backend");
  refused("--plugin " + plugin("faulty") + " --check /test/mortal", 3, "signal 9");
  refused("--plugin " + plugin("faulty") + " --check /test/particular:speed=9", 3, "option 'speed=9' is unknown");
  refused("--check /cpu/self --cases NoSuchCase", 4, "no case of the suite ran");
}

TEST(CeedInfo, ExplainsItself) {
  const Finished help = ceed_info("--help"), version = ceed_info("--version");
  EXPECT_EQ(help.code, 0);
  for (const char *option : {"--check", "--support", "--plugin", "--cases", "--json", "--detail", "Exit status"}) {
    EXPECT_HAS(help.out, option);
  }
  EXPECT_EQ(version.code, 0);
  EXPECT_HAS(version.out, "Honeyguide");
  EXPECT_HAS(version.out, "interface");
}

/// All entries of the tables have names.
TEST(CeedInfo, KnowsAllEntriesOfTheTables) {
  const Finished listed = ceed_info("--json -", "CEED_PLUGIN_PATH=" + plugin("everything"));
  const Json changed = backend(Json::parse(listed.out), "/test/everything")["changed"];
  EXPECT_GE(changed.size(), 35u);
  for (const Json &entry : changed) EXPECT_HAS_NOT(entry.get<std::string>(), "unnamed");
}

/// Without the suite beside it, it says what is missing.
TEST(CeedInfo, SaysThatTheSuiteIsNotThere) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::copy_file(HG_CEED_INFO, folder / "bin/ceed-info");
  const Finished checked = run(quoted(folder / "bin/ceed-info") + " --check /cpu/self");
  EXPECT_EQ(checked.code, 4);
  EXPECT_HAS(checked.err, (folder / "libexec/ceed/ceed-conformance").string());
}

}  // namespace
