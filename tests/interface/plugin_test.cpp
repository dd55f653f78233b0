// Plugin libraries: good ones, refused ones, and what happens when a backend of one does not open.
#include <ceed/plugin.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

const std::filesystem::path plugins = HG_TEST_PLUGINS;

std::string plugin_path(const char *name) {
  return (plugins / (std::string(name) + ".so")).string();
}

/// Loads a plugin once for the process.
void load_once(const char *name) {
  static std::vector<std::string> loaded;
  for (const std::string &other : loaded) {
    if (other == name) return;
  }
  loaded.emplace_back(name);
  ASSERT_EQ(CeedPluginLoad(plugin_path(name).c_str()), CEED_ERROR_SUCCESS) << CeedPluginLoadError();
}

std::vector<std::string> listed() {
  std::size_t count = 0;
  char **names = nullptr;
  ok(CeedRegistryGetList(&count, &names, nullptr));
  std::vector<std::string> result(names, names + count);
  std::free(names);
  return result;
}

bool is_listed(const std::string &resource) {
  const auto all = listed();
  return std::find(all.begin(), all.end(), resource) != all.end();
}

/// The message of a CeedInit() that must fail.
std::string init_message(const std::string &resource, int code = CEED_ERROR_MAJOR) {
  ::setenv("CEED_ERROR_HANDLER", "store", 1);
  Ceed ceed = nullptr;
  EXPECT_EQ(CeedInit(resource.c_str(), &ceed), code) << resource;
  EXPECT_EQ(ceed, nullptr);
  const char *message = nullptr;
  CeedGetErrorMessage(nullptr, &message);
  const std::string result = message;
  CeedResetErrorMessage(nullptr, &message);
  return result;
}

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

/// Values that have gone through the identity operator.
Values copied_by_an_operator(Ceed ceed, const Values &values) {
  const CeedInt size = static_cast<CeedInt>(values.size());
  QFunction qf;
  ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, qf.out()));
  Restriction rstr;
  ok(CeedElemRestrictionCreateStrided(ceed, 1, size, 1, size, CEED_STRIDES_BACKEND, rstr.out()));
  Operator op;
  ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  ok(CeedOperatorSetField(op, "input", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op, "output", rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
  const Vector u = make_vector(ceed, values), v = make_vector(ceed, size, 0);
  ok(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE));
  return values_of(v);
}

TEST(Plugin, DelegatesToItsParent) {
  load_once("delegate");
  ASSERT_TRUE(is_listed("/test/delegate"));
  const CeedHandle ceed(open("/test/delegate:device_id=3"));
  const char *resource = nullptr;
  ok(CeedGetResource(ceed, &resource));
  EXPECT_STREQ(resource, "/test/delegate");

  void *library = dlopen(plugin_path("delegate").c_str(), RTLD_NOW | RTLD_NOLOAD);
  ASSERT_NE(library, nullptr) << "the plugin is not in the process";
  const auto num_applications = reinterpret_cast<int (*)()>(dlsym(library, "delegate_num_applications"));
  const auto last_options = reinterpret_cast<const char *(*)()>(dlsym(library, "delegate_last_options"));
  ASSERT_NE(num_applications, nullptr);
  ASSERT_NE(last_options, nullptr);
  EXPECT_STREQ(last_options(), "device_id=3");

  const int before = num_applications();
  EXPECT_EQ(copied_by_an_operator(ceed, {1, -2, 3}), (Values{1, -2, 3}));
  EXPECT_EQ(num_applications(), before + 1);
  const Vector x = make_vector(ceed, Values{1, -2, 3});
  CeedScalar norm = 0;
  ok(CeedVectorNorm(x, CEED_NORM_1, &norm));  // the parent's
  EXPECT_EQ(norm, 6);

  // The reference itself is as it was.
  const CeedHandle reference(open(reference_resource));
  EXPECT_EQ(copied_by_an_operator(reference, {4, 5}), (Values{4, 5}));
  EXPECT_EQ(num_applications(), before + 1);
  dlclose(library);
}

