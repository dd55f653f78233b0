/// Operators at quadrature points. Phase by phase: gather; evaluate, direction by direction; call the QFunction;
/// integrate; scatter.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "../host/access.hpp"
#include "../host/basis_factors.hpp"
#include "../host/fields.hpp"
#include "assembly_text.hpp"
#include "phases.hpp"
#include "restriction.hpp"

namespace hg::gpu {

using host::BasisFactors, host::chk, host::Evaluation, host::evaluation_of;
using Route = BasisFactors::Route;

namespace {

/// A shape of text/elements.hpp.
struct Shape {
  CeedInt n[3] = {1, 1, 1}, num_comp = 1;

  std::string type() const { return fmt::format("Shape<{}, {}, {}, {}>", n[0], n[1], n[2], num_comp); }
  std::size_t size() const { return static_cast<std::size_t>(n[0] | 1) * n[1] * n[2] * num_comp; }
};

class ElementPrinter {
 public:
  ElementPrinter(const Block &block, const CeedProgram &program, const FunctionText &function, AssemblyText assembly)
      : block_(block), program_(program), function_(function), assembly_(std::move(assembly)) {
    for (CeedInt i = 0; i < program.num_spaces; i++) bases_.emplace_back(program.spaces[i].basis);
  }

  OperatorText print() {
    inputs_.resize(program_.num_inputs);
    outputs_.resize(program_.num_outputs);
    columns_of_outputs_.assign(program_.num_outputs, -1);
    gather();
    choose_columns();
    for (Evaluation &e : evaluations_) evaluate(e);
    call_ = last_;
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      if (assembly_.is_read(program_.inputs[i])) take_input(i);
    }
    if (assembly_.applies()) {
      for (CeedInt o = 0; o < program_.num_outputs; o++) take_output(o);
    } else {
      take_columns();
    }
    print_points();
    last_ = call_;
    if (assembly_.contracts()) contract_columns();
    std::vector<int> free_from(program_.num_sinks, call_ + 1);
    for (const Evaluation &e : integrations_) free_from[e.side] = integrate(e, free_from[e.side]);
    for (CeedInt t = 0; t < program_.num_sinks; t++) {
      if (sums_[t] < 0) continue;
      const Shape &nodes = sink_shapes_[t];
      phases_.step(last_ + 1,
                   fmt::format("add_nodes<{}, {}>(job.sinks[{}], first, count, {});", comp_first(program_.sinks[t]),
                               nodes.type(), t, phases_.use(sums_[t], last_ + 1)));
    }
    return finish();
  }

 private:
  static bool comp_first(const CeedProgramSide &side) {
    const CeedElementMap &map = map_of(side.rstr);
    return map.num_comp > 1 && (map.offsets != nullptr ? map.comp_stride : map.strides[1]) == 1;
  }
  static Shape shape(const BasisFactors &basis, CeedInt length) {
    Shape s{.num_comp = basis.num_comp};
    for (CeedInt d = 0; d < basis.num_directions; d++) s.n[d] = length;
    return s;
  }
  Shape nodes_of(CeedInt space) const { return shape(bases_[space], bases_[space].P); }
  Shape points_of(CeedInt space) const { return shape(bases_[space], bases_[space].Q); }
  int new_array(const std::string &name, const Shape &shape, CeedInt count = 1) {
    return phases_.array(fmt::format("{}{}", name, num_arrays_++), count * shape.size(),
                         fmt::format("{} {}", count, shape.type()));
  }
  /// The array that comes `g` arrays after another one.
  std::string use(int array, int phase, const Shape &shape, CeedInt g = 0) {
    const std::string name = phases_.use(array, phase);
    return g == 0 ? name : fmt::format("{} + elems * {}", name, g * shape.size());
  }

