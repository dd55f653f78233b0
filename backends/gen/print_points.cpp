/// Operators at points of the elements' own: nodes are gathered and turned into Chebyshev coefficients for W elements
/// side by side; then up to two packs of points, along one element or across all, go through evaluation, QFunction and
/// integration at once: what is at a point is there for that long only, and polynomials are tabulated once for all
/// fields.
#include <algorithm>

#include "../host/access.hpp"
#include "../host/fields.hpp"
#include "print.hpp"

namespace hg::gen {

namespace {

using host::Evaluation, host::evaluation_of, host::PointBasis;

const CeedElementMap &map_of(const CeedProgramSide &side) {
  const CeedElementMap *map = nullptr;
  host::chk(CeedElemRestrictionGetElementMap(side.rstr, &map));
  return *map;
}

bool takes(const CeedProgramSide &side) {
  const CeedElementMap &map = map_of(side);
  return side.is_points || (map.type == CEED_RESTRICTION_STANDARD && map.num_bands == 0 && map.block_size == 1);
}

class PointPrinter {
 public:
  PointPrinter(const CeedProgram &program, const std::string &function, const std::vector<const PointBasis *> &bases,
               CeedInt width)
      : program_(program), function_(function), bases_(bases), to_(width) {
    for (CeedInt i = 0; i < program.num_inputs; i++) {
      const CeedProgramField &field = program.inputs[i];
      if (field.eval_mode == CEED_EVAL_NONE || field.eval_mode == CEED_EVAL_WEIGHT) continue;
      evaluation_of(evaluations_, field, false).array_of(field) = i;
    }
    for (CeedInt o = 0; o < program.num_outputs; o++) {
      const CeedProgramField &field = program.outputs[o];
      if (field.eval_mode != CEED_EVAL_NONE) evaluation_of(integrations_, field, false).array_of(field) = o;
    }
  }

  /// `is_exact`: the QFunction is called for the points that there are and no others, but for those that fill up its
  /// vector length.
  Printed print(bool is_exact, CeedInt vec_length) {
    print_function();
    to_.line("extern \"C\" __attribute__((visibility(\"default\"))) int hg_apply(Job *job) {{");
    declare();
    to_.line("Ahead ahead{{}}, ahead_x{{}};");
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      if (program_.sources[s].is_points) to_.line("Ahead ahead{}{{}};", s);
    }
    if (evaluations_.empty() && integrations_.empty()) {
      print_list(is_exact, vec_length);
    } else {
      print_blocks(is_exact, vec_length);
    }
    to_.line("return 0;");
    to_.line("}}");
    Printed printed = std::move(to_).printed();
    printed.does_all = true;
    return printed;
  }

 private:
  const PointBasis &basis(const Evaluation &e) const { return *bases_[e.space]; }
  CeedInt num_coefficients(const Evaluation &e) const { return static_cast<CeedInt>(basis(e).num_coefficients()); }
  std::string name(const std::vector<Evaluation> &list, const Evaluation &e, const char *what) const {
    return fmt::format("{}{}", what, &e - list.data());
  }

  void declare() {
    has_nodes_in_.resize(program_.num_sources);
    has_nodes_out_.resize(program_.num_sinks);
    for (const Evaluation &e : evaluations_) has_nodes_in_[e.side] = true;
    for (const Evaluation &e : integrations_) has_nodes_out_[e.side] = true;
    std::size_t rows = 0, chain = 0;
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      if (!has_nodes_in_[s]) continue;
      const CeedElementMap &map = map_of(program_.sources[s]);
      to_.array(fmt::format("nodes{}", s), static_cast<std::size_t>(map.elem_size) * map.num_comp);
    }
    for (CeedInt t = 0; t < program_.num_sinks; t++) {
      if (!has_nodes_out_[t]) continue;
      const CeedElementMap &map = map_of(program_.sinks[t]);
      const std::size_t size = static_cast<std::size_t>(map.elem_size) * map.num_comp;
      to_.array(fmt::format("sum{}", t), size);
      rows = std::max(rows, size);
    }
    for (const Evaluation &e : evaluations_) to_.array(name(evaluations_, e, "coefficients"), num_coefficients(e));
    for (const Evaluation &e : integrations_) {
      to_.array(name(integrations_, e, "sums"), num_coefficients(e));
      to_.array(name(integrations_, e, "back"), num_coefficients(e));
      to_.line("clear<{}>({});", num_coefficients(e), name(integrations_, e, "back"));
    }
    for (const PointBasis *basis : bases_) {
      if (basis == nullptr) continue;
      const CeedInt widest = std::max(basis->K(), basis->P());
      chain = std::max(chain, static_cast<std::size_t>(CeedIntPow(widest, basis->dim())) * basis->num_comp());
    }
    for (const char *array : {"chain0", "chain1"}) to_.array(array, chain);
    to_.array("rows", rows);
  }

