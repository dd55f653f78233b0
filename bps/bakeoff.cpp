#include "bakeoff.hpp"

#include <cmath>
#include <initializer_list>
#include <numeric>
#include <vector>

#include "clock.hpp"
#include "qfunctions/bps/manufactured.h"
#include "qfunctions/bps/mass.h"
#include "qfunctions/bps/poisson.h"

namespace hg::bps {

double ErrorSums::relative_l2() const {
  return std::sqrt(terms[0] / terms[1]);
}
double ErrorSums::relative_h1() const {
  return std::sqrt(terms[2] / terms[3]);
}

Bakeoff::Bakeoff(Ceed ceed, const Problem &problem, CeedInt degree, const Cells &cells)
    : ceed_(ceed), problem_(problem), degree_(degree) {
  build_mesh(cells);
  build_quadrature();
  build_operator();
}

Bakeoff::Bakeoff(Ceed ceed, const Problem &problem, CeedInt degree, const Cells &cells, const PointCloud &cloud)
    : ceed_(ceed), problem_(problem), degree_(degree), at_points_(true) {
  build_mesh(cells);
  build_points(cloud);
  build_operator();
}

void Bakeoff::build_mesh(const Cells &cells) {
  num_elem_ = cells.num_elem;
  num_dofs_ = cells.num_dofs;
  const CeedInt P = degree_ + 1, Q = problem_.q_1d(degree_), num_comp = problem_.num_comp;
  double start = now();
  check(ceed_, CeedElemRestrictionCreate(ceed_, num_elem_, P * P * P, num_comp, 1, num_dofs_, CEED_MEM_HOST,
                                         CEED_COPY_VALUES, cells.dof_offsets.data(), solution_restriction_.out()));
  seconds_created_ += now() - start;
  check(ceed_, CeedElemRestrictionCreate(ceed_, num_elem_, 8, 3, 1, static_cast<CeedSize>(cells.coordinates.size()),
                                         CEED_MEM_HOST, CEED_COPY_VALUES, cells.vertex_offsets.data(),
                                         mesh_restriction_.out()));
  coordinates_ = make_vector(ceed_, cells.coordinates);
  start = now();
  check(ceed_, CeedBasisCreateTensorH1Lagrange(ceed_, 3, num_comp, P, Q, problem_.quad_mode(), solution_basis_.out()));
  seconds_created_ += now() - start;
  check(ceed_, CeedBasisCreateTensorH1Lagrange(ceed_, 3, 3, 2, Q, problem_.quad_mode(), mesh_basis_.out()));
}

void Bakeoff::build_quadrature() {
  const CeedInt Q = problem_.q_1d(degree_), elem_points = Q * Q * Q, num_stored = problem_.num_stored();
  num_points_ = static_cast<CeedSize>(num_elem_) * elem_points;
  check(ceed_, CeedElemRestrictionCreateStrided(ceed_, num_elem_, elem_points, num_stored, num_points_ * num_stored,
                                                CEED_STRIDES_BACKEND, stored_restriction_.out()));
}

void Bakeoff::build_points(const PointCloud &cloud) {
  const CeedInt num_points = num_elem_ * cloud.per_cell;
  num_points_ = num_points;
  // num_elem + 1 starts, counted from the head of this array, then the ids of the points
  std::vector<CeedInt> offsets(num_elem_ + 1 + num_points);
  for (CeedInt e = 0; e <= num_elem_; e++) offsets[e] = num_elem_ + 1 + e * cloud.per_cell;
  std::iota(offsets.begin() + num_elem_ + 1, offsets.end(), 0);
  const auto at_points = [&](CeedInt num_comp, Restriction &restriction) {
    check(ceed_, CeedElemRestrictionCreateAtPoints(ceed_, num_elem_, num_points, num_comp, num_points_ * num_comp,
                                                   CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), restriction.out()));
  };
  at_points(3, points_restriction_);
  at_points(1, weights_restriction_);
  at_points(problem_.num_stored(), stored_restriction_);
  points_ = make_vector(ceed_, cloud.coordinates);
  weights_ = make_vector(ceed_, cloud.weights);
}

