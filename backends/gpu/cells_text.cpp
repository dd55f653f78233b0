/// Operators at points of the elements' own.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "../host/access.hpp"
#include "../host/fields.hpp"
#include "assembly_text.hpp"
#include "restriction.hpp"

namespace hg::gpu {

using host::chk, host::Evaluation, host::evaluation_of;

namespace {

class CellPrinter {
 public:
  CellPrinter(const Block &block, const CeedProgram &program, const FunctionText &function, AssemblyText assembly)
      : block_(block),
        program_(program),
        function_(function),
        assembly_(std::move(assembly)),
        spaces_(program.num_spaces) {
    chk(CeedElemRestrictionGetNumComponents(program.points_rstr, &dim_));
    for (CeedInt i = 0; i < program.num_spaces; i++) {
      if (program.spaces[i].rstr != CEED_ELEMRESTRICTION_NONE) spaces_[i] = space(program.spaces[i].basis);
    }
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
  }

  OperatorText print() {
    if (!fits_a_job(program_, text_.numbers.size())) return {};
    if (evaluations_.empty() && integrations_.empty() && !assembly_.contracts()) {
      text_.num_threads = block_.num_threads;
      text_.num_elem = 0;
      print_points();
    } else {
      if (!lay_out()) return {};
      print_cells();
    }
    const std::string constants = fmt::format("warp = {}, cell_lanes = {}, slots = {}, most_planes = {}",
                                              block_.warp_size, lanes_, slots_, most_planes);
    text_.text = begin_text(program_, function_, constants, "cells.hpp", !assembly_.applies(), text_) +
                 (text_.num_elem > 0 ? "  HG_SHARED(shared);\n" : "") + declarations_ + lines_ + "}\n}\n";
    return std::move(text_);
  }

 private:
  /// A space; `functions`: which of the distinct sets of functions it has.
  struct Space {
    CeedInt P = 0, K = 0, num_comp = 0;
    int numbers = -1, functions = -1;
  };
  struct Functions {
    CeedInt P, K;
    int numbers;
    bool is_kept = false;  ///< in shared memory, for what is contracted
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
                       .functions = fmt::format("functions_at{}", s.functions),
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

