// Two triangles share an edge. The five unknowns are fluxes through edges; the edge in the middle is an outflow of the
// first triangle and an inflow of the second, which is what its orientation says. What flows out of both adds up to
// what crosses the border.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 2, num_edges = 3, num_qpts = 1, num_fluxes = 5 };

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  // Lowest order, on the triangle (0, 0), (1, 0), (0, 1): the function of an edge is x minus the vertex opposite to it.
  // Its flux through the edge is 1, its divergence 2. One quadrature point, the centre; the area is 1/2.
  const CeedScalar vertices[num_edges][2] = {{0, 0}, {1, 0}, {0, 1}}, centre[2] = {1. / 3, 1. / 3}, area[1] = {0.5};
  CeedScalar interp[2][num_qpts][num_edges], div[num_qpts][num_edges];
  for (int n = 0; n < num_edges; n++) {
    for (int d = 0; d < 2; d++) interp[d][0][n] = centre[d] - vertices[n][d];
    div[0][n] = 2;
  }
  CeedBasis basis;
  CeedBasisCreateHdiv(ceed, CEED_TOPOLOGY_TRIANGLE, 1, num_edges, num_qpts, &interp[0][0][0], &div[0][0], centre, area,
                      &basis);

  // Edge 2 is the one in the middle.
  const CeedInt edges_of[num_elem * num_edges] = {0, 1, 2, 2, 3, 4};
  const bool is_inflow[num_elem * num_edges] = {false, false, false, true, false, false};
  CeedElemRestriction restriction;
  CeedElemRestrictionCreateOriented(ceed, num_elem, num_edges, 1, 1, num_fluxes, CEED_MEM_HOST, CEED_COPY_VALUES,
                                    edges_of, is_inflow, &restriction);

  CeedScalar values[num_fluxes] = {1, 2, 3, 4, 5};
  CeedVector fluxes, by_element, divergence, weights;
  CeedElemRestrictionCreateVector(restriction, &fluxes, &by_element);
  CeedVectorSetArray(fluxes, CEED_MEM_HOST, CEED_COPY_VALUES, values);
  CeedVectorCreate(ceed, num_elem * num_qpts, &divergence);
  CeedVectorCreate(ceed, num_elem * num_qpts, &weights);
  CeedElemRestrictionApply(restriction, CEED_NOTRANSPOSE, fluxes, by_element, CEED_REQUEST_IMMEDIATE);
  CeedBasisApply(basis, num_elem, CEED_NOTRANSPOSE, CEED_EVAL_DIV, by_element, divergence);
  CeedBasisApply(basis, num_elem, CEED_NOTRANSPOSE, CEED_EVAL_WEIGHT, CEED_VECTOR_NONE, weights);

  // The divergence theorem, on each triangle.
  CeedVectorPointwiseMult(divergence, divergence, weights);
  const CeedScalar *outflow;
  CeedVectorGetArrayRead(divergence, CEED_MEM_HOST, &outflow);
  printf("outflow %.6f + %.6f = %.6f\n", outflow[0], outflow[1], outflow[0] + outflow[1]);
  printf("border  %.6f\n", values[0] + values[1] + values[3] + values[4]);
  CeedVectorRestoreArrayRead(divergence, &outflow);

  CeedVectorDestroy(&fluxes);
  CeedVectorDestroy(&by_element);
  CeedVectorDestroy(&divergence);
  CeedVectorDestroy(&weights);
  CeedElemRestrictionDestroy(&restriction);
  CeedBasisDestroy(&basis);
  CeedDestroy(&ceed);
  return 0;
}