void Bakeoff::build_operator() {
  const CeedInt num_comp = problem_.num_comp, num_stored = problem_.num_stored();
  stored_ = make_vector(ceed_, num_points_ * num_stored);
  const Field dx{"dx", 9, CEED_EVAL_GRAD, mesh_restriction_, mesh_basis_, CEED_VECTOR_ACTIVE};
  const Field new_data{"qdata", num_stored, CEED_EVAL_NONE, stored_restriction_, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE};
  const Operator setup =
      problem_.is_poisson
          ? make_operator(BPPoissonSetup, BPPoissonSetup_loc, false, {dx, weight_field()}, new_data, at_points_)
          : make_operator(BPMassSetup, BPMassSetup_loc, false, {dx, weight_field()}, new_data, at_points_);
  check(ceed_, CeedOperatorApply(setup, coordinates_, stored_, CEED_REQUEST_IMMEDIATE));

  const bool is_poisson = problem_.is_poisson, is_scalar = num_comp == 1;
  const CeedEvalMode mode = is_poisson ? CEED_EVAL_GRAD : CEED_EVAL_INTERP;
  const CeedInt size = num_comp * (is_poisson ? 3 : 1);
  const Field data{"qdata", num_stored, CEED_EVAL_NONE, stored_restriction_, CEED_BASIS_NONE, stored_};
  const Field u{"u", size, mode, solution_restriction_, solution_basis_, CEED_VECTOR_ACTIVE};
  const Field v{"v", size, mode, solution_restriction_, solution_basis_, CEED_VECTOR_ACTIVE};
  const CeedQFunctionUser function =
      is_poisson ? (is_scalar ? BPPoissonApply : BPPoissonApply3) : (is_scalar ? BPMassApply : BPMassApply3);
  const char *source = is_poisson ? (is_scalar ? BPPoissonApply_loc : BPPoissonApply3_loc)
                                  : (is_scalar ? BPMassApply_loc : BPMassApply3_loc);
  const double start = now();
  operator_ = make_operator(function, source, false, {u, data}, v, at_points_);
  seconds_created_ += now() - start;
}

Bakeoff::Field Bakeoff::weight_field() const {
  if (at_points_) return {"weight", 1, CEED_EVAL_NONE, weights_restriction_, CEED_BASIS_NONE, weights_};
  return {"weight", 1, CEED_EVAL_WEIGHT, CEED_ELEMRESTRICTION_NONE, mesh_basis_, CEED_VECTOR_NONE};
}

Operator Bakeoff::make_operator(CeedQFunctionUser function, const char *source, bool with_solution,
                                std::initializer_list<Field> inputs, Field output, bool at_points) const {
  QFunction qfunction;
  check(ceed_, CeedQFunctionCreateInterior(ceed_, 1, function, source, qfunction.out()));
  for (const Field &f : inputs) check(ceed_, CeedQFunctionAddInput(qfunction, f.name, f.size, f.mode));
  check(ceed_, CeedQFunctionAddOutput(qfunction, output.name, output.size, output.mode));
  if (with_solution) {
    BPSolution solution{problem_.is_poisson ? 0. : 1., problem_.num_comp};
    QFunctionContext context;
    check(ceed_, CeedQFunctionContextCreate(ceed_, context.out()));
    check(ceed_, CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof solution, &solution));
    check(ceed_, CeedQFunctionSetContext(qfunction, context));
    check(ceed_, CeedQFunctionSetContextWritable(qfunction, false));
  }
  Operator result;
  const auto create = at_points ? CeedOperatorCreateAtPoints : CeedOperatorCreate;
  check(ceed_, create(ceed_, qfunction, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, result.out()));
  for (const Field &f : inputs) check(ceed_, CeedOperatorSetField(result, f.name, f.restriction, f.basis, f.vector));
  check(ceed_, CeedOperatorSetField(result, output.name, output.restriction, output.basis, output.vector));
  if (at_points) check(ceed_, CeedOperatorAtPointsSetPoints(result, points_restriction_, points_));
  return result;
}

void Bakeoff::apply(CeedVector u, CeedVector v) const {
  check(ceed_, CeedOperatorApply(operator_, u, v, CEED_REQUEST_IMMEDIATE));
}

void Bakeoff::diagonal(CeedVector d) const {
  check(ceed_, CeedOperatorLinearAssembleDiagonal(operator_, d, CEED_REQUEST_IMMEDIATE));
}

