#include "operators/integration.hpp"

#include <cstring>

#include "options/error.hpp"

namespace hg {

CeedVectorHandle share(CeedVector vector) {
  CeedVectorHandle copy;
  ceed_check(CeedVectorReferenceCopy(vector, copy.put()));
  return copy;
}

CeedElemRestrictionHandle share(CeedElemRestriction rstr) {
  CeedElemRestrictionHandle copy;
  ceed_check(CeedElemRestrictionReferenceCopy(rstr, copy.put()));
  return copy;
}

CeedBasisHandle share(CeedBasis basis) {
  CeedBasisHandle copy;
  ceed_check(CeedBasisReferenceCopy(basis, copy.put()));
  return copy;
}

CeedVectorHandle make_vector(Ceed ceed, std::span<const double> values) {
  CeedVectorHandle vector;
  ceed_check(CeedVectorCreate(ceed, static_cast<CeedSize>(values.size()), vector.put()));
  // COPY_VALUES only reads
  ceed_check(CeedVectorSetArray(vector, CEED_MEM_HOST, CEED_COPY_VALUES, const_cast<double *>(values.data())));
  return vector;
}

std::vector<double> to_host(CeedVector vector) {
  CeedSize length;
  const CeedScalar *array;
  ceed_check(CeedVectorGetLength(vector, &length));
  ceed_check(CeedVectorGetArrayRead(vector, CEED_MEM_HOST, &array));
  std::vector<double> values(array, array + length);
  ceed_check(CeedVectorRestoreArrayRead(vector, &array));
  return values;
}

CeedQFunction QFunctionCache::get(const QFunctionSpec &spec, CeedQFunctionContext context) {
  CeedQFunctionHandle &qf = made_[spec.name];
  if (qf) return qf;
  ceed_check(CeedQFunctionCreateInterior(ceed_, 1, spec.function, spec.source, qf.put()));
  for (const QFunctionField &field : spec.inputs) {
    ceed_check(CeedQFunctionAddInput(qf, field.name, field.size, field.mode));
  }
  for (const QFunctionField &field : spec.outputs) {
    ceed_check(CeedQFunctionAddOutput(qf, field.name, field.size, field.mode));
  }
  if (context) {
    ceed_check(CeedQFunctionSetContext(qf, context));
    ceed_check(CeedQFunctionSetContextWritable(qf, false));
  }
  return qf;
}

namespace detail {

CeedQFunctionContextHandle make_context(Ceed ceed, std::size_t size, const void *data) {
  CeedQFunctionContextHandle context;
  ceed_check(CeedQFunctionContextCreate(ceed, context.put()));
  ceed_check(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, size, const_cast<void *>(data)));
  return context;
}

void set_context(CeedQFunctionContext context, std::size_t size, const void *data) {
  void *held;
  ceed_check(CeedQFunctionContextGetData(context, CEED_MEM_HOST, &held));
  std::memcpy(held, data, size);
  ceed_check(CeedQFunctionContextRestoreData(context, &held));
}

}  // namespace detail

Integration::AtPoints &Integration::add(const std::string &name, CeedInt num_comp) {
  AtPoints &field = at_points[name];
  field.rstr = restriction(num_comp);
  ceed_check(CeedVectorCreate(ceed, num_points * num_comp, field.values.put()));
  return field;
}

CeedOperatorHandle Integration::make(QFunctionCache &cache, const QFunctionSpec &spec, CeedQFunctionContext context,
                                     const char *active_output) const {
  CeedOperatorHandle op;
  CeedQFunction qf = cache.get(spec, context);
  if (points) {
    ceed_check(CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.put()));
    ceed_check(CeedOperatorAtPointsSetPoints(op, points, x_ref));
  } else {
    ceed_check(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op.put()));
  }
  ceed_check(CeedOperatorSetName(op, spec.name));

  const auto set_field = [&](const QFunctionField &field, bool active) {
    if (field.mode == CEED_EVAL_WEIGHT) {
      const OnMesh &any = on_mesh.begin()->second;
      ceed_check(CeedOperatorSetField(op, field.name, CEED_ELEMRESTRICTION_NONE, any.basis, CEED_VECTOR_NONE));
    } else if (field.mode == CEED_EVAL_NONE) {
      const auto found = at_points.find(field.name);
      if (found == at_points.end() && !active) fail("%s: no data at points called \"%s\"", spec.name, field.name);
      if (active) {
        const CeedElemRestrictionHandle rstr = restriction(field.size);
        ceed_check(CeedOperatorSetField(op, field.name, rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE));
      } else {
        const AtPoints &data = found->second;
        ceed_check(CeedOperatorSetField(op, field.name, data.rstr, CEED_BASIS_NONE, data.values));
      }
    } else {
      // a value and a gradient of one field may both be asked for: "u" and "grad u" are the same field on the mesh
      const auto found = on_mesh.find(std::string(field.name).substr(0, 5) == "grad_" ? field.name + 5 : field.name);
      if (found == on_mesh.end()) fail("%s: no field on the mesh called \"%s\"", spec.name, field.name);
      const OnMesh &nodal = found->second;
      ceed_check(CeedOperatorSetField(op, field.name, nodal.rstr, nodal.basis,
                                      nodal.values ? nodal.values.get() : CEED_VECTOR_ACTIVE));
    }
  };
  for (const QFunctionField &field : spec.inputs) set_field(field, false);
  for (const QFunctionField &field : spec.outputs) {
    set_field(field, active_output && std::strcmp(active_output, field.name) == 0);
  }
  return op;
}

}  // namespace hg
