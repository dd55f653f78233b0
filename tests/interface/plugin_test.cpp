// Plugin libraries: good ones, refused ones, and what happens when a backend of one does not open.
#include <ceed/plugin.h>
#include <dlfcn.h>
#include <elf.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/program.hpp"
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

TEST(Plugin, WithoutANameOrBackendsIsRefused) {
  expect_refused(plugin_path("bad_nameless"), CEED_ERROR_INCOMPATIBLE, {"has no name"});
  expect_refused(plugin_path("bad_empty"), CEED_ERROR_INCOMPATIBLE, {"empty-handed", "3 backends", "NULL"});
}

TEST(Plugin, ThatThrowsIsRefused) {
  expect_refused(plugin_path("bad_throw"), CEED_ERROR_MAJOR, {"the device library is broken"});
  expect_refused(plugin_path("bad_throw_odd"), CEED_ERROR_MAJOR, {"threw"});
  expect_refused(plugin_path("bad_throw_own"), CEED_ERROR_MAJOR, {"an error of a type of the plugin's own"});
}

/// The library is mapped by then and cannot be made whole: it stays refused, and others still load.
TEST(Plugin, WhoseConstructorThrowsIsRefused) {
  expect_refused(plugin_path("bad_constructor"), CEED_ERROR_MAJOR, {"constructor", "no room for a table"});
  expect_refused(plugin_path("bad_constructor"), CEED_ERROR_MAJOR, {"constructor", "before"});
  EXPECT_FALSE(is_listed("/test/bad"));
  load_once("delegate");
  EXPECT_TRUE(is_listed("/test/delegate"));
}

/// All or nothing: its first backend has a new name, its second one a name that is taken.
TEST(Plugin, WithATakenNameIsRefused) {
  expect_refused(plugin_path("bad_name"), CEED_ERROR_MINOR, {"/cpu/self/ref/serial", "a thief"});
  EXPECT_FALSE(is_listed("/test/new"));
}

TEST(Plugin, ThatIsNoLibraryIsRefused) {
  const TemporaryFolder scratch;
  const auto path = scratch / "letter.so";
  std::ofstream(path) << "Dear loader, I am a letter.\n";
  expect_refused(path.string(), CEED_ERROR_MINOR, {"cannot be opened", "no ELF header"});
  std::ofstream(path) << "";
  expect_refused(path.string(), CEED_ERROR_MINOR, {"cannot be opened", "no ELF header"});
  expect_refused(scratch.path().string(), CEED_ERROR_MINOR, {"cannot be opened", "no regular file"});
  expect_refused(HG_TEST_HOST, CEED_ERROR_MINOR, {"cannot be opened"});  // a program
}

/// However much of it is there, and without a signal from the dynamic loader.
TEST(Plugin, ThatIsCutShortIsRefused) {
  const TemporaryFolder scratch;
  const auto path = scratch / "short.so";
  const std::string whole = read_text(plugin_path("delegate"));
  ASSERT_GT(whole.size(), 4096u);
  Elf64_Ehdr header;
  std::memcpy(&header, whole.data(), sizeof header);
  std::vector<std::size_t> sizes{EI_NIDENT, EI_NIDENT + 8, sizeof header, sizeof header + 40, header.e_phoff + 100};
  std::size_t needed = 0;  // the last byte that is mapped
  for (int i = 0; i < header.e_phnum; i++) {
    Elf64_Phdr segment;
    std::memcpy(&segment, whole.data() + header.e_phoff + i * sizeof segment, sizeof segment);
    if (segment.p_type == PT_LOAD) needed = std::max<std::size_t>(needed, segment.p_offset + segment.p_filesz);
  }
  for (int i = 1; i <= 8; i++) sizes.push_back(needed * i / 8 - 1);
  for (const std::size_t size : sizes) {
    SCOPED_TRACE(size);
    std::ofstream(path, std::ios::binary) << whole.substr(0, size);
    expect_refused(path.string(), CEED_ERROR_MINOR, {"cannot be opened", "cut short"});
  }
}

