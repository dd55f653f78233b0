#include "basis.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace hg::ref {

namespace {

/// out(a, i, c) (+)= sum_j matrix(i, j) in(a, j, c), a = 0 .. before-1 fastest, c = 0 .. after-1 slowest.
void contract_direction(const CeedScalar *matrix, CeedInt rows, CeedInt columns, CeedInt before, CeedInt after,
                        const CeedScalar *in, CeedScalar *out, bool add) {
  if (!add) std::fill_n(out, static_cast<CeedSize>(before) * rows * after, 0.0);
  for (CeedInt c = 0; c < after; c++) {
    for (CeedInt i = 0; i < rows; i++) {
      CeedScalar *out_i = out + (static_cast<CeedSize>(c) * rows + i) * before;
      for (CeedInt j = 0; j < columns; j++) {
        const CeedScalar m = matrix[i * columns + j];
        const CeedScalar *in_j = in + (static_cast<CeedSize>(c) * columns + j) * before;
        for (CeedInt a = 0; a < before; a++) out_i[a] += m * in_j[a];
      }
    }
  }
}

std::vector<CeedScalar> transpose(const std::vector<CeedScalar> &a, CeedInt rows, CeedInt columns) {
  std::vector<CeedScalar> t(a.size());
  for (CeedInt i = 0; i < rows; i++) {
    for (CeedInt j = 0; j < columns; j++) t[j * rows + i] = a[i * columns + j];
  }
  return t;
}

}  // namespace

void ElementBasis::add_factors(const CeedScalar *matrices, CeedInt count) {
  const std::size_t size = static_cast<std::size_t>(Q_) * P_;
  for (CeedInt g = 0; g < count; g++) {
    std::vector<CeedScalar> matrix(matrices + g * size, matrices + (g + 1) * size), t = transpose(matrix, Q_, P_);
    factors_.push_back({std::move(matrix), std::move(t)});
  }
}

int ElementBasis::create(CeedBasis basis, ElementBasis *element_basis) {
  ElementBasis b;
  const CeedScalar *interp, *derivative, *weight, *chebyshev = nullptr;
  CeedCallBackend(CeedBasisIsTensor(basis, &b.is_tensor_));
  CeedCallBackend(CeedBasisGetDimension(basis, &b.dim_));
  CeedCallBackend(CeedBasisGetNumComponents(basis, &b.num_comp_));
  if (b.is_tensor_) {
    b.num_directions_ = b.q_derivative_ = b.dim_;
    CeedCallBackend(CeedBasisGetNumNodes1D(basis, &b.P_));
    CeedCallBackend(CeedBasisGetNumQuadraturePoints1D(basis, &b.Q_));
    CeedCallBackend(CeedBasisGetInterp1D(basis, &interp));
    CeedCallBackend(CeedBasisGetGrad1D(basis, &derivative));
    CeedCallBackend(CeedBasisGetChebyshevCoefficients1D(basis, &b.num_coeff_, &chebyshev));
    b.add_factors(interp, 1);
    b.add_factors(derivative, 1);
  } else {
    CeedEvalMode mode = CEED_EVAL_NONE;
    b.num_directions_ = 1;
    CeedCallBackend(CeedBasisGetNumNodes(basis, &b.P_));
    CeedCallBackend(CeedBasisGetNumQuadraturePoints(basis, &b.Q_));
    CeedCallBackend(CeedBasisGetNumQuadratureComponents(basis, CEED_EVAL_INTERP, &b.q_interp_));
    CeedCallBackend(CeedBasisGetInterp(basis, &interp));
    b.add_factors(interp, b.q_interp_);
    CeedCallBackend(CeedBasisGetDerivativeMode(basis, &mode));
    if (mode != CEED_EVAL_NONE) {
      CeedCallBackend(CeedBasisGetNumQuadratureComponents(basis, mode, &b.q_derivative_));
      CeedCallBackend(CeedOperatorGetBasisPointer(basis, mode, nullptr, &derivative));
      b.add_factors(derivative, b.q_derivative_);
    }
  }
  CeedCallBackend(CeedBasisGetQWeights(basis, &weight));
  b.weight_.assign(weight, weight + b.Q_);
  if (b.num_coeff_ > 0) b.chebyshev_.assign(chebyshev, chebyshev + b.num_coeff_ * b.P_);
  const std::size_t most = static_cast<std::size_t>(power(std::max(b.P_, b.Q_), b.num_directions_)) * b.num_comp_;
  for (auto &work : b.work_) work.resize(b.num_directions_ > 1 ? most : 0);
  if (b.can_evaluate_at_points()) {
    const std::size_t at_nodes = static_cast<std::size_t>(b.num_nodes()) * b.num_comp_;
    b.node_lanes_.resize(at_nodes);
    for (auto &partials : b.partials_) partials.resize((b.dim_ + 1) * at_nodes);
  }
  *element_basis = std::move(b);
  return CEED_ERROR_SUCCESS;
}

