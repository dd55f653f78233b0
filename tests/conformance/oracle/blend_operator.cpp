#include "blend_operator.hpp"

#include <string>

#include "conformance/qfunctions/blend.h"

namespace hg::test {

Operator make_blend(Ceed ceed, CeedInt seed, const std::vector<BlendField> &inputs,
                    const std::vector<BlendField> &outputs, const BlendPoints &points) {
  BlendContext blend_ctx{};
  blend_ctx.num_in = static_cast<CeedInt>(inputs.size());
  blend_ctx.num_out = static_cast<CeedInt>(outputs.size());
  blend_ctx.seed = seed;
  QFunction qf;
  ok(CeedQFunctionCreateInterior(ceed, 1, blend, blend_loc, qf.out()));
  for (CeedInt i = 0; i < blend_ctx.num_in; i++) {
    blend_ctx.in_size[i] = inputs[i].size;
    blend_ctx.in_is_active[i] = inputs[i].vec == CEED_VECTOR_ACTIVE;
    ok(CeedQFunctionAddInput(qf, ("in" + std::to_string(i)).c_str(), inputs[i].size, inputs[i].mode));
  }
  for (CeedInt i = 0; i < blend_ctx.num_out; i++) {
    blend_ctx.out_size[i] = outputs[i].size;
    ok(CeedQFunctionAddOutput(qf, ("out" + std::to_string(i)).c_str(), outputs[i].size, outputs[i].mode));
  }
  Context context;
  ok(CeedQFunctionContextCreate(ceed, context.out()));
  ok(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof blend_ctx, &blend_ctx));
  ok(CeedQFunctionSetContext(qf, context));
  ok(CeedQFunctionSetContextWritable(qf, false));
  Operator op;
  const auto create = points.rstr != nullptr ? CeedOperatorCreateAtPoints : CeedOperatorCreate;
  ok(create(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.out()));
  const auto set = [&](const std::vector<BlendField> &fields, const std::string &prefix) {
    for (std::size_t i = 0; i < fields.size(); i++) {
      ok(CeedOperatorSetField(op, (prefix + std::to_string(i)).c_str(), fields[i].rstr, fields[i].basis,
                              fields[i].vec));
    }
  };
  set(inputs, "in");
  set(outputs, "out");
  if (points.rstr != nullptr) ok(CeedOperatorAtPointsSetPoints(op, points.rstr, points.coordinates));
  return op;
}

Values dense_by_unit_vectors(Ceed ceed, CeedOperator op) {
  CeedSize in = 0, out = 0;
  ok(CeedOperatorGetActiveVectorLengths(op, &in, &out));
  Values dense(static_cast<std::size_t>(in * out)), unit(static_cast<std::size_t>(in), 0);
  const Vector u = make_vector(ceed, in, 0), v = make_vector(ceed, out, 0);
  for (CeedSize j = 0; j < in; j++) {
    unit[j] = 1;
    set_values(u, unit);
    unit[j] = 0;
    ok(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE));
    const Values column = values_of(v);
    for (CeedSize i = 0; i < out; i++) dense[i * in + j] = column[i];
  }
  return dense;
}

}  // namespace hg::test
