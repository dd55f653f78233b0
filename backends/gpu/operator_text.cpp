#include "operator_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../host/access.hpp"
#include "restriction.hpp"
#include "text/jobs.hpp"
#include "texts.hpp"

namespace hg::gpu {

using host::chk;

bool is_taken(const CeedProgram &program) {
  CeedInt vector_length = 1;
  chk(CeedQFunctionGetVectorLength(program.qf, &vector_length));
  const auto takes = [](const CeedProgramSide &side) {
    const CeedElementMap &map = map_of(side.rstr);
    return map.num_bands == 0 && map.block_size == 1;
  };
  return vector_length == 1 && std::all_of(program.sources, program.sources + program.num_sources, takes) &&
         std::all_of(program.sinks, program.sinks + program.num_sinks, takes);
}

bool fits_a_job(const CeedProgram &program, std::size_t num_numbers) {
  const auto num_sides = static_cast<std::size_t>(std::max(program.num_sources, 1) + std::max(program.num_sinks, 1));
  return sizeof(OperatorFacts) + num_sides * sizeof(Side) +
             std::max<std::size_t>(num_numbers, 1) * sizeof(CeedScalar) <=
         most_job_bytes;
}

bool is_alone(const CeedProgram &program, CeedInt sink) {
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    if (t != sink && program.sinks[t].vec == program.sinks[sink].vec) return false;
  }
  return true;
}

std::string begin_text(const CeedProgram &program, const FunctionText &function, const std::string &constants,
                       const char *name, bool assembles, const OperatorText &text) {
  const auto at_least_one = [](std::size_t count) { return std::max<std::size_t>(count, 1); };
  std::string all =
      function.text + fmt::format("#line 1 \"operator\"\nnamespace hg::gpu {{\nconstexpr int threads = {}, {};\n}}\n",
                                  text.num_threads, constants);
  const auto add = [&](const char *part) { all += fmt::format("#line 1 \"{}\"\n{}", part, gpu::text(part)); };
  add("sides.hpp");
  add(name);
  if (assembles) add("assembly.hpp");
  return all + fmt::format(
                   "#line 1 \"operator\"\nnamespace hg::gpu {{\nusing Job = OperatorJob<{}, {}, {}>;\n"
                   "HG_KERNEL_OF(hg_operator, Job, {}, {}) {{\n",
                   at_least_one(program.num_sources), at_least_one(program.num_sinks),
                   at_least_one(text.numbers.size()), text.num_threads, text.num_blocks);
}

std::vector<std::string> output_lines(const CeedProgram &program) {
  std::vector<std::string> lines;
  for (CeedInt o = 0; o < program.num_outputs; o++) {
    lines.push_back(fmt::format("CeedScalar out{}[{}];", o, program.outputs[o].size));
  }
  return lines;
}

std::vector<std::string> call_lines(const CeedProgram &program) {
  std::vector<std::string> lines, in, out;
  for (CeedInt i = 0; i < program.num_inputs; i++) in.push_back(fmt::format("in{}", i));
  for (CeedInt o = 0; o < program.num_outputs; o++) out.push_back(fmt::format("out{}", o));
  lines.push_back(fmt::format("const CeedScalar *const in[] = {{{}}};",
                              in.empty() ? "nullptr" : fmt::format("{}", fmt::join(in, ", "))));
  lines.push_back(fmt::format("CeedScalar *const out[] = {{{}}};", fmt::join(out, ", ")));
  lines.emplace_back("const int code = HG_QFUNCTION(job.facts.context, 1, in, out);");
  lines.emplace_back("if (code != 0 && job.facts.failed != nullptr) *job.facts.failed = code;");
  return lines;
}

int keep(std::vector<CeedScalar> &all, const std::vector<CeedScalar> &values) {
  const auto found = std::search(all.begin(), all.end(), values.begin(), values.end());
  const auto place = static_cast<int>(found - all.begin());
  if (found == all.end()) all.insert(all.end(), values.begin(), values.end());
  return place;
}

}  // namespace hg::gpu