// u(i, j, k) -> sum_ijk A_0(x, i) A_1(y, j) A_2(z, k) u(i, j, k) with the factors A_d of each value.
void ElementBasis::apply(CeedEvalMode mode, const CeedScalar *u, CeedScalar *v) {
  const CeedInt last = num_directions_ - 1;
  const CeedSize size = static_cast<CeedSize>(num_quadrature_points()) * num_comp_;
  for (CeedInt g = 0; g < q_comp(mode); g++) {
    const CeedScalar *in = u;
    for (CeedInt d = 0; d <= last; d++) {
      CeedScalar *out = d == last ? v + g * size : work_[d].data();
      contract_direction(factor(mode, g, d).matrix.data(), Q_, P_, power(Q_, d), power(P_, last - d) * num_comp_, in,
                         out, false);
      in = out;
    }
  }
}

void ElementBasis::apply_transpose_add(CeedEvalMode mode, const CeedScalar *v, CeedScalar *u) {
  const CeedInt last = num_directions_ - 1;
  const CeedSize size = static_cast<CeedSize>(num_quadrature_points()) * num_comp_;
  for (CeedInt g = 0; g < q_comp(mode); g++) {
    const CeedScalar *in = v + g * size;
    for (CeedInt d = 0; d <= last; d++) {
      CeedScalar *out = d == last ? u : work_[d].data();
      contract_direction(factor(mode, g, d).transpose.data(), P_, Q_, power(P_, d), power(Q_, last - d) * num_comp_, in,
                         out, d == last);
      in = out;
    }
  }
}

void ElementBasis::weights(CeedScalar *w) const {
  for (CeedInt q = 0; q < num_quadrature_points(); q++) {
    w[q] = 1.0;
    for (CeedInt d = 0, rest = q; d < num_directions_; d++, rest /= Q_) w[q] *= weight_[rest % Q_];
  }
}

