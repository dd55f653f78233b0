// x^2 on [-1, 1], by the basis of degree two: integrated at quadrature points, and evaluated elsewhere.
#include <ceed.h>
#include <stdio.h>

enum { num_nodes = 3, num_qpts = 2 };

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);
  CeedBasis basis;
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, num_nodes, num_qpts, CEED_GAUSS, &basis);

  // The nodes are -1, 0 and 1.
  CeedScalar at_nodes[num_nodes] = {1, 0, 1};
  CeedVector u, values, weights;
  CeedVectorCreate(ceed, num_nodes, &u);
  CeedVectorSetArray(u, CEED_MEM_HOST, CEED_COPY_VALUES, at_nodes);
  CeedVectorCreate(ceed, num_qpts, &values);
  CeedVectorCreate(ceed, num_qpts, &weights);
  CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, values);
  CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, weights);

  const CeedScalar *v, *w;
  CeedScalar integral = 0;
  CeedVectorGetArrayRead(values, CEED_MEM_HOST, &v);
  CeedVectorGetArrayRead(weights, CEED_MEM_HOST, &w);
  for (CeedInt q = 0; q < num_qpts; q++) integral += w[q] * v[q];
  CeedVectorRestoreArrayRead(values, &v);
  CeedVectorRestoreArrayRead(weights, &w);
  printf("integral %.12f\n", integral);

  // Anywhere: three points of the one element.
  const CeedInt num_points = 3;
  CeedScalar places[3] = {-0.5, 0.25, 1};
  CeedVector x, at_points;
  CeedVectorCreate(ceed, num_points, &x);
  CeedVectorSetArray(x, CEED_MEM_HOST, CEED_COPY_VALUES, places);
  CeedVectorCreate(ceed, num_points, &at_points);
  const CeedEvalMode modes[] = {CEED_EVAL_INTERP, CEED_EVAL_GRAD};
  for (int m = 0; m < 2; m++) {
    CeedBasisApplyAtPoints(basis, 1, &num_points, CEED_NOTRANSPOSE, modes[m], x, u, at_points);
    CeedVectorGetArrayRead(at_points, CEED_MEM_HOST, &v);
    printf("%s at -0.5, 0.25, 1: %.4f %.4f %.4f\n", CeedEvalModes[modes[m]], v[0], v[1], v[2]);
    CeedVectorRestoreArrayRead(at_points, &v);
  }

  CeedVectorDestroy(&u);
  CeedVectorDestroy(&values);
  CeedVectorDestroy(&weights);
  CeedVectorDestroy(&x);
  CeedVectorDestroy(&at_points);
  CeedBasisDestroy(&basis);
  CeedDestroy(&ceed);
  return 0;
}
