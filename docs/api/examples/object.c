// Handles of any kind, looked at and destroyed by the same functions.
#include <ceed.h>
#include <stdio.h>

static void show_and_destroy(const char *name, CeedObject *object) {
  printf("%s:\n", name);
  CeedObjectSetNumViewTabs(*object, 1);
  CeedObjectView(*object, stdout);
  CeedObjectDestroy(object);
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  const CeedInt offsets[] = {0, 1, 1, 2};
  CeedVector vector;
  CeedElemRestriction restriction;
  CeedVectorCreate(ceed, 2, &vector);
  CeedVectorSetValue(vector, 0.5);
  CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, &restriction);

  show_and_destroy("a vector", (CeedObject *)&vector);
  show_and_destroy("a restriction", (CeedObject *)&restriction);
  if (vector == NULL && restriction == NULL) printf("both are gone\n");

  CeedDestroy(&ceed);
  return 0;
}