// value_j(x) = sum_k c(k, j) T_k(x), derivative_j(x) = sum_k c(k, j) T_k'(x), T_(k+1) = 2 x T_k - T_(k-1).
// Points beyond the last fill its block up; they lie at the centre and their results go nowhere.
void ElementBasis::set_points(CeedInt num_points, const CeedScalar *x_ref) {
  num_points_ = num_points;
  const CeedInt num_blocks = (num_points + lanes - 1) / lanes;
  if (table_.size() < static_cast<std::size_t>(num_blocks) * dim_ * 2 * P_) table_.resize(num_blocks * dim_ * 2 * P_);
  for (CeedInt block = 0; block < num_blocks; block++) {
    const CeedInt first = block * lanes, count = std::min(lanes, num_points - first);
    for (CeedInt d = 0; d < dim_; d++) {
      Lane *value = &table_[(block * dim_ + d) * 2 * P_], *derivative = value + P_;
      Lane x{}, t{}, dt{}, t_last{}, dt_last{};
      for (CeedInt w = 0; w < count; w++) x.v[w] = x_ref[d * static_cast<CeedSize>(num_points) + first + w];
      for (CeedInt w = 0; w < lanes; w++) t.v[w] = 1.0;
      for (CeedInt j = 0; j < P_; j++) value[j] = derivative[j] = Lane{};
      for (CeedInt k = 0; k < num_coeff_; k++) {
        for (CeedInt j = 0; j < P_; j++) {
          const CeedScalar c = chebyshev_[k * P_ + j];
          for (CeedInt w = 0; w < lanes; w++) {
            value[j].v[w] += c * t.v[w];
            derivative[j].v[w] += c * dt.v[w];
          }
        }
        const CeedScalar two = k == 0 ? 1.0 : 2.0;  // T_1 = x T_0
        for (CeedInt w = 0; w < lanes; w++) {
          const CeedScalar t_next = two * x.v[w] * t.v[w] - t_last.v[w];
          const CeedScalar dt_next = two * (t.v[w] + x.v[w] * dt.v[w]) - dt_last.v[w];
          t_last.v[w] = t.v[w];
          t.v[w] = t_next;
          dt_last.v[w] = dt.v[w];
          dt.v[w] = dt_next;
        }
      }
    }
  }
}

/// out(r) = sum_i table(i) in(i, r)
void ElementBasis::contract(CeedInt rows, CeedInt P, const Lane *table, const Lane *in, Lane *out) {
  for (CeedInt r = 0; r < rows; r++) {
    Lane sum{};
    for (CeedInt i = 0; i < P; i++) {
      for (CeedInt w = 0; w < lanes; w++) sum.v[w] += table[i].v[w] * in[r * P + i].v[w];
    }
    out[r] = sum;
  }
}

/// out(i, r) += table(i) in(r)
void ElementBasis::expand_add(CeedInt rows, CeedInt P, const Lane *table, const Lane *in, Lane *out) {
  for (CeedInt r = 0; r < rows; r++) {
    for (CeedInt i = 0; i < P; i++) {
      for (CeedInt w = 0; w < lanes; w++) out[r * P + i].v[w] += table[i].v[w] * in[r].v[w];
    }
  }
}

// x, y and z are summed out one after another. After direction d, partial result 0 is the value and 1+g (g <= d) the
// derivative in direction g, each with P^(dim-1-d) nc entries.
void ElementBasis::apply_at_points(CeedEvalMode mode, const CeedScalar *u, CeedScalar *v) {
  const CeedInt at_nodes = num_nodes() * num_comp_;
  const bool is_grad = mode == CEED_EVAL_GRAD;
  for (CeedInt n = 0; n < at_nodes; n++) {
    for (CeedInt w = 0; w < lanes; w++) node_lanes_[n].v[w] = u[n];
  }
  for (CeedInt block = 0; block * lanes < num_points_; block++) {
    const Lane *in = node_lanes_.data();
    CeedInt rows = at_nodes;
    for (CeedInt d = 0; d < dim_; d++) {
      const Lane *value = value_1d(block, d), *derivative = derivative_1d(block, d);
      Lane *out = partials_[d % 2].data();
      rows /= P_;
      const auto partial_in = [&](CeedInt k) { return in + k * rows * P_; };
      const auto partial_out = [&](CeedInt k) { return out + k * rows; };
      if (is_grad) {
        for (CeedInt g = 0; g < d; g++) contract(rows, P_, value, partial_in(1 + g), partial_out(1 + g));
        contract(rows, P_, derivative, in, partial_out(1 + d));
      }
      if (!is_grad || d + 1 < dim_) contract(rows, P_, value, in, out);
      in = out;
    }
    const CeedInt first = block * lanes, count = std::min(lanes, num_points_ - first);
    for (CeedInt i = 0; i < q_comp(mode) * num_comp_; i++) {
      std::copy_n(in[(is_grad ? num_comp_ : 0) + i].v, count, v + i * static_cast<CeedSize>(num_points_) + first);
    }
  }
}

