// Masses at points are shared out to the nodes of linear elements: m_i = sum over points N_i(X_p) m_p. Then the points
// move, and one of them changes its element.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 2, num_nodes = 3, num_points = 4 };

// What is given to the basis functions is the mass itself.
CEED_QFUNCTION(share_out)
(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar *mass = in[0];
  CeedScalar *shares = out[0];

  (void)ctx;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) shares[q] = mass[q];
  return CEED_ERROR_SUCCESS;
}

static void apply_and_print(CeedOperator op, CeedVector mass, CeedVector nodal) {
  const CeedScalar *values;
  CeedOperatorApply(op, mass, nodal, CEED_REQUEST_IMMEDIATE);
  CeedVectorGetArrayRead(nodal, CEED_MEM_HOST, &values);
  printf("%.3f + %.3f + %.3f = %.3f\n", values[0], values[1], values[2], values[0] + values[1] + values[2]);
  CeedVectorRestoreArrayRead(nodal, &values);
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  // Three points in the first element, one in the second; reference coordinates are in [-1, 1].
  const CeedInt nodes_of[num_elem * 2] = {0, 1, 1, 2}, points_of[num_elem + 1 + num_points] = {3, 6, 7, 0, 1, 2, 3};
  CeedScalar X[num_points] = {-1, 0, 0.5, -0.5}, masses[num_points] = {1, 2, 4, 8};
  CeedElemRestriction restriction, restriction_points;
  CeedElemRestrictionCreate(ceed, num_elem, 2, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, nodes_of,
                            &restriction);
  CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, 1, num_points, CEED_MEM_HOST, CEED_COPY_VALUES,
                                    points_of, &restriction_points);
  CeedBasis basis;
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, 2, CEED_GAUSS, &basis);
  CeedVector places, mass, nodal;
  CeedVectorCreate(ceed, num_points, &places);
  CeedVectorSetArray(places, CEED_MEM_HOST, CEED_COPY_VALUES, X);
  CeedVectorCreate(ceed, num_points, &mass);
  CeedVectorSetArray(mass, CEED_MEM_HOST, CEED_COPY_VALUES, masses);
  CeedVectorCreate(ceed, num_nodes, &nodal);

  CeedQFunction qf;
  CeedQFunctionCreateInterior(ceed, 1, share_out, share_out_loc, &qf);
  CeedQFunctionAddInput(qf, "mass", 1, CEED_EVAL_NONE);
  CeedQFunctionAddOutput(qf, "shares", 1, CEED_EVAL_INTERP);
  CeedOperator op;
  CeedOperatorCreateAtPoints(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op);
  CeedOperatorSetField(op, "mass", restriction_points, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(op, "shares", restriction, basis, CEED_VECTOR_ACTIVE);
  CeedOperatorAtPointsSetPoints(op, restriction_points, places);
  apply_and_print(op, mass, nodal);

  // The third point goes to the second element. Its vectors keep their order; what is stored at points is set again.
  const CeedInt points_after[num_elem + 1 + num_points] = {3, 5, 7, 0, 1, 2, 3};
  const CeedScalar X_after[num_points] = {0, 0.5, -1, 0};
  CeedElemRestriction restriction_after;
  CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, 1, num_points, CEED_MEM_HOST, CEED_COPY_VALUES,
                                    points_after, &restriction_after);
  CeedVectorSetArray(places, CEED_MEM_HOST, CEED_COPY_VALUES, (CeedScalar *)X_after);
  CeedOperatorAtPointsSetPoints(op, restriction_after, places);
  CeedOperatorSetField(op, "mass", restriction_after, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE);
  apply_and_print(op, mass, nodal);

  CeedOperatorDestroy(&op);
  CeedQFunctionDestroy(&qf);
  CeedVectorDestroy(&places);
  CeedVectorDestroy(&mass);
  CeedVectorDestroy(&nodal);
  CeedBasisDestroy(&basis);
  CeedElemRestrictionDestroy(&restriction);
  CeedElemRestrictionDestroy(&restriction_points);
  CeedElemRestrictionDestroy(&restriction_after);
  CeedDestroy(&ceed);
  return 0;
}
