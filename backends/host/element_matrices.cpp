#include "element_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "access.hpp"

namespace hg::host {

namespace {

/// T_i(x) and T'_i(x), i < count.
void chebyshev(CeedInt count, CeedScalar x, CeedScalar *T, CeedScalar *dT) {
  for (CeedInt i = 0; i < count; i++) {
    T[i] = i == 0 ? 1 : i == 1 ? x : 2 * x * T[i - 1] - T[i - 2];
    dT[i] = i == 0 ? 0 : i == 1 ? 1 : 2 * T[i - 1] + 2 * x * dT[i - 1] - dT[i - 2];
  }
}

/// Zeros of T_N: sums over them tell the first N polynomials apart.
CeedScalar chebyshev_zero(CeedInt N, CeedInt j) {
  return std::cos((j + 0.5) * std::numbers::pi / N);
}

}  // namespace

std::unique_ptr<ElementAssembly> ElementMatrices::make(const Kernels &kernels, const CeedProgram &program,
                                                       CeedInt source, CeedInt sink, CeedAssembleKind kind) {
  std::unique_ptr<ElementMatrices> made(new ElementMatrices(kernels));
  if (!made->choose_points(program, source, sink)) return nullptr;
  made->pairs_ = {kind, made->test_.num_comp, made->trial_.num_comp};
  made->add_rows(program, true, source);
  made->add_rows(program, false, sink);
  if (!made->make_terms(program)) return nullptr;
  made->make_arrays();
  made->make_places();
  return made;
}

/// Tensor products of one shape, or full tables; at points tensor products that are Chebyshev series.
bool ElementMatrices::choose_points(const CeedProgram &program, CeedInt source, CeedInt sink) {
  bool is_first = true, is_taken = true;
  CeedInt num_coefficients[2] = {0, 0};
  const auto look = [&](bool is_trial, CeedInt side) {
    const CeedProgramSide &own = is_trial ? program.sources[side] : program.sinks[side];
    (is_trial ? trial_ : test_) = {.num_comp = own.num_comp, .num_nodes = own.elem_size, .rows = {}};
    is_taken = is_taken && !own.is_points && map_of(own.rstr).num_bands == 0;
    for_each_field(program, is_trial, side, [&](const CeedProgramField &, CeedBasis basis) {
      is_taken = is_taken && basis != CEED_BASIS_NONE;
      if (!is_taken) return;
      bool is_tensor = false;
      CeedInt dim = 1, N = program.num_qpts;
      chk(CeedBasisIsTensor(basis, &is_tensor));
      if (is_tensor) {
        chk(CeedBasisGetDimension(basis, &dim));
        chk(CeedBasisGetNumQuadraturePoints1D(basis, &N));
      }
      if (program.at_points) {
        const CeedScalar *coefficients = nullptr;
        CeedInt count = 0;
        chk(CeedBasisGetChebyshevCoefficients1D(basis, &count, &coefficients));
        num_coefficients[is_trial] = std::max(num_coefficients[is_trial], count);
        N = 0;
        is_taken = count > 0;
      }
      is_taken = is_taken && (is_first || (is_tensor == is_tensor_ && dim == num_directions_ && N == N_));
      is_first = false;
      is_tensor_ = is_tensor;
      num_directions_ = dim;
      N_ = N;
    });
  };
  look(true, source);
  look(false, sink);
  if (!is_taken || is_first) return false;
  if (!program.at_points) return true;
  N_ = num_coefficients[0] + num_coefficients[1] - 1;
  integrate_ = kernels_->point_moments(N_);
  return integrate_ != nullptr;
}

void ElementMatrices::add_rows(const CeedProgram &program, bool is_trial, CeedInt side) {
  Side &to = is_trial ? trial_ : test_;
  for_each_field(program, is_trial, side, [&](const CeedProgramField &field, CeedBasis basis) {
    for (CeedInt v = 0; v < field.size / to.num_comp; v++) {
      Row row{field.first_value + v * to.num_comp, {}};
      for (CeedInt d = 0; d < num_directions_; d++) {
        const bool is_value = field.eval_mode == CEED_EVAL_INTERP || (is_tensor_ && v != d);
        row.tables[d] = add_table(basis, is_value ? CEED_EVAL_INTERP : field.eval_mode, is_tensor_ ? 0 : v);
      }
      to.rows.push_back(row);
    }
  });
}

/// The table's index; a new one where there is none.
CeedInt ElementMatrices::add_table(CeedBasis basis, CeedEvalMode mode, CeedInt value) {
  for (std::size_t i = 0; i < tables_.size(); i++) {
    const Table &other = tables_[i];
    if (other.basis == basis && other.mode == mode && other.value == value) return static_cast<CeedInt>(i);
  }
  Table table{basis, mode, value, 0, {}};
  const CeedScalar *values = nullptr;
  chk(is_tensor_ ? CeedBasisGetNumNodes1D(basis, &table.P) : CeedBasisGetNumNodes(basis, &table.P));
  const std::size_t size = static_cast<std::size_t>(N_) * table.P;
  if (integrate_ != nullptr) {
    CeedInt count = 0;
    chk(CeedBasisGetChebyshevCoefficients1D(basis, &count, &values));
    table.values.assign(size, 0.0);
    std::vector<CeedScalar> T(count), dT(count);
    for (CeedInt j = 0; j < N_; j++) {
      chebyshev(count, chebyshev_zero(N_, j), T.data(), dT.data());
      for (CeedInt k = 0; k < count; k++) {
        const CeedScalar factor = mode == CEED_EVAL_INTERP ? T[k] : dT[k];
        for (CeedInt n = 0; n < table.P; n++) table.values[j * table.P + n] += factor * values[k * table.P + n];
      }
    }
  } else {
    if (!is_tensor_) {
      chk(CeedOperatorGetBasisPointer(basis, mode, nullptr, &values));
      values += value * size;
    } else {
      chk(mode == CEED_EVAL_INTERP ? CeedBasisGetInterp1D(basis, &values) : CeedBasisGetGrad1D(basis, &values));
    }
    table.values.assign(values, values + size);
  }
  tables_.push_back(std::move(table));
  return static_cast<CeedInt>(tables_.size()) - 1;
}

/// Products at the points, or their Chebyshev coefficients: (2 - [i = 0])/N Σ_j f(x_j) T_i(x_j) at the zeros x_j.
Factor ElementMatrices::product(const Table &test, const Table &trial) const {
  const CeedInt N = N_;
  std::vector<CeedScalar> products(static_cast<std::size_t>(num_products_) * N);
  const auto at = [&](CeedInt product, CeedInt q) -> CeedScalar & { return products[product * N + q]; };
  for (CeedInt q = 0; q < N; q++) {
    for (CeedInt i = 0; i < num_products_; i++) {
      const CeedInt m = pairs_.kind == CEED_ASSEMBLE_MATRIX ? i / trial.P : i,
                    n = pairs_.kind == CEED_ASSEMBLE_MATRIX ? i % trial.P : i;
      at(i, q) = test.values[q * test.P + m] * trial.values[q * trial.P + n];
    }
  }
  if (integrate_ == nullptr) return Factor(*kernels_, products.data(), num_products_, N);
  std::vector<CeedScalar> coefficients(products.size(), 0.0), T(N), dT(N);
  for (CeedInt j = 0; j < N; j++) {
    chebyshev(N, chebyshev_zero(N, j), T.data(), dT.data());
    for (CeedInt i = 0; i < num_products_; i++) {
      for (CeedInt k = 0; k < N; k++) coefficients[i * N + k] += (k == 0 ? 1.0 : 2.0) / N * at(i, j) * T[k];
    }
  }
  return Factor(*kernels_, coefficients.data(), num_products_, N);
}

/// Elements side by side while a pair of components fits the caches, else one at a time; false where not even one does.
bool ElementMatrices::choose_kernels(std::size_t num_factors) {
  constexpr double most_in_tables = 1 << 18, most_entries = 1 << 19, most_in_block = 1 << 22;  // numbers
  const double entries = std::pow(num_products_, num_directions_), points = std::pow(N_, num_directions_);
  const double terms = static_cast<double>(terms_.size()) * (integrate_ != nullptr ? 1 + pairs_.count() : 1);
  const double of_element = entries + terms * points;
  if (static_cast<double>(num_factors) * num_products_ * N_ > most_in_tables || of_element > most_in_block)
    return false;
  const char *reason = "";
  const bool fits = entries * kernels_->width <= most_entries && of_element * kernels_->width <= most_in_block;
  if (!fits) kernels_ = kernels(false, &reason);
  return kernels_ != nullptr;
}

bool ElementMatrices::make_terms(const CeedProgram &program) {
  const bool is_matrix = pairs_.kind == CEED_ASSEMBLE_MATRIX;
  const CeedInt P = tables_[trial_.rows[0].tables[0]].P, M = tables_[test_.rows[0].tables[0]].P;
  const auto has_size = [&](const Side &side, CeedInt size) {
    return std::all_of(side.rows.begin(), side.rows.end(), [&](const Row &row) {
      return std::all_of(row.tables.begin(), row.tables.begin() + num_directions_,
                         [&](CeedInt table) { return tables_[table].P == size; });
    });
  };
  if (!has_size(trial_, P) || !has_size(test_, M)) return false;
  num_products_ = is_matrix ? M * P : P;
  // A diagonal's products are the same whichever function comes first.
  using Pair = std::pair<CeedInt, CeedInt>;
  const auto pair = [&](CeedInt test, CeedInt trial) {
    return is_matrix ? Pair(test, trial) : Pair(std::min(test, trial), std::max(test, trial));
  };
  std::map<std::array<Pair, 3>, std::vector<CeedInt>> components;  // by the factors, the last direction's first
  for (const Row &k : trial_.rows) {
    for (const Row &l : test_.rows) {
      std::array<Pair, 3> key = {};
      for (CeedInt d = 0; d < num_directions_; d++) key[num_directions_ - 1 - d] = pair(l.tables[d], k.tables[d]);
      components[key].push_back(k.first_value * program.num_active_out + l.first_value);
    }
  }
  std::map<Pair, CeedInt> factors;
  for (const auto &[key, own] : components) {
    Term term{{}, own};
    for (CeedInt d = 0; d < num_directions_; d++) {
      const Pair &tables = key[num_directions_ - 1 - d];
      const auto [found, is_new] = factors.try_emplace(tables, static_cast<CeedInt>(factors.size()));
      term.factors[d] = found->second;
    }
    terms_.push_back(std::move(term));
  }
  if (!choose_kernels(factors.size())) return false;
  factors_.resize(factors.size());
  for (const auto &[tables, index] : factors) factors_[index] = product(tables_[tables.first], tables_[tables.second]);
  return true;
}

void ElementMatrices::make_arrays() {
  const CeedInt W = kernels_->width;
  const std::size_t of_term = static_cast<std::size_t>(CeedIntPow(N_, num_directions_));
  values_ = arena_.add(terms_.size() * of_term * W);
  sum_ = arena_.add(of_term * W);
  for (CeedInt d = 0; d < num_directions_; d++) {
    stages_[d] = arena_.add(static_cast<std::size_t>(CeedIntPow(N_, num_directions_ - 1 - d)) *
                            CeedIntPow(num_products_, d + 1) * W);
  }
  if (integrate_ != nullptr) {
    row_ = (static_cast<CeedSize>(terms_.size()) * pairs_.count() + max_width - 1) / max_width * max_width;
    moments_ = arena_.add(of_term * row_ * W);
    table_ = arena_.add(of_term * moment_points);
  }
  arena_.allocate();
}

/// Entry (m,n) of a matrix stands where the products of its directions do.
void ElementMatrices::make_places() {
  const bool is_matrix = pairs_.kind == CEED_ASSEMBLE_MATRIX;
  const CeedInt P = tables_[trial_.rows[0].tables[0]].P, M = tables_[test_.rows[0].tables[0]].P;
  for (CeedInt m = 0; m < (is_matrix ? test_.num_nodes : 1); m++) {
    for (CeedInt n = 0; n < trial_.num_nodes; n++) {
      CeedInt place = is_matrix ? 0 : n;
      for (CeedInt d = num_directions_ - 1; is_matrix && d >= 0; d--) {
        const CeedInt m_d = m / CeedIntPow(M, d) % M, n_d = n / CeedIntPow(P, d) % P;
        place = place * num_products_ + m_d * P + n_d;
      }
      places_.push_back(place);
    }
  }
}

/// The values of all terms at quadrature points, D(component, point) of one element after another.
void ElementMatrices::read_values(const CeedProgram &program, CeedInt num_elem, const CeedScalar *D, CeedInt pair) {
  const CeedInt W = kernels_->width, Q = program.num_qpts;
  const CeedInt component = pairs_.component(pair, program.num_active_out);
  const CeedSize of_element = static_cast<CeedSize>(program.num_active_in) * program.num_active_out * Q;
  CeedScalar *to = arena_[values_], *sum = arena_[sum_];
  for (const Term &term : terms_) {
    for (const CeedInt own : term.components) {
      const CeedScalar *rows[max_width];
      for (CeedInt lane = 0; lane < W; lane++) {
        rows[lane] = D + std::min(lane, num_elem - 1) * of_element + static_cast<CeedSize>(own + component) * Q;
      }
      const bool is_first = own == term.components.front();
      kernels_->gather_rows(Q, rows, is_first ? to : sum);
      for (CeedInt i = 0; !is_first && i < Q * W; i++) to[i] += sum[i];
    }
    to += static_cast<CeedSize>(Q) * W;
  }
}

/// The moments of all terms and pairs of element e, D(point, component).
void ElementMatrices::make_moments(const CeedProgram &program, CeedInt lane, CeedInt e, const CeedScalar *x_ref,
                                   const CeedScalar *D) {
  const CeedElementMap &map = map_of(program.points_rstr);
  const CeedInt Q = num_points(map, e), of_point = program.num_active_in * program.num_active_out;
  const std::size_t size = static_cast<std::size_t>(Q) * row_ + max_width;
  if (num_point_values_ < size) {
    point_values_ = allocate_array(size);
    if (!point_values_) throw std::bad_alloc();
    num_point_values_ = size;
  }
  x_ref_.resize(static_cast<std::size_t>(Q) * num_directions_ + max_width);
  kernels_->gather_points(Q, num_directions_, places_of_points(map, e), x_ref, map.l_size, Q, x_ref_.data());
  std::fill_n(point_values_.get(), size, 0.0);
  for (CeedInt q = 0; q < Q; q++, D += of_point) {
    CeedScalar *to = point_values_.get() + q * row_;
    for (CeedInt pair = 0; pair < pairs_.count(); pair++) {
      const CeedScalar *from = D + pairs_.component(pair, program.num_active_out);
      for (const Term &term : terms_) {
        for (const CeedInt own : term.components) *to += from[own];
        to++;
      }
    }
  }
  const auto num_columns = static_cast<CeedInt>(terms_.size()) * pairs_.count();
  Ahead nothing;
  const PointEvaluation at{num_directions_, N_, num_columns, Q, x_ref_.data(), Q, &nothing};
  integrate_(at, point_values_.get(), row_, arena_[table_],
             arena_[moments_] + lane * CeedIntPow(N_, num_directions_) * row_);
}

void ElementMatrices::read_moments(CeedInt num_elem, CeedInt pair) {
  const CeedInt W = kernels_->width, of_term = CeedIntPow(N_, num_directions_);
  const auto num_terms = static_cast<CeedInt>(terms_.size());
  for (CeedInt lane = 0; lane < num_elem; lane++) {
    const CeedScalar *from = arena_[moments_] + lane * of_term * row_ + static_cast<CeedSize>(pair) * num_terms;
    CeedScalar *to = arena_[values_] + lane;
    for (CeedInt i = 0; i < of_term; i++, from += row_, to += W) {
      for (CeedInt t = 0; t < num_terms; t++) to[static_cast<CeedSize>(t) * of_term * W] = from[t];
    }
  }
}

/// All terms, direction by direction. Terms that have their further factors in common are next to each other: the next
/// direction waits for the last one of them.
void ElementMatrices::contract() {
  Ahead nothing;
  const CeedSize of_term = static_cast<CeedSize>(CeedIntPow(N_, num_directions_)) * kernels_->width;
  std::array<bool, 3> is_begun = {};
  for (std::size_t t = 0; t < terms_.size(); t++) {
    const CeedScalar *in = arena_[values_] + static_cast<CeedSize>(t) * of_term;
    for (CeedInt d = 0; d < num_directions_; d++) {
      const auto &own = terms_[t].factors;
      factors_[own[d]].apply(CeedIntPow(N_, num_directions_ - 1 - d), CeedIntPow(num_products_, d), in,
                             arena_[stages_[d]], nothing, is_begun[d]);
      is_begun[d] = true;
      const bool is_last = t + 1 == terms_.size() || !std::equal(own.begin() + d + 1, own.begin() + num_directions_,
                                                                 terms_[t + 1].factors.begin() + d + 1);
      if (d + 1 == num_directions_ || !is_last) break;
      is_begun[d] = false;
      in = arena_[stages_[d]];
    }
  }
}

std::size_t ElementMatrices::num_bytes() const {
  std::size_t bytes = arena_.num_bytes() + places_.size() * sizeof(CeedInt);
  std::size_t numbers = x_ref_.size() + num_point_values_;
  for (const Table &table : tables_) numbers += table.values.size();
  for (const Factor &factor : factors_) bytes += factor.num_bytes();
  return bytes + numbers * sizeof(CeedScalar);
}

void ElementMatrices::compute(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem,
                              const CeedScalar *qfunction, CeedScalar *entries) {
  const CeedSize of_point = static_cast<CeedSize>(program.num_active_in) * program.num_active_out;
  const bool is_matrix = pairs_.kind == CEED_ASSEMBLE_MATRIX;
  const CeedInt P = trial_.num_nodes, M = is_matrix ? test_.num_nodes : 1;
  EntryPlaces to{.places = places_.data(),
                 .num_rows = M,
                 .num_columns = P,
                 .num_elem = 0,
                 .row_stride = static_cast<CeedSize>(pairs_.num_columns) * P,
                 .elem_stride = static_cast<CeedSize>(pairs_.count()) * P * M};
  std::unique_ptr<Reader> x_ref;
  if (integrate_ != nullptr) x_ref = std::make_unique<Reader>(program.points);
  for_blocks(first_elem, first_elem + num_elem, kernels_->width, [&](CeedInt first, CeedInt lanes) {
    const CeedScalar *D = qfunction;
    for (CeedInt lane = 0; lane < lanes; lane++) {
      const CeedInt Q = x_ref ? num_points(map_of(program.points_rstr), first + lane) : program.num_qpts;
      if (x_ref) make_moments(program, lane, first + lane, x_ref->data(), qfunction);
      qfunction += Q * of_point;
    }
    to.num_elem = lanes;
    for (CeedInt pair = 0; pair < pairs_.count(); pair++) {
      if (x_ref) {
        read_moments(lanes, pair);
      } else {
        read_values(program, lanes, D, pair);
      }
      contract();
      // Blocks of a diagonal follow each other; those of a matrix stand in its rows and columns.
      const CeedSize first_row = is_matrix ? static_cast<CeedSize>(pairs_.row(pair)) * M : 0;
      const CeedSize first_column = static_cast<CeedSize>(is_matrix ? pairs_.column(pair) : pair) * P;
      kernels_->to_entries(to, arena_[stages_[num_directions_ - 1]],
                           entries + first_row * to.row_stride + first_column);
    }
    entries += lanes * to.elem_stride;
  });
  if (x_ref) x_ref->release();
}

}  // namespace hg::host
