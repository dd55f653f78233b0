/// Operators at quadrature points. Where all bases are tensor products, the QFunction is called for a slice of points
/// at a time, those of one plane (of one line in two dimensions): what is stored at the points, and what the QFunction
/// reads and writes, then stay in the first cache. Only what couples the slices, values and the derivative along the
/// last direction, is there for all points.
#include <algorithm>

#include "../host/access.hpp"
#include "../host/fields.hpp"
#include "print.hpp"

namespace hg::gen {

namespace {

using host::BlockBasis, host::Evaluation, host::evaluation_of;
using Route = BlockBasis::Route;

/// How a side is read and written: by offsets, or as rows of numbers.
const char *kind_of(const CeedElementMap &map) {
  return map.offsets != nullptr ? "nodes" : "stored";
}

bool takes(const CeedProgramSide &side) {
  const CeedElementMap *map = nullptr;
  host::chk(CeedElemRestrictionGetElementMap(side.rstr, &map));
  const bool is_stored = map->type == CEED_RESTRICTION_STRIDED && map->strides[0] == 1;
  return is_stored || (map->type == CEED_RESTRICTION_STANDARD && map->num_bands == 0 && map->block_size == 1);
}

class BlockPrinter {
 public:
  BlockPrinter(const host::Kernels &kernels, const CeedProgram &program, const std::string &function,
               const std::vector<const BlockBasis *> &bases)
      : program_(program),
        function_(function),
        bases_(bases),
        to_(kernels.width),
        W_(kernels.width),
        Q_(program.num_qpts) {
    slice();
  }

  /// Whether the points of a slice are such a number as the QFunction wants.
  bool takes(CeedInt width) const {
    CeedInt vec_length = 1;
    host::chk(CeedQFunctionGetVectorLength(program_.qf, &vec_length));
    return n_ * width % vec_length == 0;
  }

  Printed print() {
    to_.line("extern \"C\" __attribute__((visibility(\"default\"))) int hg_apply(Job *job) {{");
    declare_inputs();
    declare_outputs();
    to_.line("for (CeedInt first = job->first; first < job->end; first += W) {{");
    to_.line("{}", ahead_mark);
    for (CeedInt s = 0; s < program_.num_sources; s++) read_nodes(s);
    for (const Evaluation &e : evaluations_) evaluate(e);
    ask();
    to_.line("for (CeedInt k = 0; k < {}; k++) {{", num_slices_);
    to_.repeat(num_slices_);
    for (const Evaluation &e : evaluations_) evaluate_slice(e);
    for (CeedInt i = 0; i < program_.num_inputs; i++) read_slice(i);
    call();
    for (const Evaluation &e : integrations_) integrate_slice(e);
    for (CeedInt o = 0; o < program_.num_outputs; o++) write_slice(o);
    to_.line("}}");
    to_.repeat(1);
    for (const Evaluation &e : integrations_) integrate(e);
    for (CeedInt t = 0; t < program_.num_sinks; t++) write_nodes(t);
    to_.line("}}");
    to_.line("return 0;");
    to_.line("}}");
    plan_ahead();
    return std::move(to_).printed();
  }

 private:
  static constexpr const char *ahead_mark = "Ahead ahead;";

  /// What is stored at the points streams by once: the largest such source of the next block is asked for while this
  /// one is worked on, a few lines at each step.
  void plan_ahead() {
    CeedSize largest = 0;
    CeedInt source = -1;
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      const CeedElementMap &map = map_of(program_.sources[s]);
      const CeedSize size = static_cast<CeedSize>(map.elem_size) * map.num_comp;
      if (has_nodes_in_[s] || map.offsets != nullptr || map.strides[2] != size || size <= largest) continue;
      largest = size;
      source = s;
    }
    if (source < 0 || to_.num_steps() == 0) return;
    const CeedSize lines =
        (largest * W_ * static_cast<CeedSize>(sizeof(CeedScalar)) + host::Ahead::line - 1) / host::Ahead::line;
    to_.fill_in(ahead_mark, fmt::format("Ahead ahead = ahead_of(job->sources[{0}], job->inputs[{0}], first, {1});",
                                        source, (lines + to_.num_steps() - 1) / to_.num_steps()));
  }

