// a M + a K on the unit interval, as the sum of two operators that read the same number a: for u = x, the products
// u^T M u and u^T K u are 1/3 and 1.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 4, num_nodes = num_elem + 1, num_qpts = 2 };

// Mass where u is a value, stiffness where it is a derivative: with elements of length 1/4 the factors are dx/dX = 1/8
// and its inverse.
static int scaled(const double *a, CeedScalar factor, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *w = in[1];
  CeedScalar *v = out[0];

  for (CeedInt q = 0; q < Q; q++) v[q] = *a * factor * w[q] * u[q];
  return CEED_ERROR_SUCCESS;
}
CEED_QFUNCTION(mass)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  return scaled((const double *)ctx, 0.125, Q, in, out);
}
CEED_QFUNCTION(stiffness)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  return scaled((const double *)ctx, 8, Q, in, out);
}

static void add_part(Ceed ceed, CeedOperator sum, const char *name, CeedQFunctionUser f, const char *source,
                     CeedEvalMode mode, CeedElemRestriction restriction, CeedBasis basis) {
  double a = 1;
  CeedQFunctionContext context;
  CeedQFunctionContextCreate(ceed, &context);
  CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof a, &a);
  CeedQFunctionContextRegisterDouble(context, "a", 0, 1, "factor");

  CeedQFunction qf;
  CeedQFunctionCreateInterior(ceed, 1, f, source, &qf);
  CeedQFunctionAddInput(qf, "u", 1, mode);
  CeedQFunctionAddInput(qf, "weights", 1, CEED_EVAL_WEIGHT);
  CeedQFunctionAddOutput(qf, "v", 1, mode);
  CeedQFunctionSetContext(qf, context);

  CeedOperator part;
  CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &part);
  CeedOperatorSetName(part, name);
  CeedOperatorSetField(part, "u", restriction, basis, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(part, "weights", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE);
  CeedOperatorSetField(part, "v", restriction, basis, CEED_VECTOR_ACTIVE);
  CeedOperatorCompositeAddSub(sum, part);

  // The sum counts the part, which counts what it is made of: nobody else needs to.
  CeedOperatorDestroy(&part);
  CeedQFunctionDestroy(&qf);
  CeedQFunctionContextDestroy(&context);
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  CeedInt nodes_of[num_elem * 2];
  CeedScalar x[num_nodes];
  for (CeedInt i = 0; i < num_elem * 2; i++) nodes_of[i] = i / 2 + i % 2;
  for (CeedInt i = 0; i < num_nodes; i++) x[i] = (CeedScalar)i / num_elem;
  CeedElemRestriction restriction;
  CeedElemRestrictionCreate(ceed, num_elem, 2, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, nodes_of,
                            &restriction);
  CeedBasis basis;
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, num_qpts, CEED_GAUSS, &basis);

  CeedOperator sum;
  CeedOperatorCreateComposite(ceed, &sum);
  add_part(ceed, sum, "mass", mass, mass_loc, CEED_EVAL_INTERP, restriction, basis);
  add_part(ceed, sum, "stiffness", stiffness, stiffness_loc, CEED_EVAL_GRAD, restriction, basis);
  CeedOperatorViewTerse(sum, stdout);

  // One label for both parts.
  CeedContextFieldLabel label;
  CeedOperatorGetContextFieldLabel(sum, "a", &label);
  CeedVector u, v;
  CeedVectorCreate(ceed, num_nodes, &u);
  CeedVectorSetArray(u, CEED_MEM_HOST, CEED_COPY_VALUES, x);
  CeedVectorCreate(ceed, num_nodes, &v);
  for (double a = 1; a < 4; a += 2) {
    CeedOperatorSetContextDouble(sum, label, &a);
    CeedOperatorApply(sum, u, v, CEED_REQUEST_IMMEDIATE);
    const CeedScalar *values;
    CeedScalar energy = 0;
    CeedVectorGetArrayRead(v, CEED_MEM_HOST, &values);
    for (CeedInt i = 0; i < num_nodes; i++) energy += x[i] * values[i];
    CeedVectorRestoreArrayRead(v, &values);
    printf("a = %g: %.12f\n", a, energy);
  }

  CeedVectorDestroy(&u);
  CeedVectorDestroy(&v);
  CeedOperatorDestroy(&sum);
  CeedBasisDestroy(&basis);
  CeedElemRestrictionDestroy(&restriction);
  CeedDestroy(&ceed);
  return 0;
}
