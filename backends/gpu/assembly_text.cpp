#include "assembly_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hg::gpu {

AssemblyText::AssemblyText(const CeedProgram &program, Purpose purpose) : program_(program), purpose_(purpose) {
  if (purpose == Purpose::apply || purpose == Purpose::qfunction) return;
  is_taken_ = find(program.inputs, program.num_inputs, program.sources, trials_) &&
              find(program.outputs, program.num_outputs, program.sinks, tests_);
  // Each coupling is a text of its own: 1600 of them, of 40 fields, are compiled for minutes.
  constexpr int most_couplings = 64;
  int num_couplings = 0;
  for (const Active &trial : trials_) {
    for (const Active &test : tests_) num_couplings += are_coupled(trial, test) ? 1 : 0;
  }
  is_taken_ = is_taken_ && num_couplings <= most_couplings;
}

bool AssemblyText::are_coupled(const Active &trial, const Active &test) const {
  return purpose_ == Purpose::matrix || program_.sources[trial.side].rstr == program_.sinks[test.side].rstr;
}

bool AssemblyText::find(const CeedProgramField *fields, CeedInt count, const CeedProgramSide *sides,
                        std::vector<Active> &active) {
  for (CeedInt i = 0; i < count; i++) {
    const CeedProgramField &field = fields[i];
    if (field.first_value < 0) continue;
    if (!is_evaluated(field)) return false;
    const auto found =
        std::find_if(active.begin(), active.end(), [&](const Active &one) { return one.side == field.side; });
    if (found != active.end() && found->space != field.space) return false;
    if (found == active.end()) active.push_back({field.side, field.space, sides[field.side].num_comp});
    if (std::find(spaces_.begin(), spaces_.end(), field.space) == spaces_.end()) spaces_.push_back(field.space);
  }
  // In the order of the entries.
  std::sort(active.begin(), active.end(), [](const Active &a, const Active &b) { return a.side < b.side; });
  return true;
}

std::string AssemblyText::matrices_type() const {
  return fmt::format("Matrices<{}, {}>", program_.num_active_in, program_.num_active_out);
}

std::vector<std::string> AssemblyText::column_lines(const std::string &write) const {
  std::vector<std::string> lines{
      fmt::format("CeedScalar active[{}], column[{}];", program_.num_active_in, program_.num_active_out)};
  for (CeedInt i = 0; i < program_.num_inputs; i++) {
    const CeedInt first = program_.inputs[i].first_value;
    if (first >= 0) lines.push_back(fmt::format("CeedScalar *const in{} = active + {};", i, first));
  }
  for (CeedInt o = 0; o < program_.num_outputs; o++) {
    const CeedProgramField &field = program_.outputs[o];
    lines.push_back(field.first_value >= 0 ? fmt::format("CeedScalar *const out{} = column + {};", o, field.first_value)
                                           : fmt::format("CeedScalar out{}[{}];", o, field.size));
  }
  lines.push_back(fmt::format("HG_ROLLED for (int i = 0; i < {}; i++) {{", program_.num_active_in));
  lines.push_back(
      fmt::format("  HG_UNROLL for (int j = 0; j < {}; j++) active[j] = i == j ? 1 : 0;", program_.num_active_in));
  for (const std::string &line : call_lines(program_)) lines.push_back("  " + line);
  lines.push_back("  " + write);
  lines.emplace_back("}");
  return lines;
}

std::string AssemblyText::rows(const CeedProgramField *fields, CeedInt count, const Active &active,
                               const FunctionsText &functions) {
  std::vector<int> numbers;
  for (CeedInt i = 0; i < count; i++) {
    const CeedProgramField &field = fields[i];
    if (field.first_value < 0 || field.side != active.side) continue;
    const auto &kinds = field.eval_mode == CEED_EVAL_INTERP ? functions.kinds : functions.derivative_kinds;
    for (std::size_t g = 0; g < kinds.size(); g++) {
      numbers.push_back(kinds[g]);
      numbers.push_back(field.first_value + static_cast<int>(g) * active.num_comp);
    }
  }
  return fmt::format("Rows<{}>", fmt::join(numbers, ", "));
}

std::vector<std::string> AssemblyText::contraction_lines(
    const std::function<FunctionsText(CeedInt space)> &functions_of, CeedInt *most_tasks) const {
  // Tiles as long as registers have room for, and as lines are whole tiles.
  const auto length_of = [&](const FunctionsText &functions) {
    constexpr CeedInt longest = 5;
    if (purpose_ != Purpose::matrix) return 1;
    CeedInt length = std::min(longest, functions.in_line);
    while (functions.in_line % length != 0) length--;
    return length;
  };
  std::vector<std::string> lines;
  CeedInt tasks = 1;
  CeedSize before = 0;  // entries of an element in the couplings before
  for (const Active &trial : trials_) {
    const FunctionsText trials = functions_of(trial.space);
    const std::string trial_rows = rows(program_.inputs, program_.num_inputs, trial, trials);
    for (const Active &test : tests_) {
      if (!are_coupled(trial, test)) continue;
      const FunctionsText tests = functions_of(test.space);
      const CeedInt M = length_of(tests), N = length_of(trials);
      const std::string types = fmt::format("{}, {}, {}, {}", rows(program_.outputs, program_.num_outputs, test, tests),
                                            trial_rows, tests.tile_of(M), trials.tile_of(N));
      const std::string arguments = fmt::format("count, lanes, matrices, {}, {}", tests.functions, trials.functions);
      const CeedInt comps = test.num_comp * trial.num_comp;
      if (purpose_ == Purpose::matrix) {
        const CeedSize entries = static_cast<CeedSize>(comps) * tests.num_nodes * trials.num_nodes;
        lines.push_back(
            fmt::format("add_matrices<{}, {}, {}>(job.facts.entries + job.facts.num_elem * {} + first * "
                        "CeedSize({}), {});",
                        types, test.num_comp, trial.num_comp, before, entries, arguments));
        before += entries;
        tasks = std::max(tasks, comps * (tests.num_nodes / M) * (trials.num_nodes / N));
      } else {
        const bool is_block = purpose_ == Purpose::point_blocks;
        lines.push_back(fmt::format("add_diagonals<{}, {}, {}>(job.sinks[{}], first, {});", is_block, types,
                                    test.num_comp, test.side, arguments));
        tasks = std::max(tasks, tests.num_nodes * (is_block ? comps : test.num_comp));
      }
    }
  }
  if (most_tasks != nullptr) *most_tasks = tasks;
  return lines;
}

}  // namespace hg::gpu
