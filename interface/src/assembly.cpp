// Full assembly: the entries of element matrices in coordinate form.
#include "assembly.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "panel_product.hpp"

namespace {

using hg::require;
using hg::text;

/// Entries of one operator in coordinate form.
CeedSize num_entries(CeedOperator_private &op) {
  const CeedProgram &program = hg::program_of(op);
  CeedSize count = 0;
  for (CeedInt s = 0; s < program.num_sources; s++) {
    for (CeedInt t = 0; t < program.num_sinks; t++) {
      if (!program.sources[s].is_active || !program.sinks[t].is_active) continue;
      const auto &in = *program.sources[s].rstr, &out = *program.sinks[t].rstr;
      const CeedSize comps = static_cast<CeedSize>(in.num_comp) * out.num_comp;
      if (!in.is_points() && !out.is_points()) {
        count += comps * in.elem_size * out.elem_size * program.num_elem;
        continue;
      }
      for (CeedInt e = 0; e < program.num_elem; e++) {
        count += comps * in.num_nodes(e) * out.num_nodes(e);
      }
    }
  }
  return count;
}

void assemble(CeedOperator_private &op, CeedSize offset, CeedVector values) {
  const CeedProgram &program = hg::program_of(op);
  if (program.num_elem == 0) return;
  if (hg::assemble_on_backend(op, program, CEED_ASSEMBLE_MATRIX, offset, values)) return;
  const auto all = hg::couplings(program);
  // Entries stand coupling by coupling; elements are walked once.
  std::vector<CeedSize> places;
  for (const hg::Coupling &coupling : all) {
    places.push_back(offset);
    for (CeedInt e = 0; e < program.num_elem; e++) offset += coupling.num_entries(e);
  }
  const hg::WriteArray array(values);
  hg::FunctionTables functions(program, all);
  hg::ElementMatrix matrix;
  hg::for_each_assembled(op, program, [&](const hg::AssembledElements &elements) {
    for (std::size_t i = 0; i < all.size(); i++) {
      CeedScalar *K = array.data() + places[i];
      for (CeedInt e = elements.first; e < elements.last; e++) places[i] += all[i].num_entries(e);
      if (hg::contract_on_backend(op, all[i], CEED_ASSEMBLE_MATRIX, elements, K)) continue;
      elements.for_each([&](CeedInt e, CeedInt Q, const hg::PointMatrices &D) {
        matrix.compute(functions.move_to(i, e), e, Q, D, K);
        K += all[i].num_entries(e);
      });
    }
  });
}

void symbolic(CeedOperator_private &op, CeedInt *rows, CeedInt *cols, CeedSize &k) {
  const CeedProgram &program = hg::program_of(op);
  for (CeedInt s = 0; s < program.num_sources; s++) {
    for (CeedInt t = 0; t < program.num_sinks; t++) {
      if (!program.sources[s].is_active || !program.sinks[t].is_active) continue;
      const auto &in = *program.sources[s].rstr, &out = *program.sinks[t].rstr;
      for (CeedInt e = 0; e < program.num_elem; e++) {
        const CeedInt P = in.num_nodes(e), M = out.num_nodes(e);
        for (CeedInt r = 0; r < out.num_comp; r++) {
          for (CeedInt m = 0; m < M; m++) {
            const CeedInt row = static_cast<CeedInt>(out.place(e, m, r));
            for (CeedInt c = 0; c < in.num_comp; c++) {
              for (CeedInt n = 0; n < P; n++, k++) {
                rows[k] = row;
                cols[k] = static_cast<CeedInt>(in.place(e, n, c));
              }
            }
          }
        }
      }
    }
  }
}

}  // namespace

