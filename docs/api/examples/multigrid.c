// Two elements on the interval from 0 to 2: degree two above, degree one below. A linear function goes up exactly; the
// operator below is the same mass operator, so both measure the length.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 2, num_qpts = 3, fine_degree = 2, coarse_degree = 1 };

static void make_space(Ceed ceed, CeedInt degree, CeedElemRestriction *restriction, CeedBasis *basis) {
  CeedInt nodes_of[num_elem * (fine_degree + 1)];
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt i = 0; i <= degree; i++) nodes_of[e * (degree + 1) + i] = e * degree + i;
  }
  CeedElemRestrictionCreate(ceed, num_elem, degree + 1, 1, 1, num_elem * degree + 1, CEED_MEM_HOST, CEED_COPY_VALUES,
                            nodes_of, restriction);
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, degree + 1, num_qpts, CEED_GAUSS, basis);
}

static CeedScalar print(const char *name, CeedVector vector) {
  CeedSize length;
  CeedScalar sum = 0;
  const CeedScalar *values;
  CeedVectorGetLength(vector, &length);
  CeedVectorGetArrayRead(vector, CEED_MEM_HOST, &values);
  if (name != NULL) printf("%s", name);
  for (CeedSize i = 0; i < length; i++) {
    sum += values[i];
    if (name != NULL) printf(" %.4f", values[i]);
  }
  if (name != NULL) printf("\n");
  CeedVectorRestoreArrayRead(vector, &values);
  return sum;
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);
  CeedElemRestriction rstr_fine, rstr_coarse, rstr_q;
  CeedBasis basis_fine, basis_coarse;
  make_space(ceed, fine_degree, &rstr_fine, &basis_fine);
  make_space(ceed, coarse_degree, &rstr_coarse, &basis_coarse);

  // Elements have length 1, the reference element 2: weights are halved.
  CeedScalar q_ref[num_qpts], weights[num_qpts], halves[num_elem * num_qpts];
  CeedGaussQuadrature(num_qpts, q_ref, weights);
  for (CeedInt i = 0; i < num_elem * num_qpts; i++) halves[i] = weights[i % num_qpts] / 2;
  const CeedInt strides[3] = {1, num_qpts, num_qpts};
  CeedElemRestrictionCreateStrided(ceed, num_elem, num_qpts, 1, num_elem * num_qpts, strides, &rstr_q);
  CeedVector q_data;
  CeedVectorCreate(ceed, num_elem * num_qpts, &q_data);
  CeedVectorSetArray(q_data, CEED_MEM_HOST, CEED_COPY_VALUES, halves);
  CeedQFunction qf;
  CeedOperator fine, coarse, prolong, restrict_op;
  CeedQFunctionCreateInteriorByName(ceed, "MassApply", &qf);
  CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &fine);
  CeedOperatorSetField(fine, "u", rstr_fine, basis_fine, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(fine, "qdata", rstr_q, CEED_BASIS_NONE, q_data);
  CeedOperatorSetField(fine, "v", rstr_fine, basis_fine, CEED_VECTOR_ACTIVE);

  // One process: nobody else has a share in the nodes.
  CeedVector u_fine, v_fine, u_coarse, v_coarse, shares;
  CeedElemRestrictionCreateVector(rstr_fine, &u_fine, NULL);
  CeedElemRestrictionCreateVector(rstr_fine, &v_fine, NULL);
  CeedElemRestrictionCreateVector(rstr_fine, &shares, NULL);
  CeedElemRestrictionCreateVector(rstr_coarse, &u_coarse, NULL);
  CeedElemRestrictionCreateVector(rstr_coarse, &v_coarse, NULL);
  CeedVectorSetValue(shares, 1);
  CeedOperatorMultigridLevelCreate(fine, shares, rstr_coarse, basis_coarse, &coarse, &prolong, &restrict_op);

  CeedScalar linear[num_elem * coarse_degree + 1] = {10, 20, 30};
  CeedVectorSetArray(u_coarse, CEED_MEM_HOST, CEED_COPY_VALUES, linear);
  CeedOperatorApply(prolong, u_coarse, u_fine, CEED_REQUEST_IMMEDIATE);
  print("prolonged", u_fine);
  CeedVectorSetValue(u_fine, 1);
  CeedOperatorApply(restrict_op, u_fine, u_coarse, CEED_REQUEST_IMMEDIATE);
  print("restricted", u_coarse);

  CeedOperatorApply(fine, u_fine, v_fine, CEED_REQUEST_IMMEDIATE);
  CeedVectorSetValue(u_coarse, 1);
  CeedOperatorApply(coarse, u_coarse, v_coarse, CEED_REQUEST_IMMEDIATE);
  printf("lengths %.12f %.12f\n", print(NULL, v_fine), print(NULL, v_coarse));

  CeedVector *vectors[] = {&u_fine, &v_fine, &u_coarse, &v_coarse, &shares, &q_data};
  CeedOperator *operators[] = {&fine, &coarse, &prolong, &restrict_op};
  CeedElemRestriction *restrictions[] = {&rstr_fine, &rstr_coarse, &rstr_q};
  for (int i = 0; i < 6; i++) CeedVectorDestroy(vectors[i]);
  for (int i = 0; i < 4; i++) CeedOperatorDestroy(operators[i]);
  for (int i = 0; i < 3; i++) CeedElemRestrictionDestroy(restrictions[i]);
  CeedQFunctionDestroy(&qf);
  CeedBasisDestroy(&basis_fine);
  CeedBasisDestroy(&basis_coarse);
  CeedDestroy(&ceed);
  return 0;
}
