// Which backend a request opens.
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"

namespace {

using namespace hg::test;

int init(Ceed, const char *, CeedBackendOps *) {
  return CEED_ERROR_SUCCESS;
}

int is_away(const char **reason) {
  *reason = "it is away";
  return 0;
}

/// Some backends below /zoo and one beside it; and a stand-in.
void register_zoo() {
  static const char *const aliases[] = {"/zoo/striped horse", nullptr};
  static constexpr const char *ref = "/cpu/self/ref/serial";
  static const CeedBackend backends[] = {
      {"/zoo/cat/lion", ref, 30, nullptr, nullptr, init},
      {"/zoo/cat/lynx", ref, 20, nullptr, nullptr, init},
      {"/zoo/zebra", ref, 40, aliases, nullptr, init},
      {"/zoological", ref, 1, nullptr, nullptr, init},
      {"/zoo/cat/of plush", ref, CEED_MAX_BACKEND_PRIORITY, nullptr, nullptr, init},
      {"/garden/away", ref, 10, nullptr, is_away, init},
      {"/garden/gnome/red", ref, CEED_MAX_BACKEND_PRIORITY, nullptr, nullptr, init},
  };
  static const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "zoo", std::size(backends), backends};
  static const int code = CeedPluginRegister(&plugin);
  ASSERT_EQ(code, 0);
}

std::string resolved(const std::string &request) {
  const CeedHandle ceed(open(request));
  const char *resource = nullptr;
  ok(CeedGetResource(ceed, &resource));
  return resource;
}

std::string refusal(const std::string &request) {
  ::setenv("CEED_ERROR_HANDLER", "store", 1);
  Ceed ceed = nullptr;
  EXPECT_EQ(CeedInit(request.c_str(), &ceed), CEED_ERROR_MAJOR) << request;
  EXPECT_EQ(ceed, nullptr) << request;
  const char *message = nullptr;
  CeedGetErrorMessage(nullptr, &message);
  const std::string result = message;
  CeedResetErrorMessage(nullptr, &message);
  return result;
}

TEST(Registry, OpensByFullName) {
  register_zoo();
  EXPECT_EQ(resolved("/cpu/self/ref/serial"), "/cpu/self/ref/serial");
  EXPECT_EQ(resolved("/zoo/cat/lion"), "/zoo/cat/lion");
}

TEST(Registry, OpensByPrefixThenPriority) {
  register_zoo();
  EXPECT_EQ(resolved("/zoo"), "/zoo/cat/lynx");
  EXPECT_EQ(resolved("/zoo/cat"), "/zoo/cat/lynx");
  EXPECT_EQ(resolved("/zoo/zebra"), "/zoo/zebra");
  EXPECT_EQ(resolved("/zoo/striped horse"), "/zoo/zebra");
}

/// What only stands in for others is opened where it is named, not in their place.
TEST(Registry, OpensAStandInWhereItIsNamed) {
  register_zoo();
  EXPECT_EQ(resolved("/zoo/cat/of plush"), "/zoo/cat/of plush");
  EXPECT_EQ(resolved("/garden/gnome"), "/garden/gnome/red");
  const std::string message = refusal("/garden");
  EXPECT_NE(message.find("/garden/away is not available on this machine: it is away"), std::string::npos) << message;
}

/// Components are whole: /zoo is no part of /zoological.
TEST(Registry, ComparesWholeComponents) {
  register_zoo();
  EXPECT_EQ(resolved("/zoological"), "/zoological");
  EXPECT_NE(resolved("/zoo"), "/zoological");
}

TEST(Registry, PassesOnWhatFollowsTheColon) {
  register_zoo();
  EXPECT_EQ(resolved("/zoo/zebra:stripes=40"), "/zoo/zebra");
  EXPECT_EQ(resolved("/cpu/self:anything"), resolved("/cpu/self"));
}

/// The names that scripts for libCEED use.
TEST(Registry, OpensWhatOnlyLibCeedHas) {
  const std::string best = resolved("/cpu/self");
  EXPECT_EQ(best.rfind("/cpu/self/", 0), 0u) << best;
  for (const char *name :
       {"/cpu/self/opt/blocked", "/cpu/self/opt/serial", "/cpu/self/xsmm/serial", "/cpu/self/xsmm/blocked",
        "/cpu/self/avx/blocked", "/cpu/self/avx/serial", "/cpu/self/opt", "/cpu/self/xsmm"}) {
    EXPECT_EQ(resolved(name).rfind("/cpu/self/", 0), 0u) << name << " opened " << resolved(name);
  }
  EXPECT_EQ(resolved("/cpu/self/ref/blocked").rfind("/cpu/self/ref/", 0), 0u);
}

TEST(Registry, ListsWhatThereIsWhereNothingFits) {
  register_zoo();
  for (const char *request : {"/abacus", "abacus", "", "/", "/cpu/remote", "/cpu/self/re", "/cpu/self/ref/serial/more",
                              "/zoo/zebra/young", "/abacus:beads=7"}) {
    const std::string message = refusal(request);
    const std::string name = std::string(request).substr(0, std::string(request).find(':'));
    EXPECT_NE(message.find("No suitable backend: " + name), std::string::npos) << message;
    EXPECT_NE(message.find("Available backend resources:"), std::string::npos) << message;
    EXPECT_NE(message.find("/cpu/self/ref/serial"), std::string::npos) << message;
    EXPECT_NE(message.find("/zoo/cat/lynx"), std::string::npos) << message;
  }
}

