// Diagonals, and blocks on the diagonal that couple the components of a node.
#include <algorithm>

#include "assembly.hpp"
#include "panel_product.hpp"

namespace {

using hg::require;
using hg::text;

/// Where the entries of a point-block diagonal stand: num_comp^2 values for each node, row-major. Blocks follow each
/// other as the nodes do whose component 0 stands at `node` in an L-vector where components are comp_stride apart.
struct BlockLayout {
  CeedInt num_comp = 1;
  CeedSize comp_stride = 1;

  CeedSize block(CeedSize node) const {
    if (num_comp == 1) return node;
    // Components next to each other: each entry of the L-vector has its row of the block. Else, nodes come in stacks of
    // comp_stride, component after component.
    if (comp_stride == 1) return node * num_comp;
    return (node / (comp_stride * num_comp) * comp_stride + node % comp_stride) * num_comp * num_comp;
  }
};

CeedSize comp_stride_of(const CeedElemRestriction_private &rstr) {
  return rstr.is_strided() ? rstr.strides[1] : rstr.comp_stride;
}

/// One layout for all active fields of the operator, which is square.
BlockLayout block_layout(CeedOperator_private &op) {
  BlockLayout layout;
  bool is_known = false;
  hg::for_each_single(op, [&](CeedOperator_private &single) {
    const CeedProgram &program = hg::program_of(single);
    const auto agree = [&](const CeedProgramSide *sides, CeedInt count) {
      for (CeedInt i = 0; i < count; i++) {
        if (!sides[i].is_active) continue;
        const CeedElemRestriction_private &rstr = *sides[i].rstr;
        const CeedSize comp_stride = comp_stride_of(rstr);
        if (!is_known) layout = {rstr.num_comp, comp_stride};
        is_known = true;
        require(rstr.num_comp == 1 || comp_stride > 0, CEED_ERROR_INCOMPATIBLE, [&] {
          return text(
              "CeedOperator '%s': the components of an active field are 0 entries apart; point blocks need them "
              "apart",
              single.shown_name());
        });
        require(rstr.num_comp == layout.num_comp && (rstr.num_comp == 1 || comp_stride == layout.comp_stride),
                CEED_ERROR_INCOMPATIBLE, [&] {
                  return text("CeedOperator '%s': an active field has %" CeedInt_FMT " components, %" CeedSize_FMT
                              " entries apart; one before it has %" CeedInt_FMT ", %" CeedSize_FMT
                              " apart. Point blocks need nodes of one kind",
                              single.shown_name(), rstr.num_comp, comp_stride, layout.num_comp, layout.comp_stride);
                });
      }
    };
    agree(program.sources, program.num_sources);
    agree(program.sinks, program.num_sinks);
  });
  return layout;
}

/// Pairs of components whose entries are wanted: (c, c) for a diagonal, all for blocks.
struct ComponentPair {
  CeedInt row, column;
};

std::vector<ComponentPair> component_pairs(CeedInt num_comp, bool is_block) {
  std::vector<ComponentPair> pairs;
  for (CeedInt r = 0; r < num_comp; r++) {
    for (CeedInt c = 0; c < num_comp; c++) {
      if (is_block || r == c) pairs.push_back({r, c});
    }
  }
  return pairs;
}

/// Diagonals of element matrices.
class ElementDiagonal {
 public:
  /// Entry i*P + n of the result is that of node n with itself for pair i: the products of two functions, times the sum
  /// of all that couples them. Flops: for each point and each two rows P for the products, and 2 P for each pair of
  /// components, which is the floor without sum factorisation: for a 3-vector Poisson problem with 27 nodes and 64
  /// points 10 and 62 thousand.
  const std::vector<CeedScalar> &compute(const hg::CoupledFunctions &functions, CeedInt P, CeedInt Q,
                                         const hg::PointMatrices &D, const std::vector<ComponentPair> &pairs) {
    const hg::Functions &trial = functions.trial, &test = functions.test;
    const auto num_pairs = static_cast<CeedInt>(pairs.size());
    const CeedInt P_padded = hg::pad_to_tile(P), pairs_padded = hg::pad_to_tile(num_pairs), K = trial.num_rows(),
                  L = test.num_rows();
    // A product of the same two functions comes once.
    const bool is_symmetric = trial.has_rows_of(test);
    const CeedInt rows = is_symmetric ? K * (K + 1) / 2 : K * L;
    entries_.assign(static_cast<std::size_t>(num_pairs) * P, 0.0);
    const CeedInt block = std::max<CeedInt>(hg::panel_rows(std::max(P_padded, pairs_padded)) / rows, 1);
    products_.assign(static_cast<std::size_t>(block) * rows * P_padded, 0.0);
    factors_.assign(static_cast<std::size_t>(block) * rows * pairs_padded, 0.0);
    for (CeedInt first = 0; first < Q; first += block) {
      const CeedInt last = std::min(first + block, Q);
      CeedScalar *product = products_.data(), *factor = factors_.data();
      for (CeedInt q = first; q < last; q++) {
        for (CeedInt k = 0; k < K; k++) {
          const CeedScalar *b = trial.row(k, q);
          for (CeedInt l = is_symmetric ? k : 0; l < L; l++, product += P_padded, factor += pairs_padded) {
            const CeedScalar *t = test.row(l, q);
            for (CeedInt n = 0; n < P; n++) product[n] = t[n] * b[n];
            for (CeedInt i = 0; i < num_pairs; i++) {
              factor[i] = D(q, trial.value(k, pairs[i].column), test.value(l, pairs[i].row));
              if (is_symmetric && l != k)
                factor[i] += D(q, trial.value(l, pairs[i].column), test.value(k, pairs[i].row));
            }
          }
        }
      }
      hg::add_panel_product((last - first) * rows, factors_.data(), pairs_padded, num_pairs, products_.data(), P_padded,
                            P, entries_.data(), P);
    }
    return entries_;
  }

