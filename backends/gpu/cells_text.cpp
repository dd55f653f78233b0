/// Operators at points of the elements' own.
#include <fmt/format.h>

#include <algorithm>

#include "../host/access.hpp"
#include "../host/fields.hpp"
#include "assembly_text.hpp"

namespace hg::gpu {

using host::chk, host::Evaluation, host::evaluation_of;

namespace {

class CellPrinter {
 public:
  CellPrinter(const Block &block, const CeedProgram &program, const FunctionText &function, Purpose purpose)
      : program_(program), function_(function), assembly_(program, purpose), spaces_(program.num_spaces) {
    chk(CeedElemRestrictionGetNumComponents(program.points_rstr, &dim_));
    text_.num_threads = block.num_threads;
    most_shared_ = block.shared_bytes;
    for (CeedInt i = 0; i < program.num_spaces; i++) {
      if (program.spaces[i].rstr != CEED_ELEMRESTRICTION_NONE) spaces_[i] = space(program.spaces[i].basis);
    }
  }

  OperatorText print() {
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      const CeedProgramField &field = program_.inputs[i];
      if (!assembly_.is_read(field) || !is_evaluated(field)) continue;
      Evaluation &e = evaluation_of(evaluations_, field, true);
      if (e.array_of(field) < 0) e.array_of(field) = i;
    }
    for (CeedInt o = 0; assembly_.applies() && o < program_.num_outputs; o++) {
      const CeedProgramField &field = program_.outputs[o];
      if (is_evaluated(field)) evaluation_of(integrations_, field, false).array_of(field) = o;
    }
    lay_out();
    if (text_.shared_bytes + text_.num_elem * text_.bytes_of_cell > most_shared_ || text_.numbers.size() > most_numbers)
      return {};

    line("const CeedInt first = job.facts.groups[block()], count = job.facts.groups[block() + 1] - first;");
    line("const CeedInt *const starts = job.facts.points.offsets;");
    line("const CeedInt end = starts[first + count];");
    line("if (starts[first] == end) return;");
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      if (nodes_[s].empty()) continue;
      line("read_cells<{}, {}>(job.sources[{}], first, count, shared + {});", cell_of(source_space(s)), of_cell_, s,
           nodes_[s]);
    }
    line("for (CeedInt begin = starts[first]; begin < end; begin += threads) {{");
    if (has_shared()) line("  barrier();");
    line("  const CeedInt point = begin + thread();");
    line("  if (point < end) {{");
    at_point();
    line("  }}");
    if (has_lanes()) {
      line("  barrier();");
      line("  const PointLanes lanes{{starts + first, begin}};");
    }
    for (std::size_t f = 0; f < functions_.size(); f++) {
      if (!functions_[f].is_kept) continue;
      line("  const PointFunctions<{0}, {1}> at{2}{{shared + functions{2}}};", dim_, functions_[f].P, f);
    }
    for (const Evaluation &e : integrations_) {
      const Space &s = spaces_[e.space];
      const auto flux = [&](int o) { return o < 0 ? "shared" : fmt::format("shared + flux{}", o); };
      line("  integrate_cells<{}, {}, {}, {}, {}>(job.sinks[{}], first, count, lanes, at{}, {}, {});", dim_, s.P,
           s.num_comp, e.interp >= 0, e.derivative >= 0, e.side, s.functions, flux(e.interp), flux(e.derivative));
    }
    if (assembly_.contracts()) {
      line("  const {} matrices{{shared + columns}};", assembly_.matrices_type());
      const auto functions_of = [&](CeedInt space) { return functions_text(spaces_[space]); };
      for (const std::string &text : assembly_.contraction_lines(functions_of)) line("  {}", text);
    }
    line("}}");
    text_.text = begin_text(program_, function_, "cells.hpp", !assembly_.applies(), text_) +
                 (has_shared() ? "  HG_SHARED(shared);\n" : "") + declarations_ + lines_ + "}\n}\n";
    return std::move(text_);
  }

 private:
  /// Whether anything is done with what the points of a cell have left.
  bool has_lanes() const { return !integrations_.empty() || assembly_.contracts(); }
  bool has_shared() const { return text_.shared_bytes + text_.bytes_of_cell > 0; }
  /// A space; `functions`: which of the distinct sets of functions it has.
  struct Space {
    CeedInt P = 0, K = 0, num_comp = 0;
    int numbers = -1, functions = -1;
  };
  struct Functions {
    CeedInt P, K;
    int numbers;
    bool is_kept = false;  ///< in shared memory, for what comes after the points
  };