namespace hg {

void require_index_range(CeedOperator_private &op) {
  CeedSize in = -1, out = -1;
  check(CeedOperatorGetActiveVectorLengths(&op, &in, &out));
  require(std::max(in, out) <= std::numeric_limits<CeedInt>::max(), CEED_ERROR_DIMENSION, [&] {
    return text("CeedOperator '%s': its active vectors have lengths %" CeedSize_FMT " and %" CeedSize_FMT
                "; row and column numbers go up to %" CeedInt_FMT,
                op.shown_name(), in, out, std::numeric_limits<CeedInt>::max());
  });
}

IndexArrays allocate_indices(const CeedOperator_private &op, CeedSize count) {
  const std::size_t bytes = std::max<std::size_t>(static_cast<std::size_t>(count), 1) * sizeof(CeedInt);
  IndexArrays arrays;
  arrays.rows.reset(static_cast<CeedInt *>(std::malloc(bytes)));
  if (arrays.rows) arrays.cols.reset(static_cast<CeedInt *>(std::malloc(bytes)));
  require(arrays.rows && arrays.cols, CEED_ERROR_MAJOR, [&] {
    return text("CeedOperator '%s': no memory for 2 x %" CeedSize_FMT " indices", op.shown_name(), count);
  });
  return arrays;
}

// Flops: 2 L K P for D B and 2 L P M for the product, for each pair of components and point, with K rows of trial and L
// rows of test functions. The second is the floor of a dense product; for a 3-vector Poisson problem with 27 nodes and
// 64 points the two are 0.28 and 2.5 million.
void ElementMatrix::compute(const CoupledFunctions &functions, CeedInt e, CeedInt Q, const PointMatrices &D,
                            CeedScalar *K) {
  const Functions &trial = functions.trial, &test = functions.test;
  const CeedInt P = trial.rstr().num_nodes(e), M = test.rstr().num_nodes(e), L = test.num_rows();
  const CeedInt P_padded = pad_to_tile(P), M_padded = pad_to_tile(M);
  const CeedSize num_columns = static_cast<CeedSize>(trial.num_comp()) * P;
  std::fill_n(K, num_columns * test.num_comp() * M, 0.0);
  if (P == 0 || M == 0) return;
  const CeedInt block = std::max<CeedInt>(panel_rows(std::max(P_padded, M_padded)) / L, 1);
  test_.assign(static_cast<std::size_t>(block) * L * M_padded, 0.0);
  DB_.assign(static_cast<std::size_t>(block) * L * P_padded, 0.0);
  for (CeedInt first = 0; first < Q; first += block) {
    const CeedInt last = std::min(first + block, Q);
    for (CeedInt q = first; q < last; q++) {
      for (CeedInt l = 0; l < L; l++) {
        std::copy_n(test.row(l, q), M, &test_[(static_cast<std::size_t>(q - first) * L + l) * M_padded]);
      }
    }
    for (CeedInt r = 0; r < test.num_comp(); r++) {
      for (CeedInt c = 0; c < trial.num_comp(); c++) {
        CeedScalar *DB = DB_.data();
        for (CeedInt q = first; q < last; q++) {
          for (CeedInt l = 0; l < L; l++, DB += P_padded) {
            std::fill_n(DB, P, 0.0);
            for (CeedInt k = 0; k < trial.num_rows(); k++) {
              const CeedScalar d = D(q, trial.value(k, c), test.value(l, r));
              const CeedScalar *b = trial.row(k, q);
              for (CeedInt n = 0; n < P; n++) DB[n] += d * b[n];
            }
          }
        }
        add_panel_product((last - first) * L, test_.data(), M_padded, M, DB_.data(), P_padded, P,
                          K + static_cast<CeedSize>(r) * M * num_columns + static_cast<CeedSize>(c) * P, num_columns);
      }
    }
  }
}

}  // namespace hg

int CeedOperatorLinearAssembleGetNumEntries(CeedOperator op, CeedSize *num_entries) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::check_ready(hg::deref(op, "CeedOperator"));
    CeedSize count = 0;
    hg::for_each_single(*op, [&](CeedOperator_private &single) { count += ::num_entries(single); });
    hg::result(num_entries, "num_entries") = count;
  });
}

int CeedOperatorLinearAssembleSymbolic(CeedOperator op, CeedSize *num_entries, CeedInt **rows, CeedInt **cols) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    hg::require_argument(num_entries, "num_entries (where their number goes)");
    hg::require_argument(rows, "rows (where the array goes)");
    hg::require_argument(cols, "cols (where the array goes)");
    CeedSize count = 0, k = 0;
    hg::check(CeedOperatorLinearAssembleGetNumEntries(op, &count));
    hg::require_index_range(*op);
    auto indices = hg::allocate_indices(*op, count);
    hg::for_each_single(
        *op, [&](CeedOperator_private &single) { symbolic(single, indices.rows.get(), indices.cols.get(), k); });
    *num_entries = count;
    *rows = indices.rows.release();
    *cols = indices.cols.release();
  });
}

int CeedOperatorLinearAssemble(CeedOperator op, CeedVector values) {
  return hg::guard(hg::ceed_of(op), [&] {
    hg::deref(op, "CeedOperator");
    CeedSize count = 0;
    hg::check(CeedOperatorLinearAssembleGetNumEntries(op, &count));
    require(hg::deref(values, "vector of the entries").length >= count, CEED_ERROR_DIMENSION, [&] {
      return text("CeedOperator '%s': the vector of the entries has length %" CeedSize_FMT "; expected %" CeedSize_FMT
                  " or more",
                  op->shown_name(), values->length, count);
    });
    hg::require_not_read(*op, values, "vector of the entries");
    hg::check(CeedVectorSetValue(values, 0.0));
    CeedSize offset = 0;
    hg::for_each_single(*op, [&](CeedOperator_private &single) {
      assemble(single, offset, values);
      offset += num_entries(single);
    });
  });
}
