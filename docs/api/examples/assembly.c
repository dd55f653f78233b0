// The mass matrix of two linear elements of length 6: each adds (2 1; 1 2) to the matrix.
#include <ceed.h>
#include <stdio.h>
#include <stdlib.h>

enum { num_elem = 2, num_nodes = 3, num_qpts = 2 };

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  const CeedInt nodes_of[num_elem * 2] = {0, 1, 1, 2};
  CeedElemRestriction restriction, restriction_q;
  CeedElemRestrictionCreate(ceed, num_elem, 2, 1, 1, num_nodes, CEED_MEM_HOST, CEED_COPY_VALUES, nodes_of,
                            &restriction);
  CeedElemRestrictionCreateStrided(ceed, num_elem, num_qpts, 1, num_elem * num_qpts, CEED_STRIDES_BACKEND,
                                   &restriction_q);
  CeedBasis basis;
  CeedBasisCreateTensorH1Lagrange(ceed, 1, 1, 2, num_qpts, CEED_GAUSS, &basis);

  // Weight times length over that of the reference element, at both points: 1 * 6 / 2.
  CeedVector q_data;
  CeedVectorCreate(ceed, num_elem * num_qpts, &q_data);
  CeedVectorSetValue(q_data, 3);
  CeedQFunction qf;
  CeedOperator op;
  CeedQFunctionCreateInteriorByName(ceed, "MassApply", &qf);
  CeedOperatorCreate(ceed, qf, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, &op);
  CeedOperatorSetField(op, "u", restriction, basis, CEED_VECTOR_ACTIVE);
  CeedOperatorSetField(op, "qdata", restriction_q, CEED_BASIS_NONE, q_data);
  CeedOperatorSetField(op, "v", restriction, basis, CEED_VECTOR_ACTIVE);

  const CeedScalar *values;
  CeedVector diagonal;
  CeedVectorCreate(ceed, num_nodes, &diagonal);
  CeedOperatorLinearAssembleDiagonal(op, diagonal, CEED_REQUEST_IMMEDIATE);
  CeedVectorGetArrayRead(diagonal, CEED_MEM_HOST, &values);
  printf("diagonal %.6f %.6f %.6f\n", values[0], values[1], values[2]);
  CeedVectorRestoreArrayRead(diagonal, &values);

  // All entries of both elements, each with its row and column; those of the node in the middle are to be added.
  CeedSize num_entries;
  CeedInt *rows, *cols;
  CeedVector entries;
  CeedScalar matrix[num_nodes][num_nodes] = {{0}};
  CeedOperatorLinearAssembleSymbolic(op, &num_entries, &rows, &cols);
  CeedVectorCreate(ceed, num_entries, &entries);
  CeedOperatorLinearAssemble(op, entries);
  CeedVectorGetArrayRead(entries, CEED_MEM_HOST, &values);
  for (CeedSize k = 0; k < num_entries; k++) matrix[rows[k]][cols[k]] += values[k];
  CeedVectorRestoreArrayRead(entries, &values);
  printf("%td entries\n", num_entries);
  for (int i = 0; i < num_nodes; i++) printf("%.6f %.6f %.6f\n", matrix[i][0], matrix[i][1], matrix[i][2]);
  free(rows);
  free(cols);

  CeedVectorDestroy(&entries);
  CeedVectorDestroy(&diagonal);
  CeedOperatorDestroy(&op);
  CeedQFunctionDestroy(&qf);
  CeedVectorDestroy(&q_data);
  CeedBasisDestroy(&basis);
  CeedElemRestrictionDestroy(&restriction_q);
  CeedElemRestrictionDestroy(&restriction);
  CeedDestroy(&ceed);
  return 0;
}
