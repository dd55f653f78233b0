// Three elements of two nodes in a row: R takes an L-vector to an E-vector, and its transpose adds up what comes back.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 3, elem_size = 2, num_nodes = 4 };

static void print(const char *name, CeedVector vector) {
  CeedSize length;
  const CeedScalar *values;
  CeedVectorGetLength(vector, &length);
  CeedVectorGetArrayRead(vector, CEED_MEM_HOST, &values);
  printf("%s =", name);
  for (CeedSize i = 0; i < length; i++) printf(" %g", values[i]);
  printf("\n");
  CeedVectorRestoreArrayRead(vector, &values);
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  const CeedInt offsets[num_elem * elem_size] = {0, 1, 1, 2, 2, 3};
  CeedElemRestriction restriction;
  CeedElemRestrictionCreate(ceed, num_elem, elem_size, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, offsets,
                            &restriction);
  CeedVector u, e, sums, multiplicity;
  CeedElemRestrictionCreateVector(restriction, &u, &e);
  CeedElemRestrictionCreateVector(restriction, &sums, NULL);
  CeedElemRestrictionCreateVector(restriction, &multiplicity, NULL);

  CeedScalar values[num_nodes] = {10, 20, 30, 40};
  CeedVectorSetArray(u, CEED_MEM_HOST, CEED_COPY_VALUES, values);
  CeedElemRestrictionApply(restriction, CEED_NOTRANSPOSE, u, e, CEED_REQUEST_IMMEDIATE);
  print("R u", e);

  // The transpose adds, so there must be something to add to.
  CeedVectorSetValue(sums, 0);
  CeedElemRestrictionApply(restriction, CEED_TRANSPOSE, e, sums, CEED_REQUEST_IMMEDIATE);
  print("R^T R u", sums);

  // Divided by how often each node is used, it is u again.
  CeedElemRestrictionGetMultiplicity(restriction, multiplicity);
  print("multiplicity", multiplicity);
  CeedVectorReciprocal(multiplicity);
  CeedVectorPointwiseMult(sums, sums, multiplicity);
  print("their quotient", sums);

  CeedVectorDestroy(&u);
  CeedVectorDestroy(&e);
  CeedVectorDestroy(&sums);
  CeedVectorDestroy(&multiplicity);
  CeedElemRestrictionDestroy(&restriction);
  CeedDestroy(&ceed);
  return 0;
}