// The same steps backwards.
void ElementBasis::apply_transpose_add_at_points(CeedEvalMode mode, const CeedScalar *v, CeedScalar *u) {
  const CeedInt at_nodes = num_nodes() * num_comp_;
  const bool is_grad = mode == CEED_EVAL_GRAD;
  std::fill_n(node_lanes_.begin(), at_nodes, Lane{});
  for (CeedInt block = 0; block * lanes < num_points_; block++) {
    const CeedInt first = block * lanes, count = std::min(lanes, num_points_ - first);
    Lane *in = partials_[dim_ % 2].data();
    for (CeedInt i = 0; i < q_comp(mode) * num_comp_; i++) {
      Lane &lane = in[(is_grad ? num_comp_ : 0) + i];
      lane = Lane{};
      std::copy_n(v + i * static_cast<CeedSize>(num_points_) + first, count, lane.v);
    }
    CeedInt rows = num_comp_;
    for (CeedInt d = dim_ - 1; d >= 0; d--, rows *= P_) {
      const Lane *value = value_1d(block, d), *derivative = derivative_1d(block, d);
      Lane *out = d == 0 ? node_lanes_.data() : partials_[d % 2].data();
      const auto partial_in = [&](CeedInt k) { return in + k * rows; };
      const auto partial_out = [&](CeedInt k) { return out + k * rows * P_; };
      if (d > 0) std::fill_n(out, (is_grad ? 1 + d : 1) * rows * P_, Lane{});
      if (!is_grad || d + 1 < dim_) expand_add(rows, P_, value, in, out);
      if (is_grad) {
        expand_add(rows, P_, derivative, partial_in(1 + d), out);
        for (CeedInt g = 0; g < d; g++) expand_add(rows, P_, value, partial_in(1 + g), partial_out(1 + g));
      }
      in = out;
    }
  }
  for (CeedInt n = 0; n < at_nodes; n++) {
    for (CeedInt w = 0; w < lanes; w++) u[n] += node_lanes_[n].v[w];
  }
}

namespace {

int basis_create(CeedBasis basis) {
  auto element_basis = std::make_unique<ElementBasis>();
  CeedCallBackend(ElementBasis::create(basis, element_basis.get()));
  CeedCallBackend(CeedBasisSetData(basis, element_basis.release()));
  return CEED_ERROR_SUCCESS;
}

int basis_destroy(CeedBasis basis) {
  ElementBasis *element_basis;
  CeedCallBackend(CeedBasisGetData(basis, &element_basis));
  delete element_basis;
  return CEED_ERROR_SUCCESS;
}

/// Host arrays of the vectors of an application for a scope; those of vectors that are NULL are not asked for. An empty
/// vector's array may be NULL, and is given back all the same.
class Arrays {
 public:
  Arrays() = default;
  Arrays(const Arrays &) = delete;
  Arrays &operator=(const Arrays &) = delete;
  ~Arrays() { release(); }

  int get(CeedTransposeMode t_mode, bool add, CeedVector x_ref, CeedVector u, CeedVector v) {
    if (u != nullptr) CeedCallBackend(CeedVectorGetArrayRead(u, CEED_MEM_HOST, &u_array));
    u_ = u;
    if (x_ref != nullptr) CeedCallBackend(CeedVectorGetArrayRead(x_ref, CEED_MEM_HOST, &x_ref_array));
    x_ref_ = x_ref;
    CeedCallBackend(add ? CeedVectorGetArray(v, CEED_MEM_HOST, &v_array)
                        : CeedVectorGetArrayWrite(v, CEED_MEM_HOST, &v_array));
    v_ = v;
    if (t_mode == CEED_NOTRANSPOSE || add) return CEED_ERROR_SUCCESS;
    CeedSize length = 0;
    CeedCallBackend(CeedVectorGetLength(v, &length));
    std::fill_n(v_array, length, 0.0);
    return CEED_ERROR_SUCCESS;
  }

