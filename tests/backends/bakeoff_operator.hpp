/// @file
/// Operators of the bake-off, for tests of what is printed and compiled for them.
#pragma once

#include <ceed.h>

#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/random.hpp"

namespace hg::test {

/// A mass or Poisson operator on two cells, at quadrature points or, where `per_cell` is not 0, at points. Its input
/// and its output have restrictions of their own, which are equal. Nothing is compiled here.
class BakeoffOperator {
 public:
  /// On the host the QFunction fails.
  static int never(void *, CeedInt, const CeedScalar *const *, CeedScalar *const *) { return 1; }

  BakeoffOperator(Ceed ceed, bool is_poisson, CeedInt num_comp, CeedInt P, CeedInt Q, CeedInt per_cell,
                  CeedQFunctionUser on_host = never) {
    const CeedInt nodes = P * P * P, points = per_cell > 0 ? per_cell : Q * Q * Q, stored = is_poisson ? 6 : 1;
    std::vector<CeedInt> places(num_elem * nodes), ids(num_elem + 1 + num_elem * points);
    for (std::size_t i = 0; i < places.size(); i++) places[i] = static_cast<CeedInt>(i) * num_comp;
    for (CeedInt e = 0; e <= num_elem; e++) ids[e] = num_elem + 1 + e * points;
    std::iota(ids.begin() + num_elem + 1, ids.end(), 0);
    for (Restriction *restriction : {&nodes_, &nodes_again_}) {
      ok(CeedElemRestrictionCreate(ceed, num_elem, nodes, num_comp, 1, num_elem * nodes * num_comp, CEED_MEM_HOST,
                                   CEED_COPY_VALUES, places.data(), restriction->out()));
    }
    ok(CeedBasisCreateTensorH1Lagrange(ceed, 3, num_comp, P, Q, Q == P ? CEED_GAUSS_LOBATTO : CEED_GAUSS,
                                       basis_.out()));
    const auto at_points = [&](CeedInt size, Restriction &restriction) {
      ok(CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_elem * points, size, num_elem * points * size,
                                           CEED_MEM_HOST, CEED_COPY_VALUES, ids.data(), restriction.out()));
    };
    if (per_cell > 0) {
      at_points(stored, stored_);
      at_points(3, coordinates_);
    } else {
      ok(CeedElemRestrictionCreateStrided(ceed, num_elem, points, stored, num_elem * points * stored,
                                          CEED_STRIDES_BACKEND, stored_.out()));
    }
    ok(CeedVectorCreate(ceed, num_elem * points * stored, data_.out()));
    ok(CeedVectorCreate(ceed, num_elem * points * 3, x_.out()));
    for (const auto &[vec, size, value] : {std::tuple(&data_, stored, 1.), std::tuple(&x_, 3, 0.25)}) {
      std::vector<CeedScalar> values(num_elem * points * size, value);
      ok(CeedVectorSetArray(*vec, CEED_MEM_HOST, CEED_COPY_VALUES, values.data()));
    }
    const std::string name = std::string(is_poisson ? "BPPoissonApply" : "BPMassApply") + (num_comp > 1 ? "3" : "");
    const std::string place = std::string(HG_QFUNCTIONS) + (is_poisson ? "/bps/poisson.h:" : "/bps/mass.h:") + name;
    const CeedEvalMode mode = is_poisson ? CEED_EVAL_GRAD : CEED_EVAL_INTERP;
    const CeedInt size = num_comp * (is_poisson ? 3 : 1);
    ok(CeedQFunctionCreateInterior(ceed, 1, on_host, place.c_str(), qf_.out()));
    ok(CeedQFunctionAddInput(qf_, "u", size, mode));
    ok(CeedQFunctionAddInput(qf_, "data", stored, CEED_EVAL_NONE));
    ok(CeedQFunctionAddOutput(qf_, "v", size, mode));
    ok((per_cell > 0 ? CeedOperatorCreateAtPoints : CeedOperatorCreate)(ceed, qf_, CEED_QFUNCTION_NONE,
                                                                        CEED_QFUNCTION_NONE, op_.out()));
    ok(CeedOperatorSetField(op_, "u", nodes_, basis_, CEED_VECTOR_ACTIVE));
    ok(CeedOperatorSetField(op_, "data", stored_, CEED_BASIS_NONE, data_));
    ok(CeedOperatorSetField(op_, "v", nodes_again_, basis_, CEED_VECTOR_ACTIVE));
    if (per_cell > 0) ok(CeedOperatorAtPointsSetPoints(op_, coordinates_, x_));
  }
  operator CeedOperator() const { return op_; }
  /// What is stored at the points, and where they are, in [-1, 1]³, becomes random.
  void shuffle(Random &random) {
    for (const auto &[vec, is_used] : {std::pair(&data_, true), std::pair(&x_, coordinates_.get() != nullptr)}) {
      CeedSize length = 0;
      ok(CeedVectorGetLength(*vec, &length));
      if (is_used) ok(CeedVectorSetArray(*vec, CEED_MEM_HOST, CEED_COPY_VALUES, random.reals(length).data()));
    }
  }

 private:
  static constexpr CeedInt num_elem = 2;
  Restriction nodes_, nodes_again_, stored_, coordinates_;
  Basis basis_;
  Vector data_, x_;
  QFunction qf_;
  Operator op_;
};

}  // namespace hg::test