  /// Threads of a cell, points of a thread, and shared memory: first what each thread has, then what each cell has.
  bool lay_out() {
    text_.num_threads = block_.num_threads;
    list_nodes();
    choose_lanes();
    CeedInt of_thread = 0;
    for (const CeedInt space : assembly_.spaces()) {
      Functions &f = functions_[spaces_[space].functions];
      if (f.is_kept) continue;
      f.is_kept = true;
      declarations_ +=
          fmt::format("  constexpr int functions{} = threads * {};\n", spaces_[space].functions, of_thread);
      of_thread += odd_pairs(2 * dim_ * f.P);
    }
    if (assembly_.contracts()) {
      declarations_ += fmt::format("  constexpr int columns = threads * {};\n", of_thread);
      of_thread += assembly_.matrix_size();
    }
    for (std::size_t i = 0; sums_in_shared_ && i < integrations_.size(); i++) {
      declarations_ += fmt::format("  constexpr int sums_of{} = threads * {};\n", i, of_thread);
      of_thread += num_sums(integrations_[i], lanes_);
    }
    of_thread += of_thread % 2;
    for (const Nodes &nodes : nodes_) {
      declarations_ +=
          fmt::format("  const SharedArray nodes{} = shared + (threads * {} + thread() / cell_lanes * {} + {});\n",
                      nodes.side, of_thread, of_cell_, nodes.place);
    }
    // Several blocks are to find room.
    const auto is_much = [&] { return bytes(of_thread, lanes_) > block_.shared_bytes / 3; };
    while (is_much() && text_.num_threads > block_.warp_size) text_.num_threads -= block_.warp_size;
    text_.shared_bytes = bytes(of_thread, lanes_);
    text_.num_elem = text_.num_threads / lanes_;
    text_.points_of_step = lanes_ * slots_;
    text_.lanes = lanes_;
    text_.slots = slots_;
    text_.places_of_point = places_of_point(lanes_);
    constexpr int most_blocks = 32, most_threads = 2048;  // of a processor
    const int most = assembly_.applies() ? std::min(most_blocks, most_threads / text_.num_threads) : 1;
    while (text_.num_blocks < most && registers(text_.num_blocks + 1) >= wanted_registers()) text_.num_blocks++;
    return text_.shared_bytes <= block_.shared_bytes;
  }
  /// The nodes that a cell has in shared memory, of each source once.
  void list_nodes() {
    for (const Evaluation &e : evaluations_) {
      if (std::any_of(nodes_.begin(), nodes_.end(), [&](const Nodes &nodes) { return nodes.side == e.side; })) continue;
      nodes_.push_back({.side = e.side, .space = e.space, .place = of_cell_});
      of_cell_ += cell_size(spaces_[e.space]);
    }
  }
  /// Shared memory of a block, with so many numbers for each thread and lanes for each cell.
  std::size_t bytes(CeedInt of_thread, CeedInt lanes) const {
    const CeedInt cells = text_.num_threads / lanes;
    return (static_cast<std::size_t>(of_thread) * text_.num_threads + static_cast<std::size_t>(of_cell_) * cells) *
           sizeof(CeedScalar);
  }
  /// A matrix is taken by a whole warp. Else two points for a thread, which share what they read of the nodes, where
  /// registers have room for them, and cells have points for them.
  void choose_lanes() {
    constexpr int few_registers = 128;
    lanes_ = block_.warp_size;
    if (assembly_.contracts()) return;
    for (slots_ = block_.slots > 0 ? block_.slots : 2;; slots_ = 1) {
      lanes_ = block_.lanes > 0 ? std::min(block_.lanes, block_.warp_size) : lanes_of_cell();
      sums_in_shared_ = num_shared_sums(lanes_) > 0;
      if (slots_ == block_.slots || slots_ == 1) return;
      if (wanted_registers() <= few_registers && places_of_point(lanes_) <= most_places) return;
    }
  }
  /// As many as leave few without a point (5 % more of these are worth twice as many lanes, which have smaller shares);
  /// and more, as long as half of them have one, where the nodes of a block's cells, and sums, would take too much of
  /// shared memory for several blocks.
  CeedInt lanes_of_cell() const {
    constexpr CeedInt fewest = 4, most = 16;
    constexpr double more = 1.05;
    const double least = more * places_of_point(fewest);
    CeedInt wanted = fewest;
    while (wanted < most && places_of_point(wanted * 2) <= least) wanted *= 2;
    const auto bytes_with = [&](CeedInt lanes) { return bytes(num_shared_sums(lanes), lanes); };
    while (wanted < block_.warp_size && bytes_with(wanted) > block_.shared_bytes / 5 &&
           bytes_with(2 * wanted) < bytes_with(wanted) && places_of_point(2 * wanted) <= most_places) {
      wanted *= 2;
    }
    return wanted;
  }
  /// Places for points, of all steps of all cells, over points; of some thousand cells, where there are more.
  double places_of_point(CeedInt lanes) const {
    constexpr CeedInt looked_at = 4096;
    const CeedElementMap &map = map_of(program_.points_rstr);
    const CeedInt distance = std::max<CeedInt>(1, program_.num_elem / looked_at), of_step = lanes * slots_;
    CeedSize places = 0, points = 0;
    for (CeedSize e = 0; e < program_.num_elem; e += distance) {
      const CeedInt count = map.offsets[e + 1] - map.offsets[e];
      places += (static_cast<CeedSize>(count) + of_step - 1) / of_step * of_step;
      points += count;
    }
    return points > 0 ? static_cast<double>(places) / static_cast<double>(points) : 1;
  }
  /// Lines of nodes that are summed at a time: a plane where that is not too much for registers.
  CeedInt lines_at_once(const Space &s) const {
    constexpr CeedInt most = 32, longest = 4;
    const CeedInt in_plane = dim_ > 1 ? s.P : 1;
    return s.P <= longest && in_plane * s.P * s.num_comp <= most ? in_plane : 1;
  }
  /// Numbers of a lane's sums, as CellSums has them.
  CeedInt num_sums(const Evaluation &e, CeedInt lanes) const {
    const Space &s = spaces_[e.space];
    CeedInt share = lines_at_once(s) * s.P * s.num_comp;
    for (CeedInt group = lanes; group > 1; group /= 2) share = (share + 1) / 2;
    return CeedIntPow(s.P, dim_ - 1) / lines_at_once(s) * share;
  }
  CeedInt num_sums(CeedInt lanes) const {
    return std::accumulate(integrations_.begin(), integrations_.end(), CeedInt{0},
                           [&](CeedInt sum, const Evaluation &e) { return sum + num_sums(e, lanes); });
  }
  static bool are_planes_one_by_one(CeedInt P, CeedInt dim) { return dim == 3 && P > most_planes; }
  /// Sums of a lane that are in shared memory: all or none. Registers have no room for many, and none for those that
  /// are found by the number of a plane.
  CeedInt num_shared_sums(CeedInt lanes) const {
    const bool have_numbers = std::any_of(integrations_.begin(), integrations_.end(), [&](const Evaluation &e) {
      return are_planes_one_by_one(spaces_[e.space].P, dim_);
    });
    const CeedInt sums = num_sums(lanes);
    return have_numbers || sums > most_sums ? sums : 0;
  }
  /// What a thread has at hand at once: the functions of its points, its sums over steps, and what the evaluation of a
  /// field, with two lines of nodes, or a part of its integration works with. For all bake-off problems up to p = 4 the
  /// compiler spills one number at most with two registers for each of these and 22 for all else.
  int wanted_registers() const {
    constexpr int in_number = 2, other = 22;
    int functions = 0, stored = 0, most = 0;
    std::vector<int> kinds(functions_.size());
    for (const auto *evaluations : {&evaluations_, &integrations_}) {
      for (const Evaluation &e : *evaluations) {
        int &of_space = kinds[spaces_[e.space].functions];
        of_space = std::max(of_space, e.derivative >= 0 ? 2 : 1);
      }
    }
    for (std::size_t f = 0; f < functions_.size(); f++) {
      // Those of planes that are taken one by one are in memory; the compiler wants registers in their stead where
      // there are no derivatives, or many nodes.
      constexpr CeedInt many_planes = 8;
      const CeedInt P = functions_[f].P;
      const bool are_apart = are_planes_one_by_one(P, dim_) && kinds[f] == 2 && P < many_planes;
      functions += kinds[f] * (are_apart ? dim_ - 1 : dim_) * P;
    }
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      if (program_.inputs[i].eval_mode == CEED_EVAL_NONE) stored += program_.inputs[i].size;
    }
    for (const Evaluation &e : evaluations_) {
      const Space &s = spaces_[e.space];
      const int sums = e.derivative >= 0 ? 1 + dim_ : 1, in_plane = dim_ < 3 ? 0 : e.derivative >= 0 ? 3 : 1;
      most = std::max(most, slots_ * ((sums + in_plane) * s.num_comp + stored) + 2 * s.P * s.num_comp);
    }
    for (const Evaluation &e : integrations_) {
      const Space &s = spaces_[e.space];
      const int flux = (e.interp >= 0 ? 1 : 0) + (e.derivative >= 0 ? dim_ : 0),
                in_plane = e.derivative >= 0 ? dim_ : 1;
      most = std::max(most, slots_ * (flux + in_plane) * s.num_comp + lines_at_once(s) * s.P * s.num_comp);
    }
    return other + in_number * (slots_ * functions + (sums_in_shared_ ? 0 : num_sums(lanes_)) + most);
  }
  /// Of a thread, where a processor holds so many blocks: a quarter of its 65536 are for a quarter of the warps.
  int registers(int num_blocks) const {
    constexpr int quarter = 65536 / 4, in_warp = 32, unit = 8;
    const int warps = (num_blocks * text_.num_threads / in_warp + 3) / 4;
    return quarter / in_warp / warps / unit * unit;
  }

