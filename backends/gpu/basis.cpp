#include "basis.hpp"

#include <memory>
#include <span>
#include <vector>

#include "../host/access.hpp"
#include "tables.hpp"

namespace hg::gpu {

using host::chk, host::wall;

Points::Points(CeedInt num_elem, CeedInt num_qpts)
    : facts_{.num_points = static_cast<CeedSize>(num_elem) * num_qpts, .num_qpts = num_qpts} {}

Points::Points(Device &device, CeedInt num_elem, const CeedInt *counts) {
  std::vector<CeedSize> starts(num_elem + 1, 0);
  std::vector<CeedInt> elem;
  for (CeedInt e = 0; e < num_elem; e++) {
    starts[e + 1] = starts[e] + counts[e];
    elem.insert(elem.end(), counts[e], e);
  }
  starts_ = device.upload(starts);
  elem_ = device.upload(elem);
  facts_ = {.num_points = starts[num_elem], .starts = starts_.as<CeedSize>(), .elem = elem_.as<CeedInt>()};
}

BasisTables::BasisTables(Device &device, CeedBasis basis) : device_(&device) {
  const CeedScalar *interp = nullptr, *derivative = nullptr, *weights = nullptr, *coefficients = nullptr;
  CeedInt num_qpts = 0;
  chk(CeedBasisIsTensor(basis, &is_tensor_));
  chk(CeedBasisGetDimension(basis, &dim_));
  chk(CeedBasisGetNumComponents(basis, &num_comp_));
  chk(CeedBasisGetNumNodes(basis, &num_nodes_));
  chk(CeedBasisGetNumQuadraturePoints(basis, &num_qpts));
  const auto upload = [&](const CeedScalar *values, CeedSize count) {
    return device.upload(std::span(values, static_cast<std::size_t>(count)));
  };
  if (is_tensor_) {
    chk(CeedBasisGetNumNodes1D(basis, &P_));
    chk(CeedBasisGetNumQuadraturePoints1D(basis, &Q_));
    chk(CeedBasisGetInterp1D(basis, &interp));
    chk(CeedBasisGetGrad1D(basis, &derivative));
    chk(CeedBasisGetChebyshevCoefficients1D(basis, &num_coefficients_, &coefficients));
    num_derivatives_ = dim_;
  } else {
    CeedEvalMode mode = CEED_EVAL_NONE;
    P_ = num_nodes_;
    Q_ = num_qpts;
    chk(CeedBasisGetNumQuadratureComponents(basis, CEED_EVAL_INTERP, &num_interp_));
    chk(CeedBasisGetInterp(basis, &interp));
    chk(CeedBasisGetDerivativeMode(basis, &mode));
    if (mode != CEED_EVAL_NONE) {
      chk(CeedBasisGetNumQuadratureComponents(basis, mode, &num_derivatives_));
      chk(CeedOperatorGetBasisPointer(basis, mode, nullptr, &derivative));
    }
  }
  const CeedSize of_matrix = static_cast<CeedSize>(P_) * Q_;
  interp_ = upload(interp, of_matrix * num_interp_);
  derivative_ = upload(derivative, is_tensor_ ? of_matrix : of_matrix * num_derivatives_);
  coefficients_ = upload(coefficients, static_cast<CeedSize>(num_coefficients_) * P_);

  // Products of the directions' weights.
  chk(CeedBasisGetQWeights(basis, &weights));
  std::vector<CeedScalar> all(num_qpts, 1.0);
  for (CeedInt q = 0; q < num_qpts; q++) {
    for (CeedInt d = 0, rest = q; d < (is_tensor_ ? dim_ : 1); d++, rest /= Q_) all[q] *= weights[rest % Q_];
  }
  weights_ = device.upload(all);
}

BasisJob BasisTables::job(CeedEvalMode mode, const Points &points, CeedInt num_elem, const CeedScalar *table) const {
  const bool is_derivative = mode != CEED_EVAL_INTERP;
  const CeedScalar *interp = interp_.as<CeedScalar>(), *derivative = derivative_.as<CeedScalar>();
  return {.points = points.facts(),
          .num_elem = num_elem,
          .num_comp = num_comp_,
          .num_values = num_values(mode),
          .num_directions = is_tensor_ ? dim_ : 1,
          .P = P_,
          .Q = Q_,
          .num_nodes = num_nodes_,
          .is_tensor = is_tensor_,
          .is_derivative = is_derivative,
          .interp = is_derivative && !is_tensor_ ? derivative : interp,
          .derivative = derivative,
          .table = table};
}

Buffer BasisTables::at_points(const Points &points, const CeedScalar *x_ref) const {
  const CeedSize count = points.facts().num_points * dim_;
  Buffer table = device_->allocate(static_cast<std::size_t>(count) * 2 * P_ * sizeof(CeedScalar));
  device_->run("hg_point_table", count,
               PointTableJob{.points = points.facts(),
                             .dim = dim_,
                             .P = P_,
                             .num_coefficients = num_coefficients_,
                             .coefficients = coefficients_.as<CeedScalar>(),
                             .x_ref = x_ref,
                             .table = table.as<CeedScalar>()});
  return table;
}

void BasisTables::evaluate(CeedEvalMode mode, const Points &points, CeedInt num_elem, const CeedScalar *table,
                           const CeedScalar *u, CeedScalar *v) const {
  BasisJob job = this->job(mode, points, num_elem, table);
  job.u = u;
  job.v = v;
  device_->run("hg_evaluate", job.points.num_points * job.num_values * job.num_comp, job);
}

void BasisTables::integrate(CeedEvalMode mode, const Points &points, CeedInt num_elem, const CeedScalar *table,
                            const CeedScalar *u, CeedScalar *v, bool add) const {
  BasisJob job = this->job(mode, points, num_elem, table);
  job.u = u;
  job.v = v;
  job.add = add;
  device_->run("hg_integrate", static_cast<CeedSize>(num_elem) * job.num_comp * job.num_nodes, job);
}

void BasisTables::weights(const Points &points, CeedScalar *v) const {
  if (points.facts().starts != nullptr) {
    return device_->run("hg_set_value", points.facts().num_points,
                        VectorJob{.length = points.facts().num_points, .a = 1, .w = v});
  }
  BasisJob job = this->job(CEED_EVAL_INTERP, points, 0, nullptr);
  job.interp = weights_.as<CeedScalar>();
  job.v = v;
  device_->run("hg_weight", job.points.num_points, job);
}

const BasisTables &tables_of(CeedBasis basis) {
  Device &device = Device::of(CeedBasisReturnCeed(basis));
  const auto one_thread = device.lock();
  BasisTables *tables = nullptr;
  chk(CeedBasisGetData(basis, &tables));
  if (tables != nullptr) return *tables;
  auto made = std::make_unique<BasisTables>(device, basis);
  chk(CeedBasisSetData(basis, made.get()));
  return *made.release();
}

namespace {

int create(CeedBasis basis) {
  return CeedBasisSetData(basis, nullptr);  // the tables are made when they are used
}

int destroy(CeedBasis basis) {
  BasisTables *tables = nullptr;
  CeedCallBackend(CeedBasisGetData(basis, &tables));
  delete tables;
  return CEED_ERROR_SUCCESS;
}

/// The vectors of an application: u is read unless weights are wanted, v is written or added to.
template <typename F>
void with_arrays(CeedEvalMode mode, CeedVector u, CeedVector v, bool add, F &&f) {
  std::unique_ptr<host::Reader> from;
  if (mode != CEED_EVAL_WEIGHT) from = std::make_unique<host::Reader>(u, CEED_MEM_DEVICE);
  bool has_values = add;  // what lies beyond the elements stays
  if (!add) chk(CeedVectorHasValidArray(v, &has_values));
  host::Writer to(v, has_values ? host::Writer::read_write : host::Writer::write_only, CEED_MEM_DEVICE);
  f(from ? from->data() : nullptr, to.data());
  to.release();
  if (from) from->release();
}

void apply_at(CeedBasis basis, const Points &points, CeedInt num_elem, const CeedScalar *table,
              CeedTransposeMode t_mode, CeedEvalMode mode, CeedVector u, CeedVector v, bool add) {
  const BasisTables &tables = tables_of(basis);
  if (!add && t_mode == CEED_TRANSPOSE) {
    CeedSize length = 0;
    chk(CeedVectorGetLength(v, &length));
    const bool is_longer = length > static_cast<CeedSize>(num_elem) * tables.num_comp() * tables.num_nodes();
    if (is_longer) chk(CeedVectorSetValue(v, 0.0));
  }
  with_arrays(mode, u, v, add, [&](const CeedScalar *from, CeedScalar *to) {
    if (mode == CEED_EVAL_WEIGHT) {
      tables.weights(points, to);
    } else if (t_mode == CEED_NOTRANSPOSE) {
      tables.evaluate(mode, points, num_elem, table, from, to);
    } else {
      tables.integrate(mode, points, num_elem, table, from, to, add);
    }
  });
}

int apply(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode mode, CeedVector u, CeedVector v,
          bool add) {
  return wall(CeedBasisReturnCeed(basis), [&] {
    CeedInt num_qpts = 0;
    chk(CeedBasisGetNumQuadraturePoints(basis, &num_qpts));
    apply_at(basis, Points(num_elem, num_qpts), num_elem, nullptr, t_mode, mode, u, v, add);
  });
}

int apply_at_points(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode,
                    CeedEvalMode mode, CeedVector x_ref, CeedVector u, CeedVector v, bool add) {
  return wall(CeedBasisReturnCeed(basis), [&] {
    const Points points(Device::of(CeedBasisReturnCeed(basis)), num_elem, num_points);
    Buffer table;
    if (mode != CEED_EVAL_WEIGHT) {
      host::Reader x(x_ref, CEED_MEM_DEVICE);
      table = tables_of(basis).at_points(points, x.data());
      x.release();
    }
    apply_at(basis, points, num_elem, table.as<CeedScalar>(), t_mode, mode, u, v, add);
  });
}

}  // namespace

void fill_basis_ops(CeedBasisOps &ops) {
  ops = {.create = create, .destroy = destroy, .apply = apply, .apply_at_points = apply_at_points};
}

}  // namespace hg::gpu
