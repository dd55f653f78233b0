#include "library.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string_view>

#include "../jit/cache.hpp"
#include "../jit/tell.hpp"
#include "texts.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace hg::gen {

using jit::Cache, jit::Compiler, jit::is_set, jit::NotCompiled, jit::tell_once;

namespace {

/// Tells what the compiler said of the loops in the QFunction's own files.
void report(const Source &source, const Cache &cache, const std::string &said) {
  std::istringstream lines(said);
  std::set<std::string> of_user;
  for (std::string line; std::getline(lines, line);) {
    const bool is_about_loops = line.find("vectorized") != std::string::npos;
    const bool is_of_user = line[0] == '/' && line.rfind(cache.folder().string(), 0) != 0;
    if (is_about_loops && is_of_user) of_user.insert(line);
  }
  std::string text = "gen: loops of the QFunction '" + source.function + "':";
  for (const auto &line : of_user) text += "\n  " + line;
  if (of_user.empty()) text += " the compiler says nothing of them";
  tell_once(text, text);
}

/// What the compiler's "native" means here.
std::string processor() {
  std::ostringstream text;
#if defined(__x86_64__)
  for (const unsigned leaf : {1u, 7u, 0x80000001u}) {
    unsigned a = 0, b = 0, c = 0, d = 0;
    __get_cpuid_count(leaf, 0, &a, &b, &c, &d);
    if (leaf == 1) b = 0;  // which of the processors this is
    text << std::hex << a << ' ' << b << ' ' << c << ' ' << d << ' ';
  }
#endif
  return text.str();
}

std::vector<std::string> options_for(const host::Kernels &kernels, const Source &source,
                                     const std::filesystem::path &headers) {
  std::vector<std::string> options = {"-std=gnu++20",
                                      "-O3",
                                      "-w",
                                      "-fpermissive",
                                      "-fno-math-errno",
                                      "-fno-trapping-math",
                                      "-ffp-contract=fast",
                                      "-fopenmp-simd",
                                      "-fno-exceptions",
                                      "-fvisibility=hidden",
                                      "-nostdinc++",
                                      "-I" + headers.string(),
                                      "-I" + (headers / "honeyguide").string()};
  const std::string_view isa = kernels.isa;
  if (isa != "portable") options.emplace_back("-march=native");
  if (isa == "avx2") options.emplace_back("-mno-avx512f");
  if (isa == "avx512") options.emplace_back("-mprefer-vector-width=512");
  for (const auto &root : source.roots) options.push_back("-I" + root.string());
  for (auto &option : jit::lines_of(source.defines).options) options.push_back(std::move(option));
  for (auto &flag : jit::flags_of_user()) options.push_back(std::move(flag));
  return options;
}

/// The folder of our own headers, written where it is not there.
std::filesystem::path headers_in(const Cache &cache) {
  std::string all;
  for (const jit::Text &header : texts) all += std::string(header.name) + '\n' + header.text;
  const std::filesystem::path folder = "include-" + jit::digest(all);
  for (const jit::Text &header : texts) cache.keep(folder / header.name, header.text);
  return cache.folder() / folder;
}

std::string text_of(const host::Kernels &kernels, const Source &source, const Printed &printed) {
  const jit::Defines defines = jit::lines_of(source.defines);
  std::string text = "// The QFunction " + source.function + ", compiled for the operator that it belongs to.\n";
  text += "#define HG_HOST_ISA compiled\n#define HG_HOST_WIDTH " + std::to_string(kernels.width) +
          "\n#define HG_HOST_FUSES\n#include <honeyguide/begin.hpp>\n#include <honeyguide/at_points.hpp>\n\n";
  text += defines.begin + "#include \"" + source.file.string() + "\"\n" + defines.end + '\n';
  text += "// " + jit::digest_of(source) + " is the digest of all that it includes.\n";
  if (!printed.does_all) {
    text +=
        "extern \"C\" __attribute__((visibility(\"default\"))) int hg_qfunction(void *context, CeedInt Q,\n"
        "    const CeedScalar *const *in, CeedScalar *const *out) {\n  return ::" +
        source.function + "(context, Q, in, out);\n}\n";
  }
  if (!printed.text.empty()) text += "\nnamespace hg::host::compiled {\n\n" + printed.text + "\n}  // namespace\n";
  return text;
}

}  // namespace

Library compile(const host::Kernels &kernels, const Source &source, const Printed &printed) {
  const Compiler compiler = Compiler::find();
  const Cache cache;
  const Cache::Request request{.text = text_of(kernels, source, printed),
                               .options = options_for(kernels, source, headers_in(cache)),
                               .depends_on = processor(),
                               .is_report_wanted = is_set("CEED_GEN_REPORT")};
  std::string said;
  void *library = cache.library(compiler, request, &said);
  if (request.is_report_wanted && !said.empty()) report(source, cache, said);
  const auto symbol = [&](const char *name) {
    void *address = ::dlsym(library, name);
    if (address == nullptr) throw NotCompiled(std::string("the library has no symbol ") + name);
    return address;
  };
  return {.function = printed.does_all ? nullptr : reinterpret_cast<CeedQFunctionUser>(symbol("hg_qfunction")),
          .apply = printed.text.empty() ? nullptr : reinterpret_cast<Apply>(symbol("hg_apply"))};
}

}  // namespace hg::gen