 private:
  std::vector<CeedScalar> products_, factors_, entries_;
};

/// Places in the L-vector of all components of an element's nodes, sorted.
void sorted_places(const CeedElemRestriction_private &rstr, CeedInt e, std::vector<CeedSize> &places) {
  places.clear();
  for (CeedInt n = 0; n < rstr.num_nodes(e); n++) {
    for (CeedInt c = 0; c < rstr.num_comp; c++) places.push_back(rstr.place(e, n, c));
  }
  std::sort(places.begin(), places.end());
}

bool has_common_entry(const std::vector<CeedSize> &a, const std::vector<CeedSize> &b) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) return true;
    (*i < *j ? i : j)++;
  }
  return false;
}

/// Adds entries of one coupling. is_block: array has the layout of the blocks, else it is the diagonal.
class Adder {
 public:
  Adder(CeedOperator_private &op, const hg::Coupling &coupling, CeedScalar *array, bool is_block,
        const BlockLayout &layout)
      : op_(op),
        coupling_(coupling),
        array_(array),
        is_block_(is_block),
        is_one_space_(&coupling.trial == &coupling.test || hg::equal(coupling.trial, coupling.test)),
        layout_(layout),
        pairs_(component_pairs(coupling.trial.num_comp, is_block)) {}

  /// functions(e): those of the coupling at element e
  template <typename FunctionsAt>
  void add(const hg::AssembledElements &elements, FunctionsAt &&functions) {
    const CeedElemRestriction_private &rstr = coupling_.trial;
    CeedSize num_entries = 0, place = 0;
    const auto count = [&](CeedInt e) { return rstr.num_nodes(e) * static_cast<CeedSize>(pairs_.size()); };
    for (CeedInt e = elements.first; is_one_space_ && e < elements.last; e++) num_entries += count(e);
    contracted_.resize(static_cast<std::size_t>(num_entries));
    const bool is_contracted =
        is_one_space_ &&
        hg::contract_on_backend(op_, coupling_, is_block_ ? CEED_ASSEMBLE_POINT_BLOCKS : CEED_ASSEMBLE_DIAGONAL,
                                elements, contracted_.data());
    elements.for_each([&](CeedInt e, CeedInt Q, const hg::PointMatrices &D) {
      const CeedScalar *entries = contracted_.data() + std::exchange(place, place + count(e));
      if (Q == 0 || !meets(e)) return;
      if (!is_simple_) return add_matching(functions(e), e, Q, D);
      add_simple(is_contracted ? entries : diagonal_.compute(functions(e), rstr.num_nodes(e), Q, D, pairs_).data(), e);
    });
  }

 private:
  /// Whether rows and columns share entries of the L-vector; is_simple_: each node meets itself alone.
  bool meets(CeedInt e) {
    sorted_places(coupling_.trial, e, trial_places_);
    is_simple_ = is_one_space_ && std::adjacent_find(trial_places_.begin(), trial_places_.end()) == trial_places_.end();
    if (is_one_space_) return true;
    sorted_places(coupling_.test, e, test_places_);
    return has_common_entry(trial_places_, test_places_);
  }