  static CeedInt power(CeedInt base, CeedInt exponent) { return CeedIntPow(base, exponent); }
  const BlockBasis &basis(const Evaluation &e) const { return *bases_[e.space]; }
  static bool is_at_points(const BlockBasis &basis) {
    return basis.route() == Route::identity || basis.route() == Route::collocated;
  }

  /// Slices of n points pay where rows of them fill packs, or little is read beside what is evaluated: else turning
  /// what is left over of the rows costs more than the second cache.
  bool slices_pay(CeedInt n) const {
    CeedInt stored = 0, evaluated = 0;
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      const CeedProgramField &field = program_.inputs[i];
      if (field.eval_mode == CEED_EVAL_NONE) {
        stored += field.size;
      } else if (field.eval_mode != CEED_EVAL_WEIGHT) {
        evaluated += field.size;
      }
    }
    return n % W_ == 0 || (n > W_ && stored <= evaluated);
  }

  /// Slices are lines or planes of points, where all bases have the same.
  void slice() {
    CeedInt Q = 0, dim = 0;
    bool can = true;
    for (const BlockBasis *basis : bases_) {
      can = can && is_at_points(*basis) && basis->num_directions() > 1;
      can = can && (dim == 0 || (basis->Q() == Q && basis->num_directions() == dim));
      Q = basis->Q();
      dim = basis->num_directions();
    }
    num_slices_ = can && dim > 0 && slices_pay(Q_ / Q) ? Q : 1;
    n_ = Q_ / num_slices_;
  }
  bool is_sliced() const { return num_slices_ > 1; }
  /// Derivatives along the first `inside` directions are taken in a slice.
  CeedInt inside(const BlockBasis &basis) const { return basis.num_directions() - (is_sliced() ? 1 : 0); }

  const CeedElementMap &map_of(const CeedProgramSide &side) const {
    const CeedElementMap *map = nullptr;
    host::chk(CeedElemRestrictionGetElementMap(side.rstr, &map));
    return *map;
  }

  /// Values at all points: component c of slice k begins at pack k*slice + c*comp.
  struct Values {
    std::string array;
    CeedInt comp, slice;
  };
  Values values_of(const Evaluation &e, const std::string &nodes, const std::string &points) const {
    const BlockBasis &b = basis(e);
    if (b.route() == Route::identity) return {nodes, Q_, n_};
    return {points, n_, b.num_comp() * n_};
  }
  std::string at_slice(const std::string &array, CeedInt packs) const {
    return is_sliced() ? fmt::format("{} + k * {} * W", array, packs) : array;
  }
  static std::string plus(const std::string &array, CeedInt packs) {
    return packs == 0 ? array : fmt::format("{} + {} * W", array, packs);
  }
  std::string id(const std::vector<Evaluation> &list, const Evaluation &e, const char *what) const {
    return fmt::format("{}{}", what, &e - list.data());
  }