  /// Nothing is evaluated and nothing integrated: a point for each thread.
  void print_points() {
    line("const CeedInt *const starts = job.facts.points.offsets;");
    line("const CeedSize point = starts[0] + index();");
    line("if (point >= starts[job.facts.num_elem]) return;");
    line("const CeedInt number = starts[point];");
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      const CeedProgramField &field = program_.inputs[i];
      if (!assembly_.is_read(field)) continue;
      line("CeedScalar in{}[{}];", i, field.size);
      line("{}", stored_input(i, "number", fmt::format("in{}", i)));
    }
    if (assembly_.applies()) {
      for (const std::string &text : output_lines(program_)) line("{}", text);
    }
    for (const std::string &text : at_point("number", "point")) line("{}", text);
  }
  /// An input that is stored, or a weight.
  std::string stored_input(CeedInt i, const std::string &number, const std::string &to) const {
    const CeedProgramField &field = program_.inputs[i];
    if (field.eval_mode == CEED_EVAL_WEIGHT) return to + "[0] = 1;";
    return fmt::format("read_point<{}>(job.sources[{}], {}, {});", field.size, field.side, number, to);
  }
  /// Whether points' places in their list are wanted, beside their numbers.
  bool writes_columns() const { return !assembly_.applies() && !assembly_.contracts(); }
  /// What is done at a point with in0, in1, ..., and out0, out1, ...
  std::vector<std::string> at_point(const std::string &number, const std::string &point) const {
    if (!assembly_.applies()) {
      return assembly_.column_lines(
          writes_columns()
              ? fmt::format("write_column<{}, {}>(column, job.facts.entries, {} - job.facts.points.offsets[0], i);",
                            program_.num_active_in, program_.num_active_out, point)
              : fmt::format("{}{{shared + columns}}.write_column(thread(), i, column);", assembly_.matrices_type()));
    }
    std::vector<std::string> lines = call_lines(program_);
    for (CeedInt o = 0; o < program_.num_outputs; o++) {
      const CeedProgramField &field = program_.outputs[o];
      if (is_evaluated(field)) continue;
      lines.push_back(fmt::format("write_point<{}>(job.sinks[{}], {}, out{});", field.size, field.side, number, o));
    }
    return lines;
  }