TEST(Plugin, OfAnotherArchitectureIsRefused) {
  const TemporaryFolder scratch;
  const std::string whole = read_text(plugin_path("delegate"));
  const auto with = [&](const char *name, auto &&change) {
    std::string changed = whole;
    Elf64_Ehdr header;
    std::memcpy(&header, whole.data(), sizeof header);
    change(header);
    std::memcpy(changed.data(), &header, sizeof header);
    const auto path = scratch / name;
    std::ofstream(path, std::ios::binary) << changed;
    return path.string();
  };
  Elf64_Ehdr own;
  std::memcpy(&own, whole.data(), sizeof own);
  const bool is_arm = own.e_machine == EM_AARCH64;
  expect_refused(with("machine.so", [&](auto &h) { h.e_machine = is_arm ? EM_X86_64 : EM_AARCH64; }), CEED_ERROR_MINOR,
                 {"wrong architecture", "it is for " + std::string(is_arm ? "x86-64" : "AArch64")});
  expect_refused(with("odd.so", [](auto &h) { h.e_machine = 12345; }), CEED_ERROR_MINOR,
                 {"wrong architecture", "ELF machine 12345"});
  expect_refused(with("narrow.so", [](auto &h) { h.e_ident[EI_CLASS] = ELFCLASS32; }), CEED_ERROR_MINOR,
                 {"wrong architecture", "32-bit"});
  expect_refused(with("order.so", [](auto &h) { h.e_ident[EI_DATA] = h.e_ident[EI_DATA] == 1 ? 2 : 1; }),
                 CEED_ERROR_MINOR, {"wrong architecture", "byte order"});
  expect_refused(with("object.so", [](auto &h) { h.e_type = ET_REL; }), CEED_ERROR_MINOR, {"no shared library"});
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

TEST(Plugin, BackendWhoseScoreThrowsIsNotForThisMachine) {
  load_once("troubled");
  EXPECT_HAS(init_message("/test/unsure"), "the driver is of another year");
  EXPECT_HAS(init_message("/test/unsure oddly"), "threw");
  const CeedHandle ceed(open("/test/choice"));  // the others of the plugin are as they were
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
  EXPECT_HAS(init_message("/test/failing", CEED_ERROR_BACKEND), "the driver said 77");
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

std::vector<CeedPluginInfo> plugin_list() {
  std::size_t count = 0;
  CeedPluginInfo *list = nullptr;
  ok(CeedPluginGetList(&count, &list));
  std::vector<CeedPluginInfo> result(list, list + count);
  std::free(list);
  return result;
}

TEST(Plugin, ListTellsWhatBecameOfEach) {
  load_once("delegate");
  EXPECT_NE(CeedPluginLoad(plugin_path("bad_version").c_str()), 0);
  const auto plugins_met = plugin_list();
  const auto find = [&](auto &&is_it) { return std::find_if(plugins_met.begin(), plugins_met.end(), is_it); };
  const auto ref = find([](const auto &p) { return p.plugin != nullptr && p.plugin->name == std::string("ref"); });
  ASSERT_NE(ref, plugins_met.end());
  EXPECT_STREQ(ref->path, "");
  EXPECT_STREQ(ref->error, "");
  const auto good = find([](const auto &p) { return p.path == plugin_path("delegate") && p.plugin != nullptr; });
  ASSERT_NE(good, plugins_met.end());
  EXPECT_STREQ(good->plugin->backends[0].resource, "/test/delegate");
  const auto bad = find([](const auto &p) { return p.path == plugin_path("bad_version"); });
  ASSERT_NE(bad, plugins_met.end());
  EXPECT_EQ(bad->plugin, nullptr);
  EXPECT_HAS(std::string(bad->error), "from the future");
  // The same refusal again adds nothing.
  EXPECT_NE(CeedPluginLoad(plugin_path("bad_version").c_str()), 0);
  EXPECT_EQ(plugin_list().size(), plugins_met.size());
}

/// The tables of a backend: its parent's, but for what it changed.
TEST(Plugin, TablesCanBeRead) {
  load_once("delegate");
  const CeedHandle ceed(open("/test/delegate")), reference(open(reference_resource));
  const CeedBackendOps *ops = nullptr, *parents = nullptr;
  ok(CeedGetBackendOps(ceed, &ops));
  ok(CeedGetBackendOps(reference, &parents));
  EXPECT_EQ(ops->vector.create, parents->vector.create);
  EXPECT_EQ(ops->basis.apply, parents->basis.apply);
  EXPECT_NE(ops->op.apply_add, parents->op.apply_add);
  EXPECT_EQ(ops->api_version, CEED_PLUGIN_API_VERSION);
}

/// What a program that opens `library` when it runs prints, with `plugin` loaded.
std::string printed_by_host(const std::string &environment, const std::string &library, const std::string &plugin = "") {
  const Finished host = run(environment + " '" HG_TEST_HOST "' '" + library + "' " + plugin);
  EXPECT_EQ(host.code, 0) << host.err;
  return host.out + host.err;
}

/// In folders and as a file of CEED_PLUGIN_PATH; bad plugins among good ones are named and passed over.
TEST(Plugin, AreFoundInTheSearchPath) {
  const TemporaryFolder scratch;
  std::filesystem::create_directory(scratch / "folder");
  std::filesystem::copy_file(plugin_path("delegate"), scratch / "folder/good.so");
  std::filesystem::copy_file(plugin_path("bad_constructor"), scratch / "folder/constructor.so");
  std::ofstream(scratch / "folder/broken.so") << "no library";
  std::ofstream(scratch / "folder/notes.txt") << "no library either";
  const std::string whole = read_text(plugin_path("delegate")), folder = (scratch / "folder").string();
  std::ofstream(scratch / "folder/short.so", std::ios::binary) << whole.substr(0, whole.size() / 2);
  const std::string printed = printed_by_host("CEED_PLUGIN_PATH=/no/such/folder:" + folder + "::" + folder + "/:" +
                                                  plugin_path("troubled") + ":" + plugin_path("bad_throw"),
                                              HG_TEST_LIBRARY);
  for (const char *good : {"/test/delegate", "/test/choice/present", reference_resource}) {
    EXPECT_HAS(printed, "resource: " + std::string(good) + "\n");
  }
  for (const char *bad : {"/no/such/folder", "broken.so", "constructor.so", "short.so", "bad_throw.so"}) {
    const auto first = printed.find(bad);
    EXPECT_NE(first, std::string::npos) << bad << " in:\n" << printed;
    EXPECT_EQ(printed.find(bad, first + 1), std::string::npos) << bad << " is named twice in:\n" << printed;
  }
  EXPECT_EQ(printed.find("good.so"), std::string::npos) << printed;
  EXPECT_EQ(printed.find("notes.txt"), std::string::npos) << printed;
}

TEST(Plugin, IsFoundBesideTheLibrary) {
  const TemporaryFolder scratch;
  std::filesystem::create_directory(scratch / "ceed-plugins");
  std::filesystem::copy_file(HG_TEST_LIBRARY, scratch / "libceed.so");
  std::filesystem::copy_file(plugin_path("delegate"), scratch / "ceed-plugins/delegate.so");
  EXPECT_HAS(printed_by_host("LD_LIBRARY_PATH=" + scratch.path().string(), "libceed.so"), "resource: /test/delegate\n");
  // Where a link leads, too.
  std::filesystem::create_directory(scratch / "links");
  std::filesystem::create_symlink(scratch / "libceed.so", scratch / "links/libceed.so");
  EXPECT_HAS(printed_by_host("LD_LIBRARY_PATH=" + (scratch / "links").string(), "libceed.so"),
             "resource: /test/delegate\n");
}

/// A plugin works with the library that is there, even where it was linked to another copy: bindings of other languages
/// open the library by its path.
TEST(Plugin, UsesTheLibraryThatIsThere) {
  const TemporaryFolder scratch;
  std::filesystem::copy_file(HG_TEST_LIBRARY, scratch / "libceed.so");
  for (const std::string &library : {std::string(HG_TEST_LIBRARY), (scratch / "libceed.so").string()}) {
    EXPECT_HAS(printed_by_host("", library, plugin_path("delegate")), "resource: /test/delegate\n");
  }
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