  // Matrices of one direction are told with each call, those that are no products are in tables.
  std::string number(const std::vector<CeedScalar> &matrix) {
    return fmt::format("job.numbers + {}", keep(text_.numbers, matrix));
  }
  std::string interp_of(CeedInt space) { return number(bases_[space].interp_1d); }
  std::string grad_of(CeedInt space) { return number(bases_[space].grad_1d); }
  std::string table(const CeedScalar *values, std::size_t count) {
    return fmt::format("job.facts.tables + {}", keep(text_.tables, std::vector<CeedScalar>(values, values + count)));
  }

  /// Whether derivatives of an evaluation, or of an integration, along z are taken column by column: a quarter of the
  /// shared memory less, and a fifth of what goes through it. With several components, or longer columns, registers
  /// would be for half as many threads.
  bool is_by_columns(const Evaluation &e) const {
    const BasisFactors &basis = bases_[e.space];
    constexpr CeedInt longest = 8;
    return assembly_.applies() && basis.num_directions == 3 && e.derivative >= 0 && basis.num_comp == 1 &&
           basis.Q <= longest && (basis.route == Route::identity || basis.route == Route::collocated);
  }
  void choose_columns() {
    for (const auto *evaluations : {&evaluations_, &integrations_}) {
      for (const Evaluation &e : *evaluations) {
        if (is_by_columns(e)) column_ = bases_[e.space].Q;
      }
    }
  }
  /// Calls the QFunction at all points of the block's elements, point by point or column by column.
  void print_points() {
    const auto step = [&](const std::string &line) { phases_.step(call_, line); };
    if (column_ == 0) {
      step(fmt::format("HG_ROLLED for (int i = thread(); i < count * {}; i += threads) {{", program_.num_qpts));
      step(fmt::format("  const int e = i / {0}, q = i % {0};", program_.num_qpts));
      for (const std::string &line : point_) step("  " + line);
      step("}");
      return;
    }
    const CeedInt columns = column_ * column_;
    lines_ = std::max(lines_, columns);
    step(fmt::format("HG_ROLLED for (int i = thread(); i < count * {}; i += threads) {{", columns));
    step(fmt::format("  const int e = i / {0}, xy = i % {0};", columns));
    for (const std::string &line : before_column_) step("  " + line);
    step(fmt::format("  HG_ROLLED for (int z = 0; z < {}; z++) {{", column_));
    step(fmt::format("    const int q = xy + z * {};", columns));
    for (const std::string &line : point_) step("    " + line);
    step("  }");
    for (const std::string &line : after_column_) step("  " + line);
    step("}");
  }

