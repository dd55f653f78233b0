#include "point_diagonal.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <new>

namespace hg::host {

std::unique_ptr<ElementAssembly> PointDiagonal::make(const Kernels &kernels, const CeedProgram &program, CeedInt source,
                                                     CeedInt sink, CeedAssembleKind kind) {
  if (!program.at_points || kind == CEED_ASSEMBLE_MATRIX) return nullptr;
  std::unique_ptr<PointDiagonal> made(new PointDiagonal(kernels));
  made->pairs_ = {kind, program.sinks[sink].num_comp, program.sources[source].num_comp};
  if (!made->choose(program, source, sink)) return nullptr;
  made->make_terms(program, source, sink);
  const std::size_t size = static_cast<std::size_t>(made->num_nodes_) * made->pairs_.count() * max_width;
  made->sums_ = allocate_array(size);
  if (!made->sums_) throw std::bad_alloc();
  return made;
}

/// One basis, a Chebyshev series, for all fields.
bool PointDiagonal::choose(const CeedProgram &program, CeedInt source, CeedInt sink) {
  bool is_taken = true;
  const auto look = [&](bool is_trial, CeedInt side) {
    const CeedProgramSide &own = is_trial ? program.sources[side] : program.sinks[side];
    is_taken = is_taken && !own.is_points && map_of(own.rstr).num_bands == 0;
    num_nodes_ = own.elem_size;
    for_each_field(program, is_trial, side, [&](const CeedProgramField &, CeedBasis basis) {
      if (basis_ == nullptr) basis_ = basis;
      is_taken = is_taken && basis != CEED_BASIS_NONE && basis == basis_;
    });
  };
  look(true, source);
  look(false, sink);
  if (!is_taken) return false;
  const CeedScalar *coefficients = nullptr;
  CeedInt K = 0;
  chk(CeedBasisGetChebyshevCoefficients1D(basis_, &K, &coefficients));
  if (K == 0) return false;
  chk(CeedBasisGetDimension(basis_, &squares_.points.dim));
  chk(CeedBasisGetNumNodes1D(basis_, &squares_.P));
  coefficients_.assign(coefficients, coefficients + static_cast<std::size_t>(K) * squares_.P);
  squares_.coefficients = coefficients_.data();
  squares_.points.K = K;
  squares_.points.num_comp = pairs_.count();
  integrate_ = kernels_->square_integration(K, squares_.P);
  return integrate_ != nullptr;
}

/// A term for all (l,k) that are the same kinds of products. With values and derivatives of three directions there are
/// ten.
void PointDiagonal::make_terms(const CeedProgram &program, CeedInt source, CeedInt sink) {
  struct Row {
    CeedInt first_value, derived_direction;  ///< -1: values
  };
  const auto rows = [&](bool is_trial, CeedInt side) {
    std::vector<Row> all;
    const CeedInt num_comp = is_trial ? pairs_.num_columns : pairs_.num_rows;
    for_each_field(program, is_trial, side, [&](const CeedProgramField &field, CeedBasis) {
      for (CeedInt d = 0; d < field.size / num_comp; d++) {
        all.push_back({field.first_value + d * num_comp, field.eval_mode == CEED_EVAL_INTERP ? -1 : d});
      }
    });
    return all;
  };
  std::map<std::array<CeedInt, 3>, std::vector<CeedInt>> terms;  // sorted by the kind in the first direction
  for (const Row &k : rows(true, source)) {
    for (const Row &l : rows(false, sink)) {
      std::array<CeedInt, 3> kinds = {};
      for (CeedInt d = 0; d < 3; d++) kinds[d] = (k.derived_direction == d) + (l.derived_direction == d);
      terms[kinds].push_back(k.first_value * program.num_active_out + l.first_value);
    }
  }
  for (const auto &[kinds, components] : terms) {
    std::copy(kinds.begin(), kinds.end(), squares_.kinds[squares_.num_terms++]);
    for (CeedInt kind = kinds[0]; kind < num_square_kinds; kind++) squares_.ends[kind] = squares_.num_terms;
    components_.push_back(components);
  }
}

std::size_t PointDiagonal::num_bytes() const {
  const std::size_t num_sums = static_cast<std::size_t>(num_nodes_) * pairs_.count() * max_width;
  return (num_sums + coefficients_.size() + x_ref_.size() + values_.size()) * sizeof(CeedScalar);
}

void PointDiagonal::compute(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem,
                            const CeedScalar *qfunction, CeedScalar *entries) {
  const CeedElementMap &map = map_of(program.points_rstr);
  const CeedInt of_point = program.num_active_in * program.num_active_out, dim = squares_.points.dim;
  Reader x_ref(program.points);
  Ahead nothing;
  squares_.points.ahead = &nothing;
  for (CeedInt e = first_elem; e < first_elem + num_elem; e++) {
    const CeedInt Q = num_points(map, e);
    x_ref_.resize(static_cast<std::size_t>(Q) * dim + max_width);
    kernels_->gather_points(Q, dim, places_of_points(map, e), x_ref.data(), map.l_size, Q, x_ref_.data());
    values_.resize(static_cast<std::size_t>(Q) * squares_.num_terms * pairs_.count() + max_width);
    CeedScalar *to = values_.data();
    for (CeedInt pair = 0; pair < pairs_.count(); pair++) {
      const CeedScalar *D = qfunction + pairs_.component(pair, program.num_active_out);
      for (const auto &components : components_) {
        std::fill_n(to, Q, 0.0);
        for (const CeedInt own : components) {
          for (CeedInt q = 0; q < Q; q++) to[q] += D[static_cast<CeedSize>(q) * of_point + own];
        }
        to += Q;
      }
    }
    squares_.points.num_points = Q;
    squares_.points.x_ref = x_ref_.data();
    squares_.points.stride = Q;
    integrate_(squares_, values_.data(), sums_.get(), entries);
    qfunction += static_cast<CeedSize>(Q) * of_point;
    entries += static_cast<CeedSize>(num_nodes_) * pairs_.count();
  }
  x_ref.release();
}

}  // namespace hg::host