  Space space(CeedBasis basis) {
    Space s;
    const CeedScalar *coefficients = nullptr;
    chk(CeedBasisGetNumNodes1D(basis, &s.P));
    chk(CeedBasisGetNumComponents(basis, &s.num_comp));
    chk(CeedBasisGetChebyshevCoefficients1D(basis, &s.K, &coefficients));
    const std::size_t size = static_cast<std::size_t>(s.P) * s.K;
    s.numbers = keep(text_.numbers, std::vector<CeedScalar>(coefficients, coefficients + size));
    const auto found = std::find_if(functions_.begin(), functions_.end(), [&](const Functions &f) {
      return f.P == s.P && f.K == s.K && f.numbers == s.numbers;
    });
    s.functions = static_cast<int>(found - functions_.begin());
    if (found == functions_.end()) functions_.push_back({.P = s.P, .K = s.K, .numbers = s.numbers});
    return s;
  }
  std::string cell_of(const Space &s) const { return fmt::format("Cell<{}, {}, {}>", dim_, s.P, s.num_comp); }
  FunctionsText functions_text(const Space &s) const {
    FunctionsText text{.tile = fmt::format("ProductTile<PointFunctions<{0}, {1}>, {0}, {1}", dim_, s.P),
                       .functions = fmt::format("at{}", s.functions),
                       .num_nodes = CeedIntPow(s.P, dim_),
                       .in_line = s.P,
                       .kinds = {0},
                       .derivative_kinds = {}};
    for (CeedInt d = 0; d < dim_; d++) text.derivative_kinds.push_back(1 + d);
    return text;
  }
  /// As text/cells.hpp has them.
  static CeedInt odd_pairs(CeedInt size) { return 2 * ((size + 1) / 2 | 1); }
  CeedInt cell_size(const Space &s) const {
    return odd_pairs(CeedIntPow(s.P, dim_ - 1) * ((s.P * s.num_comp + 1) / 2 * 2));
  }
  const Space &source_space(CeedInt source) const {
    for (const Evaluation &e : evaluations_) {
      if (e.side == source) return spaces_[e.space];
    }
    return spaces_.front();
  }