  void add_simple(const CeedScalar *entries, CeedInt e) {
    const CeedInt P = coupling_.trial.num_nodes(e);
    for (const ComponentPair &pair : pairs_) {
      for (CeedInt n = 0; n < P; n++) array_[place(coupling_.trial, e, n, pair)] += *entries++;
    }
  }

  /// Two spaces that share entries of the L-vector, or elements that meet a node twice: entries of the element's matrix
  /// whose row and column are one place, or belong to one node.
  void add_matching(const hg::CoupledFunctions &functions, CeedInt e, CeedInt Q, const hg::PointMatrices &D) {
    const CeedElemRestriction_private &trial = coupling_.trial, &test = coupling_.test;
    entries_.resize(static_cast<std::size_t>(coupling_.num_entries(e)));
    matrix_.compute(functions, e, Q, D, entries_.data());
    const CeedScalar *entry = entries_.data();
    for (CeedInt r = 0; r < test.num_comp; r++) {
      for (CeedInt m = 0; m < test.num_nodes(e); m++) {
        for (CeedInt c = 0; c < trial.num_comp; c++) {
          for (CeedInt n = 0; n < trial.num_nodes(e); n++, entry++) {
            const CeedInt row = is_block_ ? 0 : r, column = is_block_ ? 0 : c;
            if (test.place(e, m, row) == trial.place(e, n, column)) array_[place(test, e, m, {r, c})] += *entry;
          }
        }
      }
    }
  }

  CeedSize place(const CeedElemRestriction_private &rstr, CeedInt e, CeedInt n, const ComponentPair &pair) const {
    if (!is_block_) return rstr.place(e, n, pair.row);
    return layout_.block(rstr.place(e, n, 0)) + static_cast<CeedSize>(pair.row) * layout_.num_comp + pair.column;
  }

  CeedOperator_private &op_;
  const hg::Coupling &coupling_;
  CeedScalar *array_;
  bool is_block_, is_one_space_, is_simple_ = false;
  BlockLayout layout_;
  std::vector<ComponentPair> pairs_;
  ElementDiagonal diagonal_;
  hg::ElementMatrix matrix_;
  std::vector<CeedSize> trial_places_, test_places_;
  std::vector<CeedScalar> contracted_, entries_;
};

void add_entries(CeedOperator_private &op, CeedVector assembled, bool is_block, const BlockLayout &layout) {
  const CeedProgram &program = hg::program_of(op);
  if (program.num_elem == 0) return;
  const CeedAssembleKind kind = is_block ? CEED_ASSEMBLE_POINT_BLOCKS : CEED_ASSEMBLE_DIAGONAL;
  if (hg::assemble_on_backend(op, program, kind, 0, assembled)) return;
  const auto all = hg::couplings(program);
  hg::FunctionTables functions(program, all);
  const hg::WriteArray array(assembled);
  std::vector<Adder> adders;
  for (const hg::Coupling &coupling : all) adders.emplace_back(op, coupling, array.data(), is_block, layout);
  hg::for_each_assembled(op, program, [&](const hg::AssembledElements &elements) {
    for (std::size_t i = 0; i < all.size(); i++) {
      adders[i].add(elements, [&](CeedInt e) -> const hg::CoupledFunctions & { return functions.move_to(i, e); });
    }
  });
}

/// Where entries go; nothing for a composite without sub-operators, whose vectors may have any length.
struct Target {
  CeedSize length;
  BlockLayout layout;
};

std::optional<Target> target_of(CeedOperator op, bool is_block) {
  const char *what = is_block ? "point-block diagonal" : "diagonal";
  CeedSize in = -1, out = -1;
  hg::check_ready(hg::deref(op, "CeedOperator"));
  if (op->is_empty()) return {};
  hg::check(CeedOperatorGetActiveVectorLengths(op, &in, &out));
  require(in >= 0 && out >= 0, CEED_ERROR_INCOMPATIBLE, [&] {
    return text("CeedOperator '%s' has no active %s; a %s needs an active input and an active output", op->shown_name(),
                in < 0 ? "input" : "output", what);
  });
  require(in == out, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s': a %s needs a square operator; its active input has length %" CeedSize_FMT
                ", its output %" CeedSize_FMT,
                op->shown_name(), what, in, out);
  });
  if (!is_block) return Target{out, {}};
  const BlockLayout layout = block_layout(*op);
  return Target{out * layout.num_comp, layout};
}

