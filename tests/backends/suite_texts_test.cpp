// What the conformance suite has compiled for the emulator is compiled for devices, too.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "backends/emu/texts.hpp"
#include "backends/gpu/texts.hpp"
#include "backends/jit/cache.hpp"
#include "support/program.hpp"
#include "vendor_targets.hpp"

namespace {

using namespace hg;
using test::VendorTest;

/// Whether a text is made of parts as they are now; the cache may have older ones.
bool is_of_today(const std::string &text) {
  if (text.find(gpu::first_text()) == std::string::npos) return false;
  const auto has_none_but_todays = [&](const char *part) {
    const std::string begin = "#line 1 \"" + std::string(part) + "\"\n";
    return text.find(begin) == std::string::npos || text.find(begin + gpu::text(part)) != std::string::npos;
  };
  return has_none_but_todays("sides.hpp") && has_none_but_todays("elements.hpp") && has_none_but_todays("cells.hpp") &&
         has_none_but_todays("assembly.hpp");
}

/// The texts in the cache on disk, each once and without what the emulator puts before them, in an order that says
/// nothing of them: that of their hashes.
std::vector<std::string> texts_of_the_suite() {
  const std::string emulators = jit::text_of(emu::texts, "emulator.hpp");
  std::vector<std::filesystem::path> files;
  for (const auto &entry : std::filesystem::directory_iterator(jit::Cache().folder())) {
    if (entry.path().extension() == ".cpp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::set<std::string> seen;
  std::vector<std::string> texts;
  for (const auto &file : files) {
    const std::string text = test::read_text(file);
    const std::size_t begin = text.find(emulators);
    if (begin == std::string::npos) continue;
    const std::string of_device = text.substr(begin + emulators.size());
    if (is_of_today(of_device) && seen.insert(of_device).second) texts.push_back(of_device);
  }
  return texts;
}

/// HG_EVERY=N: every Nth of them, all for 1; there are thousands.
TEST_P(VendorTest, CompilesWhatTheSuiteHasCompiled) {
  const char *every = std::getenv("HG_EVERY");
  const std::size_t step = every != nullptr ? std::max(1L, std::strtol(every, nullptr, 10)) : 1;
  const std::vector<std::string> texts = texts_of_the_suite();
  ASSERT_FALSE(texts.empty()) << "run the conformance suite on the emulator first";
  std::size_t count = 0;
  for (std::size_t i = 0; i < texts.size(); i += step, count++) {
    SCOPED_TRACE(texts[i]);
    EXPECT_FALSE(compiler->compile_now("text " + std::to_string(i), texts[i], target().options).empty());
  }
  std::printf("%s: %zu of %zu texts\n", target().name, count, texts.size());
}

INSTANTIATE_TEST_SUITE_P(Targets, VendorTest, VendorTest::all(), VendorTest::name_of);

}  // namespace