  void read_nodes(CeedInt s) {
    if (!has_nodes_in_[s]) return;
    const CeedElementMap &map = map_of(program_.sources[s]);
    to_.line("read_nodes<{0}, {1}>(job->sources[{2}], job->inputs[{2}], first, num_elem, 0, nodes{2});", map.elem_size,
             map.num_comp, s);
  }

  void to_coefficients(const Evaluation &e) {
    const PointBasis &b = basis(e);
    std::string from = fmt::format("nodes{}", e.side);
    for (CeedInt d = 0; d < b.dim(); d++) {
      const CeedInt columns = CeedIntPow(b.K(), d);
      const std::string to = d == b.dim() - 1 ? name(evaluations_, e, "coefficients") : fmt::format("chain{}", d % 2);
      to_.contract(b.matrix(), false, b.num_comp() * CeedIntPow(b.P(), b.dim() - 1 - d), columns,
                   {from, b.P() * columns, columns}, {to, b.K() * columns, columns});
      from = to;
    }
  }

  void from_coefficients(const Evaluation &e) {
    const PointBasis &b = basis(e);
    std::string from = name(integrations_, e, "back");
    for (CeedInt d = 0; d < b.dim(); d++) {
      const bool is_last = d == b.dim() - 1;
      const CeedInt columns = CeedIntPow(b.P(), d);
      const std::string to = is_last ? fmt::format("sum{}", e.side) : fmt::format("chain{}", d % 2);
      to_.contract(b.matrix(), true, b.num_comp() * CeedIntPow(b.K(), b.dim() - 1 - d), columns,
                   {from, b.K() * columns, columns}, {to, b.P() * columns, columns}, is_last && e.add);
      from = to;
    }
  }

  /// Where nothing belongs to elements the points of all lie along one.
  void print_list(bool is_exact, CeedInt vec_length) {
    print_some_points(is_exact);
    to_.line("const CeedInt start = first_point(*job->points, job->first);");
    to_.line("const CeedInt num_points = first_point(*job->points, job->end) - start;");
    print_along("job->first", "0", "element_of(*job->points, job->end, start + p)", is_exact, vec_length);
  }

  void print_blocks(bool is_exact, CeedInt vec_length) {
    print_some_points(is_exact);
    to_.line("for (CeedInt first = job->first; first < job->end; first += W) {{");
    to_.line("const CeedInt num_elem = job->end - first < W ? job->end - first : W;");
    to_.line("const BlockPoints block(*job->points, first, num_elem);");
    to_.line("if (block.total == 0) continue;");
    ask_for_points();
    for (CeedInt s = 0; s < program_.num_sources; s++) read_nodes(s);
    for (const Evaluation &e : evaluations_) to_coefficients(e);
    if (!is_exact) {
      to_.line("if (block.is_across) {{");
      print_across();
      to_.line("}} else {{");
    }
    to_.line("for (CeedInt lane = 0; lane < num_elem; lane++) {{");
    to_.line("const CeedInt num_points = block.count[lane];");
    for_integrations(
        [&](const std::string &sums, const std::string &, CeedInt n) { to_.line("clear<{}>({});", n, sums); });
    print_along("first + lane", "lane", "first + lane", is_exact, vec_length);
    for_integrations([&](const std::string &sums, const std::string &back, CeedInt n) {
      to_.line("reduce<W>({}, {}, {} + lane);", sums, n, back);
    });
    to_.line("}}");
    if (!is_exact) to_.line("}}");
    for (const Evaluation &e : integrations_) from_coefficients(e);
    for (CeedInt t = 0; t < program_.num_sinks; t++) write_nodes(t);
    to_.line("}}");
  }

