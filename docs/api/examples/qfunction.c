// The square of the length of a vector with two components, at each of four points.
#include <ceed.h>
#include <stdio.h>

enum { num_points = 4 };

// Component c of point q is in[i][c * Q + q]; the views give the arrays their two dimensions.
CEED_QFUNCTION(length_squared)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar(*u)[CEED_Q_VLA] = (const CeedScalar(*)[CEED_Q_VLA])in[0];
  CeedScalar *v = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) v[q] = u[0][q] * u[0][q] + u[1][q] * u[1][q];
  return CEED_ERROR_SUCCESS;
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  // The macro made length_squared_loc: where the source is, for backends that compile it for a device.
  CeedQFunction qf;
  CeedQFunctionCreateInterior(ceed, 1, length_squared, length_squared_loc, &qf);
  CeedQFunctionAddInput(qf, "u", 2, CEED_EVAL_INTERP);
  CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_NONE);

  // Operators call it; so may a program.
  CeedScalar values[2 * num_points] = {3, 5, 8, 1, 4, 12, 15, 1};
  CeedVector u, v;
  CeedVectorCreate(ceed, 2 * num_points, &u);
  CeedVectorSetArray(u, CEED_MEM_HOST, CEED_COPY_VALUES, values);
  CeedVectorCreate(ceed, num_points, &v);
  CeedQFunctionApply(qf, num_points, &u, &v);

  const CeedScalar *squares;
  CeedVectorGetArrayRead(v, CEED_MEM_HOST, &squares);
  printf("squares %g %g %g %g\n", squares[0], squares[1], squares[2], squares[3]);
  CeedVectorRestoreArrayRead(v, &squares);

  CeedVectorDestroy(&u);
  CeedVectorDestroy(&v);
  CeedQFunctionDestroy(&qf);
  CeedDestroy(&ceed);
  return 0;
}