/// A misspelt name opens nothing, and the message says what is near.
TEST(Registry, NamesTheClosestMatch) {
  const std::string message = refusal("/cpu/self/ref/seriak");
  EXPECT_NE(message.find("Closest match: /cpu/self/ref/serial"), std::string::npos) << message;
  EXPECT_EQ(refusal("abacus").find("Closest match"), std::string::npos);
}

TEST(Registry, HelpsOnRequest) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(resolved("help:/cpu/self/ref"), "/cpu/self/ref/serial");
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("Available backend resources:\n"), std::string::npos) << text;
  EXPECT_NE(text.find("/cpu/self/ref/serial"), std::string::npos) << text;
}

/// A device that is not there must not become a host backend without a word.
TEST(Registry, DoesNotReplaceADeviceByTheHost) {
  ::setenv("CEED_ERROR_HANDLER", "store", 1);
  for (const char *request : {"/gpu/abacus", "/gpu/cuda/gen", "/gpu/cuda"}) {
    Ceed ceed = nullptr;
    if (CeedInit(request, &ceed) == CEED_ERROR_SUCCESS) {
      const CeedHandle held(ceed);
      const char *resource = nullptr;
      ok(CeedGetResource(ceed, &resource));
      EXPECT_EQ(std::string(resource).rfind("/gpu/", 0), 0u) << request << " opened " << resource;
    }
  }
}

TEST(Registry, RefusesNullPointers) {
  ::setenv("CEED_ERROR_HANDLER", "return", 1);
  Ceed ceed = nullptr;
  EXPECT_NE(CeedInit(nullptr, &ceed), 0);
  EXPECT_NE(CeedInit("/cpu/self", nullptr), 0);
}

TEST(Registry, ListsNamesWithPriorities) {
  register_zoo();
  std::size_t count = 0;
  char **names = nullptr;
  CeedInt *priorities = nullptr;
  ok(CeedRegistryGetList(&count, &names, &priorities));
  const std::vector<std::string> all(names, names + count);
  const std::vector<CeedInt> order(priorities, priorities + count);
  std::free(names);
  std::free(priorities);
  const auto find = [&](const char *name) {
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
  };
  ASSERT_LT(find("/cpu/self/ref/serial"), all.size());
  ASSERT_LT(find("/zoo/cat/lion"), all.size());
  EXPECT_EQ(order[find("/zoo/cat/lion")], 30);
  EXPECT_EQ(order[find("/zoo/cat/lynx")], 20);
  std::size_t again = 0;
  ok(CeedRegistryGetList(&again, nullptr, nullptr));
  EXPECT_EQ(again, count);
}

TEST(Registry, CountsReferences) {
  Ceed ceed = open("/cpu/self/ref/serial"), copy = nullptr;
  ok(CeedReferenceCopy(ceed, &copy));
  EXPECT_EQ(copy, ceed);
  ok(CeedDestroy(&ceed));
  EXPECT_EQ(ceed, nullptr);
  {
    const Vector vec = make_vector(copy, 3, 2);  // alive through the copy
    EXPECT_EQ(values_of(vec), Values(3, 2));
  }
  ok(CeedDestroy(&copy));
  ok(CeedDestroy(&copy));  // nothing left: fine
}

/// Objects keep their Ceed.
TEST(Registry, LivesAsLongAsItsObjects) {
  Ceed ceed = open("/cpu/self/ref/serial");
  const Vector vec = make_vector(ceed, 3, 2);
  ok(CeedDestroy(&ceed));
  EXPECT_EQ(values_of(vec), Values(3, 2));
}

TEST(Registry, SaysItsVersion) {
  int major = -1, minor = -1, patch = -1;
  bool release = true;
  ok(CeedGetVersion(&major, &minor, &patch, &release));
  EXPECT_EQ(major, CEED_VERSION_MAJOR);
  EXPECT_EQ(minor, CEED_VERSION_MINOR);
  EXPECT_EQ(patch, CEED_VERSION_PATCH);
  EXPECT_EQ(release, CEED_VERSION_RELEASE);
  ok(CeedGetVersion(nullptr, nullptr, nullptr, nullptr));
  CeedScalarType type = CEED_SCALAR_FP32;
  ok(CeedGetScalarType(&type));
  EXPECT_EQ(type, CEED_SCALAR_FP64);
  const char *git = nullptr, *configuration = nullptr;
  ok(CeedGetGitVersion(&git));
  ok(CeedGetBuildConfiguration(&configuration));
  EXPECT_STRNE(git, "");
  EXPECT_STRNE(configuration, "");
}

TEST(Registry, ResourcesHaveRoots) {
  const CeedHandle ceed(open(reference_resource));
  const auto root = [&](const char *resource, const char *delineator) {
    char *text = nullptr;
    ok(CeedGetResourceRoot(ceed, resource, delineator, &text));
    const std::string result = text;
    std::free(text);
    return result;
  };
  EXPECT_EQ(root("/gpu/cuda:device_id=1", ":"), "/gpu/cuda");
  EXPECT_EQ(root("/gpu/cuda:device_id=1", ":device_id="), "/gpu/cuda");
  EXPECT_EQ(root("/cpu/self", ":"), "/cpu/self");
  expect_error(CeedGetResourceRoot(ceed, nullptr, ":", nullptr), CEED_ERROR_MINOR, {"NULL"});
}

}  // namespace