Vector Bakeoff::right_hand_side() const {
  const CeedInt num_comp = problem_.num_comp;
  const bool weak = problem_.is_poisson && at_points_;
  const Field x{"x", 3, CEED_EVAL_INTERP, mesh_restriction_, mesh_basis_, CEED_VECTOR_ACTIVE};
  const Field dx{"dx", 9, CEED_EVAL_GRAD, mesh_restriction_, mesh_basis_, CEED_VECTOR_ACTIVE};
  const Field v{"v",
                num_comp * (weak ? 3 : 1),
                weak ? CEED_EVAL_GRAD : CEED_EVAL_INTERP,
                solution_restriction_,
                solution_basis_,
                CEED_VECTOR_ACTIVE};
  const CeedQFunctionUser function = weak ? BPPoissonFlux : problem_.is_poisson ? BPPoissonSource : BPMassSource;
  const char *source = weak ? BPPoissonFlux_loc : problem_.is_poisson ? BPPoissonSource_loc : BPMassSource_loc;
  const Operator source_operator = make_operator(function, source, true, {x, dx, weight_field()}, v, at_points_);
  Vector b = make_vector(ceed_, num_dofs_);
  check(ceed_, CeedOperatorApply(source_operator, coordinates_, b, CEED_REQUEST_IMMEDIATE));
  return b;
}

ErrorSums Bakeoff::error(CeedVector u) const {
  const CeedInt num_comp = problem_.num_comp, P = degree_ + 1, Q = degree_ + 3, elem_points = Q * Q * Q;
  const CeedSize num_terms = static_cast<CeedSize>(num_elem_) * elem_points * 4;
  Basis solution_basis, mesh_basis;
  check(ceed_, CeedBasisCreateTensorH1Lagrange(ceed_, 3, num_comp, P, Q, CEED_GAUSS, solution_basis.out()));
  check(ceed_, CeedBasisCreateTensorH1Lagrange(ceed_, 3, 3, 2, Q, CEED_GAUSS, mesh_basis.out()));
  const CeedInt strides[3] = {1, elem_points, elem_points * 4};  // term t of point q of cell e at q + Q³ (t + 4 e)
  Restriction terms_restriction;
  check(ceed_, CeedElemRestrictionCreateStrided(ceed_, num_elem_, elem_points, 4, num_terms, strides,
                                                terms_restriction.out()));
  const Operator error_operator =
      make_operator(BPError, BPError_loc, true,
                    {{"u", num_comp, CEED_EVAL_INTERP, solution_restriction_, solution_basis, CEED_VECTOR_ACTIVE},
                     {"du", 3 * num_comp, CEED_EVAL_GRAD, solution_restriction_, solution_basis, CEED_VECTOR_ACTIVE},
                     {"x", 3, CEED_EVAL_INTERP, mesh_restriction_, mesh_basis, coordinates_},
                     {"dx", 9, CEED_EVAL_GRAD, mesh_restriction_, mesh_basis, coordinates_},
                     {"weight", 1, CEED_EVAL_WEIGHT, CEED_ELEMRESTRICTION_NONE, mesh_basis, CEED_VECTOR_NONE}},
                    {"terms", 4, CEED_EVAL_NONE, terms_restriction, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE}, false);
  const Vector terms = make_vector(ceed_, num_terms);
  check(ceed_, CeedOperatorApply(error_operator, u, terms, CEED_REQUEST_IMMEDIATE));

  const CeedScalar *values = nullptr;
  check(ceed_, CeedVectorGetArrayRead(terms, CEED_MEM_HOST, &values));
  ErrorSums sums;
  for (CeedInt e = 0; e < num_elem_; e++)
    for (int t = 0; t < 4; t++) {
      const CeedScalar *of_cell = values + static_cast<CeedSize>(elem_points) * (t + 4 * static_cast<CeedSize>(e));
      sums.terms[t] += std::accumulate(of_cell, of_cell + elem_points, 0.);
    }
  check(ceed_, CeedVectorRestoreArrayRead(terms, &values));
  return sums;
}

Work Bakeoff::work() const {
  return at_points_ ? work_at_points(problem_, degree_, num_elem_, num_dofs_, num_points_)
                    : work_at_quadrature(problem_, degree_, num_elem_, num_dofs_);
}

}  // namespace hg::bps
