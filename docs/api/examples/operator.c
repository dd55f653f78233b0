// Mass on the interval from 0 to 2, cut in three elements of different length: 1^T M 1 is the length, x^T M x the
// integral of x^2.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 3, degree = 2, num_nodes = num_elem * degree + 1, num_qpts = 3 };

// v = w dx/dX u, for the basis functions of each node to be multiplied with.
CEED_QFUNCTION(mass)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *u = in[0], *dx_dX = in[1], *w = in[2];
  CeedScalar *v = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) v[q] = w[q] * dx_dX[q] * u[q];
  return CEED_ERROR_SUCCESS;
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  // Nodes of degree two: the ends of the elements and their middles.
  const CeedScalar ends[num_elem + 1] = {0, 0.25, 1, 2};
  CeedScalar x[num_nodes];
  CeedInt nodes_of[num_elem * (degree + 1)];
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt i = 0; i <= degree; i++) {
      nodes_of[e * (degree + 1) + i] = e * degree + i;
      x[e * degree + i] = ends[e] + (ends[e + 1] - ends[e]) * i / degree;
    }
  }
  CeedElemRestriction restriction;
  CeedElemRestrictionCreate(ceed, num_elem, degree + 1, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, nodes_of,
                            &restriction);
  CeedBasis basis;
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, degree + 1, num_qpts, CEED_GAUSS, &basis);
  CeedVector coordinates;
  CeedVectorCreate(ceed, num_nodes, &coordinates);
  CeedVectorSetArray(coordinates, CEED_MEM_HOST, CEED_USE_POINTER, x);

  // Fields: what the operator is applied to (active), what it always reads (passive), and weights.
  CeedQFunction qf;
  CeedQFunctionCreateInterior(ceed, 1, mass, mass_loc, &qf);
  CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP);
  CeedQFunctionAddInput(qf, "dx", 1, CEED_EVAL_GRAD);
  CeedQFunctionAddInput(qf, "weights", 1, CEED_EVAL_WEIGHT);
  CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP);
  CeedOperator op;
  CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op);
  CeedOperatorSetField(op, "u", restriction, basis, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(op, "dx", restriction, basis, coordinates);
  CeedOperatorSetField(op, "weights", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE);
  CeedOperatorSetField(op, "v", restriction, basis, CEED_VECTOR_ACTIVE);

  CeedVector u, v;
  CeedVectorCreate(ceed, num_nodes, &u);
  CeedVectorCreate(ceed, num_nodes, &v);
  const char *names[] = {"1^T M 1", "x^T M x"};
  for (int power = 0; power < 2; power++) {
    if (power == 0) CeedVectorSetValue(u, 1);
    if (power == 1) CeedVectorCopy(coordinates, u);
    CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE);
    CeedVectorPointwiseMult(v, u, v);
    const CeedScalar *products;
    CeedScalar sum = 0;
    CeedVectorGetArrayRead(v, CEED_MEM_HOST, &products);
    for (CeedInt i = 0; i < num_nodes; i++) sum += products[i];
    CeedVectorRestoreArrayRead(v, &products);
    printf("%s = %.12f\n", names[power], sum);
  }

  CeedVectorDestroy(&u);
  CeedVectorDestroy(&v);
  CeedOperatorDestroy(&op);
  CeedQFunctionDestroy(&qf);
  CeedVectorDestroy(&coordinates);
  CeedBasisDestroy(&basis);
  CeedElemRestrictionDestroy(&restriction);
  CeedDestroy(&ceed);
  return 0;
}