TEST(Plugin, IsFoundByItsAlias) {
  load_once("delegate");
  const CeedHandle ceed(open("/test/alias of delegate"));
  const char *resource = nullptr;
  ok(CeedGetResource(ceed, &resource));
  EXPECT_STREQ(resource, "/test/delegate");
}

TEST(Plugin, IsNotLoadedTwice) {
  load_once("delegate");
  const auto before = listed();
  EXPECT_NE(CeedPluginLoad(plugin_path("delegate").c_str()), CEED_ERROR_SUCCESS);
  EXPECT_HAS(std::string(CeedPluginLoadError()), "/test/delegate");
  EXPECT_EQ(listed(), before);
  const CeedHandle ceed(open("/test/delegate"));  // and it still works
  EXPECT_EQ(length_of(make_vector(ceed, 2, 1)), 2);
}

/// A plugin that is refused changes nothing, and the message names its file and the reason.
void expect_refused(const std::string &path, int code, const std::vector<std::string> &fragments) {
  const auto before = listed();
  EXPECT_EQ(CeedPluginLoad(path.c_str()), code) << CeedPluginLoadError();
  const std::string message = CeedPluginLoadError();
  EXPECT_HAS(message, path);
  for (const std::string &fragment : fragments) EXPECT_HAS(message, fragment);
  EXPECT_EQ(listed(), before);
  const CeedHandle ceed(open(reference_resource));
  EXPECT_EQ(length_of(make_vector(ceed, 2, 1)), 2);
}

TEST(Plugin, OfAnotherVersionIsRefused) {
  expect_refused(plugin_path("bad_version"), CEED_ERROR_INCOMPATIBLE,
                 {"from the future", std::to_string(CEED_PLUGIN_API_VERSION + 41),
                  "version " + std::to_string(CEED_PLUGIN_API_VERSION)});
}

TEST(Plugin, WithoutTheSymbolIsRefused) {
  expect_refused(plugin_path("bad_symbol"), CEED_ERROR_INCOMPATIBLE, {"ceed_plugin_v1"});
}

TEST(Plugin, WithoutADescriptionIsRefused) {
  expect_refused(plugin_path("bad_null"), CEED_ERROR_INCOMPATIBLE, {"NULL"});
}

TEST(Plugin, ThatThrowsIsRefused) {
  expect_refused(plugin_path("bad_throw"), CEED_ERROR_MAJOR, {"the device library is broken"});
  expect_refused(plugin_path("bad_throw_odd"), CEED_ERROR_MAJOR, {"threw"});
}

/// All or nothing: its first backend has a new name, its second one a name that is taken.
TEST(Plugin, WithATakenNameIsRefused) {
  expect_refused(plugin_path("bad_name"), CEED_ERROR_MINOR, {"/cpu/self/ref/serial", "a thief"});
  EXPECT_FALSE(is_listed("/test/new"));
}

TEST(Plugin, ThatIsNoLibraryIsRefused) {
  const auto path = std::filesystem::temp_directory_path() / "not_a_library_of_honeyguide.so";
  std::ofstream(path) << "Dear loader, I am a letter.\n";
  expect_refused(path.string(), CEED_ERROR_MINOR, {"cannot be opened"});
  std::filesystem::remove(path);
}

TEST(Plugin, ThatIsNotThereIsRefused) {
  expect_refused("/no/such/plugin.so", CEED_ERROR_MINOR, {"cannot be opened", "No such file"});
  EXPECT_NE(CeedPluginLoad(nullptr), CEED_ERROR_SUCCESS);
  EXPECT_HAS(std::string(CeedPluginLoadError()), "NULL");
}

TEST(Plugin, ErrorsAreForgottenByTheNextLoad) {
  EXPECT_NE(CeedPluginLoad("/no/such/plugin.so"), CEED_ERROR_SUCCESS);
  EXPECT_STRNE(CeedPluginLoadError(), "");
  load_once("troubled");
  EXPECT_STREQ(CeedPluginLoadError(), "");
}

TEST(Plugin, BackendWithScoreZeroIsNotForThisMachine) {
  load_once("troubled");
  const std::string message = init_message("/test/absent");
  EXPECT_HAS(message, "No suitable backend: /test/absent");
  EXPECT_HAS(message, "no such device in this machine");
  EXPECT_HAS(message, "Available backend resources:");
}

