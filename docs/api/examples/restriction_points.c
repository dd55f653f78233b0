// Five points in three elements: two, none and three. A vector at points has its components next to each other.
#include <ceed.h>
#include <stdio.h>

enum { num_elem = 3, num_points = 5, num_comp = 2 };

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  // Where the points of each element begin and the last ones end, counted from here; then the points themselves.
  const CeedInt offsets[num_elem + 1 + num_points] = {4, 6, 6, 9, /* points */ 3, 0, 1, 2, 4};
  CeedElemRestriction restriction;
  CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, num_comp, num_points * num_comp, CEED_MEM_HOST,
                                    CEED_COPY_VALUES, offsets, &restriction);

  CeedScalar values[num_points * num_comp];
  for (CeedInt i = 0; i < num_points * num_comp; i++) values[i] = 10 * (i / num_comp) + i % num_comp;
  CeedVector at_points, in_element;
  CeedElemRestrictionCreateVector(restriction, &at_points, NULL);
  CeedVectorSetArray(at_points, CEED_MEM_HOST, CEED_COPY_VALUES, values);

  for (CeedInt elem = 0; elem < num_elem; elem++) {
    CeedInt num_points_here;
    CeedElemRestrictionGetNumPointsInElement(restriction, elem, &num_points_here);
    CeedVectorCreate(ceed, num_points_here * num_comp, &in_element);
    CeedElemRestrictionApplyAtPointsInElement(restriction, elem, CEED_NOTRANSPOSE, at_points, in_element,
                                              CEED_REQUEST_IMMEDIATE);
    printf("element %d, %d points:", elem, num_points_here);
    if (num_points_here > 0) {
      const CeedScalar *here;
      CeedVectorGetArrayRead(in_element, CEED_MEM_HOST, &here);
      for (CeedInt i = 0; i < num_points_here * num_comp; i++) printf(" %g", here[i]);
      CeedVectorRestoreArrayRead(in_element, &here);
    }
    printf("\n");
    CeedVectorDestroy(&in_element);
  }

  CeedVectorDestroy(&at_points);
  CeedElemRestrictionDestroy(&restriction);
  CeedDestroy(&ceed);
  return 0;
}