  void gather() {
    sources_.assign(program_.num_sources, -1);
    sums_.assign(program_.num_sinks, -1);
    sink_shapes_.resize(program_.num_sinks);
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      const CeedProgramField &field = program_.inputs[i];
      if (!assembly_.is_read(field) || !is_evaluated(field)) continue;
      Evaluation &e = evaluation_of(evaluations_, field, true);
      int &place = e.array_of(field);
      if (place < 0) place = i;
      if (sources_[field.side] >= 0) continue;
      const Shape nodes = nodes_of(field.space);
      sources_[field.side] = new_array("nodes", nodes);
      phases_.step(0, fmt::format("read_nodes<{}, {}>(job.sources[{}], first, count, {});",
                                  comp_first(program_.sources[field.side]), nodes.type(), field.side,
                                  phases_.use(sources_[field.side], 0)));
    }
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      const bool is_read = assembly_.applies() || !program_.sources[s].is_active;
      if (!is_read || sources_[s] >= 0 || !is_standard(program_.sources[s])) continue;
      const CeedElementMap &map = map_of(program_.sources[s].rstr);
      phases_.step(0, fmt::format("ask_for<{}>(job.sources[{}], first, count);", map.elem_size * map.num_comp, s));
    }
    for (CeedInt o = 0; assembly_.applies() && o < program_.num_outputs; o++) {
      const CeedProgramField &field = program_.outputs[o];
      if (is_evaluated(field)) evaluation_of(integrations_, field, false).array_of(field) = o;
    }
    last_ = evaluations_.empty() ? 0 : 1;
  }
  /// Stored point by point, the point fastest.
  static bool is_standard(const CeedProgramSide &side) {
    const CeedElementMap &map = map_of(side.rstr);
    return map.offsets == nullptr && map.strides[0] == 1 && map.strides[1] == map.elem_size &&
           map.strides[2] == map.elem_size * map.num_comp;
  }

  std::string contract(CeedInt d, bool is_transpose, bool add, const Shape &in, const Shape &out,
                       const std::string &matrix, const std::string &from, const std::string &to) {
    CeedInt lines = in.num_comp;
    for (CeedInt other = 0; other < 3; other++) lines *= other == d ? 1 : in.n[other];
    lines_ = std::max(lines_, lines);
    return fmt::format("contract<{}, {}, {}, {}, {}>({}, count, {}, {});", d, is_transpose, add, in.type(), out.type(),
                       matrix, from, to);
  }

  /// Direction after direction from `phase` on; the phase after the last one.
  int to_points(CeedInt space, CeedInt derived, int nodes, int phase, const std::function<std::string(int)> &to) {
    const CeedInt dim = bases_[space].num_directions;
    Shape from = nodes_of(space);
    for (CeedInt d = 0; d < dim; d++, phase++) {
      Shape next = from;
      next.n[d] = bases_[space].Q;
      const int array = d == dim - 1 ? -1 : new_array("chain", next);
      const std::string target = array < 0 ? to(phase) : phases_.use(array, phase);
      phases_.step(phase, contract(d, false, false, from, next, d == derived ? grad_of(space) : interp_of(space),
                                   phases_.use(nodes, phase), target));
      nodes = array;
      from = next;
    }
    return phase;
  }
  /// The same back, the last direction first.
  int to_nodes(CeedInt space, CeedInt derived, int phase, const std::function<std::string(int)> &points, int sum,
               bool add, int sum_free_from) {
    const CeedInt dim = bases_[space].num_directions;
    Shape from = points_of(space);
    int array = -1;
    for (CeedInt d = dim - 1; d >= 0; d--, phase++) {
      if (d == 0) phase = std::max(phase, sum_free_from);
      Shape next = from;
      next.n[d] = bases_[space].P;
      const std::string source = array < 0 ? points(phase) : phases_.use(array, phase);
      const int to = d == 0 ? sum : new_array("chain", next);
      phases_.step(phase, contract(d, true, d == 0 && add, from, next, d == derived ? grad_of(space) : interp_of(space),
                                   source, phases_.use(to, phase)));
      array = to;
      from = next;
    }
    return phase;
  }

  void evaluate(const Evaluation &e) {
    const BasisFactors &basis = bases_[e.space];
    const CeedInt dim = basis.num_directions;
    const Shape nodes = nodes_of(e.space), points = points_of(e.space);
    const int source = sources_[e.side];
    int phase = 1;
    // `column`: values whose derivatives along z are taken column by column, and are in no array; or -1.
    const auto derivative_array = [&](int column = -1) {
      const CeedInt count = program_.inputs[e.derivative].size / points.num_comp - (column >= 0 ? 1 : 0);
      const int array = new_array("derivative", points, count);
      inputs_[e.derivative] = {array, points, column};
      return array;
    };
    switch (basis.route) {
      case Route::identity:
      case Route::collocated: {
        int values = source;
        if (basis.route == Route::collocated) {
          values = new_array("values", points);
          phase = to_points(e.space, -1, source, phase, [&](int at) { return phases_.use(values, at); });
        }
        if (e.interp >= 0) inputs_[e.interp] = {values, points};
        if (e.derivative < 0) break;
        const bool by_columns = is_by_columns(e);
        const int array = derivative_array(by_columns ? values : -1);
        for (CeedInt g = 0; g < (by_columns ? dim - 1 : dim); g++) {
          phases_.step(phase, contract(g, false, false, points, points, grad_of(e.space), phases_.use(values, phase),
                                       use(array, phase, points, g)));
        }
        phase++;
        break;
      }
      case Route::chains: {
        int end = phase;
        if (e.interp >= 0) {
          const int values = new_array("values", points);
          inputs_[e.interp] = {values, points};
          end = to_points(e.space, -1, source, phase, [&](int at) { return phases_.use(values, at); });
        }
        const int array = e.derivative >= 0 ? derivative_array() : -1;
        for (CeedInt g = 0; array >= 0 && g < dim; g++) {
          end = to_points(e.space, g, source, phase, [&](int at) { return use(array, at, points, g); });
        }
        phase = end;
        break;
      }
      case Route::full: {
        const std::size_t size = static_cast<std::size_t>(basis.P) * basis.Q;
        const auto all = [&](const std::vector<const CeedScalar *> &factors, int array) {
          for (std::size_t g = 0; g < factors.size(); g++) {
            phases_.step(phase, fmt::format("multiply<false, false, {}, {}>({}, count, {}, {});", nodes.type(),
                                            points.type(), table(factors[g], size), phases_.use(source, phase),
                                            use(array, phase, points, static_cast<CeedInt>(g))));
          }
        };
        lines_ = std::max(lines_, points.n[0] * points.num_comp);
        if (e.interp >= 0) {
          const int array = new_array("values", points, static_cast<CeedInt>(basis.interp.size()));
          inputs_[e.interp] = {array, points};
          all(basis.interp, array);
        }
        if (e.derivative >= 0) all(basis.derivative, derivative_array());
        phase++;
        break;
      }
    }
    last_ = std::max(last_, phase);
  }

  /// The phase after the last one that adds to the sink.
  int integrate(const Evaluation &e, int sum_free_from) {
    const BasisFactors &basis = bases_[e.space];
    const CeedInt dim = basis.num_directions;
    const Shape nodes = nodes_of(e.space), points = points_of(e.space);
    const auto output = [&](int o, int phase, CeedInt g = 0) { return use(outputs_[o], phase, points, g); };
    const int start = call_ + 1;
    bool add = sums_[e.side] >= 0;
    sink_shapes_[e.side] = nodes;
    int end = start;
    switch (basis.route) {
      case Route::identity:
      case Route::collocated: {
        int phase = start, values = -1;
        bool has_values = false;
        const bool is_identity = basis.route == Route::identity, by_columns = is_by_columns(e);
        if (by_columns || (is_identity && add)) {
          // What columns have left, or another integration, is there already, and all else is added to it.
          values = by_columns ? columns_of_outputs_[e.derivative] : sums_[e.side];
          if (!by_columns) phase = std::max(phase, sum_free_from);
          has_values = true;
          if (e.interp >= 0) {
            phases_.step(phase, fmt::format("add_array<{}>(count, {}, {});", points.type(), output(e.interp, phase),
                                            phases_.use(values, phase)));
            phase++;
          }
        } else if (e.interp >= 0) {
          values = outputs_[e.interp];
          has_values = true;
        } else {
          values = new_array("back", points);
        }
        for (CeedInt g = 0; e.derivative >= 0 && g < (by_columns ? dim - 1 : dim); g++, phase++) {
          phases_.step(phase, contract(g, true, has_values, points, points, grad_of(e.space),
                                       output(e.derivative, phase, g), phases_.use(values, phase)));
          has_values = true;
        }
        end = phase;
        if (is_identity && by_columns && add) {
          phase = std::max(phase, sum_free_from);
          phases_.step(phase, fmt::format("add_array<{}>(count, {}, {});", points.type(), phases_.use(values, phase),
                                          phases_.use(sums_[e.side], phase)));
          end = phase + 1;
        } else if (is_identity) {
          sums_[e.side] = values;
        } else {
          if (!add) sums_[e.side] = new_array("sum", nodes);
          end = to_nodes(
              e.space, -1, phase, [&](int at) { return phases_.use(values, at); }, sums_[e.side], add, sum_free_from);
        }
        break;
      }
      case Route::chains:
        if (!add) sums_[e.side] = new_array("sum", nodes);
        end = sum_free_from;
        if (e.interp >= 0) {
          end = to_nodes(
              e.space, -1, start, [&](int at) { return output(e.interp, at); }, sums_[e.side], add, end);
          add = true;
        }
        for (CeedInt g = 0; e.derivative >= 0 && g < dim; g++) {
          end = to_nodes(
              e.space, g, start, [&](int at) { return output(e.derivative, at, g); }, sums_[e.side], add, end);
          add = true;
        }
        break;
      case Route::full: {
        const std::size_t size = static_cast<std::size_t>(basis.P) * basis.Q;
        if (!add) sums_[e.side] = new_array("sum", nodes);
        // Each thread has its own numbers of the sum: one phase does.
        int phase = std::max(start, sum_free_from);
        const auto all = [&](const std::vector<const CeedScalar *> &factors, int o) {
          for (std::size_t g = 0; g < factors.size(); g++) {
            phases_.step(phase,
                         fmt::format("multiply<true, {}, {}, {}>({}, count, {}, {});", add, points.type(), nodes.type(),
                                     table(factors[g], size), output(o, phase, static_cast<CeedInt>(g)),
                                     phases_.use(sums_[e.side], phase)));
            add = true;
          }
        };
        if (e.interp >= 0) all(basis.interp, e.interp);
        if (e.derivative >= 0) all(basis.derivative, e.derivative);
        end = phase + 1;
        break;
      }
    }
    last_ = std::max(last_, end - 1);
    return end;
  }

  void point(const std::string &line) { point_.push_back(line); }

  void take_input(CeedInt i) {
    const CeedProgramField &field = program_.inputs[i];
    point(fmt::format("CeedScalar in{}[{}];", i, field.size));
    if (field.eval_mode == CEED_EVAL_WEIGHT) {
      const auto &weights = bases_[field.space].weights;
      point(fmt::format("in{}[0] = ({})[q];", i, table(weights.data(), weights.size())));
    } else if (field.eval_mode == CEED_EVAL_NONE) {
      point(fmt::format("read_{}<{}, {}>(job.sources[{}], first + e, q, in{});",
                        is_standard(program_.sources[field.side]) ? "stored" : "scattered", field.size,
                        program_.num_qpts, field.side, i));
    } else {
      const Values &values = inputs_[evaluation_of(evaluations_, field, true).array_of(field)];
      const CeedInt num_comp = values.shape.num_comp, num_arrays = field.size / num_comp - (values.column >= 0 ? 1 : 0);
      point(fmt::format("read_values<{}, {}>({}, e, q, in{});", num_arrays, values.shape.type(),
                        phases_.use(values.array, call_), i));
      if (values.column < 0) return;
      before_column_.push_back(fmt::format("CeedScalar column{}[{}];", i, column_ * num_comp));
      before_column_.push_back(fmt::format("read_column<{}>({}, e, xy, column{});", values.shape.type(),
                                           phases_.use(values.column, call_), i));
      point(fmt::format("derive_column<{}, {}>({}, column{}, z, in{} + {});", column_, num_comp, grad_of(field.space),
                        i, i, num_arrays * num_comp));
    }
  }

  void take_output(CeedInt o) {
    if (o == 0) {
      for (const std::string &line : output_lines(program_)) point(line);
      for (const std::string &line : call_lines(program_)) point(line);
    }
    const CeedProgramField &field = program_.outputs[o];
    if (field.eval_mode == CEED_EVAL_NONE) {
      point(fmt::format(
          "add_{}<{}, {}>(job.sinks[{}], first + e, q, out{});",
          is_standard(program_.sinks[field.side]) && is_alone(program_, field.side) ? "stored" : "scattered",
          field.size, program_.num_qpts, field.side, o));
      return;
    }
    const Shape points = points_of(field.space);
    const bool by_columns = std::any_of(integrations_.begin(), integrations_.end(),
                                        [&](const Evaluation &e) { return e.derivative == o && is_by_columns(e); });
    const CeedInt count = field.size / points.num_comp - (by_columns ? 1 : 0);
    outputs_[o] = new_array("flux", points, count);
    phases_.replaces(outputs_[o], call_);
    point(fmt::format("write_values<{}, {}>(out{}, e, q, {});", count, points.type(), o,
                      phases_.use(outputs_[o], call_)));
    if (!by_columns) return;
    columns_of_outputs_[o] = new_array("back", points);
    phases_.replaces(columns_of_outputs_[o], call_);
    before_column_.push_back(fmt::format("CeedScalar back{}[{}] = {{}};", o, column_ * points.num_comp));
    point(fmt::format("integrate_column<{}, {}>({}, out{} + {}, z, back{});", column_, points.num_comp,
                      grad_of(field.space), o, count * points.num_comp, o));
    after_column_.push_back(fmt::format("write_column<{}>(back{}, e, xy, {});", points.type(), o,
                                        phases_.use(columns_of_outputs_[o], call_)));
  }

  /// The QFunction's matrices, to where they are contracted, or to memory.
  void take_columns() {
    const CeedInt Q = program_.num_qpts;
    std::string write = fmt::format("write_column<{}, {}, {}>(column, job.facts.entries, first + e, q, i);",
                                    program_.num_active_in, program_.num_active_out, Q);
    if (assembly_.contracts()) {
      const auto size = static_cast<std::size_t>(assembly_.matrix_size()) * Q;
      columns_ = phases_.array("columns", size, "columns");
      write = fmt::format("{}{{{}}}.write_column(e * {} + q, i, column);", assembly_.matrices_type(),
                          phases_.use(columns_, call_), Q);
    } else {
      lines_ = std::max(lines_, Q);
    }
    for (const std::string &line : assembly_.column_lines(write)) point(line);
  }

  void contract_columns() {
    const int phase = call_ + 1;
    phases_.step(phase, fmt::format("const QuadratureLanes<{}> lanes;", program_.num_qpts));
    phases_.step(phase,
                 fmt::format("const {} matrices{{{}}};", assembly_.matrices_type(), phases_.use(columns_, phase)));
    for (const CeedInt space : assembly_.spaces()) {
      phases_.step(phase, fmt::format("const {} functions{}{{{}}};", functions_type(space), space,
                                      bases_[space].route == Route::full ? "job.facts.tables" : tables_1d(space)));
    }
    const auto functions_of = [&](CeedInt space) { return functions_text(space); };
    for (const std::string &line : assembly_.contraction_lines(functions_of, &lines_)) phases_.step(phase, line);
    last_ = phase;
  }
  std::string functions_type(CeedInt space) const {
    const BasisFactors &basis = bases_[space];
    if (basis.route == Route::full) return "CeedScalar *const";
    return fmt::format("QuadratureFunctions<{}, {}>", basis.P, basis.Q);
  }
  /// Values and derivatives of the nodes' functions at the points, whatever route evaluation takes.
  std::string tables_1d(CeedInt space) {
    const CeedBasis basis = program_.spaces[space].basis;
    const CeedScalar *interp = nullptr, *grad = nullptr;
    chk(CeedBasisGetInterp1D(basis, &interp));
    chk(CeedBasisGetGrad1D(basis, &grad));
    const auto size = static_cast<std::size_t>(bases_[space].P) * bases_[space].Q;
    return table(interp, size) + ", " + table(grad, size);
  }
  FunctionsText functions_text(CeedInt space) {
    const BasisFactors &basis = bases_[space];
    FunctionsText text{.tile = {},
                       .functions = fmt::format("functions{}", space),
                       .num_nodes = CeedIntPow(basis.P, basis.num_directions),
                       .in_line = basis.P,
                       .kinds = {},
                       .derivative_kinds = {}};
    if (basis.route != Route::full) {
      text.tile = fmt::format("ProductTile<{}, {}, {}", functions_type(space), basis.num_directions, basis.P);
      text.kinds.push_back(0);
      for (CeedInt d = 0; d < basis.num_directions; d++) text.derivative_kinds.push_back(1 + d);
      return text;
    }
    text.tile = fmt::format("TableTile<{}, {}", basis.P, basis.Q);
    const auto place = [&](const CeedScalar *factor) {
      return keep(text_.tables, std::vector<CeedScalar>(factor, factor + static_cast<std::size_t>(basis.P) * basis.Q));
    };
    for (const CeedScalar *factor : basis.interp) text.kinds.push_back(place(factor));
    for (const CeedScalar *factor : basis.derivative) text.derivative_kinds.push_back(place(factor));
    return text;
  }

  /// Elements of a block: as many as fill its warps best.
  OperatorText finish() {
    const std::size_t size = phases_.place() * sizeof(CeedScalar);
    if (size > block_.shared_bytes || !fits_a_job(program_, text_.numbers.size())) return {};
    double best = 0;
    for (CeedInt elems = 1; elems <= block_.num_threads; elems++) {
      const CeedInt lines = elems * lines_;
      if (elems > 1 && (lines > block_.num_threads || elems * size > block_.shared_bytes / 3)) break;
      const int threads = std::min(block_.whole_warps(lines), block_.num_threads);
      const double filled = static_cast<double>(lines) / (threads * ((lines + threads - 1) / threads));
      if (filled < best) continue;
      best = filled;
      text_.num_elem = elems;
      text_.num_threads = threads;
    }
    text_.shared_bytes = text_.num_elem * size;
    // Registers for as many threads as shared memory has room for, where lines are so long that the compiler would take
    // more, and fewer threads; shorter ones are quicker with what it takes by itself.
    constexpr int threads_of_processor = 1024;
    constexpr CeedInt long_line = 6;
    const bool is_long =
        std::any_of(bases_.begin(), bases_.end(), [](const BasisFactors &basis) { return basis.P >= long_line; });
    text_.num_blocks = 1;
    if (is_long && assembly_.applies()) {
      const auto most = static_cast<int>(block_.shared_bytes / std::max<std::size_t>(text_.shared_bytes, 1));
      text_.num_blocks = std::max(1, std::min(most, threads_of_processor / text_.num_threads));
    }
    text_.text = begin_text(program_, function_, fmt::format("elems = {}", text_.num_elem), "elements.hpp",
                            !assembly_.applies(), text_) +
                 "  HG_SHARED(shared);\n" + phases_.declarations() +
                 "  const CeedSize first = block() * elems, left = job.facts.num_elem - first;\n"
                 "  const int count = left < elems ? static_cast<int>(left) : elems;\n" +
                 phases_.text() + "}\n}\n";
    return std::move(text_);
  }

  struct Values {
    int array = -1;
    Shape shape;
    int column = -1;  ///< of derivatives: values whose derivatives along z are taken column by column
  };
  const Block &block_;
  const CeedProgram &program_;
  const FunctionText &function_;
  AssemblyText assembly_;
  std::vector<BasisFactors> bases_;
  Phases phases_;
  OperatorText text_;
  std::vector<Evaluation> evaluations_, integrations_;
  std::vector<Values> inputs_;       ///< of the first input that has them
  std::vector<int> outputs_;         ///< arrays
  std::vector<int> sources_, sums_;  ///< arrays of nodes, or -1
  std::vector<Shape> sink_shapes_;
  std::vector<int> columns_of_outputs_;                    ///< arrays of what is integrated column by column
  std::vector<std::string> point_;                         ///< what is done at a point,
  std::vector<std::string> before_column_, after_column_;  ///< and for a column of them
  int num_arrays_ = 0, call_ = 0, last_ = 0, columns_ = -1;
  CeedInt lines_ = 1;   ///< most lines of an element in a step
  CeedInt column_ = 0;  ///< points of a column, where some derivatives are taken so
};

}  // namespace

OperatorText elements_text(const Block &block, const CeedProgram &program, const FunctionText &function,
                           Purpose purpose) {
  if (!is_taken(program) || program.num_qpts == 0 || program.num_outputs == 0) return {};
  AssemblyText assembly(program, purpose);
  if (!assembly.is_taken()) return {};
  return ElementPrinter(block, program, function, std::move(assembly)).print();
}

}  // namespace hg::gpu