  /// Shared memory: first what each point has, then what each cell has.
  void lay_out() {
    CeedInt of_point = 0;
    const auto add = [&](const std::string &name, CeedInt size) {
      declarations_ += fmt::format("  constexpr int {} = threads * {};\n", name, of_point);
      of_point += odd_pairs(size);
    };
    const auto keep_functions = [&](CeedInt space) {
      Functions &f = functions_[spaces_[space].functions];
      if (!f.is_kept) add(fmt::format("functions{}", spaces_[space].functions), 2 * dim_ * f.P);
      f.is_kept = true;
    };
    for (const Evaluation &e : integrations_) {
      keep_functions(e.space);
      for (const int o : {e.interp, e.derivative}) {
        if (o >= 0) add(fmt::format("flux{}", o), program_.outputs[o].size);
      }
    }
    if (assembly_.contracts()) {
      for (const CeedInt space : assembly_.spaces()) keep_functions(space);
      declarations_ += fmt::format("  constexpr int columns = threads * {};\n", of_point);
      of_point += assembly_.matrix_size();
    }
    nodes_.resize(program_.num_sources);
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      const bool is_read =
          std::any_of(evaluations_.begin(), evaluations_.end(), [&](const Evaluation &e) { return e.side == s; });
      if (!is_read) continue;
      nodes_[s] = fmt::format("nodes{}", s);
      declarations_ += fmt::format("  constexpr int nodes{} = threads * {} + {};\n", s, of_point, of_cell_);
      of_cell_ += cell_size(source_space(s));
    }
    // Cells of a block: enough for eight points in each, as far as they need no more memory than points do.
    constexpr CeedInt few_points = 8;
    constexpr std::size_t for_cells = 24 << 10;
    text_.shared_bytes = static_cast<std::size_t>(of_point) * text_.num_threads * sizeof(CeedScalar);
    text_.bytes_of_cell = of_cell_ * sizeof(CeedScalar);
    text_.num_elem = text_.num_threads / few_points;
    if (text_.num_elem * text_.bytes_of_cell > for_cells) {
      text_.num_elem = std::max<CeedInt>(1, static_cast<CeedInt>(for_cells / text_.bytes_of_cell));
    }
    // A processor is to hold as many threads as its registers have room for with a point's numbers in them: the
    // functions of a basis, sums, and a line of nodes. (Where that is up to 96, 80 and a few numbers spilled are 12 %
    // faster.)
    int numbers = 0;
    for (const Evaluation &e : evaluations_) {
      const Space &s = spaces_[e.space];
      numbers = std::max(numbers, 2 * dim_ * s.P + (dim_ + 1 + s.P) * s.num_comp);
    }
    constexpr int few = 80, enough_for_few = 96, other = 16;
    const int wanted = 2 * numbers + other <= enough_for_few ? few : 2 * numbers + other;
    text_.num_blocks = 1;
    if (!assembly_.applies()) return;
    while (registers(text_.num_blocks + 1) >= wanted) text_.num_blocks++;
  }
  /// Of a thread, where a processor holds so many blocks: a quarter of its 65536 are for a quarter of the warps.
  int registers(int num_blocks) const {
    constexpr int quarter = 65536 / 4, in_warp = 32;
    const int warps = (num_blocks * text_.num_threads / in_warp + 3) / 4;
    return quarter / in_warp / warps;
  }

  void at_point() {
    if (!evaluations_.empty()) {
      line("    const int cell = job.facts.elem[point - starts[0]] - first;");
    }
    if (!evaluations_.empty() || has_lanes()) {
      line("    CeedScalar x[{}];", dim_);
      line("    read_point<{}>(job.facts.points, point, x);", dim_);
    }
    for (std::size_t f = 0; f < functions_.size(); f++) {
      const Functions &functions = functions_[f];
      if (evaluations_.empty() && !functions.is_kept) continue;
      line("    Functions<{}, {}> at{};", dim_, functions.P, f);
      line("    at{}.evaluate<{}>(job.numbers + {}, x);", f, functions.K, functions.numbers);
      if (functions.is_kept) line("    at{0}.write(shared + functions{0}, thread());", f);
    }
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      const CeedProgramField &field = program_.inputs[i];
      if (!assembly_.is_read(field) || !is_first(i)) continue;
      line("    CeedScalar in{}[{}];", i, field.size);
      if (field.eval_mode == CEED_EVAL_WEIGHT) line("    in{}[0] = 1;", i);
      if (field.eval_mode == CEED_EVAL_NONE) {
        line("    read_point<{}>(job.sources[{}], point, in{});", field.size, field.side, i);
      }
    }
    for (const Evaluation &e : evaluations_) {
      const Space &s = spaces_[e.space];
      const auto array = [](int i) { return i < 0 ? std::string("nullptr") : fmt::format("in{}", i); };
      line("    evaluate_point<{}, {}, {}, {}, {}>(at{}, shared + ({} + cell * {}), {}, {});", dim_, s.P, s.num_comp,
           e.interp >= 0, e.derivative >= 0, s.functions, nodes_[e.side], of_cell_, array(e.interp),
           array(e.derivative));
    }
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      if (!assembly_.is_read(program_.inputs[i]) || is_first(i)) continue;
      line("    CeedScalar *const in{} = in{};", i, first_of(i));
    }
    if (!assembly_.applies()) {
      const std::string write =
          assembly_.contracts()
              ? fmt::format("{}{{shared + columns}}.write_column(thread(), i, column);", assembly_.matrices_type())
              : fmt::format("write_column<{}, {}>(column, job.facts.entries, point - starts[0], i);",
                            program_.num_active_in, program_.num_active_out);
      for (const std::string &text : assembly_.column_lines(write)) line("    {}", text);
      return;
    }
    for (const std::string &text : output_lines(program_)) line("    {}", text);
    for (const std::string &text : call_lines(program_)) line("    {}", text);
    for (CeedInt o = 0; o < program_.num_outputs; o++) {
      const CeedProgramField &field = program_.outputs[o];
      if (is_evaluated(field)) {
        line("    write_flux<{0}>(out{1}, shared + flux{1}, thread());", field.size, o);
      } else {
        line("    write_point<{}>(job.sinks[{}], point, out{});", field.size, field.side, o);
      }
    }
  }
  /// The input whose values this one has.
  int first_of(CeedInt i) {
    const CeedProgramField &field = program_.inputs[i];
    return is_evaluated(field) ? evaluation_of(evaluations_, field, true).array_of(field) : i;
  }
  bool is_first(CeedInt i) { return first_of(i) == i; }

  template <typename... Args>
  void line(fmt::format_string<Args...> format, Args &&...args) {
    lines_ += "  " + fmt::format(format, std::forward<Args>(args)...) + '\n';
  }

  const CeedProgram &program_;
  const FunctionText &function_;
  AssemblyText assembly_;
  CeedInt dim_ = 0, of_cell_ = 0;
  std::size_t most_shared_ = 0;
  std::vector<Functions> functions_;
  OperatorText text_;
  std::vector<Space> spaces_;
  std::vector<Evaluation> evaluations_, integrations_;
  std::vector<std::string> nodes_;  ///< names of arrays, of the sources that have them
  std::string declarations_, lines_;
};

}  // namespace

OperatorText cells_text(const Block &block, const CeedProgram &program, const FunctionText &function, Purpose purpose) {
  if (!is_taken(program) || program.num_outputs == 0 || !AssemblyText(program, purpose).is_taken()) return {};
  Block smaller = block;
  for (; smaller.num_threads >= block.warp_size; smaller.num_threads -= block.warp_size) {
    OperatorText text = CellPrinter(smaller, program, function, purpose).print();
    if (!text.text.empty()) return text;
  }
  return {};
}

}  // namespace hg::gpu
