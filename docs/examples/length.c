// Measures the unit interval with a mass operator: eight elements of degree three, L = 1ᵀ M 1.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 8, degree = 3, p_1d = degree + 1, q_1d = degree + 2, num_nodes = num_elem * degree + 1 };

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  // The ends of the elements, and which nodes each element has.
  CeedScalar x[num_elem + 1];
  CeedInt ends_of[num_elem * 2], nodes_of[num_elem * p_1d];
  for (CeedInt i = 0; i <= num_elem; i++) x[i] = (CeedScalar)i / num_elem;
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt i = 0; i < 2; i++) ends_of[e * 2 + i] = e + i;
    for (CeedInt i = 0; i < p_1d; i++) nodes_of[e * p_1d + i] = e * degree + i;
  }
  CeedElemRestriction restriction_x, restriction_u, restriction_q;
  CeedElemRestrictionCreate(ceed, num_elem, 2, 1, 1, num_elem + 1, CEED_MEM_HOST, CEED_USE_POINTER, ends_of,
                            &restriction_x);
  CeedElemRestrictionCreate(ceed, num_elem, p_1d, 1, 1, num_nodes, CEED_MEM_HOST, CEED_USE_POINTER, nodes_of,
                            &restriction_u);
  CeedElemRestrictionCreateStrided(ceed, num_elem, q_1d, 1, num_elem * q_1d, CEED_STRIDES_BACKEND, &restriction_q);
  CeedBasis basis_x, basis_u;
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, q_1d, CEED_GAUSS, &basis_x);
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, p_1d, q_1d, CEED_GAUSS, &basis_u);

  // Set up: the length that each quadrature point stands for.
  CeedVector coordinates, q_data;
  CeedVectorCreate(ceed, num_elem + 1, &coordinates);
  CeedVectorSetArray(coordinates, CEED_MEM_HOST, CEED_USE_POINTER, x);
  CeedVectorCreate(ceed, num_elem * q_1d, &q_data);
  CeedQFunction build_qf, mass_qf;
  CeedQFunctionCreateInteriorByName(ceed, "Mass1DBuild", &build_qf);
  CeedOperator build, mass;
  CeedOperatorCreate(ceed, build_qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &build);
  CeedOperatorSetField(build, "dx", restriction_x, basis_x, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(build, "weights", CEED_ELEMRESTRICTION_NONE, basis_x, CEED_VECTOR_NONE);
  CeedOperatorSetField(build, "qdata", restriction_q, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE);
  CeedOperatorApply(build, coordinates, q_data, CEED_REQUEST_IMMEDIATE);

  // Apply: v = M u.
  CeedQFunctionCreateInteriorByName(ceed, "MassApply", &mass_qf);
  CeedOperatorCreate(ceed, mass_qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &mass);
  CeedOperatorSetField(mass, "u", restriction_u, basis_u, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(mass, "qdata", restriction_q, CEED_BASIS_NONE, q_data);
  CeedOperatorSetField(mass, "v", restriction_u, basis_u, CEED_VECTOR_ACTIVE);
  CeedVector u, v;
  CeedVectorCreate(ceed, num_nodes, &u);
  CeedVectorCreate(ceed, num_nodes, &v);
  CeedVectorSetValue(u, 1);
  CeedOperatorApply(mass, u, v, CEED_REQUEST_IMMEDIATE);

  const CeedScalar *values;
  CeedScalar length = 0;
  CeedVectorGetArrayRead(v, CEED_MEM_HOST, &values);
  for (CeedInt i = 0; i < num_nodes; i++) length += values[i];
  CeedVectorRestoreArrayRead(v, &values);
  const char *resource;
  CeedGetResource(ceed, &resource);
  printf("length %.15g, on %s\n", length, resource);

  CeedVectorDestroy(&u);
  CeedVectorDestroy(&v);
  CeedOperatorDestroy(&mass);
  CeedOperatorDestroy(&build);
  CeedQFunctionDestroy(&mass_qf);
  CeedQFunctionDestroy(&build_qf);
  CeedVectorDestroy(&q_data);
  CeedVectorDestroy(&coordinates);
  CeedBasisDestroy(&basis_u);
  CeedBasisDestroy(&basis_x);
  CeedElemRestrictionDestroy(&restriction_q);
  CeedElemRestrictionDestroy(&restriction_u);
  CeedElemRestrictionDestroy(&restriction_x);
  CeedDestroy(&ceed);
  return length > 1 - 1e-12 && length < 1 + 1e-12 ? 0 : 1;
}
