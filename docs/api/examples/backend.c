// What ceed/backend.h tells of a basis, and its dense algebra.
#include <ceed/backend.h>
#include <stdio.h>

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);
  CeedBasis basis;
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 3, 3, CEED_GAUSS_LOBATTO, &basis);

  // From values at -1, 0 and 1 to the derivatives of the parabola through them.
  bool is_collocated;
  CeedScalar D[3][3];
  CeedBasisIsCollocated(basis, &is_collocated);
  CeedBasisGetCollocatedGrad(basis, &D[0][0]);
  printf("%s\n", is_collocated ? "quadrature points are the nodes" : "quadrature points lie elsewhere");
  for (int q = 0; q < 3; q++) printf("%8.4f%8.4f%8.4f\n", D[q][0], D[q][1], D[q][2]);

  // All basis functions at one place.
  const CeedScalar x = 0.5;
  CeedScalar N[3], dN[3];
  CeedBasisEvaluateAtPoint(basis, &x, N, dN);
  printf("at 0.5: values %.4f %.4f %.4f, derivatives %.4f %.4f %.4f\n", N[0], N[1], N[2], dN[0], dN[1], dN[2]);

  // A = V diag(lambda) V^T
  CeedScalar A[2][2] = {{2, 1}, {1, 2}}, lambda[2];
  CeedSymmetricSchurDecomposition(ceed, &A[0][0], lambda, 2);
  printf("eigenvalues %.4f %.4f\n", lambda[0], lambda[1]);

  CeedBasisDestroy(&basis);
  CeedDestroy(&ceed);
  return 0;
}
