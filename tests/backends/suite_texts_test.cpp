// What the conformance suite has compiled for the emulator is compiled for devices, too.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/emu/texts.hpp"
#include "backends/gpu/function_text.hpp"
#include "backends/gpu/texts.hpp"
#include "backends/jit/cache.hpp"
#include "support/program.hpp"
#include "vendor_targets.hpp"

namespace {

using namespace hg;
using test::VendorTest;

constexpr std::size_t at_once = 16;  ///< texts of a program

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

/// Whether a text was made for warps of more threads than a target's, which it is never asked for.
bool is_of_wider_warps(const std::string &text, int warp_size) {
  const std::string before = "constexpr int threads = ", name = ", warp = ";
  const auto line = text.find(before);
  if (line == std::string::npos) return false;
  const auto at = text.substr(line, text.find('\n', line) - line).find(name);
  return at != std::string::npos && std::stoi(text.substr(line + at + name.size())) > warp_size;
}

/// The texts in the cache on disk, each once and without what the emulator puts before them, in an order that says
/// nothing of them: that of their hashes.
std::vector<std::string> texts_of_the_suite(int warp_size) {
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
    if (!is_of_today(of_device) || is_of_wider_warps(of_device, warp_size)) continue;
    if (seen.insert(of_device).second) texts.push_back(of_device);
  }
  return texts;
}

/// The names that follow `before` in a text, up to what is not of a name.
std::set<std::string> names_after(std::string_view before, const std::string &text) {
  std::set<std::string> names;
  for (auto at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
    const auto begin = text.find_first_not_of(" \t", at + before.size());
    const auto end = std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(),
                                      [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    names.emplace(text.begin() + static_cast<std::ptrdiff_t>(begin), end);
  }
  return names;
}

/// Several texts as one, as a compiler takes longer to start than for most of them: each in a namespace, with all that
/// comes before a text, and its macros end with it. Kernels, whose names are those of C, get others.
std::string joined(std::span<const std::string> texts) {
  const std::string first = jit::text_of(gpu::texts, "vendors.hpp");
  std::string all;
  for (std::size_t i = 0; i < texts.size(); i++) {
    const std::string number = std::to_string(i), space = "of_text_" + number;
    std::string text = texts[i];
    std::set<std::string> kernels = names_after("HG_KERNEL(", text), macros = names_after("#define", first + text);
    kernels.merge(names_after("HG_KERNEL_OF(", text));
    for (const auto &kernel : kernels) all += gpu::define(kernel, kernel + '_' + number);
    const std::string outermost = "#define HG_QFUNCTION ::";
    if (const auto at = text.find(outermost); at != std::string::npos) {
      text.replace(at, outermost.size(), "#define HG_QFUNCTION " + space + "::");
    }
    all += "namespace " + space + " {\n" + first + text + "\n}\n";
    macros.merge(kernels);
    for (const auto &macro : macros) all += "#undef " + macro + '\n';
  }
  return all;
}

TEST_P(VendorTest, TellsTextsThatAreJoinedApart) {
  const auto with = [](const std::string &number, const std::string &expected) {
    return gpu::define("HG_NUMBER", number) + "HG_KERNEL(hg_own, int) { static_assert(HG_NUMBER == " + expected +
           "); }\n";
  };
  const auto compile = [&](const std::vector<std::string> &texts) {
    return compiler->compile_now("texts", joined(texts), target().options);
  };
  EXPECT_FALSE(compile({with("1", "1"), with("2", "2")}).empty());
  EXPECT_THROW(compile({with("1", "1"), with("2", "1")}), gpu::DeviceError);
  EXPECT_THROW(compile({"HG_KERNEL(hg_own, Unknown) {}\n", with("1", "1")}), gpu::DeviceError);
}

TEST_P(VendorTest, CompilesWhatTheSuiteHasCompiled) {
  const std::vector<std::string> texts = texts_of_the_suite(target().warp_size);
  ASSERT_FALSE(texts.empty()) << "run the conformance suite on the emulator first";
  const auto compile = [&](const std::string &name, const std::string &text) {
    return compiler->compile_now(name, text, target().options);
  };
  for (std::size_t begin = 0; begin < texts.size(); begin += at_once) {
    const std::span some = std::span(texts).subspan(begin, std::min(at_once, texts.size() - begin));
    try {
      EXPECT_FALSE(compile("texts from " + std::to_string(begin) + " on", joined(some)).empty());
    } catch (const gpu::DeviceError &error) {
      ADD_FAILURE() << "together: " << error.what();
      for (const std::string &text : some) {
        SCOPED_TRACE(text);
        EXPECT_NO_THROW(compile("text", text));
      }
    }
  }
  std::printf("%s: %zu texts\n", target().name, texts.size());
}

INSTANTIATE_TEST_SUITE_P(Targets, VendorTest, VendorTest::all(), VendorTest::name_of);

}  // namespace