  void print_cells() {
    line("const CellLanes at(job.facts);");
    for (const Nodes &nodes : nodes_) {
      line("read_cell<{}>(job.sources[{}], at, nodes{});", cell_of(spaces_[nodes.space]), nodes.side, nodes.side);
    }
    for (std::size_t i = 0; i < integrations_.size(); i++) {
      const Space &s = spaces_[integrations_[i].space];
      line("CellSums<{}, {}, {}, {}, {}> sums{}(shared + {});", dim_, s.P, s.num_comp, lines_at_once(s),
           sums_in_shared_, i, sums_in_shared_ ? fmt::format("sums_of{}", i) : "0");
    }
    line("HG_ROLLED for (CeedInt step = 0; step < at.num_steps; step++) {{");
    if (!evaluations_.empty()) line("  warp_barrier();");
    read_points();
    evaluate_and_call();
    if (assembly_.contracts()) contract();
    for (std::size_t i = 0; i < integrations_.size(); i++) {
      const Evaluation &e = integrations_[i];
      const auto array = [](int o) { return o < 0 ? std::string("nullptr") : fmt::format("outs{}", o); };
      line("  sums{}.add<{}, {}>(at{}, {}, {});", i, e.interp >= 0, e.derivative >= 0, spaces_[e.space].functions,
           array(e.interp), array(e.derivative));
    }
    line("}}");
    for (std::size_t i = 0; i < integrations_.size(); i++) {
      line("sums{}.add_to(job.sinks[{}], at);", i, integrations_[i].side);
    }
  }
  /// What is read from memory comes first, for all points of a thread.
  void read_points() {
    line("  CeedInt numbers[slots]{};", writes_columns() ? ", points[slots]" : "");
    line("  CeedScalar x[slots][{}];", dim_);
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      if (assembly_.is_read(program_.inputs[i]) && is_first(i)) {
        line("  CeedScalar ins{}[slots][{}];", i, program_.inputs[i].size);
      }
    }
    line("  HG_UNROLL for (int s = 0; s < slots; s++) {{");
    if (writes_columns()) line("    points[s] = at.point(step, s);");
    line("    numbers[s] = number_of(job.facts, at.point(step, s));");
    line("    read_coordinates<{}>(job.facts.points, numbers[s], x[s]);", dim_);
    if (!reads_late()) {
      line("    if (!at.has(numbers[s])) continue;");
      read_stored();
    }
    line("  }}");
  }
  void read_stored() {
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      const CeedProgramField &field = program_.inputs[i];
      if (!assembly_.is_read(field) || is_evaluated(field)) continue;
      line("    {}", stored_input(i, "numbers[s]", fmt::format("ins{}[s]", i)));
    }
  }
  /// Whether what is stored is read when it is wanted, the points' numbers once more: where registers are short in any
  /// case.
  bool reads_late() const {
    constexpr int many_registers = 168;
    return assembly_.applies() && wanted_registers() > many_registers;
  }
  void evaluate_and_call() {
    for (std::size_t f = 0; f < functions_.size(); f++) {
      line("  Functions<{}, {}> at{}[slots];", dim_, functions_[f].P, f);
      line("  HG_UNROLL for (int s = 0; s < slots; s++) at{}[s].evaluate<{}>(job.numbers + {}, x[s]);", f,
           functions_[f].K, functions_[f].numbers);
      if (functions_[f].is_kept) line("  at{0}[0].write(shared + functions{0}, thread());", f);
    }
    for (const Evaluation &e : evaluations_) {
      const Space &s = spaces_[e.space];
      const auto array = [](int i) { return i < 0 ? std::string("nullptr") : fmt::format("ins{}", i); };
      line("  if (at.has(numbers[0])) evaluate_points<{}, {}, {}, {}, {}>(at{}, nodes{}, {}, {});", dim_, s.P,
           s.num_comp, e.interp >= 0, e.derivative >= 0, s.functions, e.side, array(e.interp), array(e.derivative));
    }
    for (CeedInt o = 0; assembly_.applies() && o < program_.num_outputs; o++) {
      line("  CeedScalar outs{}[slots][{}];", o, program_.outputs[o].size);
    }
    line("  HG_UNROLL for (int s = 0; s < slots; s++) {{");
    for (CeedInt o = 0; assembly_.applies() && o < program_.num_outputs; o++) {
      const CeedInt size = program_.outputs[o].size;
      if (is_evaluated(program_.outputs[o]))
        line("    HG_UNROLL for (int i = 0; i < {}; i++) outs{}[s][i] = 0;", size, o);
    }
    if (reads_late()) line("    numbers[s] = number_of(job.facts, at.point(step, s));");
    line("    if (!at.has(numbers[s])) continue;");
    if (reads_late()) read_stored();
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      if (assembly_.is_read(program_.inputs[i])) line("    CeedScalar *const in{} = ins{}[s];", i, first_of(i));
    }
    for (CeedInt o = 0; assembly_.applies() && o < program_.num_outputs; o++) {
      line("    CeedScalar *const out{} = outs{}[s];", o, o);
    }
    for (const std::string &text : at_point("numbers[s]", "points[s]")) line("    {}", text);
    line("  }}");
  }
  /// Each cell of the block has a warp.
  void contract() {
    line("  warp_barrier();");
    line("  const StepLanes lanes(at, step);");
    line("  const CeedSize first = at.cell;");
    line("  const int count = 1;");
    line("  const {} matrices{{shared + columns}};", assembly_.matrices_type());
    for (std::size_t f = 0; f < functions_.size(); f++) {
      if (!functions_[f].is_kept) continue;
      line("  const PointFunctions<{0}, {1}> functions_at{2}{{shared + functions{2}}};", dim_, functions_[f].P, f);
    }
    const auto functions_of = [&](CeedInt space) { return functions_text(spaces_[space]); };
    for (const std::string &text : assembly_.contraction_lines(functions_of)) line("  {}", text);
    line("  warp_barrier();");
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

  const Block &block_;
  const CeedProgram &program_;
  const FunctionText &function_;
  AssemblyText assembly_;
  struct Nodes {
    CeedInt side, space, place;
  };
  std::vector<Nodes> nodes_;
  CeedInt dim_ = 0, lanes_ = 1, slots_ = 1, of_cell_ = 0;
  static constexpr CeedInt most_sums = 9;  ///< that registers are to keep over all steps of a cell
  static constexpr double most_places = 2;  ///< for a point
  static constexpr CeedInt most_planes = 3;  ///< as text/cells.hpp has it
  bool sums_in_shared_ = false;
  std::vector<Functions> functions_;
  OperatorText text_;
  std::vector<Space> spaces_;
  std::vector<Evaluation> evaluations_, integrations_;
  std::string declarations_, lines_;
};

}  // namespace

OperatorText cells_text(const Block &block, const CeedProgram &program, const FunctionText &function, Purpose purpose) {
  if (!is_taken(program) || program.num_outputs == 0) return {};
  AssemblyText assembly(program, purpose);
  if (!assembly.is_taken()) return {};
  return CellPrinter(block, program, function, std::move(assembly)).print();
}

}  // namespace hg::gpu
