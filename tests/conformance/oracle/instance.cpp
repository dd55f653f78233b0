#include "instance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "conformance/qfunctions/mix.h"
#include "restriction_case.hpp"

namespace hg::test {
namespace {

Restriction make_restriction(Ceed ceed, const Case &c, const Space &space) {
  RestrictionCase r;
  r.num_elem = c.num_elem;
  r.num_comp = space.num_comp;
  r.elem_size = space.elem_size;
  r.block_size = space.block_size;
  r.comp_stride = space.comp_stride;
  r.l_size = space.l_size;
  if (!space.point_list.empty()) {
    r.type = CEED_RESTRICTION_POINTS;
    r.offsets = space.point_list;
    r.num_points = c.total_points();
  } else if (space.is_strided) {
    r.type = CEED_RESTRICTION_STRIDED;
    std::copy_n(space.strides, 3, r.strides);
  } else {
    r.type = space.type;
    r.offsets = space.offsets;
    r.curl_orients = space.orientation;
    r.orients = std::make_shared<bool[]>(space.offsets.size());
    for (std::size_t i = 0; i < space.orientation.size() / 3; i++) r.orients[i] = space.orientation[3 * i + 1] < 0;
  }
  return make_restriction(ceed, r);
}

}  // namespace

Instance::Instance(Ceed ceed_, const Case &c) : ceed(ceed_) {
  for (const Space &space : c.spaces) {
    restrictions.push_back(make_restriction(ceed, c, space));
    bases.emplace_back();
    if (space.is_tabulated()) {
      const auto create = space.kind == CEED_FE_SPACE_H1     ? CeedBasisCreateH1
                          : space.kind == CEED_FE_SPACE_HDIV ? CeedBasisCreateHdiv
                                                             : CeedBasisCreateHcurl;
      ok(create(ceed, space.topology, space.num_comp, space.elem_size, c.max_points(), space.interp.data(),
                space.derivative.data(), nullptr, nullptr, bases.back().out()));
    } else if (!space.interp_1d.empty()) {
      Values points(c.Q_1d), weights(c.Q_1d);
      ok(CeedGaussQuadrature(c.Q_1d, points.data(), weights.data()));
      ok(CeedBasisCreateTensorH1(ceed, c.dim, space.num_comp, space.P_1d, c.Q_1d, space.interp_1d.data(),
                                 space.grad_1d.data(), points.data(), weights.data(), bases.back().out()));
    } else if (space.has_basis()) {
      ok(CeedBasisCreateTensorH1Lagrange(ceed, c.dim, space.num_comp, space.P_1d, c.Q_1d, c.quad_mode,
                                         bases.back().out()));
    }
  }
  ok(CeedBasisCreateTensorH1Lagrange(ceed, c.dim, 1, 2, c.Q_1d, c.quad_mode, weight_basis.out()));
  for (const Values &values : c.passive) passive.push_back(make_vector(ceed, values));
  make_qfunction(c);
  make_operator(c);
}

Instance::Instance(const Instance &other, const Case &c) : ceed(other.ceed) {
  for (const Restriction &rstr : other.restrictions) {
    ok(CeedElemRestrictionReferenceCopy(rstr, restrictions.emplace_back().address()));
  }
  for (const Basis &basis : other.bases) {
    bases.emplace_back();
    if (basis) ok(CeedBasisReferenceCopy(basis, bases.back().address()));
  }
  ok(CeedBasisReferenceCopy(other.weight_basis, weight_basis.address()));
  for (std::size_t i = 0; i < c.passive.size(); i++) {
    passive.emplace_back();
    if (is_output(c, static_cast<int>(i))) {
      passive.back() = make_vector(ceed, c.passive[i]);
    } else {
      ok(CeedVectorReferenceCopy(other.passive[i], passive.back().address()));
    }
  }
  ok(CeedQFunctionReferenceCopy(other.qf, qf.address()));
  make_operator(c);
}

void Instance::make_qfunction(const Case &c) {
  ok(CeedQFunctionContextCreate(ceed, context.out()));
  ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof c.mix,
                                 const_cast<MixContext *>(&c.mix)));
  ok(CeedQFunctionCreateInterior(ceed, 1, mix, mix_loc, qf.out()));
  for (const Field &field : c.inputs) ok(CeedQFunctionAddInput(qf, field.name.c_str(), c.size(field), field.mode));
  for (const Field &field : c.outputs) ok(CeedQFunctionAddOutput(qf, field.name.c_str(), c.size(field), field.mode));
  ok(CeedQFunctionSetContext(qf, context));
  ok(CeedQFunctionSetContextWritable(qf, false));
}

