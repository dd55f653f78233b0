// v = a u + b at each point, with a and b in the context, where a can be changed by its name.
#include <ceed.h>
#include <stddef.h>
#include <stdio.h>

enum { num_points = 3 };

typedef struct {
  double a;
  double b;
} Line;

CEED_QFUNCTION(line)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const Line *data = (const Line *)ctx;
  const CeedScalar *u = in[0];
  CeedScalar *v = out[0];

  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) v[q] = data->a * u[q] + data->b;
  return CEED_ERROR_SUCCESS;
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  const Line data = {.a = 1, .b = 100};
  CeedQFunctionContext context;
  CeedQFunctionContextCreate(ceed, &context);
  CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof data, (void *)&data);
  CeedQFunctionContextRegisterDouble(context, "a", offsetof(Line, a), 1, "slope of the line");

  CeedQFunction qf;
  CeedQFunctionCreateInterior(ceed, 1, line, line_loc, &qf);
  CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_NONE);
  CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_NONE);
  CeedQFunctionSetContext(qf, context);
  CeedQFunctionSetContextWritable(qf, false);  // a promise: line() only reads

  CeedElemRestriction restriction;
  CeedElemRestrictionCreateStrided(ceed, 1, num_points, 1, num_points, CEED_STRIDES_BACKEND, &restriction);
  CeedOperator op;
  CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op);
  CeedOperatorSetField(op, "u", restriction, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(op, "v", restriction, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE);

  // The label finds the value in the operator, also while that is in use.
  CeedContextFieldLabel label;
  CeedOperatorGetContextFieldLabel(op, "a", &label);
  CeedScalar places[num_points] = {1, 2, 3};
  CeedVector u, v;
  CeedVectorCreate(ceed, num_points, &u);
  CeedVectorSetArray(u, CEED_MEM_HOST, CEED_COPY_VALUES, places);
  CeedVectorCreate(ceed, num_points, &v);
  for (double a = 1; a < 4; a++) {
    CeedOperatorSetContextDouble(op, label, &a);
    CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE);
    const CeedScalar *values;
    CeedVectorGetArrayRead(v, CEED_MEM_HOST, &values);
    printf("a = %g: %g %g %g\n", a, values[0], values[1], values[2]);
    CeedVectorRestoreArrayRead(v, &values);
  }

  CeedVectorDestroy(&u);
  CeedVectorDestroy(&v);
  CeedOperatorDestroy(&op);
  CeedElemRestrictionDestroy(&restriction);
  CeedQFunctionDestroy(&qf);
  CeedQFunctionContextDestroy(&context);
  CeedDestroy(&ceed);
  return 0;
}
