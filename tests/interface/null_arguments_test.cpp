// Pointers that are NULL where they may not be: every public function gives an error and says which, and none crashes.
#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

#include "null_arguments/cases.hpp"
#include "support/handles.hpp"

namespace {

using namespace hg::test;

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const auto &cases : {ceed_cases(), vector_cases(), restriction_cases(), basis_cases(), qfunction_cases(),
                            context_cases(), operator_cases(), assembly_cases()}) {
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

/// Functions with pointers that have no case, and why.
const std::set<std::string> without_case = {
    // Reports itself, with any number of arguments: below.
    "CeedErrorImpl",
    // Called by CeedErrorImpl() alone.
    "CeedErrorReturn",
    "CeedErrorStore",
    "CeedErrorAbort",
    "CeedErrorExit",
    // Needs a backend with streams, and takes any handle: NULL is the default stream.
    "CeedSetStream",
    // Its message is not stored by a handler: below.
    "CeedPluginLoad",
    // NULL data are accepted, and the reference's own would be lost: below.
    "CeedVectorSetData",
    "CeedBasisSetData",
};

/// Names of the functions that the public headers declare with at least one argument.
std::set<std::string> declared_functions() {
  std::set<std::string> names;
  for (const char *header : {"ceed.h", "backend.h", "plugin.h", "jit-tools.h", "cuda.h", "hip.h"}) {
    std::ifstream file(std::string(HG_PUBLIC_HEADERS "/") + header);
    EXPECT_TRUE(file.good()) << header;
    std::stringstream text;
    text << file.rdbuf();
    const std::string content = text.str();
    // CEED_EXTERN type name(arguments); at the beginning of a line. (Not by <regex>: GCC 12 warns of it when it sanitizes.)
    constexpr std::string_view start = "\nCEED_EXTERN ";
    for (std::size_t at = content.find(start); at != std::string::npos; at = content.find(start, at + 1)) {
      const std::string declaration = content.substr(at, content.find(';', at) - at);
      const std::size_t open = declaration.find('('), close = declaration.rfind(')');
      if (open == std::string::npos) continue;  // data
      const std::size_t before = declaration.find_last_of(" *", open);
      if (declaration.substr(open + 1, close - open - 1) != "void") {
        names.insert(declaration.substr(before + 1, open - before - 1));
      }
    }
  }
  return names;
}

TEST(NullArguments, AreRefusedUnlessTheyAreOptional) {
  for (const Case &one : all_cases()) one.check();
}

TEST(NullArguments, AreTriedInEveryPublicFunction) {
  std::set<std::string> tried = without_case;
  for (const Case &one : all_cases()) EXPECT_TRUE(tried.insert(one.function).second) << one.function << " comes twice";
  const auto declared = declared_functions();
  EXPECT_GT(declared.size(), 300u);
  for (const auto &name : declared) EXPECT_TRUE(tried.contains(name)) << name << "() has no case in null_arguments/";
  for (const auto &name : tried) EXPECT_TRUE(declared.contains(name)) << name << "() is declared nowhere";
}

TEST(NullArguments, DoNotKeepAnErrorFromBeingReported) {
  Objects objects;
  objects.forget_messages();
  EXPECT_EQ(CeedErrorImpl(objects.ceed, nullptr, 3, nullptr, 5, nullptr), 5);
  EXPECT_NE(objects.messages().find(":3 in "), std::string::npos) << objects.messages();
}

TEST(NullArguments, HaveNoDataOfABackend) {
  Objects objects;
  int data = 0;
  EXPECT_EQ(CeedVectorSetData(nullptr, &data), CEED_ERROR_INCOMPLETE);
  EXPECT_EQ(CeedBasisSetData(nullptr, &data), CEED_ERROR_INCOMPLETE);
}

TEST(NullArguments, AreNoPluginToLoad) {
  EXPECT_NE(CeedPluginLoad(nullptr), CEED_ERROR_SUCCESS);
  EXPECT_NE(std::string(CeedPluginLoadError()).find("NULL; expected a file name"), std::string::npos);
}

}  // namespace