  // Fields' arrays are known by the number of the input or output; that of an evaluation's interp and derivative, too.
  void declare_inputs() {
    input_.resize(program_.num_inputs);
    has_nodes_in_.resize(program_.num_sources);
    for (CeedInt i = 0; i < program_.num_inputs; i++) {
      const CeedProgramField &field = program_.inputs[i];
      if (field.eval_mode == CEED_EVAL_WEIGHT) {
        const auto &weights = bases_[field.space]->weights();
        input_[i] = at_slice(to_.array(fmt::format("weights{}", i), Q_), n_);
        to_.line("fill<{}>({}, weights{});", Q_, to_.numbers(weights.data()), i);
      } else if (field.eval_mode == CEED_EVAL_NONE) {
        input_[i] = to_.array(fmt::format("in{}", i), static_cast<std::size_t>(field.size) * n_);
      } else {
        Evaluation &e = evaluation_of(evaluations_, field, !program_.sources[field.side].is_active);
        int &place = e.array_of(field);
        if (place < 0) place = i;
        first_with_.push_back({i, place});
        has_nodes_in_[field.side] = true;
      }
    }
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      if (!has_nodes_in_[s]) continue;
      const CeedElementMap &map = map_of(program_.sources[s]);
      to_.array(fmt::format("nodes{}", s), static_cast<std::size_t>(map.elem_size) * map.num_comp);
    }
    CeedInt chain = 0;
    for (const BlockBasis *basis : bases_) {
      const CeedInt dim = basis->num_directions();
      chain = std::max(chain, basis->num_comp() * power(std::max(basis->P(), basis->Q()), dim));
    }
    for (const char *name : {"chain0", "chain1"}) to_.array(name, chain);
    for (const Evaluation &e : evaluations_) declare_evaluation(e);
    for (const auto &[i, place] : first_with_) input_[i] = input_[place];
  }

  void declare_evaluation(const Evaluation &e) {
    const BlockBasis &b = basis(e);
    const CeedInt nc = b.num_comp(), dim = b.num_directions();
    const std::string values = id(evaluations_, e, "values"), across = id(evaluations_, e, "across");
    if (is_at_points(b)) {
      if (b.route() == Route::collocated) to_.array(values, static_cast<std::size_t>(nc) * Q_);
      if (e.interp >= 0) {
        const Values v = values_of(e, fmt::format("nodes{}", e.side), values);
        const bool lies_together = nc == 1 || v.comp == n_;
        input_[e.interp] = lies_together ? at_slice(v.array, v.slice)
                                         : to_.array(id(evaluations_, e, "interp"), static_cast<std::size_t>(nc) * n_);
      }
      if (e.derivative >= 0) {
        input_[e.derivative] = to_.array(id(evaluations_, e, "derivative"), static_cast<std::size_t>(dim) * nc * n_);
        if (is_sliced()) to_.array(across, static_cast<std::size_t>(nc) * Q_);
      }
      return;
    }
    if (e.interp >= 0) {
      input_[e.interp] = to_.array(values, static_cast<std::size_t>(program_.inputs[e.interp].size) * Q_);
    }
    if (e.derivative >= 0) {
      input_[e.derivative] = to_.array(id(evaluations_, e, "derivative"),
                                       static_cast<std::size_t>(program_.inputs[e.derivative].size) * Q_);
    }
  }

  void declare_outputs() {
    output_.resize(program_.num_outputs);
    has_nodes_out_.resize(program_.num_sinks);
    std::size_t rows = 0;
    for (CeedInt o = 0; o < program_.num_outputs; o++) {
      const CeedProgramField &field = program_.outputs[o];
      if (field.eval_mode == CEED_EVAL_NONE) {
        output_[o] = to_.array(fmt::format("out{}", o), static_cast<std::size_t>(field.size) * n_);
        rows = std::max(rows, static_cast<std::size_t>(field.size) * n_);
      } else {
        evaluation_of(integrations_, field, false).array_of(field) = o;
        has_nodes_out_[field.side] = true;
      }
    }
    for (CeedInt t = 0; t < program_.num_sinks; t++) {
      if (!has_nodes_out_[t]) continue;
      const CeedElementMap &map = map_of(program_.sinks[t]);
      const std::size_t size = static_cast<std::size_t>(map.elem_size) * map.num_comp;
      to_.array(fmt::format("sum{}", t), size);
      rows = std::max(rows, size);
    }
    for (const Evaluation &e : integrations_) declare_integration(e);
    to_.array("rows", rows);
  }

  void declare_integration(const Evaluation &e) {
    const BlockBasis &b = basis(e);
    const CeedInt nc = b.num_comp(), dim = b.num_directions();
    const std::string values = id(integrations_, e, "back");
    if (!is_at_points(b)) {
      for (const int o : {e.interp, e.derivative}) {
        if (o < 0) continue;
        output_[o] = to_.array(fmt::format("out{}", o), static_cast<std::size_t>(program_.outputs[o].size) * Q_);
      }
      return;
    }
    if (b.route() == Route::collocated) to_.array(values, static_cast<std::size_t>(nc) * Q_);
    if (e.interp >= 0) {
      const Values v = values_of(e, fmt::format("sum{}", e.side), values);
      output_[e.interp] = writes_in_place(e)
                              ? at_slice(v.array, v.slice)
                              : to_.array(fmt::format("out{}", e.interp), static_cast<std::size_t>(nc) * n_);
    }
    if (e.derivative >= 0) {
      output_[e.derivative] = to_.array(fmt::format("out{}", e.derivative), static_cast<std::size_t>(dim) * nc * n_);
      if (is_sliced()) to_.array(id(integrations_, e, "along"), static_cast<std::size_t>(nc) * Q_);
    }
  }
  /// Whether the QFunction writes values where they are summed up.
  bool writes_in_place(const Evaluation &e) const {
    const BlockBasis &b = basis(e);
    return b.route() == Route::collocated || (!e.add && (b.num_comp() == 1 || !is_sliced()));
  }

  void read_nodes(CeedInt s) {
    if (!has_nodes_in_[s]) return;
    const CeedElementMap &map = map_of(program_.sources[s]);
    to_.line("read_{0}<{1}, {2}>(job->sources[{3}], job->inputs[{3}], first, W, 0, nodes{3});", kind_of(map),
             map.elem_size, map.num_comp, s);
  }

  /// All that there is before slices: values, and what couples them.
  void evaluate(const Evaluation &e) {
    const BlockBasis &b = basis(e);
    const CeedInt nc = b.num_comp(), dim = b.num_directions();
    const std::string nodes = fmt::format("nodes{}", e.side), values = id(evaluations_, e, "values");
    switch (b.route()) {
      case Route::identity:
        break;
      case Route::collocated:
        to_points(b, -1, nodes, values);
        break;
      case Route::chains:
        if (e.interp >= 0) to_points(b, -1, nodes, values);
        for (CeedInt d = 0; e.derivative >= 0 && d < dim; d++) {
          to_points(b, d, nodes, plus(id(evaluations_, e, "derivative"), d * nc * Q_));
        }
        return;
      case Route::full:
        if (e.interp >= 0) apply_all(b.interp(), nc, nodes, values);
        if (e.derivative >= 0) apply_all(b.derivative(), nc, nodes, id(evaluations_, e, "derivative"));
        return;
    }
    if (e.derivative < 0 || !is_sliced()) return;
    const Values v = values_of(e, nodes, values);
    to_.contract(b.grad_1d(), false, nc, n_, {v.array, v.comp, v.slice}, {id(evaluations_, e, "across"), n_, nc * n_});
  }

  void apply_all(const std::vector<host::Factor> &factors, CeedInt nc, const std::string &nodes,
                 const std::string &values) {
    for (std::size_t g = 0; g < factors.size(); g++) {
      const auto &B = factors[g].direction(false);
      to_.contract(factors[g], false, nc, 1, {nodes, B.N, 1},
                   {plus(values, static_cast<CeedInt>(g) * nc * B.M), B.M, 1});
    }
  }

  /// Direction after direction, the last one into slices.
  void to_points(const BlockBasis &b, CeedInt derived, const std::string &nodes, const std::string &values) {
    const CeedInt nc = b.num_comp(), dim = b.num_directions(), P = b.P(), Q = b.Q();
    std::string from = nodes;
    for (CeedInt d = 0; d < dim; d++) {
      const host::Factor &factor = d == derived ? b.grad_1d() : b.interp_1d();
      const CeedInt columns = power(Q, d), pre = nc * power(P, dim - 1 - d);
      const std::string to = d == dim - 1 ? values : fmt::format("chain{}", d % 2);
      const bool into_slices = is_sliced() && d == dim - 1;
      to_.contract(factor, false, pre, columns, {from, P * columns, columns},
                   into_slices ? Printer::Rows{to, n_, nc * n_} : Printer::Rows{to, Q * columns, columns});
      from = to;
    }
  }

  void evaluate_slice(const Evaluation &e) {
    const BlockBasis &b = basis(e);
    if (!is_at_points(b)) return;
    const CeedInt nc = b.num_comp(), Q = b.Q();
    const Values v = values_of(e, fmt::format("nodes{}", e.side), id(evaluations_, e, "values"));
    const std::string slice = at_slice(v.array, v.slice);
    if (e.interp >= 0 && input_[e.interp] != slice) {
      to_.line("copy_rows<{}, {}>({}, {}, {}, {});", nc, n_, slice, v.comp, input_[e.interp], n_);
    }
    if (e.derivative < 0) return;
    const std::string &derivative = input_[e.derivative];
    for (CeedInt d = 0; d < inside(b); d++) {
      const CeedInt columns = power(Q, d), pre = power(Q, inside(b) - 1 - d);
      for_components(nc, v.comp, [&](CeedInt first, CeedInt count) {
        to_.contract(b.grad_1d(), false, count * pre, columns, {plus(slice, first * v.comp), Q * columns, columns},
                     {plus(derivative, (d * nc + first) * n_), Q * columns, columns});
      });
    }
    if (is_sliced()) {
      to_.line("copy<{}>({}, {});", nc * n_, at_slice(id(evaluations_, e, "across"), nc * n_),
               plus(derivative, inside(b) * nc * n_));
    }
  }

  /// All components at once where they lie together, else one after another.
  template <typename Visit>
  void for_components(CeedInt nc, CeedInt comp_step, Visit &&visit) const {
    if (comp_step == n_) {
      visit(0, nc);
    } else {
      for (CeedInt c = 0; c < nc; c++) visit(c, 1);
    }
  }

  void read_slice(CeedInt i) {
    const CeedProgramField &field = program_.inputs[i];
    if (field.eval_mode != CEED_EVAL_NONE) return;
    const CeedElementMap &map = map_of(program_.sources[field.side]);
    to_.line("read_{0}<{1}, {2}, {3}>(job->sources[{4}], job->inputs[{4}], first, W, {5}, {6});", kind_of(map),
             map.elem_size, map.num_comp, n_, field.side, is_sliced() ? fmt::format("k * {}", n_) : "0", input_[i]);
  }

  void call() {
    to_.line("const CeedScalar *const in[] = {{{}}};",
             input_.empty() ? "nullptr" : fmt::format("{}", fmt::join(input_, ", ")));
    to_.line("CeedScalar *const out[] = {{{}}};",
             output_.empty() ? "nullptr" : fmt::format("{}", fmt::join(output_, ", ")));
    to_.line("if (const int code = ::{}(job->context, {} * W, in, out); code != 0) {{", function_, n_);
    to_.line("job->failed = first;");
    to_.line("return code;");
    to_.line("}}");
  }

  void integrate_slice(const Evaluation &e) {
    const BlockBasis &b = basis(e);
    if (!is_at_points(b)) return;
    const CeedInt nc = b.num_comp(), Q = b.Q();
    const Values v = values_of(e, fmt::format("sum{}", e.side), id(integrations_, e, "back"));
    const std::string slice = at_slice(v.array, v.slice);
    bool add = b.route() == Route::identity && e.add;
    if (e.interp >= 0) {
      if (!writes_in_place(e)) {
        to_.line("copy_rows<{}, {}, {}>({}, {}, {}, {});", nc, n_, add, output_[e.interp], n_, slice, v.comp);
      }
      add = true;
    }
    if (e.derivative < 0) return;
    const std::string &derivative = output_[e.derivative];
    for (CeedInt d = 0; d < inside(b); d++) {
      const CeedInt columns = power(Q, d), pre = power(Q, inside(b) - 1 - d);
      for_components(nc, v.comp, [&](CeedInt first, CeedInt count) {
        to_.contract(b.grad_1d(), true, count * pre, columns,
                     {plus(derivative, (d * nc + first) * n_), Q * columns, columns},
                     {plus(slice, first * v.comp), Q * columns, columns}, add);
      });
      add = true;
    }
    if (is_sliced()) {
      to_.line("copy<{}>({}, {});", nc * n_, plus(derivative, inside(b) * nc * n_),
               at_slice(id(integrations_, e, "along"), nc * n_));
    }
  }

  void write_slice(CeedInt o) {
    const CeedProgramField &field = program_.outputs[o];
    if (field.eval_mode != CEED_EVAL_NONE) return;
    const CeedElementMap &map = map_of(program_.sinks[field.side]);
    to_.line("add_{0}<{1}, {2}, {3}>(job->sinks[{4}], first, W, {5}, {6}, rows, job->outputs[{4}]);", kind_of(map),
             map.elem_size, map.num_comp, n_, field.side, is_sliced() ? fmt::format("k * {}", n_) : "0", output_[o]);
  }

  void integrate(const Evaluation &e) {
    const BlockBasis &b = basis(e);
    const CeedInt nc = b.num_comp(), dim = b.num_directions();
    const std::string sum = fmt::format("sum{}", e.side), back = id(integrations_, e, "back");
    const auto all_back = [&](const std::vector<host::Factor> &factors, const std::string &values, bool add) {
      for (std::size_t g = 0; g < factors.size(); g++) {
        const auto &B = factors[g].direction(true);
        to_.contract(factors[g], true, nc, 1, {plus(values, static_cast<CeedInt>(g) * nc * B.N), B.N, 1}, {sum, B.M, 1},
                     add || g > 0);
      }
    };
    switch (b.route()) {
      case Route::chains:
        if (e.interp >= 0) to_nodes(b, -1, output_[e.interp], sum, e.add);
        for (CeedInt d = 0; e.derivative >= 0 && d < dim; d++) {
          to_nodes(b, d, plus(output_[e.derivative], d * nc * Q_), sum, e.add || e.interp >= 0 || d > 0);
        }
        return;
      case Route::full:
        if (e.interp >= 0) all_back(b.interp(), output_[e.interp], e.add);
        if (e.derivative >= 0) all_back(b.derivative(), output_[e.derivative], e.add || e.interp >= 0);
        return;
      default:
        break;
    }
    const Values v = values_of(e, sum, back);
    if (e.derivative >= 0 && is_sliced()) {
      to_.contract(b.grad_1d(), true, nc, n_, {id(integrations_, e, "along"), n_, nc * n_}, {v.array, v.comp, v.slice},
                   true);
    }
    if (b.route() == Route::collocated) to_nodes(b, -1, back, sum, e.add);
  }

  /// Direction after direction, the last one first, out of slices.
  void to_nodes(const BlockBasis &b, CeedInt derived, const std::string &values, const std::string &nodes, bool add) {
    const CeedInt nc = b.num_comp(), dim = b.num_directions(), P = b.P(), Q = b.Q();
    std::string from = values;
    for (CeedInt d = dim - 1; d >= 0; d--) {
      const host::Factor &factor = d == derived ? b.grad_1d() : b.interp_1d();
      const CeedInt columns = power(Q, d), pre = nc * power(P, dim - 1 - d);
      const std::string to = d == 0 ? nodes : fmt::format("chain{}", d % 2);
      const bool out_of_slices = is_sliced() && d == dim - 1;
      to_.contract(factor, true, pre, columns,
                   out_of_slices ? Printer::Rows{from, n_, nc * n_} : Printer::Rows{from, Q * columns, columns},
                   {to, P * columns, columns}, add && d == 0);
      from = to;
    }
  }

  void ask() {
    for (CeedInt t = 0; t < program_.num_sinks; t++) {
      const CeedElementMap &map = map_of(program_.sinks[t]);
      if (!has_nodes_out_[t] || map.offsets == nullptr) continue;
      to_.line("ask_for<{0}, {1}, true>(job->sinks[{2}], job->outputs[{2}], first, W);", map.elem_size, map.num_comp,
               t);
    }
    for (CeedInt s = 0; s < program_.num_sources; s++) {
      const CeedElementMap &map = map_of(program_.sources[s]);
      if (!has_nodes_in_[s] || map.offsets == nullptr) continue;
      to_.line("if (job->end - first > W) ask_for<{0}, {1}, false>(job->sources[{2}], job->inputs[{2}], first + W, W);",
               map.elem_size, map.num_comp, s);
    }
  }

  void write_nodes(CeedInt t) {
    if (!has_nodes_out_[t]) return;
    const CeedElementMap &map = map_of(program_.sinks[t]);
    to_.line("add_{0}<{1}, {2}>(job->sinks[{3}], first, W, 0, sum{3}, rows, job->outputs[{3}]);", kind_of(map),
             map.elem_size, map.num_comp, t);
  }

  /// An input and the one whose array it has.
  struct SameAs {
    CeedInt input, place;
  };
  const CeedProgram &program_;
  const std::string &function_;
  const std::vector<const BlockBasis *> &bases_;
  Printer to_;
  CeedInt W_, Q_, n_ = 0, num_slices_ = 1;  ///< points of an element, and of a slice
  std::vector<Evaluation> evaluations_, integrations_;
  std::vector<SameAs> first_with_;
  std::vector<bool> has_nodes_in_, has_nodes_out_;
  std::vector<std::string> input_, output_;  ///< the QFunction's arrays
};

}  // namespace

Printed print_blocks(const host::Kernels &kernels, const CeedProgram &program, const std::string &function,
                     const std::vector<const BlockBasis *> &bases) {
  for (CeedInt s = 0; s < program.num_sources; s++) {
    if (!takes(program.sources[s])) return {};
  }
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    if (!takes(program.sinks[t])) return {};
  }
  BlockPrinter printer(kernels, program, function, bases);
  return printer.takes(kernels.width) ? printer.print() : Printed{};
}

}  // namespace hg::gen