  /// Gives all of them back. The first error, if any.
  int release() {
    int first = CEED_ERROR_SUCCESS;
    const auto keep = [&](int code) { first = first != CEED_ERROR_SUCCESS ? first : code; };
    if (v_ != nullptr) keep(CeedVectorRestoreArray(std::exchange(v_, nullptr), &v_array));
    if (x_ref_ != nullptr) keep(CeedVectorRestoreArrayRead(std::exchange(x_ref_, nullptr), &x_ref_array));
    if (u_ != nullptr) keep(CeedVectorRestoreArrayRead(std::exchange(u_, nullptr), &u_array));
    return first;
  }

  const CeedScalar *u_array = nullptr, *x_ref_array = nullptr;
  CeedScalar *v_array = nullptr;

 private:
  CeedVector x_ref_ = nullptr, u_ = nullptr, v_ = nullptr;  ///< whose arrays are held
};

int basis_apply(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector u,
                CeedVector v, bool add) {
  ElementBasis *b;
  CeedCallBackend(CeedBasisGetData(basis, &b));
  const bool is_weight = eval_mode == CEED_EVAL_WEIGHT;
  Arrays arrays;
  CeedCallBackend(arrays.get(t_mode, add, nullptr, is_weight ? nullptr : u, v));
  const CeedSize Q = b->num_quadrature_points(), at_nodes = static_cast<CeedSize>(b->num_nodes()) * b->num_comp();
  const CeedSize at_points = Q * b->num_comp() * b->q_comp(eval_mode);
  for (CeedInt e = 0; e < num_elem; e++) {
    if (is_weight) {
      b->weights(arrays.v_array + e * Q);
    } else if (t_mode == CEED_NOTRANSPOSE) {
      b->apply(eval_mode, arrays.u_array + e * at_nodes, arrays.v_array + e * at_points);
    } else {
      b->apply_transpose_add(eval_mode, arrays.u_array + e * at_points, arrays.v_array + e * at_nodes);
    }
  }
  return arrays.release();
}

int basis_apply_at_points(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode,
                          CeedEvalMode eval_mode, CeedVector x_ref, CeedVector u, CeedVector v, bool add) {
  ElementBasis *b;
  CeedCallBackend(CeedBasisGetData(basis, &b));
  const bool is_weight = eval_mode == CEED_EVAL_WEIGHT;
  Arrays arrays;
  CeedCallBackend(arrays.get(t_mode, add, is_weight ? nullptr : x_ref, is_weight ? nullptr : u, v));
  const CeedSize at_nodes = static_cast<CeedSize>(b->num_nodes()) * b->num_comp();
  const CeedSize at_a_point = static_cast<CeedSize>(b->num_comp()) * b->q_comp(eval_mode);
  CeedSize first = 0;  // points of the elements before this one
  for (CeedInt e = 0; e < num_elem; first += num_points[e], e++) {
    if (is_weight) {
      std::fill_n(arrays.v_array + first, num_points[e], 1.0);
      continue;
    }
    const CeedScalar *x = arrays.x_ref_array + first * b->dim();
    if (t_mode == CEED_NOTRANSPOSE) {
      b->apply_at_points(eval_mode, num_points[e], x, arrays.u_array + e * at_nodes,
                         arrays.v_array + first * at_a_point);
    } else {
      b->apply_transpose_add_at_points(eval_mode, num_points[e], x, arrays.u_array + first * at_a_point,
                                       arrays.v_array + e * at_nodes);
    }
  }
  return arrays.release();
}

}  // namespace

void fill_basis_ops(CeedBasisOps &ops) {
  ops.create = basis_create;
  ops.destroy = basis_destroy;
  ops.apply = basis_apply;
  ops.apply_at_points = basis_apply_at_points;
}

}  // namespace hg::ref