void Instance::make_operator(const Case &c) {
  if (c.at_points) {
    ok(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  } else {
    ok(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  }
  for (const std::vector<Field> *fields : {&c.inputs, &c.outputs}) {
    for (const Field &field : *fields) {
      if (field.mode == CEED_EVAL_WEIGHT) {
        ok(CeedOperatorSetField(op, field.name.c_str(), CEED_ELEMRESTRICTION_NONE, weight_basis, CEED_VECTOR_NONE));
        continue;
      }
      const bool has_basis = field.mode != CEED_EVAL_NONE;
      ok(CeedOperatorSetField(op, field.name.c_str(), restrictions[field.space],
                              has_basis ? bases[field.space].get() : CEED_BASIS_NONE,
                              field.is_active() ? CEED_VECTOR_ACTIVE : passive[field.vector].get()));
    }
  }
  if (c.at_points) set_points(c);
}

void Instance::set_points(const Case &c) {
  std::vector<CeedInt> list;
  Values coordinates(static_cast<std::size_t>(c.total_points()) * c.dim);
  for (CeedInt e = 0, start = c.num_elem + 1; e <= c.num_elem; e++) {
    list.push_back(start);
    if (e < c.num_elem) start += c.num_points[e];
  }
  for (CeedInt e = 0; e < c.num_elem; e++) {
    for (CeedInt q = 0; q < c.num_points[e]; q++) {
      const CeedInt number = c.point_numbers[e][q];
      list.push_back(number);
      std::copy(c.x[e][q].begin(), c.x[e][q].end(), coordinates.begin() + number * c.dim);
    }
  }
  ok(CeedElemRestrictionCreateAtPoints(ceed, c.num_elem, c.total_points(), c.dim,
                                       static_cast<CeedSize>(coordinates.size()), CEED_MEM_HOST, CEED_COPY_VALUES,
                                       list.data(), points_restriction.out()));
  points = make_vector(ceed, coordinates);
  ok(CeedOperatorAtPointsSetPoints(op, points_restriction, points));
}

Values apply(const Instance &instance, const Case &c, const Values &in) {
  Vector u, v;
  if (c.input_size() > 0) u = make_vector(instance.ceed, in);
  if (c.output_size() > 0) v = make_vector(instance.ceed, c.output_size(), 1e30);
  ok(CeedOperatorApply(instance.op, u ? u.get() : CEED_VECTOR_NONE, v ? v.get() : CEED_VECTOR_NONE,
                       CEED_REQUEST_IMMEDIATE));
  return v ? values_of(v) : Values{};
}

std::vector<Values> by_element(CeedElemRestriction rstr, CeedVector l_vector) {
  CeedInt num_elem = 0, num_comp = 0;
  ok(CeedElemRestrictionGetNumElements(rstr, &num_elem));
  ok(CeedElemRestrictionGetNumComponents(rstr, &num_comp));
  bool is_at_points = false;
  ok(CeedElemRestrictionIsAtPoints(rstr, &is_at_points));
  std::vector<Values> result(num_elem);
  if (is_at_points) {
    Values l_values = values_of(l_vector);
    const CeedInt *offsets = nullptr;
    ok(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &offsets));
    for (CeedInt e = 0; e < num_elem; e++) {
      for (CeedInt i = offsets[e]; i < offsets[e + 1]; i++) {
        for (CeedInt comp = 0; comp < num_comp; comp++) {
          result[e].push_back(l_values.at(static_cast<std::size_t>(offsets[i]) * num_comp + comp));
        }
      }
    }
    ok(CeedElemRestrictionRestoreOffsets(rstr, &offsets));
    return result;
  }
  CeedInt elem_size = 0, layout[3];
  ok(CeedElemRestrictionGetElementSize(rstr, &elem_size));
  Vector e_vector;
  ok(CeedElemRestrictionCreateVector(rstr, nullptr, e_vector.out()));
  ok(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l_vector, e_vector, CEED_REQUEST_IMMEDIATE));
  ok(CeedElemRestrictionGetELayout(rstr, layout));
  const Values e_values = values_of(e_vector);
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt n = 0; n < elem_size; n++) {
      for (CeedInt comp = 0; comp < num_comp; comp++) {
        result[e].push_back(e_values.at(static_cast<std::size_t>(n) * layout[0] + comp * layout[1] +
                                        static_cast<std::size_t>(e) * layout[2]));
      }
    }
  }
  return result;
}

Values dense_from_coordinates(CeedOperator op, Ceed ceed, CeedSize num_rows, CeedSize num_cols) {
  CeedSize num_entries = 0, num_values = 0;
  CeedInt *rows = nullptr, *cols = nullptr;
  ok(CeedOperatorLinearAssembleSymbolic(op, &num_entries, &rows, &cols));
  const std::unique_ptr<CeedInt, decltype(&std::free)> own_rows(rows, std::free), own_cols(cols, std::free);
  ok(CeedOperatorLinearAssembleGetNumEntries(op, &num_values));
  EXPECT_EQ(num_entries, num_values);
  const Vector values = make_vector(ceed, num_entries, 1e30);
  ok(CeedOperatorLinearAssemble(op, values));
  const Values entries = values_of(values);
  Values result(static_cast<std::size_t>(num_rows * num_cols), 0);
  for (CeedSize i = 0; i < num_entries; i++) {
    if (rows[i] < 0 || rows[i] >= num_rows || cols[i] < 0 || cols[i] >= num_cols) {
      ADD_FAILURE() << "entry " << i << " at (" << rows[i] << ", " << cols[i] << ") of a " << num_rows << " by "
                    << num_cols << " matrix";
      break;
    }
    result[rows[i] * num_cols + cols[i]] += entries[i];
  }
  return result;
}

}  // namespace hg::test
