#include "block_basis.hpp"

#include <algorithm>
#include <cmath>

namespace hg::host {

namespace {

/// Symmetry up to rounding: points and weights are computed.
Symmetry symmetry_of(const std::vector<CeedScalar> &B, CeedInt M, CeedInt N) {
  CeedScalar largest = 0, even = 0, odd = 0;
  for (CeedInt m = 0; m < M; m++) {
    for (CeedInt n = 0; n < N; n++) {
      const CeedScalar here = B[m * N + n], there = B[(M - 1 - m) * N + N - 1 - n];
      largest = std::max(largest, std::abs(here));
      even = std::max(even, std::abs(here - there));
      odd = std::max(odd, std::abs(here + there));
    }
  }
  const CeedScalar tolerance = 1e-14 * largest;
  return even <= tolerance ? Symmetry::even : odd <= tolerance ? Symmetry::odd : Symmetry::none;
}

/// The coefficients of even-odd kernels, see Contraction.
std::vector<CeedScalar> even_odd(const std::vector<CeedScalar> &B, CeedInt M, CeedInt N) {
  std::vector<CeedScalar> coefficients;
  for (CeedInt m = 0; m < (M + 1) / 2; m++) {
    const CeedScalar *row = &B[m * N];
    for (CeedInt n = 0; n < (N + 1) / 2; n++) {
      coefficients.push_back(n == N - 1 - n ? row[n] : 0.5 * (row[n] + row[N - 1 - n]));
    }
    for (CeedInt n = 0; n < N / 2; n++) coefficients.push_back(0.5 * (row[n] - row[N - 1 - n]));
  }
  return coefficients;
}

/// B, and its columns where kernels want them, see Kernels::columns.
std::vector<CeedScalar> with_columns(const std::vector<CeedScalar> &B, CeedInt M, CeedInt N, CeedInt multiple) {
  std::vector<CeedScalar> coefficients = B;
  for (CeedInt n = 0; multiple > 0 && n < N; n++) {
    for (CeedInt m = 0; m < (M + multiple - 1) / multiple * multiple; m++) {
      coefficients.push_back(m < M ? B[m * N + n] : 0.0);
    }
  }
  return coefficients;
}

}  // namespace

Factor::Direction Factor::prepare(const Kernels &kernels, const std::vector<CeedScalar> &B, CeedInt M, CeedInt N) {
  const Symmetry symmetry = symmetry_of(B, M, N);
  if (symmetry != Symmetry::none && kernels.contraction(M, N, symmetry, false) != nullptr) {
    return {M,
            N,
            symmetry,
            even_odd(B, M, N),
            {kernels.contraction(M, N, symmetry, false), kernels.contraction(M, N, symmetry, true)}};
  }
  return {M,
          N,
          Symmetry::none,
          with_columns(B, M, N, kernels.columns),
          {kernels.contraction(M, N, Symmetry::none, false), kernels.contraction(M, N, Symmetry::none, true)}};
}

Factor::Factor(const Kernels &kernels, const CeedScalar *B, CeedInt M, CeedInt N) {
  const std::vector<CeedScalar> matrix(B, B + static_cast<std::size_t>(M) * N);
  std::vector<CeedScalar> transpose(matrix.size());
  for (CeedInt m = 0; m < M; m++) {
    for (CeedInt n = 0; n < N; n++) transpose[n * M + m] = matrix[m * N + n];
  }
  forward_ = prepare(kernels, matrix, M, N);
  back_ = prepare(kernels, transpose, N, M);
}

BlockBasis::BlockBasis(const Kernels &kernels, CeedBasis basis) : BlockBasis(kernels, BasisFactors(basis)) {}

BlockBasis::BlockBasis(const Kernels &kernels, const BasisFactors &factors)
    : route_(factors.route),
      width_(kernels.width),
      num_directions_(factors.num_directions),
      num_comp_(factors.num_comp),
      P_(factors.P),
      Q_(factors.Q),
      weights_(factors.weights) {
  if (route_ == Route::full) {
    for (const CeedScalar *B : factors.interp) interp_.emplace_back(kernels, B, Q_, P_);
    for (const CeedScalar *B : factors.derivative) derivative_.emplace_back(kernels, B, Q_, P_);
  } else {
    interp_1d_ = Factor(kernels, factors.interp_1d.data(), Q_, P_);
    grad_1d_ = Factor(kernels, factors.grad_1d.data(), Q_, route_ == Route::collocated ? Q_ : P_);
  }
  work_stride_ = static_cast<std::size_t>(power(std::max(P_, Q_), num_directions_)) * num_comp_ * width_;
}

// values(i, j, k) = Σ A_2(k, n) A_1(j, m) A_0(i, l) u(l, m, n), A_d the derivative where d is derived_direction.
void BlockBasis::to_points(const CeedScalar *u, CeedScalar *values, CeedInt derived_direction, CeedScalar *work,
                           Ahead &ahead) const {
  const CeedInt last = num_directions_ - 1;
  for (CeedInt d = 0; d <= last; d++) {
    CeedScalar *out = d == last ? values : work + (d % 2) * work_stride_;
    (d == derived_direction ? grad_1d_ : interp_1d_)
        .apply(num_comp_ * power(P_, last - d), power(Q_, d), u, out, ahead);
    u = out;
  }
}

void BlockBasis::to_nodes(const CeedScalar *values, CeedScalar *u, CeedInt derived_direction, bool add,
                          CeedScalar *work, Ahead &ahead) const {
  const CeedInt last = num_directions_ - 1;
  for (CeedInt d = 0; d <= last; d++) {
    CeedScalar *out = d == last ? u : work + (d % 2) * work_stride_;
    (d == derived_direction ? grad_1d_ : interp_1d_)
        .apply_transpose(num_comp_ * power(Q_, last - d), power(P_, d), values, out, ahead, add && d == last);
    values = out;
  }
}

void BlockBasis::evaluate(const CeedScalar *u, CeedScalar *interp, CeedScalar *derivative, CeedScalar *work,
                          Ahead &ahead) const {
  const CeedInt dim = num_directions_;
  const std::size_t size = static_cast<std::size_t>(num_comp_) * num_points() * width_;
  switch (route_) {
    case Route::identity:
      if (interp != nullptr) std::copy_n(u, size, interp);
      break;
    case Route::collocated: {
      CeedScalar *values = interp != nullptr ? interp : work + 2 * work_stride_;
      to_points(u, values, -1, work, ahead);
      u = values;
      break;
    }
    case Route::chains:
      if (interp != nullptr) to_points(u, interp, -1, work, ahead);
      for (CeedInt g = 0; derivative != nullptr && g < dim; g++) to_points(u, derivative + g * size, g, work, ahead);
      return;
    case Route::full:
      for (std::size_t g = 0; interp != nullptr && g < interp_.size(); g++) {
        interp_[g].apply(num_comp_, 1, u, interp + g * size, ahead);
      }
      for (std::size_t g = 0; derivative != nullptr && g < derivative_.size(); g++) {
        derivative_[g].apply(num_comp_, 1, u, derivative + g * size, ahead);
      }
      return;
  }
  for (CeedInt g = 0; derivative != nullptr && g < dim; g++) {
    grad_1d_.apply(num_comp_ * power(Q_, dim - 1 - g), power(Q_, g), u, derivative + g * size, ahead);
  }
}

void BlockBasis::integrate(CeedScalar *interp, const CeedScalar *derivative, CeedScalar *u, bool add, CeedScalar *work,
                           Ahead &ahead) const {
  const CeedInt dim = num_directions_;
  const std::size_t size = static_cast<std::size_t>(num_comp_) * num_points() * width_;
  const auto add_derivatives = [&](CeedScalar *values, bool add_first) {
    for (CeedInt g = 0; derivative != nullptr && g < dim; g++) {
      grad_1d_.apply_transpose(num_comp_ * power(Q_, dim - 1 - g), power(Q_, g), derivative + g * size, values, ahead,
                               add_first || g > 0);
    }
  };
  switch (route_) {
    case Route::identity:
      if (interp != nullptr && add) {
        for (std::size_t i = 0; i < size; i++) u[i] += interp[i];
      } else if (interp != nullptr) {
        std::copy_n(interp, size, u);
      }
      add_derivatives(u, add || interp != nullptr);
      break;
    case Route::collocated: {
      CeedScalar *values = interp != nullptr ? interp : work + 2 * work_stride_;
      add_derivatives(values, interp != nullptr);
      to_nodes(values, u, -1, add, work, ahead);
      break;
    }
    case Route::chains:
      if (interp != nullptr) to_nodes(interp, u, -1, add, work, ahead);
      for (CeedInt g = 0; derivative != nullptr && g < dim; g++) {
        to_nodes(derivative + g * size, u, g, add || interp != nullptr || g > 0, work, ahead);
      }
      break;
    case Route::full:
      for (std::size_t g = 0; interp != nullptr && g < interp_.size(); g++) {
        interp_[g].apply_transpose(num_comp_, 1, interp + g * size, u, ahead, add || g > 0);
      }
      for (std::size_t g = 0; derivative != nullptr && g < derivative_.size(); g++) {
        derivative_[g].apply_transpose(num_comp_, 1, derivative + g * size, u, ahead,
                                       add || interp != nullptr || g > 0);
      }
      break;
  }
}

}  // namespace hg::host