  /// What is stored at the points of the next block is asked for while this one is worked on.
  void ask_for_points() {
    to_.line("ahead_x = points_ahead<{}>(*job->points, job->x_ref, first + num_elem, job->end);",
             program_at_points_dim());
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      if (!program_.sources[s].is_points) continue;
      to_.line("ahead{0} = points_ahead<{1}>(job->sources[{0}], job->inputs[{0}], first + num_elem, job->end);", s,
               program_.sources[s].num_comp);
    }
  }

  template <typename Visit>
  void for_integrations(Visit &&visit) const {
    for (const Evaluation &e : integrations_) {
      visit(name(integrations_, e, "sums"), name(integrations_, e, "back"), num_coefficients(e));
    }
  }

  /// Two points of each element at a time.
  void print_across() {
    for_integrations(
        [&](const std::string &, const std::string &back, CeedInt n) { to_.line("clear<{}>({});", n, back); });
    to_.line("for (CeedInt k = 0; k < block.most; k += 2) {{");
    to_.line("const int code = k + 1 < block.most ? some_points(Count<2>(), Across{{block, k, 2 * W}})");
    to_.line("                                    : some_points(Count<1>(), Across{{block, k, W}});");
    print_failure("first");
    to_.line("}}");
  }

  void print_failure(const char *element) {
    to_.line("if (code != 0) {{");
    to_.line("job->failed = {};", element);
    to_.line("return code;");
    to_.line("}}");
  }

  /// num_points points of one element, two packs at a time.
  void print_along(const char *element, const char *lane, const char *failed, bool is_exact, CeedInt vec_length) {
    to_.line("for (CeedInt p = 0; p < num_points;) {{");
    to_.line("const CeedInt left = num_points - p;");
    const auto some = [&](int packs, const char *n, const char *stride) {
      return fmt::format("some_points(Count<{}>(), Along{{{}, {}, p, {}, {}}})", packs, element, lane, n, stride);
    };
    if (is_exact) {
      to_.line("const CeedInt stride = left < W ? (left + {0} - 1) / {0} * {0} : W;", vec_length);
      to_.line("const int code = left > 2 * W - 1 ? {}", some(2, "2 * W", "2 * W"));
      to_.line("                 : {};", some(1, "left < W ? left : W", "stride"));
    } else {
      to_.line("const int code = left > W ? {}", some(2, "left < 2 * W ? left : 2 * W", "2 * W"));
      to_.line("                          : {};", some(1, "left", "W"));
    }
    print_failure(failed);
    to_.line("p += left > {} ? 2 * W : W;", is_exact ? "2 * W - 1" : "W");
    to_.line("}}");
  }

  /// The names of the QFunction's arrays, in order, each after `before` and its kind.
  std::string fields(const char *before_in, const char *before_out) const {
    std::string text;
    for (CeedInt i = 0; i < program_.num_inputs; i++) text += fmt::format("{}in{}", before_in, i);
    for (CeedInt o = 0; o < program_.num_outputs; o++)
      text += fmt::format("{}out{}", *before_out ? before_out : before_in, o);
    return text;
  }
  std::string list_of(const char *what, CeedInt count) const {
    std::string text;
    for (CeedInt i = 0; i < count; i++) text += fmt::format("{}{}{}", i > 0 ? ", " : "", what, i);
    return count > 0 ? text : "nullptr";
  }

  /// The QFunction, with arrays that do not overlap. It is called from several places: compilers may take a large one
  /// into one function instead of four, which is most of their time. fixed_Q > 0: Q.
  void print_function() {
    to_.line("template <int fixed_Q>");
    to_.line("inline int function(void *context, CeedInt Q{}) {{",
             fields(", const CeedScalar *__restrict ", ", CeedScalar *__restrict "));
    to_.line("const CeedScalar *const in[] = {{{}}};", list_of("in", program_.num_inputs));
    to_.line("CeedScalar *const out[] = {{{}}};", list_of("out", program_.num_outputs));
    to_.line("return ::{}(context, fixed_Q > 0 ? fixed_Q : Q, in, out);", function_);
    to_.line("}}");
    to_.line("");
  }

  /// All that is done with one or two packs of points.
  void print_some_points(bool is_exact) {
    to_.line("const auto some_points = [&](auto count, const auto &points) __attribute__((always_inline)) {{");
    to_.line("constexpr int packs = decltype(count)::value;");
    to_.line("const CeedInt stride = points.stride;");
    if (const std::vector<CeedInt> all = tables(); !all.empty()) {
      to_.line("ask<packs>(ahead_x);");
      to_.line("alignas(64) CeedScalar x_ref[({} * packs + 1) * W];", program_at_points_dim());
      to_.line("read_points<{}>(*job->points, job->x_ref, points, x_ref);", program_at_points_dim());
      for (const CeedInt K : all) {
        to_.line("PointTable table{}[packs];", K);
        to_.line("tabulate<packs>({}, {}, x_ref, stride, table{});", program_at_points_dim(), K, K);
      }
    }
    for (CeedInt i = 0; i < program_.num_inputs; i++) declare_input(i);
    for (const Evaluation &e : evaluations_) evaluate(e);
    for (CeedInt o = 0; o < program_.num_outputs; o++) {
      to_.line("alignas(64) CeedScalar out{}[({} * packs + 1) * W];", o, program_.outputs[o].size);
    }
    to_.line("const int code = function<{}>(job->context, stride{});", is_exact ? "0" : "packs * W", fields(", ", ""));
    to_.line("if (code != 0) return code;");
    for (const Evaluation &e : integrations_) integrate(e);
    for (CeedInt o = 0; o < program_.num_outputs; o++) write(o);
    to_.line("return 0;");
    to_.line("}};");
  }

  CeedInt program_at_points_dim() const {
    const CeedElementMap *map = nullptr;
    host::chk(CeedElemRestrictionGetElementMap(program_.points_rstr, &map));
    return map->num_comp;
  }

  /// The numbers of coefficients for which polynomials are tabulated.
  std::vector<CeedInt> tables() const {
    std::vector<CeedInt> all;
    for (const auto *list : {&evaluations_, &integrations_}) {
      for (const Evaluation &e : *list) {
        if (std::find(all.begin(), all.end(), basis(e).K()) == all.end()) all.push_back(basis(e).K());
      }
    }
    return all;
  }

  void declare_input(CeedInt i) {
    const CeedProgramField &field = program_.inputs[i];
    to_.line("alignas(64) CeedScalar in{}[({} * packs + 1) * W];", i, field.size);
    if (field.eval_mode == CEED_EVAL_WEIGHT) {
      to_.line("for (CeedInt q = 0; q < stride; q++) in{}[q] = 1;", i);
    } else if (field.eval_mode == CEED_EVAL_NONE) {
      to_.line("ask<packs>(ahead{});", field.side);
      to_.line("read_points<{0}>(job->sources[{1}], job->inputs[{1}], points, in{2});", field.size, field.side, i);
    }
  }

  void evaluate(const Evaluation &e) {
    const PointBasis &b = basis(e);
    to_.line("evaluate_at<{}, {}, {}, {}>(table{}, {}, points, {}, {});", b.dim(), b.K(), b.num_comp(),
             e.derivative >= 0, b.K(), name(evaluations_, e, "coefficients"), array_name("in", e.interp),
             array_name("in", e.derivative));
  }

  void integrate(const Evaluation &e) {
    const PointBasis &b = basis(e);
    for (const int o : {e.interp, e.derivative}) {
      if (o >= 0) to_.line("drop_repeated<{}>(points, out{});", program_.outputs[o].size, o);
    }
    to_.line("integrate_at<{}, {}, {}, {}>(table{}, points, {}, {}, {}, {});", b.dim(), b.K(), b.num_comp(),
             e.derivative >= 0, b.K(), array_name("out", e.interp), array_name("out", e.derivative),
             name(integrations_, e, "sums"), name(integrations_, e, "back"));
  }

  static std::string array_name(const char *what, int place) {
    return place < 0 ? "static_cast<CeedScalar *>(nullptr)" : fmt::format("{}{}", what, place);
  }

  void write(CeedInt o) {
    const CeedProgramField &field = program_.outputs[o];
    if (field.eval_mode != CEED_EVAL_NONE) return;
    to_.line("write_points<{0}>(job->sinks[{1}], points, out{2}, job->sets[{1}], job->outputs[{1}]);", field.size,
             field.side, o);
  }

  void write_nodes(CeedInt t) {
    if (!has_nodes_out_[t]) return;
    const CeedElementMap &map = map_of(program_.sinks[t]);
    to_.line("add_nodes<{0}, {1}>(job->sinks[{2}], first, num_elem, 0, sum{2}, rows, job->outputs[{2}]);",
             map.elem_size, map.num_comp, t);
  }

  const CeedProgram &program_;
  const std::string &function_;
  const std::vector<const PointBasis *> &bases_;
  Printer to_;
  std::vector<Evaluation> evaluations_, integrations_;
  std::vector<bool> has_nodes_in_, has_nodes_out_;
};

}  // namespace

Printed print_points(const host::Kernels &kernels, const CeedProgram &program, const std::string &function,
                     const std::vector<const PointBasis *> &bases) {
  for (CeedInt s = 0; s < program.num_sources; s++) {
    if (!takes(program.sources[s])) return {};
  }
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    if (!takes(program.sinks[t])) return {};
  }
  CeedInt vec_length = 1;
  host::chk(CeedQFunctionGetVectorLength(program.qf, &vec_length));
  if (kernels.width % vec_length != 0) return {};
  return PointPrinter(program, function, bases, kernels.width).print(host::may_count_points(program.qf), vec_length);
}

}  // namespace hg::gen