void assemble(CeedOperator op, CeedVector assembled, bool is_block, bool is_added) {
  const auto target = target_of(op, is_block);
  hg::deref(assembled, "vector of the diagonal");
  require(!target || assembled->length >= target->length, CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s': the vector of the %s has length %" CeedSize_FMT "; expected %" CeedSize_FMT
                " or more",
                op->shown_name(), is_block ? "point-block diagonal" : "diagonal", assembled->length, target->length);
  });
  hg::require_not_read(*op, assembled, is_block ? "point-block diagonal" : "diagonal");
  if (!is_added) hg::check(CeedVectorSetValue(assembled, 0.0));
  if (!target) return;
  hg::for_each_single(*op,
                      [&](CeedOperator_private &single) { add_entries(single, assembled, is_block, target->layout); });
}

/// Rows and columns of the blocks of a space; -1 stands where no block has been. Two nodes in one place would make the
/// sum of their blocks meaningless.
void block_indices(const CeedOperator_private &op, const CeedElemRestriction_private &rstr, const BlockLayout &layout,
                   CeedInt *rows, CeedInt *cols) {
  const CeedInt num_comp = layout.num_comp;
  for (CeedInt e = 0; e < rstr.num_elem; e++) {
    for (CeedInt n = 0; n < rstr.num_nodes(e); n++) {
      const CeedSize block = layout.block(rstr.place(e, n, 0));
      for (CeedInt i = 0; i < num_comp * num_comp; i++) {
        const auto row = static_cast<CeedInt>(rstr.place(e, n, i / num_comp)),
                   col = static_cast<CeedInt>(rstr.place(e, n, i % num_comp));
        require(rows[block + i] < 0 || (rows[block + i] == row && cols[block + i] == col), CEED_ERROR_INCOMPATIBLE,
                [&] {
                  return text(
                      "CeedOperator '%s': node %" CeedInt_FMT " of element %" CeedInt_FMT
                      " shares some but not all entries of the L-vector with another node; expected nodes that are one "
                      "or apart, %" CeedInt_FMT " components %" CeedSize_FMT " entries apart",
                      op.shown_name(), n, e, num_comp, layout.comp_stride);
                });
        rows[block + i] = row;
        cols[block + i] = col;
      }
    }
  }
}

}  // namespace

int CeedOperatorLinearAssembleDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { assemble(op, assembled, false, false); });
}

int CeedOperatorLinearAssembleAddDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { assemble(op, assembled, false, true); });
}

int CeedOperatorLinearAssemblePointBlockDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { assemble(op, assembled, true, false); });
}

int CeedOperatorLinearAssembleAddPointBlockDiagonal(CeedOperator op, CeedVector assembled, CeedRequest *) {
  return hg::guard(hg::ceed_of(op), [&] { assemble(op, assembled, true, true); });
}

int CeedOperatorLinearAssemblePointBlockDiagonalSymbolic(CeedOperator op, CeedSize *num_entries, CeedInt **rows,
                                                         CeedInt **cols) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    hg::require_argument(num_entries, "num_entries (where their number goes)");
    hg::require_argument(rows, "rows (where the array goes)");
    hg::require_argument(cols, "cols (where the array goes)");
    const Target target = target_of(op, true).value_or(Target{0, {}});
    hg::require_index_range(*op);
    auto indices = hg::allocate_indices(*op, target.length);
    std::fill_n(indices.rows.get(), target.length, -1);
    std::fill_n(indices.cols.get(), target.length, -1);
    hg::for_each_single(*op, [&](CeedOperator_private &single) {
      const CeedProgram &program = hg::program_of(single);
      for (CeedInt t = 0; t < program.num_sinks; t++) {
        if (!program.sinks[t].is_active) continue;
        block_indices(single, *program.sinks[t].rstr, target.layout, indices.rows.get(), indices.cols.get());
      }
    });
    // What belongs to no node is a zero on the first entry.
    std::replace(indices.rows.get(), indices.rows.get() + target.length, -1, 0);
    std::replace(indices.cols.get(), indices.cols.get() + target.length, -1, 0);
    *num_entries = target.length;
    *rows = indices.rows.release();
    *cols = indices.cols.release();
  });
}