/// Among equally long matches a backend that cannot run gives way to one that can.
TEST(Plugin, ScoreZeroGivesWay) {
  load_once("troubled");
  const CeedHandle ceed(open("/test/choice"));
  const char *resource = nullptr;
  ok(CeedGetResource(ceed, &resource));
  EXPECT_STREQ(resource, "/test/choice/present");
}

TEST(Plugin, ErrorsOfInitAreTold) {
  load_once("troubled");
  ::setenv("CEED_ERROR_HANDLER", "return", 1);
  Ceed ceed = nullptr;
  EXPECT_EQ(CeedInit("/test/failing", &ceed), CEED_ERROR_BACKEND);
  EXPECT_EQ(ceed, nullptr);
  EXPECT_HAS(init_message("/test/throwing"), "out of streams");
  EXPECT_HAS(init_message("/test/throwing oddly"), "exception");
  EXPECT_HAS(init_message("/test/orphan"), "/test/no such parent");
}

/// Parents that lead in a circle.
TEST(Plugin, CircularParentsAreRefused) {
  load_once("troubled");
  const std::string message = init_message("/test/hen");
  EXPECT_HAS(message, "/test/hen");
  EXPECT_HAS(message, "/test/egg");
}

/// Tables without the entries that are not optional.
TEST(Plugin, EmptyTablesAreRefused) {
  load_once("troubled");
  EXPECT_HAS(init_message("/test/empty"), "/test/empty");
}

/// Beside the library and in CEED_PLUGIN_PATH; a bad plugin among good ones is named and passed over.
TEST(PluginDeathTest, AreFoundInTheSearchPath) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto directory = std::filesystem::temp_directory_path() / ("honeyguide_plugins_" + std::to_string(::getpid()));
  // In the child, which starts anew, the registry has not been asked for anything yet.
  EXPECT_EXIT(
      {
        std::filesystem::create_directories(directory);
        std::filesystem::copy_file(plugin_path("delegate"), directory / "good.so");
        std::ofstream(directory / "broken.so") << "no library";
        std::ofstream(directory / "notes.txt") << "no library either";
        ::setenv("CEED_PLUGIN_PATH", ("/no/such/folder:" + directory.string()).c_str(), 1);
        const bool is_found = is_listed("/test/delegate");
        std::filesystem::remove_all(directory);
        std::exit(is_found ? 7 : 8);
      },
      testing::ExitedWithCode(7), "broken\\.so");
}

TEST(Plugin, OfTheProgramItself) {
  static const auto init = [](Ceed, const char *, CeedBackendOps *) { return 0; };
  static const CeedBackend backends[] = {{"/test/in the program", "/cpu/self/ref/serial", 5, nullptr, nullptr, init}};
  static const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "program", 1, backends};
  ok(CeedPluginRegister(&plugin));
  const CeedHandle ceed(open("/test/in the program"));
  EXPECT_EQ(length_of(make_vector(ceed, 3, 1)), 3);
  ::setenv("CEED_ERROR_HANDLER", "return", 1);
  EXPECT_NE(CeedPluginRegister(nullptr), 0);
  static const CeedPlugin small = {sizeof(CeedPlugin) - 1, CEED_PLUGIN_API_VERSION, "small", 0, nullptr};
  EXPECT_EQ(CeedPluginRegister(&small), CEED_ERROR_INCOMPATIBLE);
  static const CeedBackend nameless[] = {{"no slash", nullptr, 5, nullptr, nullptr, init}};
  static const CeedPlugin odd = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "odd", 1, nameless};
  EXPECT_NE(CeedPluginRegister(&odd), 0);
  static const CeedBackend initless[] = {{"/test/no init", nullptr, 5, nullptr, nullptr, nullptr}};
  static const CeedPlugin idle = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "idle", 1, initless};
  EXPECT_NE(CeedPluginRegister(&idle), 0);
  EXPECT_FALSE(is_listed("/test/no init"));
}

}  // namespace
