/* A program that knows nothing of the tree that the library comes from: the mass operator of the interval [0, 2] with a
   QFunction of its own, with one of the gallery, and with the gallery's source compiled in. */
#include <ceed.h>
#include <gallery/mass_apply.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define NUM_ELEM 4
#define P_1D 3
#define Q_1D 4
#define NUM_NODES (NUM_ELEM * (P_1D - 1) + 1)

static void check(int code, const char *what) {
  if (code == 0) return;
  fprintf(stderr, "%s returned %d\n", what, code);
  exit(1);
}

CEED_QFUNCTION(scaled_weight)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar half_h = *(const CeedScalar *)ctx;
  for (CeedInt i = 0; i < Q; i++) out[0][i] = half_h * in[0][i];
  return CEED_ERROR_SUCCESS;
}

static CeedScalar total(CeedOperator op, CeedVector u, CeedVector v) {
  CeedScalar sum = 0;
  const CeedScalar *array;
  check(CeedOperatorApply(op, u, v, CEED_REQUEST_IMMEDIATE), "CeedOperatorApply");
  check(CeedVectorGetArrayRead(v, CEED_MEM_HOST, &array), "CeedVectorGetArrayRead");
  for (int i = 0; i < NUM_NODES; i++) sum += array[i];
  check(CeedVectorRestoreArrayRead(v, &array), "CeedVectorRestoreArrayRead");
  return sum;
}

int main(int argc, char **argv) {
  const char *request = argc > 1 ? argv[1] : "/cpu/self";
  Ceed ceed;
  check(CeedInit(request, &ceed), "CeedInit");
  int major = 0, minor = 0, num_applications = 0;
  check(CeedGetVersion(&major, &minor, NULL, NULL), "CeedGetVersion");
  if (major != CEED_VERSION_MAJOR || minor != CEED_VERSION_MINOR) {
    fprintf(stderr, "the library is %d.%d, its header %d.%d\n", major, minor, CEED_VERSION_MAJOR, CEED_VERSION_MINOR);
    return 1;
  }

  CeedInt offsets[NUM_ELEM * P_1D];
  const CeedInt strides[3] = {1, Q_1D, Q_1D};
  for (int e = 0; e < NUM_ELEM; e++) {
    for (int n = 0; n < P_1D; n++) offsets[e * P_1D + n] = e * (P_1D - 1) + n;
  }
  CeedElemRestriction rstr_u, rstr_q;
  CeedBasis basis;
  check(CeedElemRestrictionCreate(ceed, NUM_ELEM, P_1D, 1, 1, NUM_NODES, CEED_MEM_HOST, CEED_USE_POINTER, offsets,
                                  &rstr_u), "CeedElemRestrictionCreate");
  check(CeedElemRestrictionCreateStrided(ceed, NUM_ELEM, Q_1D, 1, NUM_ELEM * Q_1D, strides, &rstr_q),
        "CeedElemRestrictionCreateStrided");
  check(CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, P_1D, Q_1D, CEED_GAUSS, &basis), "CeedBasisCreateTensorH1Lagrange");
  CeedVector u, v, q_data;
  check(CeedVectorCreate(ceed, NUM_NODES, &u), "CeedVectorCreate");
  check(CeedVectorCreate(ceed, NUM_NODES, &v), "CeedVectorCreate");
  check(CeedVectorCreate(ceed, NUM_ELEM * Q_1D, &q_data), "CeedVectorCreate");

  /* The weights times half of the element's length. */
  const CeedScalar half_h = 0.5 * 2.0 / NUM_ELEM;
  CeedQFunctionContext ctx;
  CeedQFunction qf_setup;
  CeedOperator op_setup;
  check(CeedQFunctionContextCreate(ceed, &ctx), "CeedQFunctionContextCreate");
  check(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof half_h, (void *)&half_h),
        "CeedQFunctionContextSetData");
  check(CeedQFunctionCreateInterior(ceed, 1, scaled_weight, scaled_weight_loc, &qf_setup), "CeedQFunctionCreateInterior");
  check(CeedQFunctionAddInput(qf_setup, "w", 1, CEED_EVAL_WEIGHT), "CeedQFunctionAddInput");
  check(CeedQFunctionAddOutput(qf_setup, "q", 1, CEED_EVAL_NONE), "CeedQFunctionAddOutput");
  check(CeedQFunctionSetContext(qf_setup, ctx), "CeedQFunctionSetContext");
  check(CeedOperatorCreate(ceed, qf_setup, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op_setup), "CeedOperatorCreate");
  check(CeedOperatorSetField(op_setup, "w", CEED_ELEMRESTRICTION_NONE, basis, CEED_VECTOR_NONE), "CeedOperatorSetField");
  check(CeedOperatorSetField(op_setup, "q", rstr_q, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE), "CeedOperatorSetField");
  check(CeedOperatorApply(op_setup, CEED_VECTOR_NONE, q_data, CEED_REQUEST_IMMEDIATE), "CeedOperatorApply");

  /* The integral of c over [0, 2] is 2 c, by the gallery by name and by its source compiled here. */
  for (int is_own = 0; is_own < 2; is_own++) {
    CeedQFunction qf;
    CeedOperator op;
    if (is_own) {
      check(CeedQFunctionCreateInterior(ceed, 1, MassApply, MassApply_loc, &qf), "CeedQFunctionCreateInterior");
      check(CeedQFunctionAddInput(qf, "u", 1, CEED_EVAL_INTERP), "CeedQFunctionAddInput");
      check(CeedQFunctionAddInput(qf, "qdata", 1, CEED_EVAL_NONE), "CeedQFunctionAddInput");
      check(CeedQFunctionAddOutput(qf, "v", 1, CEED_EVAL_INTERP), "CeedQFunctionAddOutput");
    } else {
      check(CeedQFunctionCreateInteriorByName(ceed, "MassApply", &qf), "CeedQFunctionCreateInteriorByName");
    }
    check(CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op), "CeedOperatorCreate");
    check(CeedOperatorSetField(op, "u", rstr_u, basis, CEED_VECTOR_ACTIVE), "CeedOperatorSetField");
    check(CeedOperatorSetField(op, "qdata", rstr_q, CEED_BASIS_NONE, q_data), "CeedOperatorSetField");
    check(CeedOperatorSetField(op, "v", rstr_u, basis, CEED_VECTOR_ACTIVE), "CeedOperatorSetField");
    for (int c = 1; c <= 4; c++, num_applications++) {
      check(CeedVectorSetValue(u, c), "CeedVectorSetValue");
      const CeedScalar sum = total(op, u, v);
      if (fabs(sum - 2 * c) > 1e-12) {
        fprintf(stderr, "the integral of %d over [0, 2] is %.17g; expected %d\n", c, sum, 2 * c);
        return 1;
      }
    }
    CeedOperatorDestroy(&op);
    CeedQFunctionDestroy(&qf);
  }

  const char *resource;
  check(CeedGetResource(ceed, &resource), "CeedGetResource");
  printf("on %s: %d applications\n", resource, num_applications);
  CeedOperatorDestroy(&op_setup);
  CeedQFunctionDestroy(&qf_setup);
  CeedQFunctionContextDestroy(&ctx);
  CeedVectorDestroy(&u);
  CeedVectorDestroy(&v);
  CeedVectorDestroy(&q_data);
  CeedBasisDestroy(&basis);
  CeedElemRestrictionDestroy(&rstr_u);
  CeedElemRestrictionDestroy(&rstr_q);
  return CeedDestroy(&ceed) ? 1 : 0;
}
