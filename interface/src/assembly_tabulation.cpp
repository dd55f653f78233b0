// Bases at the points of one element after another.
#include <algorithm>

#include "assembly.hpp"

namespace hg {

namespace {

/// Values and derivatives at x of the 1D basis functions, Σ_k T_k(x) C_kj, by T_(k+1) = 2 x T_k - T_(k-1).
void evaluate_chebyshev(const CeedBasis_private &basis, CeedScalar x, CeedScalar *value, CeedScalar *derivative) {
  const CeedInt P = basis.P_1d, size = basis.num_chebyshev();
  std::fill_n(value, P, 0.0);
  std::fill_n(derivative, P, 0.0);
  CeedScalar t = 1.0, t_before = x, dt = 0.0, dt_before = 1.0;  // T_0 and T_(-1) = T_1
  for (CeedInt k = 0; k < size; k++) {
    const CeedScalar *row = &basis.chebyshev_1d[static_cast<std::size_t>(k) * P];
    for (CeedInt j = 0; j < P; j++) {
      value[j] += t * row[j];
      derivative[j] += dt * row[j];
    }
    const CeedScalar t_next = 2.0 * x * t - t_before, dt_next = 2.0 * t + 2.0 * x * dt - dt_before;
    t_before = std::exchange(t, t_next);
    dt_before = std::exchange(dt, dt_next);
  }
}

/// Products of one factor for each direction, x fastest: P^dim of them.
void tensor_product(CeedInt dim, CeedInt P, const CeedScalar *const *factors, CeedScalar *product) {
  std::copy_n(factors[0], P, product);
  CeedInt size = P;
  for (CeedInt d = 1; d < dim; d++) {
    // Backwards, so that what is still to be read is not overwritten.
    for (CeedInt j = P - 1; j >= 0; j--) {
      const CeedScalar factor = factors[d][j];
      for (CeedInt i = 0; i < size; i++) product[j * size + i] = product[i] * factor;
    }
    size *= P;
  }
}

}  // namespace

Tabulation::Tabulation(const CeedProgram &program) : program_(program), spaces_(program.num_spaces) {
  const auto add = [&](const CeedProgramField *fields, CeedInt count, const CeedProgramSide *sides) {
    for (CeedInt i = 0; i < count; i++) {
      if (fields[i].first_value < 0) continue;
      if (fields[i].space < 0) {
        add_nodes(*sides[fields[i].side].rstr);
        continue;
      }
      Space &space = spaces_[fields[i].space];
      space.rstr = program.spaces[fields[i].space].rstr;
      space.basis = program.spaces[fields[i].space].basis;
      (fields[i].eval_mode == CEED_EVAL_INTERP ? space.is_interpolated : space.is_derived) = true;
    }
  };
  add(program.inputs, program.num_inputs, program.sources);
  add(program.outputs, program.num_outputs, program.sinks);
  if (program.at_points) points_.emplace(program.points);
  for (Space &space : spaces_) {
    if (space.basis == nullptr) continue;
    CeedBasis_private &basis = *space.basis;
    if (program.at_points) {
      const std::size_t size = static_cast<std::size_t>(program.num_qpts) * basis.P;
      if (space.is_interpolated) space.own_interp.resize(size);
      if (space.is_derived) space.own_derivative.resize(size * basis.dim);
      space.interp = {space.own_interp.data(), basis.P, basis.P};
      space.derivative = {space.own_derivative.data(), static_cast<CeedSize>(basis.dim) * basis.P, basis.P};
      values_1d_.resize(std::max(values_1d_.size(), 2 * static_cast<std::size_t>(basis.dim) * basis.P_1d));
      continue;
    }
    const auto of_basis = [&](bool is_used, CeedEvalMode mode, std::vector<CeedScalar> &own) -> FunctionValues {
      if (!is_used) return {};
      const std::vector<CeedScalar> &values = matrix(basis, mode);
      if (space.rstr->num_bands > 0) own = values;
      return {space.rstr->num_bands > 0 ? own.data() : values.data(), basis.P,
              static_cast<CeedSize>(basis.Q) * basis.P};
    };
    space.interp = of_basis(space.is_interpolated, CEED_EVAL_INTERP, space.own_interp);
    space.derivative = of_basis(space.is_derived, derivative_mode(basis.fe_space), space.own_derivative);
  }
}

void Tabulation::add_nodes(const CeedElemRestriction_private &rstr) {
  const auto Q = static_cast<std::size_t>(program_.num_qpts);
  if (Q == 0) return;
  if (rstr.num_bands > 0) {
    TurnedNodes &nodes = turned_nodes_.emplace_back();
    nodes.rstr = &rstr;
    nodes.own.resize(Q * Q);
    nodes.values = {nodes.own.data(), program_.num_qpts, 0};
  } else if (identity_values_.empty()) {
    // Row q of the identity is read from one array, with its 1 at place q.
    identity_values_.assign(2 * Q - 1, 0.0);
    identity_values_[Q - 1] = 1.0;
    identity_ = {&identity_values_[Q - 1], -1, 0};
  }
}

void Tabulation::move_to(CeedInt e) {
  for (Space &space : spaces_) {
    if (space.basis == nullptr) continue;
    if (program_.at_points) tabulate_at_points(e, space);
    if (space.rstr->num_bands > 0) turn(e, space);
  }
  for (TurnedNodes &nodes : turned_nodes_) {
    const CeedInt Q = program_.num_qpts;
    std::fill(nodes.own.begin(), nodes.own.end(), 0.0);
    for (CeedInt q = 0; q < Q; q++) {
      nodes.rstr->for_each_turned(e, q, [&](CeedInt m, CeedInt8 entry) { nodes.own[q * Q + m] = entry; });
    }
  }
}

const FunctionValues &Tabulation::operator()(const CeedProgramField &field,
                                             const CeedElemRestriction_private &rstr) const {
  if (field.space < 0) {
    const auto turned = std::find_if(turned_nodes_.begin(), turned_nodes_.end(),
                                     [&](const TurnedNodes &nodes) { return nodes.rstr == &rstr; });
    return turned != turned_nodes_.end() ? turned->values : identity_;
  }
  const Space &space = spaces_[field.space];
  return field.eval_mode == CEED_EVAL_INTERP ? space.interp : space.derivative;
}

// For each point 4 P_1d^2 dim flops for the 1D functions and about P (1 + 1/P_1d + ...) for each value of the product.
void Tabulation::tabulate_at_points(CeedInt e, Space &space) {
  const CeedBasis_private &basis = *space.basis;
  const auto points = points_in_element(*program_.points_rstr, e);
  const CeedInt dim = basis.dim, P = basis.P_1d;
  for (CeedInt q = 0; q < points.size; q++) {
    const CeedScalar *x = points_->data() + static_cast<CeedSize>(points.points[q]) * dim;
    const CeedScalar *value[3] = {}, *derivative[3] = {};
    for (CeedInt d = 0; d < dim; d++) {
      CeedScalar *to = &values_1d_[static_cast<std::size_t>(2 * d) * P];
      evaluate_chebyshev(basis, x[d], to, to + P);
      value[d] = to;
      derivative[d] = to + P;
    }
    if (space.is_interpolated) tensor_product(dim, P, value, &space.own_interp[static_cast<std::size_t>(q) * basis.P]);
    for (CeedInt g = 0; space.is_derived && g < dim; g++) {
      const CeedScalar *factors[3] = {value[0], value[1], value[2]};
      factors[g] = derivative[g];
      tensor_product(dim, P, factors, &space.own_derivative[(static_cast<std::size_t>(q) * dim + g) * basis.P]);
    }
  }
}

// B T_e: with the element's nodes turned, function m of the L-vector is Σ_n T_e(n,m) times function n of the element.
void Tabulation::turn(CeedInt e, Space &space) {
  const CeedInt P = space.basis->P;
  work_.resize(P);
  const auto turn_rows = [&](const std::vector<CeedScalar> *from, std::vector<CeedScalar> &to) {
    for (std::size_t first = 0; first < to.size(); first += P) {
      const CeedScalar *row = from != nullptr ? from->data() + first : to.data() + first;
      std::fill(work_.begin(), work_.end(), 0.0);
      for (CeedInt n = 0; n < P; n++) {
        space.rstr->for_each_turned(e, n, [&](CeedInt m, CeedInt8 entry) { work_[m] += row[n] * entry; });
      }
      std::copy(work_.begin(), work_.end(), to.begin() + static_cast<std::ptrdiff_t>(first));
    }
  };
  // At points the values have just been tabulated; at quadrature points they are the basis' own.
  const auto source = [&](CeedEvalMode mode) { return program_.at_points ? nullptr : &matrix(*space.basis, mode); };
  if (space.is_interpolated) turn_rows(source(CEED_EVAL_INTERP), space.own_interp);
  if (space.is_derived) turn_rows(source(derivative_mode(space.basis->fe_space)), space.own_derivative);
}

Functions::Functions(const CeedProgram &program, const Tabulation &tabulation, bool is_trial, CeedInt side)
    : rstr_(is_trial ? program.sources[side].rstr : program.sinks[side].rstr) {
  const CeedProgramField *fields = is_trial ? program.inputs : program.outputs;
  const CeedInt count = is_trial ? program.num_inputs : program.num_outputs;
  for (CeedInt i = 0; i < count; i++) {
    if (fields[i].side != side || fields[i].first_value < 0) continue;
    for (CeedInt d = 0; d < fields[i].size / rstr_->num_comp; d++) {
      rows_.push_back({&tabulation(fields[i], *rstr_), d, fields[i].first_value + d * rstr_->num_comp});
    }
  }
}

std::vector<Coupling> couplings(const CeedProgram &program) {
  std::vector<Coupling> all;
  for (CeedInt s = 0; s < program.num_sources; s++) {
    for (CeedInt t = 0; t < program.num_sinks; t++) {
      if (!program.sources[s].is_active || !program.sinks[t].is_active) continue;
      all.push_back({s, t, *program.sources[s].rstr, *program.sinks[t].rstr});
    }
  }
  return all;
}

const CoupledFunctions &FunctionTables::move_to(std::size_t i, CeedInt e) {
  if (!tabulation_) {
    tabulation_.emplace(program_);
    for (const Coupling &coupling : all_) {
      functions_.push_back({Functions(program_, *tabulation_, true, coupling.source),
                            Functions(program_, *tabulation_, false, coupling.sink)});
    }
  }
  if (e != element_) tabulation_->move_to(e);
  element_ = e;
  return functions_[i];
}

}  // namespace hg
